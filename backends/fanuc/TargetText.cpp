#include "backends/fanuc/TargetText.h"

#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"
#include "sim/machine/Compile.h"
#include "support/messages/Verify.h"

namespace dotek::targets {

bool FanucText::read(const std::string& name, std::string text, const stdlib::Control& control,
                     Session& session) {
  const FileId id = sources_.add(SourceFile(name, std::move(text), Encoding::Utf8));
  Diagnostics found;
  const frontend::macrob::File tree = frontend::macrob::parse(id, sources_, session.limits(), found);
  std::optional<ir::ProgramFile> file;
  if (!found.hasErrors()) file = frontend::macrob::lower(tree, control, sources_, found);
  if (!file) {
    for (const Diagnostic& one : found.all())
      if (one.severity == Severity::Error)
        session.diagnostics().report<diag::TranslationNotRead>({}, name, one.message);
    return false;
  }
  files_.push_back(std::move(*file));
  return true;
}

bool FanucText::readTranslation(const Translation& translation, const stdlib::Control& control,
                                Session& session) {
  translation_ = sources_.size();
  return read(translation.name, translation.text, control, session);
}

bool FanucText::readMacros(const stdlib::MacroSet& set, const stdlib::Control& control, Session& session) {
  const stdlib::DataFile* text = session.data().find("macrob", set.name);
  return text == nullptr || read(set.name, std::string(text->text), control, session);
}

void FanucText::compile(const stdlib::Control& control) {
  std::vector<const ir::Program*> programs;
  for (const ir::ProgramFile& file : files_)
    for (const ir::Program& program : file.programs)
      programs.push_back(&program);
  code_ = sim::compile(programs, control, sources_);
}

} // namespace dotek::targets
