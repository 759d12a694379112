// The statements of a list: assignments, jumps, alarms; blocks are left to Blocks.cpp.
#include "backends/common/MovedMacros.h"
#include "backends/common/Waits.h"
#include "backends/fanuc/OwnCycles.h"
#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "ir/Fold.h"
#include "ir/Positions.h"
#include "ir/Walk.h"
#include "stdlib/VariableNumbers.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>

namespace dotek::backends::fanuc {

namespace {

class List {
public:
  List(State& state, const std::vector<ir::CycleStatement>& list, bool body)
      : state_(state), list_(list), body_(body), end_(state.mark()) {}

  void write() {
    for (std::size_t i = 0; i < list_.size();) {
      i = one(i);
      state_.releaseHelpers();
    }
    state_.sheet.place(end_);
  }

private:
  Mark markOf(ir::LabelId label) {
    const auto found = marks_.find(label);
    if (found != marks_.end()) return found->second;
    return marks_.emplace(label, state_.mark()).first->second;
  }

  // Writes the statement at `i`; gives the index after what was written.
  std::size_t one(std::size_t i) {
    const ir::CycleStatement& statement = list_[i];
    const ir::Origin& origin = statement.origin;
    if (state_.body != nullptr && body_) state_.at = i;
    state_.toAsk = toAsk(i);
    if (body_) settle(i);
    if (const auto* node = std::get_if<ir::Assign>(&statement.node))
      demand(state_, variablesOf(node->value), origin);
    return match(
        statement,
        [&](const ir::Assign& node) {
          if (const auto read = ir::readTool(*node.value))
            writeReadTool(state_, state_.local(node.variable), read->first, read->second, origin);
          else
            assign(state_, state_.local(node.variable), node.value, origin);
          return i + 1;
        },
        [&](const ir::Store& node) {
          if (const auto left = storeTarget(node, origin)) assign(state_, *left, node.value, origin);
          return i + 1;
        },
        [&](const ir::Label& node) {
          state_.sheet.place(markOf(node.label));
          return i + 1;
        },
        [&](const ir::Jump& node) {
          state_.sheet.jump("GOTO ", markOf(node.target), origin);
          return i + 1;
        },
        [&](const ir::Branch& node) { return writeBranch(i, node); },
        [&](const ir::Return&) {
          if (i + 1 < list_.size()) state_.sheet.jump("GOTO ", end_, origin);
          return i + 1;
        },
        [&](const ir::Alarm&) {
          const std::string text = sourceAlarm(state_, statement);
          state_.sheet.add(text, origin);
          return i + 1;
        },
        [&](const ir::Comment& node) {
          const std::string text = commentText(state_, node.text, origin.range());
          state_.sheet.comment(text, origin);
          return i + 1;
        },
        [&](const ir::OneOf<ir::Move, ir::Measure, ir::CallCycle, ir::ProbePower, ir::Spindle, ir::Coolant,
                            ir::SetMode, ir::Dwell, ir::Stop, ir::OpaqueBlock, ir::Port, ir::Print> auto&) {
          return writeBlock(state_, list_, i);
        });
  }

  // The source's control reads nothing ahead of G31, and the target's does: a skip position that is read in
  // the next block would be that of an earlier one.
  void settle(std::size_t i) {
    const ir::CycleStatement& statement = list_[i];
    const bool moves = match(
        statement, [&](const ir::OpaqueBlock& node) { return !isWait(node, state_.control); },
        [](const ir::OneOf<ir::Move, ir::Measure, ir::CallCycle, ir::ProbePower, ir::Label> auto&) {
          return true;
        },
        [](const ir::OneOf<ir::Assign, ir::Store, ir::Jump, ir::Branch, ir::Return, ir::Alarm, ir::Comment,
                           ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Port,
                           ir::Print> auto&) { return false; });
    if (moves) settled_ = false;
    if (std::holds_alternative<ir::OpaqueBlock>(statement.node) && !moves) settled_ = true;
    // What follows an IF may be written into its line.
    const bool reads = readsSkip(statement) || (std::holds_alternative<ir::Branch>(statement.node) &&
                                                i + 1 < list_.size() && readsSkip(list_[i + 1]));
    if (settled_ || !reads || !stopsAtSkip(state_.options.sourceControl) || stopsAtSkip(state_.control))
      return;
    ir::Origin origin = statement.origin;
    origin.reason = "waits until the skip move has ended";
    writeWait(state_, origin);
    settled_ = true;
  }

  static bool stopsAtSkip(const stdlib::Control& control) {
    return std::any_of(control.readAheadStops.begin(), control.readAheadStops.end(), [&](const auto& stop) {
      const auto* code = control.find(stop.first, stop.second);
      return code != nullptr && code->function == stdlib::Function::Skip;
    });
  }

