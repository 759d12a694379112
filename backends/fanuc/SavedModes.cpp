#include "backends/fanuc/SavedModes.h"

#include "ir/Dataflow.h"

#include <cmath>
#include <tuple>
#include <utility>

namespace dotek::backends::fanuc {

namespace {

constexpr std::uint32_t kGroups = 30; // that programs can read

// The number of a variable that is named; nothing: another expression, or a computed number.
std::optional<std::uint32_t> variableOf(const ir::ExpressionPtr& value) {
  const auto* use = value ? std::get_if<ir::MachineVariable>(&value->node) : nullptr;
  const double* number = use == nullptr || !use->number ? nullptr : ir::constantValue(use->number);
  if (number == nullptr || *number < 0 || *number > 99999999) return std::nullopt;
  return static_cast<std::uint32_t>(std::lround(*number));
}

std::optional<std::uint32_t> numberOf(const ir::Store& store) {
  const double* number = store.number ? ir::constantValue(store.number) : nullptr;
  if (number == nullptr || *number < 0 || *number > 99999999) return std::nullopt;
  return static_cast<std::uint32_t>(std::lround(*number));
}

// #4001 to #4099; 0: the control has none.
std::pair<std::uint32_t, std::uint32_t> modesOf(const stdlib::Control& control) {
  if (!control.variables.modalFirst) return {0, 0};
  const auto first = static_cast<std::uint32_t>(*control.variables.modalFirst) + 1;
  return {first, first + kGroups - 1};
}

// Adds what the program writes into variables that `wanted` names.
template <class Wanted>
void addWritten(ModeVariables& out, const ir::Program& program, const stdlib::Control& control,
                const Wanted& wanted) {
  const auto [first, last] = modesOf(control);
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* store = std::get_if<ir::Store>(&statement.node);
    const auto number = store == nullptr ? std::nullopt : numberOf(*store);
    if (!number || !wanted(*number)) continue;
    const auto read = variableOf(store->value);
    (read && *read >= first && *read <= last ? out.modes : out.others).insert(*number);
  }
}

} // namespace

ModeVariables modeVariables(const ir::ProgramFile& file, const stdlib::Control& control) {
  ModeVariables out;
  if (!control.variables.modalFirst) return out;
  for (const ir::Program& program : file.programs)
    addWritten(out, program, control, [&](std::uint32_t number) { return number > control.locals; });
  for (const std::uint32_t number : out.others)
    out.modes.erase(number);
  return out;
}

SavedModes::SavedModes(const ir::Program& program, const ModeVariables& common,
                       const stdlib::Control& control) {
  std::tie(first_, last_) = modesOf(control);
  if (first_ == 0) return;
  ModeVariables own;
  addWritten(own, program, control, [&](std::uint32_t number) { return number <= control.locals; });
  for (const std::uint32_t number : own.others)
    own.modes.erase(number);
  if (own.modes.empty() && common.modes.empty()) return;
  const auto after = [&](std::size_t at, std::size_t, ir::NumberSet fact) {
    const ir::ProgramStatement& statement = program.body[at];
    const auto* store = std::get_if<ir::Store>(&statement.node);
    const auto number = store == nullptr || statement.blockDelete != 0 ? std::nullopt : numberOf(*store);
    if (number && (own.modes.contains(*number) || common.modes.contains(*number))) fact.insert(*number);
    return fact;
  };
  set_ = ir::factsBefore<ir::NumberSet>(
      program.body, {}, after,
      [](ir::NumberSet& into, const ir::NumberSet& other) { return into.intersect(other); });
}

bool SavedModes::restores(const ir::ExpressionPtr& value, std::size_t at) const {
  const auto number = variableOf(value);
  if (!number || first_ == 0) return false;
  if (*number >= first_ && *number <= last_) return true;
  return at < set_.size() && set_[at] && set_[at]->contains(*number);
}

} // namespace dotek::backends::fanuc
