#include "driver/PostProgram.h"

#include "frontend/compost/Check.h"
#include "frontend/compost/Parse.h"
#include "frontend/compost/Summary.h"
#include "support/NearestName.h"

namespace dotek::driver {

namespace compost = frontend::compost;

namespace {

// The syntax tree already holds the repaired reading of these; accepting it changes no tree.
void acceptRepairs(FileId prog, Session& session) {
  for (Diagnostic& d : session.diagnostics().all()) {
    const bool repairable = d.code == diag::OpenIfAtReturn::code || d.code == diag::MissingReturn::code;
    if (!repairable || d.severity != Severity::Error || d.range.file != prog || !d.fix) continue;
    d.severity = Severity::Warning;
    d.message += "; read under --recover as if repaired: " + d.fix->title;
  }
}

std::string routineNames(const compost::Program& program) {
  std::string out;
  for (const compost::Item& item : program.items) {
    if (const auto* routine = std::get_if<compost::Routine>(&item))
      out += (out.empty() ? "`" : ", `") + routine->name + "`";
  }
  return out.empty() ? "none" : out;
}

} // namespace

std::optional<compost::Program> loadProg(const std::string& path, Session& session) {
  const std::optional<FileId> id = session.read(path, Encoding::Cp1250);
  if (!id) return std::nullopt;
  compost::Program program = compost::parse(*id, session.sources(), session.limits(), session.diagnostics());
  if (session.sources().file(*id).bytes().find_first_not_of(" \t\r\n") == std::string::npos) {
    session.diagnostics().report<diag::EmptyFile>({*id, 0, 0}, path);
    return std::nullopt;
  }
  compost::check(program, session.compostKeywords(), session.sources(), session.diagnostics());
  if (session.options().recover) acceptRepairs(*id, session);
  return program;
}

const compost::Routine* chooseRoutine(const compost::Program& program,
                                      const std::optional<std::string>& named, SourceRange namedAt,
                                      const std::string& cycle, Session& session) {
  Diagnostics& diagnostics = session.diagnostics();
  if (named) {
    const compost::Routine* routine = compost::findRoutine(program, *named);
    if (routine == nullptr) {
      diagnostics.report<diag::NoSuchRoutine>(namedAt, *named, session.sources().file(program.file).name(),
                                              routineNames(program));
    }
    return routine;
  }
  const auto found = compost::printingRoutines(program, session.compostKeywords(), cycle);
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    std::string ids;
    for (const std::string& id : compost::cycleIds(program))
      ids += (ids.empty() ? "`" : ", `") + id + "`";
    diagnostics.report<diag::NoRoutineForCycle>({program.file, 0, 0}, cycle, ids.empty() ? "no cycle" : ids);
    return nullptr;
  }
  std::string names;
  for (const compost::Routine* routine : found)
    names += (names.empty() ? "`" : ", `") + routine->name + "`";
  Diagnostic& several = diagnostics.report<diag::SeveralRoutines>(found.front()->nameRange, cycle, names);
  for (const compost::Routine* routine : found)
    several.note(routine->nameRange, "`" + routine->name + "` prints for it");
  return nullptr;
}

} // namespace dotek::driver
