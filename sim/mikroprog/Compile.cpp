// Blocks of Mikroprog as instructions of the shared machine.
#include "ir/Rewrite.h"
#include "sim/machine/Compiler.h"
#include "sim/machine/Trace.h"
#include "sim/mikroprog/Dialect.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace dotek::sim::mikroprog {

namespace {

constexpr std::string_view kJumpLetters =
    "LOH@"; // what jumps, conditions and files take: nothing for the machine
constexpr std::string_view kQuiet[] = {"join-off", "set-condition", "write-text"}; // move and decide nothing

enum class Flow : std::uint8_t { None, Jump, JumpIf, Call, Return, Position, Value, Stop };

Flow flowOf(std::string_view function) {
  static constexpr std::pair<std::string_view, Flow> kFlows[] = {
      {"jump", Flow::Jump},     {"jump-if", Flow::JumpIf},           {"call", Flow::Call},
      {"return", Flow::Return}, {"record-position", Flow::Position}, {"record-value", Flow::Value},
      {"stop", Flow::Stop},
  };
  for (const auto& [name, flow] : kFlows)
    if (name == function) return flow;
  return Flow::None;
}

bool isAxis(char letter) {
  return std::string_view(kAxisLetters).find(letter) != std::string_view::npos;
}

class BlockCompiler final : public sim::Compiler {
public:
  BlockCompiler(const ir::Program& program, const Profile& profile, const SourceMap& sources)
      : Compiler(profile.machine, sources), profile_(profile), moves_(skipMoves(program, profile.control)) {
    for (ir::LabelId label = 0; label < program.labels.size(); ++label)
      numbers_.emplace(program.labels[label].number, label);
  }

  using Compiler::operator();

  void operator()(const ir::Store& store) override {
    const double* const number = ir::constantValue(store.number);
    const auto to = number == nullptr ? std::optional<std::uint32_t>() : cellOf(*number);
    emit(Op::CountBlock);
    if (!to) return refuse("a parameter of this number is not known");
    const auto sum = parameters(store.value);
    if (sum) emit(Op::ToIncrement, value(*sum), 0, *to, 'X'); // onto the grid of the coordinates
  }

  void operator()(const ir::NcBlock& block) override {
    Plan plan;
    if (!planOf(block, plan)) return;
    if (plan.words.words.empty())
      emit(Op::CountBlock);
    else
      words(plan.words, plan.probes && isProtected());
    if (plan.probes) missed(block);
    for (const Flow flow : plan.flows)
      step(flow, block);
  }

protected:
  void textEnd() override { refuse("the program has no M30"); }

private:
  struct Plan {
    ir::NcBlock words; // for the machine
    std::vector<Flow> flows;
    bool probes = false;
  };

  std::optional<std::uint32_t> cellOf(double parameter) const {
    if (!(parameter >= 0 && parameter < 1e9) || parameter != std::floor(parameter)) return std::nullopt;
    const std::uint32_t cell = layout_.cellOf(variableOf(static_cast<std::uint32_t>(parameter)));
    return cell == CellLayout::kNone ? std::nullopt : std::optional(cell);
  }

  // With parameters as variables of the machine; each has to have a value. nullopt: refused.
  std::optional<ir::ExpressionPtr> parameters(const ir::ExpressionPtr& expression) {
    bool known = true;
    ir::ExpressionPtr out = ir::rewrite(expression, [&](const ir::ExpressionPtr& one) {
      const auto* variable = std::get_if<ir::MachineVariable>(&one->node);
      const double* number = variable == nullptr ? nullptr : ir::constantValue(variable->number);
      if (number == nullptr) return one;
      const auto cell = cellOf(*number);
      known = known && cell;
      if (!cell) return one;
      given(static_cast<std::uint32_t>(*number));
      return ir::machineVariable(ir::constant(*number + 1, one->range), one->range);
    });
    if (known) return out;
    refuse("a parameter of this number is not known");
    return std::nullopt;
  }

