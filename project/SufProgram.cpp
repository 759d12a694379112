#include "project/SufProgram.h"

#include "frontend/mikroprog/Check.h"
#include "frontend/mikroprog/Lower.h"
#include "frontend/mikroprog/Parse.h"
#include "project/Settings.h"
#include "support/messages/Commands.h"
#include "support/messages/Mikroprog.h"

namespace dotek::project {

namespace mikroprog = frontend::mikroprog;

namespace {

std::optional<ir::Program> lowered(const mikroprog::Program& tree, const stdlib::MikroprogControl& control,
                                   const SourceMap& sources, Diagnostics& diagnostics) {
  mikroprog::refuse({tree, control, sources}, diagnostics);
  if (diagnostics.hasErrors()) return std::nullopt;
  auto file = mikroprog::lower(tree, sources);
  return file ? std::optional(std::move(file->programs.front())) : std::nullopt;
}

} // namespace

std::optional<stdlib::MikroprogControl> loadMikroprogControl(const std::string& name, Session& session) {
  auto control = stdlib::MikroprogControl::load(session.data(), name);
  if (!control) {
    std::string known;
    for (const stdlib::DataFile* file : session.data().list("mikroprog"))
      known += (known.empty() ? "" : ", ") + file->name;
    session.diagnostics().report<diag::UnknownProfile>({}, name, known);
  }
  return control;
}

std::optional<ir::Program> readSuf(FileId file, const stdlib::MikroprogControl& control,
                                   const SourceMap& sources, Diagnostics& diagnostics) {
  return lowered(mikroprog::parse(file, sources, diagnostics), control, sources, diagnostics);
}

std::optional<SufProgram> loadSuf(const std::string& path, const std::string& control, Session& session) {
  Diagnostics& diagnostics = session.diagnostics();
  const std::optional<FileId> id = session.read(path, Encoding::Cp852);
  if (!id) return std::nullopt;
  const mikroprog::Program tree = mikroprog::parse(*id, session.sources(), diagnostics, session.limits());
  if (diagnostics.hasErrors()) return std::nullopt;
  std::string name = control;
  // dotek.toml may name the control of the other programs of the folder.
  if (name.empty()) name = settingsOf(path, session).control;
  if (control.empty() && session.data().find("mikroprog", name) == nullptr) name.clear();
  if (diagnostics.hasErrors()) return std::nullopt;
  if (name.empty()) name = mikroprog::profileOf(tree).value_or("");
  if (name.empty()) {
    diagnostics.report<diag::ControlNotChosen>({}, path);
    return std::nullopt;
  }
  std::optional<stdlib::MikroprogControl> profile = loadMikroprogControl(name, session);
  if (!profile) return std::nullopt;
  std::optional<ir::Program> program = lowered(tree, *profile, session.sources(), diagnostics);
  if (!program) return std::nullopt;
  return SufProgram{std::move(*profile), std::move(*program)};
}

} // namespace dotek::project
