#include "targets/SelectedSystems.h"

#include <cmath>
#include <map>
#include <optional>

namespace dotek::targets {

namespace {

bool mayMove(const ir::Call& call, const std::set<std::uint32_t>& switches) {
  const double* program = call.program == nullptr ? nullptr : ir::constantValue(call.program);
  return program == nullptr || *program < 1 || *program > 99999999 ||
         !switches.contains(static_cast<std::uint32_t>(*program));
}

// A code whose axis words are no move in the active work system.
bool movesElsewhere(const stdlib::CodeInfo& code) {
  using stdlib::Function;
  switch (code.function) {
  case Function::DataInput:
  case Function::ReferenceReturn:
  case Function::SecondReferenceReturn:
  case Function::MachineCoordinates:
  case Function::Dwell: // G4 X0.5
  case Function::LocalShift:
  case Function::RotationOn:
  case Function::ScalingOn: return true;
  default: return false;
  }
}

// What the text gives to variables, read from above: `#551=30` before `G43 H#551`.
class Known {
public:
  void read(const ir::ProgramStatement& statement) {
    const auto* store = std::get_if<ir::Store>(&statement.node);
    const double* number = store == nullptr ? nullptr : ir::constantValue(store->number);
    if (store != nullptr && number == nullptr) values_.clear();
    if (number == nullptr) return;
    const std::optional<double> value = of(store->value);
    if (value)
      values_[*number] = *value;
    else
      values_.erase(*number);
  }
  std::optional<double> of(const ir::ExpressionPtr& value) const {
    if (value == nullptr) return std::nullopt;
    if (const double* constant = ir::constantValue(value)) return *constant;
    const auto* variable = std::get_if<ir::MachineVariable>(&value->node);
    const double* number = variable == nullptr ? nullptr : ir::constantValue(variable->number);
    const auto found = number == nullptr ? values_.end() : values_.find(*number);
    return found == values_.end() ? std::nullopt : std::optional(found->second);
  }

private:
  std::map<double, double> values_; // by number
};

// The additional work system that a posted program selects before it moves in one, G54.1 Pn. 0: none.
std::uint32_t extendedIn(const ir::Program& program, const stdlib::Control& control,
                         const std::set<std::uint32_t>& switches) {
  Known known;
  for (const ir::ProgramStatement& statement : program.body) {
    known.read(statement);
    if (const auto* call = std::get_if<ir::Call>(&statement.node);
        call != nullptr && mayMove(*call, switches))
      return 0;
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    bool selects = false, axes = false, elsewhere = false;
    std::uint32_t number = 0;
    for (const ir::Word& word : block->words) {
      axes = axes || (word.address >= 'X' && word.address <= 'Z');
      const std::optional<double> value = known.of(word.value);
      if (!value || *value < 0 || *value > 9999) continue;
      const auto tenths = static_cast<std::uint32_t>(std::lround(*value * 10));
      const stdlib::CodeInfo* info = word.address == 'G' ? control.find('G', tenths) : nullptr;
      elsewhere = elsewhere || (info != nullptr && movesElsewhere(*info));
      selects = selects || (info != nullptr && info->function == stdlib::Function::ExtendedWorkSystem);
      if (word.address == 'P') number = tenths / 10;
    }
    if (selects) return number;
    if (axes && !elsewhere) return 0;
  }
  return 0;
}

} // namespace

Selected selectedIn(const ir::Program& program, const stdlib::Control& control,
                    const std::set<std::uint32_t>& switches) {
  using stdlib::Function;
  Selected out;
  bool moved = false;
  Known known;
  for (const ir::ProgramStatement& statement : program.body) {
    known.read(statement);
    const auto* call = std::get_if<ir::Call>(&statement.node);
    moved = moved || (call != nullptr && mayMove(*call, switches));
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    bool axes = false, elsewhere = false, length = false; // elsewhere: no move in a work system
    for (const ir::Word& word : block->words) {
      axes = axes || (word.address >= 'X' && word.address <= 'Z');
      const double* code = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
      if (code == nullptr || *code < 0 || *code > 9999) continue;
      const auto tenths = static_cast<std::uint32_t>(std::lround(*code * 10));
      const stdlib::CodeInfo* info = control.find('G', tenths);
      const Function function = info == nullptr ? Function::Other : info->function;
      elsewhere = elsewhere || (info != nullptr && movesElsewhere(*info));
      length = length || function == Function::ToolLengthPlus;
      if (function == Function::WorkSystem && !moved) out.system = tenths / 10;
    }
    for (const ir::Word& word : block->words) {
      const std::optional<double> number = word.address == 'H' ? known.of(word.value) : std::nullopt;
      if (length && !out.toolOffset && number && *number >= 1 && *number <= 9999)
        out.toolOffset = static_cast<std::uint32_t>(std::lround(*number));
    }
    moved = moved || (axes && !elsewhere);
  }
  return out;
}

void selectExtended(const ir::Program& program, const stdlib::Control& control,
                    const std::set<std::uint32_t>& switches, bool apart, verify::Entry& entry) {
  const std::uint32_t number = extendedIn(program, control, switches);
  const stdlib::SystemVariables& v = control.variables;
  if (number == 0 || !v.extendedX || static_cast<int>(number) > v.extendedCount) return;
  const sim::Point3 zero = entry.zeros[entry.system - 54];
  const double along[] = {zero.x, zero.y, zero.z};
  for (int axis = 0; axis < 3; ++axis)
    entry.variables.emplace_back(static_cast<std::uint32_t>(*v.extendedX + axis * v.axisStep +
                                                            (static_cast<int>(number) - 1) * v.extendedStep),
                                 along[axis]);
  if (!apart) return;
  entry.system = entry.system == 59 ? 54 : entry.system + 1;
  entry.start = entry.start + zero - entry.zeros[entry.system - 54];
}

} // namespace dotek::targets