  bool readsSkip(const ir::CycleStatement& statement) const {
    constexpr double kAxes = 6;
    const auto first = state_.control.variables.skip;
    bool found = false;
    if (first)
      ir::eachNode(statement, [&](const ir::Expression& node) {
        const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
        const double* number = variable == nullptr ? nullptr : ir::constantValue(variable->number);
        found = found || (number != nullptr && *number >= *first && *number < *first + kAxes);
      });
    return found;
  }

  std::set<ir::VariableId> toAsk(std::size_t i) const {
    return body_ || i >= state_.notAsked.size() ? std::set<ir::VariableId>() : state_.notAsked[i];
  }

  // Neither the branch nor the one statement that it skips reads what has to be asked for first.
  bool asksNothing(std::size_t i, const ir::Branch& branch) const {
    if (demandsWithin(state_, branch.condition)) return false;
    const auto* assign = std::get_if<ir::Assign>(&list_[i + 1].node);
    if (assign == nullptr) return true;
    const std::set<ir::VariableId> open = toAsk(i + 1), read = variablesOf(assign->value);
    return std::none_of(read.begin(), read.end(), [&](ir::VariableId id) { return open.contains(id); });
  }

  // A branch over one statement is an IF .. THEN with that statement.
  std::size_t writeBranch(std::size_t i, const ir::Branch& branch) {
    const ir::Origin& origin = list_[i].origin;
    if (!std::holds_alternative<ir::Junction>(branch.condition->node) &&
        !std::holds_alternative<ir::Not>(branch.condition->node))
      demand(state_, variablesOf(branch.condition), origin);
    if (state_.control.ifThen && i + 2 < list_.size() && asksNothing(i, branch)) {
      const auto* label = std::get_if<ir::Label>(&list_[i + 2].node);
      if (label != nullptr && label->label == branch.target && writeGuarded(branch, list_[i + 1]))
        return i + 2; // the label itself may have other jumps
    }
    jumpIf(state_, branch.condition, markOf(branch.target), origin);
    return i + 1;
  }

  bool writeGuarded(const ir::Branch& branch, const ir::CycleStatement& guarded) {
    return match(
        guarded,
        [&](const ir::Alarm&) {
          const std::string text = sourceAlarm(state_, guarded);
          doIf(state_, ir::negate(branch.condition), text, guarded.origin);
          return true;
        },
        [&](const ir::Stop& node) {
          if (node.optional || !state_.control.variables.message) return false;
          const std::string text = stopText(state_, node, guarded.origin);
          doIf(state_, ir::negate(branch.condition), text, guarded.origin);
          return true;
        },
        [&](const ir::Assign& node) {
          if (ir::readTool(*node.value)) return false;
          return writeGuarded(branch, guarded.origin, node.value,
                              [&] { return std::optional(state_.local(node.variable)); });
        },
        [&](const ir::Store& node) {
          return writeGuarded(branch, guarded.origin, node.value,
                              [&] { return storeTarget(node, guarded.origin); });
        },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Move, ir::Measure, ir::CallCycle,
                           ir::ProbePower, ir::Comment, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode,
                           ir::Dwell, ir::OpaqueBlock, ir::Port, ir::Print> auto&) { return false; });
  }

  template <class Target>
  bool writeGuarded(const ir::Branch& branch, const ir::Origin& origin, const ir::ExpressionPtr& value,
                    const Target& target) {
    // Lines that compute parts of the value would run whatever the condition says: tried aside.
    const Sheet::Checkpoint before = state_.sheet.checkpoint();
    const std::optional<std::string> left = target();
    if (!left) return true; // refused
    const std::string text = *left + "=" + valueText(state_, value, origin);
    if (state_.sheet.size() != before.lines) {
      state_.sheet.takeBack(before);
      state_.releaseHelpers();
      return false;
    }
    doIf(state_, ir::negate(branch.condition), text, origin);
    return true;
  }