  std::uint32_t given(std::uint32_t parameter) {
    const std::uint32_t cell = layout_.cellOf(variableOf(parameter));
    emit(Op::Given, cell, text(fmt::format("P{} has no value", parameter)));
    return cell;
  }

  bool isProtected() const {
    const auto at = std::find_if(moves_.begin(), moves_.end(),
                                 [&](const SkipMoveUse& one) { return one.statement == at_; });
    return at != moves_.end() && at->use == SkipUse::Protected;
  }

  // false: the block ends the run here.
  bool planOf(const ir::NcBlock& block, Plan& plan) {
    const stdlib::MikroprogControl& control = profile_.control;
    bool sets = false, axes = false, diameters = false;
    std::optional<bool> incremental; // as this block says it
    std::string flowCode;            // of the first
    const auto refused = [&](std::string why) {
      refuse(std::move(why));
      return false;
    };
    for (const ir::Word& word : block.words) {
      const char letter = word.address;
      if (letter != 'G' && letter != 'M') {
        if (kJumpLetters.find(letter) != std::string_view::npos) continue;
        if (isAxis(letter)) {
          if (!control.hasAxis(letter)) return refused(fmt::format("there is no axis {}", letter));
          if (!flowCode.empty())
            return refused(fmt::format("whether the move or {} comes first is not known", flowCode));
          axes = true;
          diameters = diameters || control.isDiameter(letter);
        }
        const auto with = parameters(word.value);
        if (!with) return false;
        plan.words.words.push_back({letter, control.isDiameter(letter) ? half(*with) : *with, word.range});
        continue;
      }
      const auto number = wholeOf(word);
      const stdlib::MikroprogFunction* const function = number ? control.find(letter, *number) : nullptr;
      if (function == nullptr || !function->usable)
        return refused(number ? fmt::format("{}{} is not known", letter, *number)
                              : fmt::format("a computed {} is not known", letter));
      const std::string& what = function->function;
      if (const Flow flow = flowOf(what); flow != Flow::None) {
        plan.flows.push_back(flow);
        if (flowCode.empty()) flowCode = function->code();
      } else if (profile_.machine.find(letter, *number * 10) != nullptr) {
        plan.words.words.push_back(word);
        plan.probes = plan.probes || what == "probe-move";
        sets = sets || what == "set-position";
        if (what == "absolute" || what == "incremental") incremental = what == "incremental";
      } else if (std::find(std::begin(kQuiet), std::end(kQuiet), what) == std::end(kQuiet)) {
        return refused(what.empty() ? "a function that is not followed" : what + " is not followed");
      }
    }
    if ((plan.probes || sets) && !axes) {
      emit(Op::Fault, 0, text(plan.probes ? "G31 without an axis" : "G92 without an axis"));
      return false;
    }
    if (plan.probes && !absolute(incremental, "G31 under G91 (Q20)")) return false;
    return !diameters || sets || absolute(incremental, "G91 with a diameter (Q9)");
  }

  // In incremental mode the run ends here; false: it is certain to.
  bool absolute(std::optional<bool> incremental, const char* why) {
    if (incremental && *incremental) {
      refuse(why);
      return false;
    }
    if (!incremental) emit(Op::Absolute, 0, text(why));
    return true;
  }

  // A diameter as the radius that the machine counts.
  static ir::ExpressionPtr half(const ir::ExpressionPtr& value) {
    if (const double* number = ir::constantValue(value)) return ir::constant(*number / 2, value->range);
    return ir::binary(ir::BinaryOp::Divide, value, ir::constant(2, value->range), value->range);
  }

  // What `write` adds runs where the instruction jumps.
  template <class Write> void where(std::uint32_t condition, const Write& write) {
    const std::uint32_t over = emit(Op::Jump);
    code_.instructions[condition].c = static_cast<std::uint32_t>(code_.instructions.size());
    write();
    code_.instructions[over].c = static_cast<std::uint32_t>(code_.instructions.size());
  }

