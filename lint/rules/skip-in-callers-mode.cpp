#include "ir/Dataflow.h"
#include "ir/Evaluate.h"
#include "ir/Rewrite.h"
#include "lint/Lathe.h"
#include "lint/NcProgram.h"

#include <algorithm>
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

constexpr std::uint32_t kModeOfCaller = 4003; // #4003
constexpr double kAbsolute = 90, kIncremental = 91;

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

// The mode before a statement.
struct Mode {
  DistanceMode mode = DistanceMode::AsBefore;
  bool asked = false; // an IF has found it in force: no block states it
  bool operator==(const Mode&) const = default;
};

// What the way to `to` says of the mode of the caller; nothing: not more than before.
std::optional<Mode> askedOn(const ir::ProgramStatement& statement, bool holds,
                            const std::set<std::uint32_t>& copies) {
  const auto* branch = std::get_if<ir::Branch>(&statement.node);
  if (branch == nullptr || !branch->condition) return std::nullopt;
  const auto passes = [&](double mode) {
    bool asks = false;
    const ir::ConditionPtr condition =
        ir::rewrite(branch->condition, [&](const ir::ExpressionPtr& node) -> ir::ExpressionPtr {
          const auto number = variableNumber(*node);
          if (!number || !copies.contains(*number)) return node;
          asks = true;
          return ir::constant(mode);
        });
    return !asks || ir::holds(*condition, {}).value_or(holds) == holds;
  };
  const bool absolute = passes(kAbsolute), incremental = passes(kIncremental);
  if (absolute == incremental) return std::nullopt;
  return Mode{absolute ? DistanceMode::Absolute : DistanceMode::Incremental, true};
}

void checkProgram(const NcProgram& nc, const Others& others, Report& report) {
  const ir::Program& program = nc.program;
  // Its callers are read, and state the mode that it goes by.
  if (others.called.contains(static_cast<std::uint32_t>(program.number))) return;
  const auto goesByCaller = [&](std::size_t at) {
    return axesOf(std::get<ir::NcBlock>(program.body[at].node)) != 0 && !statedMode(program.body[at]);
  };
  if (std::none_of(nc.skips().begin(), nc.skips().end(), goesByCaller)) return;
  const std::set<std::uint32_t> copies = copiesOfMode(program);
  const auto stated = ir::factsBefore<Mode>(
      program.body, nc.flow(), Mode{},
      [&](std::size_t at, std::size_t to, Mode mode) {
        const ir::ProgramStatement& statement = program.body[at];
        // A subprogram may be there to set modes.
        if (callOf(statement) != nullptr)
          return others.quiet.contains(calledBy(statement)) ? mode : Mode{DistanceMode::Unknown, false};
        if (const auto own = statedMode(statement)) return Mode{*own, false};
        if (mode.mode != DistanceMode::AsBefore) return mode;
        return askedOn(statement, to != at + 1, copies).value_or(mode);
      },
      [](Mode& into, const Mode& other) {
        if (into == other || into.mode == DistanceMode::Unknown) return false;
        const auto ofCaller = [](const Mode& one) { return one.asked || one.mode == DistanceMode::AsBefore; };
        const Mode before = into;
        // Both ways from the IF together: it is one or the other again.
        into =
            Mode{ofCaller(into) && ofCaller(other) ? DistanceMode::AsBefore : DistanceMode::Unknown, false};
        return into != before;
      });
  Diagnostic* first = nullptr; // the mode that is missing is one cause for all of them
  for (const std::size_t i : nc.skips()) {
    if (!goesByCaller(i) || !stated[i] || stated[i]->mode != DistanceMode::AsBefore) continue;
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
  const Lathes& lathes = lathesOf(project);
  for (const auto& nc : programsOf(project))
    if (!lathes.contains(&nc->file)) checkProgram(*nc, others, report);
}

} // namespace

DOTEK_LINT_RULE(skip_in_callers_mode){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
