#include "backends/fanuc/TargetText.h"

#include "sim/machine/Compile.h"
#include "stdlib/MovedSet.h"
#include "support/messages/Verify.h"
#include "targets/ReadBack.h"

#include <algorithm>

namespace dotek::targets {

bool FanucText::read(const std::string& name, std::string text, const stdlib::Control& control,
                     Session& session) {
  Diagnostics found;
  auto file = readBack(name, std::move(text), control, session.limits(), sources_, found);
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

// A program that calls nothing, which has been read before, needs none: not every control reads the text of
// our own macros.
bool FanucText::readMacros(const stdlib::MacroSet& set, const stdlib::Control& control, Session& session) {
  const auto calls = [](const ir::Program& program) {
    return std::any_of(program.body.begin(), program.body.end(), [](const ir::ProgramStatement& one) {
      return std::holds_alternative<ir::Call>(one.node);
    });
  };
  const std::vector<ir::Program>& programs = files_.back().programs;
  if (std::none_of(programs.begin(), programs.end(), calls)) return true;
  const std::optional<std::string> text = stdlib::macroText(session.data(), set.name);
  return !text || read(set.name, *text, control, session);
}

std::map<std::uint32_t, std::uint32_t> FanucText::storesOfTranslation() const {
  constexpr double kFirst = 100, kEnd = 1000;
  std::map<std::uint32_t, std::uint32_t> out;
  for (const ir::ProgramFile& file : files_)
    for (const ir::Program& program : file.programs)
      for (const ir::ProgramStatement& statement : program.body) {
        const auto* store = std::get_if<ir::Store>(&statement.node);
        const double* number = store != nullptr && store->number ? ir::constantValue(store->number) : nullptr;
        const std::uint32_t at = line(statement.origin.range());
        if (number != nullptr && *number >= kFirst && *number < kEnd && at != 0)
          out.emplace(static_cast<std::uint32_t>(*number), at);
      }
  return out;
}

void FanucText::compile(const stdlib::Control& control) {
  std::vector<const ir::Program*> programs;
  for (const ir::ProgramFile& file : files_)
    for (const ir::Program& program : file.programs)
      programs.push_back(&program);
  code_ = sim::compile(programs, control, sources_);
  safe_ = sim::safeMoves(programs, control);
}

} // namespace dotek::targets