  void missed(const ir::NcBlock& block) {
    const std::uint32_t jump = emit(Op::JumpMissed, 0, text("G31 begins in contact (Q19)"));
    where(jump, [&] {
      if (find(block, 'L') != nullptr)
        go(block);
      else
        emit(Op::Fault, 0, text("G31 has found nothing"));
    });
  }

  // To the block that L names.
  void go(const ir::NcBlock& block, Op op = Op::Jump) {
    const ir::Word* const word = find(block, 'L');
    if (word == nullptr) {
      emit(Op::Fault, 0, text("a jump without L"));
    } else if (const auto number = wholeOf(*word)) {
      const auto label = numbers_.find(*number);
      if (label != numbers_.end())
        jumpTo(emit(op), label->second);
      else
        emit(Op::Fault, 0, text(fmt::format("no block N{}", *number)));
    } else if (op != Op::Jump) {
      refuse("a subprogram whose block a parameter names is not known");
    } else if (const auto with = parameters(word->value)) {
      emit(Op::JumpTo, value(*with));
    }
  }

  void step(Flow flow, const ir::NcBlock& block) {
    switch (flow) {
    case Flow::None: return;
    case Flow::Jump: return go(block);
    case Flow::JumpIf: return jumpOn(block);
    case Flow::Call:
      // H1 is one run or two.
      if (find(block, 'H') != nullptr)
        return refuse("whether H of G26 counts all runs or those after the first (Q8)");
      return go(block, Op::CallPlace);
    case Flow::Return: emit(Op::LeavePlace, 0, text("M17 without a call")); return;
    case Flow::Stop: emit(Op::Pause, 0, text(comment())); return;
    case Flow::Position:
    case Flow::Value: {
      const ir::Word* const file = find(block, '@');
      const auto* name = file == nullptr ? nullptr : std::get_if<ir::Constant>(&file->value->node);
      if (name == nullptr || name->digits.empty()) {
        emit(Op::Fault, 0, text("no file"));
        return;
      }
      if (name->digits.find_first_of("/\\:") != std::string::npos)
        return refuse("a file outside the folder of the programs");
      emit(Op::Record, flow == Flow::Position ? kNoCell : given(kAccumulator), text(name->digits));
      return;
    }
    }
  }

  // Conditions: O7 the probe, O10 P90 = 0, then for each axis P90 at most its coordinate, P90 above it.
  void jumpOn(const ir::NcBlock& block) {
    const ir::Word* const word = find(block, 'O');
    if (word == nullptr) {
      emit(Op::Fault, 0, text("G23 without O"));
      return;
    }
    const auto number = wholeOf(*word);
    if (!number) return refuse("a condition whose number a parameter gives is not known");
    std::uint32_t condition = 0;
    if (*number == 7) {
      condition = emit(Op::JumpSignal, 0, text("O7 without a part"));
    } else if (*number < 10 || *number > 16) {
      return refuse(fmt::format("O{} is an input of the machine", *number));
    } else {
      const std::uint32_t p = given(kAccumulator);
      if (*number == 10) {
        condition = emit(Op::JumpSame, p, constant(0));
      } else {
        const std::uint32_t axis = (*number - 11) / 2;
        const std::uint32_t place = temporary();
        emit(Op::Place, 0, 0, place, static_cast<std::uint8_t>(axis));
        if (profile_.control.isDiameter(kAxisLetters[axis])) emit(Op::Multiply, place, constant(2), place);
        condition = emit(*number % 2 == 1 ? Op::JumpLessEqual : Op::JumpGreater, p, place);
      }
    }
    where(condition, [&] { go(block); });
  }

  // The text beside the block that is compiled: what the operator reads.
  std::string comment() const { return textBeside(*program_, at_); }

  const Profile& profile_;
  const std::vector<SkipMoveUse> moves_;
  std::map<std::uint64_t, ir::LabelId> numbers_; // N to the first block that has it
};

} // namespace

Bytecode compile(const ir::Program& program, const Profile& profile, const SourceMap& sources) {
  BlockCompiler compiler(program, profile, sources);
  compiler.add(program);
  return compiler.finish();
}

} // namespace dotek::sim::mikroprog
