// What the control computes in blocks for another macro set: positions, comparisons, offsets.
#include "backends/fusion/State.h"
#include "ir/Fold.h"
#include "ir/Walk.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Fusion.h"

#include <algorithm>
#include <charconv>

namespace dotek::backends::fusion {

namespace {

constexpr double kFirstOfMachine = 1000; // number of a variable: an offset, perhaps
constexpr double kFirstSystem = 54;
constexpr double kSamePlace = 0.01; // mm: a difference of coordinates that is no shift
constexpr int kFirstAlarm = 100;
constexpr int kMacroDecimals = 6; // of a constant in a formula

ir::ExpressionPtr variable(int number) {
  return ir::machineVariable(ir::constant(number));
}
ir::ExpressionPtr minus(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::binary(ir::BinaryOp::Subtract, a, b);
}
ir::ExpressionPtr plus(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::binary(ir::BinaryOp::Add, a, b);
}

std::optional<int> workSystemVariable(const stdlib::Control& control) {
  const auto* code = control.find(stdlib::Function::WorkSystem);
  if (code == nullptr || !code->group || !control.variables.modalFirst) return std::nullopt;
  return *control.variables.modalFirst + *code->group;
}

constexpr stdlib::Output kPositions[] = {stdlib::Output::PositionX, stdlib::Output::PositionY,
                                         stdlib::Output::PositionZ};

// The source's own alarms have this number.
bool isRaised(const std::vector<ir::PrintedBlock>& blocks, int number) {
  constexpr std::string_view kMark = "#3000=";
  for (const ir::PrintedBlock& block : blocks)
    for (const ir::PrintedPiece& piece : block.pieces)
      for (std::size_t at = piece.text.find(kMark); at != std::string::npos;
           at = piece.text.find(kMark, at + 1)) {
        int found = 0;
        std::from_chars(piece.text.data() + at + kMark.size(), piece.text.data() + piece.text.size(), found);
        if (found == number) return true;
      }
  return false;
}

// "" where there is none of one argument in brackets that means the same.
std::string_view functionOf(ir::UnaryOp op, bool wholeRound) {
  switch (op) {
  case ir::UnaryOp::Absolute: return "ABS";
  case ir::UnaryOp::SquareRoot: return "SQRT";
  case ir::UnaryOp::Sine: return "SIN";
  case ir::UnaryOp::Cosine: return "COS";
  case ir::UnaryOp::Tangent: return "TAN";
  case ir::UnaryOp::ArcSine: return "ASIN";
  case ir::UnaryOp::ArcCosine: return "ACOS";
  case ir::UnaryOp::Truncate: return "FIX";
  case ir::UnaryOp::RoundUp: return "FUP";
  case ir::UnaryOp::Round: return wholeRound ? "ROUND" : "";
  case ir::UnaryOp::Logarithm: return "LN";
  case ir::UnaryOp::Exponential: return "EXP";
  case ir::UnaryOp::Negate:
  case ir::UnaryOp::ArcTangent:
  case ir::UnaryOp::NullAsZero:
  case ir::UnaryOp::RoundIncrement:
  case ir::UnaryOp::FromBcd:
  case ir::UnaryOp::ToBcd:
  case ir::UnaryOp::AddPoint: return "";
  }
  return "";
}

} // namespace

bool needsControl(const ir::ExpressionPtr& value) {
  bool found = false;
  ir::eachNode(value, [&](const ir::Expression& node) {
    found = found || std::holds_alternative<ir::MachineVariable>(node.node) ||
            std::holds_alternative<ir::MeasuredResult>(node.node);
  });
  return found;
}

void MacroBlocks::flow(const ir::CycleStatement& statement) {
  const auto forget = [&] {
    for (Place& place : at_)
      place.value = nullptr;
  };
  match(
      statement,
      [&](const ir::Label& node) {
        const auto& body = state_.cycle.body;
        const auto at = static_cast<std::size_t>(&statement - body.data());
        join(at);
        // Over one statement: that one has said where it leads.
        std::size_t jumps = 0;
        for (const ir::CycleStatement& one : body) {
          const auto* branch = std::get_if<ir::Branch>(&one.node);
          const auto* jump = std::get_if<ir::Jump>(&one.node);
          jumps += (branch != nullptr && branch->target == node.label) ||
                   (jump != nullptr && jump->target == node.label);
        }
        const auto* over =
            at >= 2 && at < body.size() ? std::get_if<ir::Branch>(&body[at - 2].node) : nullptr;
        if (jumps == 1 && over != nullptr && over->target == node.label) return;
        forget();
      },
      [&](const ir::Store& node) {
        const double* number = ir::constantValue(node.number);
        if (number == nullptr || *number >= kFirstOfMachine) forget();
        for (Place& place : at_)
          forgetStored(place, node);
      },
      [](const ir::OneOf<ir::Jump, ir::Branch, ir::Move, ir::Measure, ir::CallCycle, ir::ProbePower,
                         ir::Comment, ir::Assign, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode,
                         ir::Dwell, ir::Stop, ir::Alarm, ir::OpaqueBlock, ir::Port, ir::Print> auto&) {});
}

void MacroBlocks::forgetStored(Place& place, const ir::Store& store) {
  if (place.value == nullptr) return;
  const double* number = ir::constantValue(store.number);
  bool reads = false;
  ir::eachNode(place.value, [&](const ir::Expression& node) {
    const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
    const double* other = variable == nullptr ? nullptr : ir::constantValue(variable->number);
    reads = reads || (variable != nullptr && (number == nullptr || other == nullptr || *number == *other));
  });
  if (reads) place.value = nullptr;
}

ir::ExpressionPtr MacroBlocks::positionNow(ir::Axis axis) {
  const stdlib::SystemVariables& v = state_.options.control.variables;
  const auto& with = state_.options.control.withToolLength;
  const bool held = axis == ir::Axis::Z && (!with || with->position);
  const auto* waits = state_.options.control.find(stdlib::Function::MachineCoordinates);
  if (!v.position || (held && (!with || !v.toolLength)) || waits == nullptr || waits->grade == "assumed")
    return nullptr;
  waits_ = true;
  const int i = static_cast<int>(ir::indexOf(axis));
  return held ? minus(variable(*v.position + i), variable(*v.toolLength + i)) : variable(*v.position + i);
}

// Macro statements and values of words are read before the axes are there.
void MacroBlocks::wait(std::vector<Text>& lines) {
  waits_ = false;
  const auto* code = state_.options.control.find(stdlib::Function::MachineCoordinates);
  if (code == nullptr) return;
  Text text;
  text.add(std::string(1, code->letter) + numberText(code->tenths / 10.0));
  lines.push_back(std::move(text));
}

void MacroBlocks::macro(Text& text, const ir::ExpressionPtr& value, const ir::Origin& origin) {
  if (const double* known = ir::constantValue(value)) {
    text.add(numberText(Decimal::of(*known).rounded(kMacroDecimals).value()));
    return;
  }
  if (!needsControl(value)) return texts_.number(text, value, origin, true);
  const auto refuse = [&] {
    state_.refuse<diag::FusionRunTime>(value->range.hasPlace() ? value->range : origin.range());
  };
  match(
      *value,
      [&](const ir::MachineVariable& node) {
        text.add("#");
        if (ir::constantValue(node.number) != nullptr) return macro(text, node.number, origin);
        if (!needsControl(node.number))
          return text.addExpression("String(" + valueText(state_, node.number, origin.range()) + ")");
        text.add("[");
        macro(text, node.number, origin);
        text.add("]");
      },
      [&](const ir::MeasuredResult& node) {
        const stdlib::MacroSignature* signature =
            last_ == nullptr ? nullptr : signatureOf(state_.options.macros, *last_);
        const FoundResult known = found(node.name);
        if (known.instead)
          state_.diagnostics.report<diag::ResultDiffers>(value->range, known.result->variable,
                                                         state_.options.macros.title,
                                                         ir::resultTitle(*known.instead));
        if (known.result != nullptr)
          text.add("#" + std::to_string(known.result->variable));
        else if (signature == nullptr || !errorText(node.name, *signature, origin, text))
          refuseResult(node.name, origin.range());
      },
      [&](const ir::Unary& node) {
        if (node.op == ir::UnaryOp::NullAsZero) return macro(text, node.operand, origin);
        const std::string function(functionOf(node.op, wholeRound_));
        const bool known = !function.empty() && state_.options.control.functions.contains(function);
        if (!known && node.op != ir::UnaryOp::Negate) return refuse();
        text.add(known ? function + "[" : "[0-");
        if (node.op == ir::UnaryOp::Negate)
          macroOperand(text, node.operand, origin);
        else
          macro(text, node.operand, origin);
        text.add("]");
      },
      [&](const ir::Binary& node) {
        // As the source has it: which of two angles it gives, a parameter of the control says.
        if (node.op == ir::BinaryOp::Bearing) {
          if (!state_.options.control.functions.contains("ATAN[y]/[x]")) return refuse();
          text.add("ATAN[");
          macro(text, node.right, origin);
          text.add("]/[");
          macro(text, node.left, origin);
          return text.add("]");
        }
        const std::string_view sign = node.op == ir::BinaryOp::Add        ? "+"
                                      : node.op == ir::BinaryOp::Subtract ? "-"
                                      : node.op == ir::BinaryOp::Multiply ? "*"
                                      : node.op == ir::BinaryOp::Divide   ? "/"
                                                                          : "";
        if (sign.empty()) return refuse();
        // Sums and products go from left to right.
        const auto* left = std::get_if<ir::Binary>(&node.left->node);
        const bool sum = node.op == ir::BinaryOp::Add || node.op == ir::BinaryOp::Subtract;
        const bool goesOn = sum && left != nullptr && needsControl(node.left) &&
                            (left->op == ir::BinaryOp::Add || left->op == ir::BinaryOp::Subtract ||
                             left->op == ir::BinaryOp::Multiply);
        if (goesOn)
          macro(text, node.left, origin);
        else
          macroOperand(text, node.left, origin);
        text.add(sign);
        const auto* right = std::get_if<ir::Binary>(&node.right->node);
        if (sum && right != nullptr && right->op == ir::BinaryOp::Multiply && needsControl(node.right))
          macro(text, node.right, origin);
        else
          macroOperand(text, node.right, origin);
      },
      [&](const ir::OneOf<ir::Constant, ir::VariableUse, ir::NullValue> auto&) { refuse(); });
}

// What may begin with a sign, or holds one, is in brackets.
void MacroBlocks::macroOperand(Text& text, const ir::ExpressionPtr& value, const ir::Origin& origin) {
  const double* known = ir::constantValue(value);
  const bool plain = (known != nullptr && *known >= 0) ||
                     std::holds_alternative<ir::MachineVariable>(value->node) ||
                     (needsControl(value) && std::holds_alternative<ir::Unary>(value->node));
  text.add(plain ? "" : "[");
  macro(text, value, origin);
  text.add(plain ? "" : "]");
}

void MacroBlocks::valueOfWord(Text& text, const ir::ExpressionPtr& value, const ir::Origin& origin) {
  if (!needsControl(value)) return texts_.number(text, value, origin);
  text.add("[");
  macro(text, ir::simplify(value), origin);
  text.add("]");
}

void MacroBlocks::alarmAbove(const ir::ExpressionPtr& value, const ir::ExpressionPtr& limit,
                             std::string_view what, std::vector<Text>& lines, const ir::Origin& origin) {
  const auto [known, fresh] = alarms_.emplace(what, 0);
  if (fresh) {
    int number = kFirstAlarm;
    const auto taken = [&](int wanted) {
      return isRaised(state_.options.printed, wanted) ||
             std::any_of(alarms_.begin(), alarms_.end(),
                         [&](const auto& one) { return one.second == wanted; });
    };
    while (taken(number))
      ++number;
    known->second = number;
  }
  Text text;
  text.add("IF[");
  macro(text, ir::simplify(value), origin);
  text.add("GT");
  macroOperand(text, ir::simplify(limit), origin);
  text.add("]THEN #3000=" + std::to_string(known->second) + "(" + std::string(what) + ")");
  lines.push_back(std::move(text));
}

bool MacroBlocks::tellsNominal(const ir::Measure& measure) {
  const std::vector<ir::Axis> axes = measuredAxes(measure);
  return std::all_of(axes.begin(), axes.end(), [&](ir::Axis axis) {
    const bool travels = !measure.target || measure.target->frame == ir::Frame::Here;
    return measure.setting->nominal[ir::indexOf(axis)] == nullptr || !travels ||
           at_[ir::indexOf(axis)].value != nullptr;
  });
}

std::string MacroBlocks::offsetObstacle(const stdlib::MacroSignature& signature,
                                        const ir::OffsetSetting& setting) const {
  const stdlib::Control& control = state_.options.control;
  const stdlib::SystemVariables& v = control.variables;
  if (!v.workOffsetX || !v.externalX || !v.machine || !v.position || v.axisStep == 0 || v.systemStep == 0)
    return "the control has no variables of the offsets";
  if (!workSystemVariable(control)) return "no variable says which work system is active";
  if (!control.ifThen) return "the control has no `THEN`, by which a shift is looked for";
  for (const ir::Axis axis : ir::kAxes) {
    if (setting.nominal[ir::indexOf(axis)] == nullptr) continue;
    const auto* result = signature.find(kPositions[ir::indexOf(axis)]);
    if (result == nullptr || !result->documented)
      return "the macro does not say where it leaves the measured position";
  }
  return "";
}

ir::ExpressionPtr MacroBlocks::offsetOf(const ir::ExpressionPtr& system, ir::Axis axis) const {
  const stdlib::SystemVariables& v = state_.options.control.variables;
  const int first = *v.workOffsetX + static_cast<int>(ir::indexOf(axis)) * v.axisStep;
  const ir::ExpressionPtr steps = ir::binary(
      ir::BinaryOp::Multiply, minus(system, ir::constant(kFirstSystem)), ir::constant(v.systemStep));
  return ir::machineVariable(ir::simplify(plus(ir::constant(first), steps)));
}

void MacroBlocks::checkShift(const ir::OffsetSetting& setting, std::vector<Text>& lines,
                             const ir::Origin& origin) {
  const stdlib::SystemVariables& v = state_.options.control.variables;
  const ir::ExpressionPtr active = variable(*workSystemVariable(state_.options.control));
  wait(lines);
  for (const ir::Axis axis : ir::kAxes) {
    if (setting.nominal[ir::indexOf(axis)] == nullptr) continue;
    const int i = static_cast<int>(ir::indexOf(axis));
    const ir::ExpressionPtr shift = minus(minus(minus(variable(*v.machine + i), variable(*v.position + i)),
                                                variable(*v.externalX + i * v.axisStep)),
                                          offsetOf(active, axis));
    alarmAbove(ir::unary(ir::UnaryOp::Absolute, shift), ir::constant(kSamePlace), "LOCAL SHIFT ACTIVE", lines,
               origin);
    lines.back().because("local shift checked");
  }
}

void MacroBlocks::writeOffset(const ir::OffsetSetting& setting, const stdlib::MacroSignature& signature,
                              std::vector<Text>& lines, const ir::Origin& origin) {
  const ir::ExpressionPtr active = variable(*workSystemVariable(state_.options.control));
  wait(lines);
  for (const ir::Axis axis : ir::kAxes) {
    const ir::ExpressionPtr& nominal = setting.nominal[ir::indexOf(axis)];
    if (nominal == nullptr) continue;
    const auto* result = signature.find(kPositions[ir::indexOf(axis)]);
    Text text;
    macro(text, settingOf(setting.system, axis), origin);
    text.add("=");
    macro(text,
          minus(plus(offsetOf(active, axis), variable(static_cast<int>(result->variable))),
                ir::simplify(nominal)),
          origin);
    lines.push_back(std::move(text));
  }
}

} // namespace dotek::backends::fusion