  // "#550"; nothing where it was refused.
  std::optional<std::string> storeTarget(const ir::Store& store, const ir::Origin& origin) {
    const ir::ExpressionPtr number = tidy(store.number);
    const double* value = ir::constantValue(number);
    const bool whole = value != nullptr && *value >= 0 && *value < 1e9 &&
                       *value == static_cast<double>(static_cast<std::uint32_t>(*value));
    const auto base = value == nullptr ? ir::firstNumber(number) : std::nullopt;
    // What a sum is simplified to counts from another number: 2447 of `#[2500+#19-53]`.
    const auto written = value == nullptr ? ir::firstNumber(store.number) : std::nullopt;
    if (written && stdlib::isOfOffsets(state_.control, *written)) return machineText(state_, number, origin);
    if (base && (state_.control.isCommon(*base) || stdlib::isOfOffsets(state_.control, *base) ||
                 isSettable(state_.control, *base) || isSettable(state_.control, *base + 1))) {
      warnOfReach(*base, origin);
      return machineText(state_, number, origin);
    }
    if (whole && isSettable(state_.control, static_cast<std::uint32_t>(*value)))
      return machineText(state_, number, origin);
    if (!whole || !state_.control.isCommon(static_cast<std::uint32_t>(*value))) {
      state_.refuse<diag::StoreVariable>(
          origin.range(), value == nullptr ? "a computed number" : machineText(state_, number, origin),
          state_.control.title);
      return std::nullopt;
    }
    const auto variable = static_cast<std::uint32_t>(*value);
    // Whatever set the program calls, the machine's own macros measure with it the next time.
    if (const auto& package = state_.control.package;
        package && variable >= package->calibrationFirst && variable <= package->calibrationLast &&
        state_.control.name != state_.options.sourceControl.name) {
      state_.refuse<diag::StoreCalibration>(origin.range(), variable, package->title,
                                            "store the value elsewhere");
      return std::nullopt;
    }
    for (const auto& [first, last] : state_.macros.scratch) {
      if (variable < first || variable > last) continue;
      if (!state_.macros.keepsCalibration(variable)) {
        // Where no macro is called, what it works in is like any other variable.
        if (calls())
          state_.diagnostics.report<diag::StoreScratch>(origin.range(), variable, state_.macros.title);
      } else if (measures()) {
        state_.refuse<diag::StoreCalibration>(
            origin.range(), variable, state_.macros.title,
            storeRemedy(state_.macros, state_.control, numbersOf(state_.cycle)));
        return std::nullopt;
      } else {
        state_.diagnostics.report<diag::StoreCalibrationUncalled>(origin.range(), variable,
                                                                  state_.macros.title);
      }
    }
    return "#" + std::to_string(variable);
  }

  bool calls() const {
    return std::any_of(state_.cycle.body.begin(), state_.cycle.body.end(),
                       [&](const ir::CycleStatement& one) { return callsMacro(state_, one); });
  }

  // A macro of the set may measure, by what the variable holds: no switch of the probe, no block that is none
  // of its calls.
  bool measures() const {
    return std::any_of(state_.cycle.body.begin(), state_.cycle.body.end(),
                       [&](const ir::CycleStatement& one) {
                         if (std::holds_alternative<ir::ProbePower>(one.node)) return false;
                         const auto* block = std::get_if<ir::OpaqueBlock>(&one.node);
                         return block != nullptr ? mayCall(*block) : callsMacro(state_, one);
                       });
  }

  // Codes that the control has for something else than a call call nothing.
  bool mayCall(const ir::OpaqueBlock& block) const {
    return std::any_of(block.words.begin(), block.words.end(), [&](const ir::Word& word) {
      if (word.address != 'G' && word.address != 'M') return false;
      const double* code = word.value == nullptr ? nullptr : ir::constantValue(word.value);
      if (code == nullptr || *code < 0 || *code > 9999) return true;
      const auto* info =
          state_.control.find(word.address, static_cast<std::uint32_t>(std::lround(*code * 10)));
      return info == nullptr || info->function == stdlib::Function::MacroCall ||
             info->function == stdlib::Function::ModalCall ||
             info->function == stdlib::Function::SubprogramCall;
    });
  }

  // A number that counts from `base` may reach what the macros work in, in the same bank of variables.
  void warnOfReach(std::uint32_t base, const ir::Origin& origin) {
    for (const auto& [first, last] : state_.macros.scratch)
      for (const stdlib::VariableRange& bank : state_.control.common) {
        const bool together =
            bank.first <= base && base <= bank.last && first <= bank.last && last >= bank.first;
        if (!together || base > last || (!bank.kept && !calls())) continue;
        state_.diagnostics.report<diag::StoreReachesScratch>(origin.range(), base, first, last,
                                                             state_.macros.title);
        return;
      }
  }

  State& state_;
  const std::vector<ir::CycleStatement>& list_;
  bool body_;
  bool settled_ = false; // nothing has moved since the control waited
  Mark end_;
  std::map<ir::LabelId, Mark> marks_;
};

} // namespace

void writeList(State& state, const std::vector<ir::CycleStatement>& list, bool body) {
  List(state, list, body).write();
}

} // namespace dotek::backends::fanuc
