#include "ir/Dataflow.h"
#include "ir/Walk.h"
#include "lint/Skips.h"

#include <cmath>
#include <set>

namespace dotek::lint::rule {
namespace {

std::uint32_t calledBy(const ir::ProgramStatement& statement) {
  const ir::Call* call = callOf(statement);
  const double* number = call == nullptr || !call->program ? nullptr : ir::constantValue(call->program);
  return number != nullptr && *number >= 1 && *number < 1e8 ? static_cast<std::uint32_t>(std::lround(*number))
                                                            : 0;
}

// What the programs of the files say of one another.
struct Others {
  std::set<std::uint32_t> called; // by one of them
  std::set<std::uint32_t> quiet;  // state no mode and call nothing
};

Others othersOf(const Project& project) {
  Others out;
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    bool quiet = true;
    for (const ir::ProgramStatement& statement : program.body) {
      if (const std::uint32_t number = calledBy(statement); number != 0 && number != program.number)
        out.called.insert(number);
      quiet = quiet && callOf(statement) == nullptr && !statedMode(statement);
    }
    if (quiet) out.quiet.insert(static_cast<std::uint32_t>(program.number));
  });
  return out;
}

constexpr std::uint32_t kModeOfCaller = 4003; // #4003: 90 or 91

// Variables that hold the mode of the caller: #31=#4003.
std::set<std::uint32_t> copiesOfMode(const ir::Program& program) {
  std::set<std::uint32_t> out{kModeOfCaller};
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* store = std::get_if<ir::Store>(&statement.node);
    const auto number = storedNumber(statement);
    if (store != nullptr && number && variableNumber(*store->value) == kModeOfCaller) out.insert(*number);
  }
  return out;
}

// An IF looks at the mode: what goes on from there knows it.
bool asksMode(const ir::ProgramStatement& statement, const std::set<std::uint32_t>& copies) {
  const ir::ConditionPtr* condition = ir::conditionOf(statement);
  if (condition == nullptr || !*condition) return false;
  bool out = false;
  ir::eachNode(*condition, [&](const ir::Expression& node) {
    if (!std::holds_alternative<ir::MachineVariable>(node.node)) return;
    const auto number = variableNumber(node);
    out = out || (number && copies.contains(*number));
  });
  return out;
}

void checkProgram(const ir::Program& program, const Others& others, Report& report) {
  // Its callers are read, and state the mode that it goes by.
  if (others.called.contains(static_cast<std::uint32_t>(program.number))) return;
  const std::set<std::uint32_t> copies = copiesOfMode(program);
  const auto stated = ir::factsBefore<DistanceMode>(
      program.body, ir::flowOf(program.body), DistanceMode::AsBefore,
      [&](std::size_t at, std::size_t, DistanceMode mode) {
        const ir::ProgramStatement& statement = program.body[at];
        // A subprogram may be there to set modes.
        if (callOf(statement) != nullptr)
          return others.quiet.contains(calledBy(statement)) ? mode : DistanceMode::Unknown;
        if (mode == DistanceMode::AsBefore && asksMode(statement, copies)) return DistanceMode::Unknown;
        return statedMode(statement).value_or(mode);
      },
      [](DistanceMode& into, DistanceMode other) {
        if (into == other || into == DistanceMode::Unknown) return false;
        into = DistanceMode::Unknown;
        return true;
      });
  Diagnostic* first = nullptr; // the mode that is missing is one cause for all of them
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    const ir::NcBlock* skip = skipOf(program.body[i]);
    if (skip == nullptr || axesOf(*skip) == 0 || !stated[i] || *stated[i] != DistanceMode::AsBefore) continue;
    if (statedMode(program.body[i])) continue;
    if (first != nullptr)
      first->note(program.body[i].origin.range(), "and this one");
    else
      first = &report.at(
          program.body[i].origin.range(),
          "neither G90 nor G91 is before this G31; in the other mode of the caller the stylus goes "
          "elsewhere, and the path may be too long; state the mode here");
  }
}

void check(const Project& project, Report& report) {
  const Others others = othersOf(project);
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    checkProgram(program, others, report);
  });
}

} // namespace

DOTEK_LINT_RULE(skip_in_callers_mode){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
