#include "project/Prog.h"

#include "frontend/compost/Check.h"
#include "frontend/compost/Parse.h"
#include "frontend/compost/Summary.h"
#include "frontend/gibbs/Check.h"
#include "project/Inputs.h"
#include "support/NearestName.h"
#include "support/messages/ComPost.h"
#include "support/messages/Commands.h"
#include "support/messages/Gibbs.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace dotek::project {

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

std::string quotedList(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names)
    out += (out.empty() ? "`" : ", `") + name + "`";
  return out;
}

std::string routineNames(const compost::Program& program) {
  std::vector<std::string> names;
  for (const compost::Item& item : program.items) {
    if (const auto* routine = std::get_if<compost::Routine>(&item)) names.push_back(routine->name);
  }
  return names.empty() ? "none" : quotedList(names);
}

// Words of conditions that ask for the cycle and are not spelt CycleType?; each once.
void findMisspelt(const compost::Condition& condition, const std::string& cycle,
                  std::vector<std::string>& out) {
  constexpr std::string_view kWord = "CycleType";
  constexpr std::size_t kMost = 2;
  for (const compost::ConditionTerm& term : condition.terms) {
    if (const auto* inner = std::get_if<std::unique_ptr<compost::Condition>>(&term.operand))
      findMisspelt(**inner, cycle, out);
    const auto* word = std::get_if<compost::Word>(&term.operand);
    const bool asks = word != nullptr && word->kind == compost::WordKind::Boolean && word->name != kWord &&
                      word->arguments.size() == 1 && word->arguments.front().text == cycle;
    if (asks && nameDistance(word->name, kWord, kMost) <= kMost &&
        std::find(out.begin(), out.end(), word->name) == out.end())
      out.push_back(word->name);
  }
}

void findMisspelt(const std::vector<compost::Statement>& statements, const std::string& cycle,
                  std::vector<std::string>& out) {
  for (const compost::Statement& statement : statements) {
    const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement);
    if (branch == nullptr) continue;
    findMisspelt((*branch)->condition, cycle, out);
    findMisspelt((*branch)->thenBody, cycle, out);
    findMisspelt((*branch)->elseBody, cycle, out);
  }
}

// A name that differs in one letter comes before one that begins alike, which is another cycle's.
std::string nearestCycle(const std::string& cycle, const std::vector<std::string>& ids) {
  const std::string near = nearestName(cycle, ids);
  if (!near.empty() && nameDistance(near, cycle, 1) <= 1) return near;
  const auto slip = std::find_if(ids.begin(), ids.end(),
                                 [&](const std::string& id) { return nameDistance(id, cycle, 1) == 1; });
  return slip != ids.end() ? *slip : near;
}

} // namespace

std::string testedCycles(const compost::Program& program, const std::string& cycle) {
  std::vector<std::string> misspelt;
  for (const compost::Item& item : program.items)
    if (const auto* routine = std::get_if<compost::Routine>(&item))
      findMisspelt(routine->body, cycle, misspelt);
  const std::vector<std::string> ids = compost::cycleIds(program);
  std::string out = ids.empty() ? "the Prog tests for no cycle" : "the Prog tests for " + quotedList(ids);
  if (!misspelt.empty())
    return out +
           fmt::format("; did you mean `CycleType?` where it says `{}?('{}')`?", misspelt.front(), cycle);
  const std::string near = nearestCycle(cycle, ids);
  return out + (near.empty() ? "" : "; did you mean `--cycle " + near + "`?");
}

std::optional<compost::Program> loadProg(const std::string& path, Session& session, bool checked) {
  const Recognition* const kind = session.kindOf(path, session.diagnostics(), InputKind::Prog);
  if (kind == nullptr) return std::nullopt;
  const std::optional<FileId> id = session.read(path, Encoding::Cp1250);
  if (!id) return std::nullopt;
  if (session.sources().file(*id).bytes().empty()) {
    session.diagnostics().report<diag::EmptyProg>({*id, 0, 0}, path);
    return std::nullopt;
  }
  // --from is about the inputs, and a Prog is named by a flag of its own.
  if (!session.options().from && !kindAmong(path, {InputKind::Prog}, "a Prog of ComPost", session))
    return std::nullopt;
  compost::Program program = compost::parse(*id, session.sources(), session.limits(), session.diagnostics());
  if (session.sources().file(*id).bytes().find_first_not_of(" \t\r\n") == std::string::npos) {
    session.diagnostics().report<diag::EmptyFile>({*id, 0, 0}, path);
    return std::nullopt;
  }
  if (checked) compost::check(program, session.compostKeywords(), session.sources(), session.diagnostics());
  if (session.options().recover) acceptRepairs(*id, session);
  return program;
}

const compost::Routine* chooseRoutine(const compost::Program& program,
                                      const std::optional<std::string>& named, SourceRange namedAt,
                                      const std::string& cycle, Session& session) {
  Diagnostics& diagnostics = session.diagnostics();
  if (named) {
    const compost::Routine* chosen = compost::findRoutine(program, *named);
    if (chosen == nullptr) {
      diagnostics.report<diag::NoSuchRoutine>(namedAt, *named, session.sources().file(program.file).name(),
                                              routineNames(program));
    }
    return chosen;
  }
  const auto found = compost::printingRoutines(program, session.compostKeywords(), cycle);
  if (found.empty()) {
    diagnostics.report<diag::NoRoutineForCycle>({program.file, 0, 0}, cycle, testedCycles(program, cycle));
    return nullptr;
  }
  if (found.size() == 1) return found.front();
  std::vector<std::string> names;
  for (const compost::Routine* routine : found)
    names.push_back(routine->name);
  Diagnostic& several =
      diagnostics.report<diag::SeveralRoutines>(found.front()->nameRange, cycle, quotedList(names));
  for (const compost::Routine* routine : found)
    several.note(routine->nameRange, "`" + routine->name + "` prints for it");
  return nullptr;
}

void leaveFindingsToLint(Session& session) {
  auto& all = session.diagnostics().all();
  // These change what is posted: a form, a repair, a reading, a value that the user would see differ.
  constexpr std::array kKept = {diag::FormTaken::code, diag::OpenIfAtReturn::code, diag::MissingReturn::code,
                                compost::unverifiedInProgCheck.code,
                                frontend::gibbs::inputOpensWithOtherCheck.code};
  const auto isFinding = [&](const Diagnostic& d) {
    return d.severity != Severity::Error && d.range.hasPlace() &&
           std::find(kKept.begin(), kKept.end(), d.code) == kKept.end();
  };
  const auto warnings = std::count_if(all.begin(), all.end(), [&](const Diagnostic& d) {
    return isFinding(d) && d.severity == Severity::Warning;
  });
  std::erase_if(all, isFinding);
  if (warnings > 0 && !session.diagnostics().hasErrors())
    session.diagnostics().report<diag::WarningsLeftToLint>({}, warnings);
}

} // namespace dotek::project
