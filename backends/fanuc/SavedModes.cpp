#include "backends/fanuc/SavedModes.h"

#include "ir/Dataflow.h"

#include <cmath>

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

} // namespace

SavedModes::SavedModes(const ir::Program& program, const ir::ProgramFile& file,
                       const stdlib::Control& control) {
  if (!control.variables.modalFirst) return;
  first_ = static_cast<std::uint32_t>(*control.variables.modalFirst) + 1;
  last_ = first_ + kGroups - 1;
  std::set<std::uint32_t> others; // hold something else, or may
  const auto isMode = [&](const ir::Store& store) {
    const auto read = variableOf(store.value);
    return read && *read >= first_ && *read <= last_;
  };
  for (const ir::Program& one : file.programs) {
    for (const ir::ProgramStatement& statement : one.body) {
      const auto* store = std::get_if<ir::Store>(&statement.node);
      const auto number = store == nullptr ? std::nullopt : numberOf(*store);
      if (!number) continue;
      const bool local = *number <= control.locals;
      if (local && &one != &program) continue;
      (isMode(*store) ? modes_ : others).insert(*number);
    }
  }
  for (const std::uint32_t number : others)
    modes_.erase(number);
  if (modes_.empty()) return;
  const auto after = [&](std::size_t at, std::size_t, ir::NumberSet fact) {
    const ir::ProgramStatement& statement = program.body[at];
    const auto* store = std::get_if<ir::Store>(&statement.node);
    const auto number = store == nullptr || statement.blockDelete != 0 ? std::nullopt : numberOf(*store);
    if (number && modes_.contains(*number)) fact.insert(*number);
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
