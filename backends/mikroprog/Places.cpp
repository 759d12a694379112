// Numbers, words, and where the probe is.
#include "backends/common/PlainText.h"
#include "backends/mikroprog/State.h"
#include "ir/CycleNames.h"
#include "ir/Fold.h"
#include "ir/Linear.h"
#include "ir/Walk.h"
#include "support/Decimal.h"
#include "support/messages/Nc.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dotek::backends::mikroprog {

namespace {

double sum(double a, double b) {
  return ir::exactSum(a, b).value_or(a + b);
}

constexpr double kNoise = 1e-9; // mm: what sums of decimals leave

// What an expression depends on, for messages.
std::string unknownOf(const State& state, const ir::ExpressionPtr& value) {
  std::string out = "a value";
  ir::eachNode(value, [&](const ir::Expression& node) {
    if (std::holds_alternative<ir::MeasuredResult>(node.node)) out = "a measured result";
    if (const auto* machine = std::get_if<ir::MachineVariable>(&node.node)) {
      const double* number = ir::constantValue(machine->number);
      out = ir::readTool(node)  ? "a tool offset of the control"
            : number == nullptr ? "a variable of the machine"
                                : "#" + numberText(*number);
    }
    if (const auto* use = std::get_if<ir::VariableUse>(&node.node))
      out = "`" + state.cycle.variable(use->variable).name + "`";
  });
  return out;
}

} // namespace

ir::Origin made(std::string reason, const ir::Origin& from) {
  ir::Origin out;
  out.ranges = from.ranges;
  out.reason = std::move(reason);
  return out;
}

std::string numberWord(State& state, double value, SourceRange range) {
  const Decimal rounded = Decimal::of(value).rounded(state.control.decimals);
  const double out = rounded.value();
  if (std::abs(out - value) > kNoise)
    state.diagnostics.report<diag::NumberRounded>(range, numberText(value), numberText(out));
  if (rounded.integerPart().size() > static_cast<std::size_t>(state.control.integerDigits))
    state.refuse<diag::NumberTooLarge>(range, numberText(value), state.control.integerDigits,
                                       state.control.title);
  return numberText(out);
}

std::string axisWord(State& state, ir::Axis axis, double value, SourceRange range) {
  const char letter = ir::letterOf(axis);
  const bool diameter = state.control.isDiameter(letter);
  if (diameter && state.remarked.insert("diameter").second) {
    state.diagnostics.report<diag::RadiusAsDiameter>(range, std::string(1, letter));
    state.remarks.push_back(fmt::format("{} IS A DIAMETER HERE, A RADIUS IN THE SOURCE", letter));
  }
  return letter + numberWord(state, diameter ? 2 * value : value, range);
}

std::string shownPlace(const State& state, ir::Axis axis, double value) {
  const char letter = ir::letterOf(axis);
  constexpr double kSteps = 1e6; // of a mm: sums of what is written have no more places
  const double shown = state.control.isDiameter(letter) ? 2 * value : value;
  return letter + numberText(std::round(shown * kSteps) / kSteps + 0.0);
}

std::string shownLength(const State& state, ir::Axis axis, double value) {
  return state.control.isDiameter(ir::letterOf(axis)) ? numberText(2 * value) + " MM (DIAMETER)"
                                                      : numberText(value) + " MM";
}

std::optional<double> valueOf(State& state, const ir::ExpressionPtr& value, SourceRange range) {
  const ir::ExpressionPtr simple = ir::simplify(value);
  if (const double* constant = ir::constantValue(simple)) return *constant;
  state.refuse<diag::MikroprogCannot>(range, "the number depends on " + unknownOf(state, simple),
                                      "no function reads it into a word");
  return std::nullopt;
}

std::optional<double> rangedValueOf(State& state, char letter, const ir::ExpressionPtr& value,
                                    std::string_view what, bool zero, SourceRange range) {
  const std::optional<double> out = valueOf(state, value, range);
  if (!out || *out > 0 || (zero && *out == 0)) return out;
  state.refuse<diag::ValueOutOfRange>(range, letter, numberText(*out), what, zero ? "0 or more" : "above 0");
  return std::nullopt;
}

bool checkAxis(State& state, ir::Axis axis, SourceRange range) {
  if (state.control.hasAxis(ir::letterOf(axis))) return true;
  state.refuse<diag::AxisMissing>(range, state.control.title, std::string(1, ir::letterOf(axis)));
  return false;
}

std::optional<double> hereOf(State& state, ir::Axis axis, SourceRange range) {
  const std::optional<double> at = state.axes[ir::indexOf(axis)].at;
  if (at) return at;
  const char letter = ir::letterOf(axis);
  state.refuse<diag::PositionNeeded>(range, std::string(1, letter),
                                     std::string(1, static_cast<char>(letter - 'A' + 'a')));
  return std::nullopt;
}

std::optional<double> placeOf(State& state, const ir::Coordinate& coordinate, ir::Axis axis,
                              SourceRange range) {
  if (!checkAxis(state, axis, range)) return std::nullopt;
  const std::string letter(1, ir::letterOf(axis));
  if (coordinate.system != nullptr || coordinate.frame == ir::Frame::Machine) {
    state.refuse<diag::MikroprogCannot>(
        range,
        letter + " counts in " + (coordinate.system ? "a work system of its own" : "machine coordinates"),
        "the program moves in the active system alone");
    return std::nullopt;
  }
  const std::optional<double> value = valueOf(state, coordinate.value, range);
  if (!value) return std::nullopt;
  switch (coordinate.frame) {
  case ir::Frame::Work: return value;
  case ir::Frame::Here: {
    const std::optional<double> here = hereOf(state, axis, range);
    if (!here) return std::nullopt;
    return sum(*here, *value);
  }
  case ir::Frame::Start: {
    const std::optional<double> from = state.start[ir::indexOf(axis)];
    if (from) return sum(*from, *value);
    state.refuse<diag::PositionNeeded>(range, letter,
                                       std::string(1, static_cast<char>(ir::letterOf(axis) - 'A' + 'a')));
    return std::nullopt;
  }
  case ir::Frame::Retract:
    if (const auto plane = state.options.hosts.find("retract"); plane != state.options.hosts.end())
      return sum(plane->second, *value);
    state.refuse<diag::RetractUnknown>(range);
    return std::nullopt;
  case ir::Frame::Machine: break;
  }
  return std::nullopt;
}

bool relyOn(State& state, const std::vector<std::uint32_t>& questions, std::string_view what,
            SourceRange range) {
  std::vector<std::string> open, flags;
  for (const std::uint32_t number : questions) {
    const stdlib::MikroprogQuestion* question = state.control.question(number);
    if (question == nullptr) continue; // does not arise on this control
    state.relied.insert(number);
    if (question->assumed || state.options.assumed.contains(number)) continue;
    open.push_back(fmt::format("Q{} ({})", number, question->title));
    flags.push_back(fmt::format("`--assume Q{}`", number));
  }
  if (open.empty()) return true;
  state.refuse<diag::QuestionsOpen>(range, what, fmt::format("{}", fmt::join(open, ", ")),
                                    fmt::format("{}", fmt::join(flags, " ")));
  return false;
}

std::string asciiText(State& state, const std::string& text, SourceRange range) {
  PlainText plain = plainText(text);
  if (plain.lost || plain.changed) state.diagnostics.report<diag::CommentPlain>(range, plain.text);
  return std::move(plain.text);
}

} // namespace dotek::backends::mikroprog
