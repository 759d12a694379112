// Blocks of another macro set than the source's: from what they mean, by the signatures of the set.
#include "backends/fusion/State.h"
#include "ir/Fold.h"
#include "ir/Linear.h"
#include "ir/Walk.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Fusion.h"

#include <algorithm>
#include <cmath>

namespace dotek::backends::fusion {

namespace {

using stdlib::Function;

constexpr double kSame = 1e-6; // mm: start + travel is the nominal
constexpr double kFirstSystem = 54, kLastSystem = 59;

ir::ExpressionPtr sum(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::simplify(ir::binary(ir::BinaryOp::Add, a, b));
}
ir::ExpressionPtr difference(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::simplify(ir::binary(ir::BinaryOp::Subtract, a, b));
}

bool isMacro(const State& state, const ir::CycleStatement& statement) {
  return match(
      statement,
      [&](const ir::ProbePower& node) {
        const auto intent = node.on ? stdlib::Intent::ProbeOn : stdlib::Intent::ProbeOff;
        return state.options.macros.find(intent) != nullptr;
      },
      [](const ir::Measure&) { return true; },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Move, ir::Comment, ir::Assign,
                         ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm,
                         ir::OpaqueBlock> auto&) { return false; });
}

bool readsResult(const ir::CycleStatement& statement) {
  bool found = false;
  ir::eachNode(statement, [&](const ir::Expression& node) {
    found = found || std::holds_alternative<ir::MeasuredResult>(node.node);
  });
  return found;
}

const stdlib::MacroResult* find(const stdlib::MacroSignature& signature, ir::ResultName name) {
  const auto found = std::find_if(signature.results.begin(), signature.results.end(),
                                  [&](const stdlib::MacroResult& result) { return result.name == name; });
  return found == signature.results.end() ? nullptr : &*found;
}

// What stands for "the result" in a set that has none.
ir::ResultName nearestOf(const ir::Measure& measure) {
  constexpr ir::ResultName kPositions[] = {ir::ResultName::PositionX, ir::ResultName::PositionY,
                                           ir::ResultName::PositionZ};
  return measure.feature == ir::Feature::Bore ? ir::ResultName::Size : kPositions[ir::indexOf(measure.axis)];
}

std::string_view describe(ir::ResultName name) {
  switch (name) {
  case ir::ResultName::Main: return "the result";
  case ir::ResultName::PositionX: return "the position in X";
  case ir::ResultName::PositionY: return "the position in Y";
  case ir::ResultName::PositionZ: return "the position in Z";
  case ir::ResultName::Size: return "the size";
  }
  return "";
}

std::vector<ir::Axis> measuredAxes(const ir::Measure& measure) {
  if (measure.feature == ir::Feature::Bore) return {ir::Axis::X, ir::Axis::Y};
  return {measure.axis};
}

} // namespace

MacroBlocks::MacroBlocks(State& state, Texts& texts) : state_(state), texts_(texts) {
  constexpr std::string_view kStarts[] = {"start_x", "start_y", "start_z"};
  for (const ir::Axis axis : ir::kAxes) {
    const std::size_t i = ir::indexOf(axis);
    const auto fixed = state.options.fixedByName.find(std::string(kStarts[i]));
    at_[i].value = fixed != state.options.fixedByName.end() ? ir::constant(fixed->second)
                                                            : ir::variable(state.host(kStarts[i]));
  }
}

bool MacroBlocks::block(const std::vector<const ir::CycleStatement*>& statements, std::vector<Text>& lines) {
  const bool rewritten =
      std::any_of(statements.begin(), statements.end(), [&](const ir::CycleStatement* one) {
        return isMacro(state_, *one) || std::holds_alternative<ir::Move>(one->node) || readsResult(*one);
      });
  for (const ir::CycleStatement* one : statements) {
    const ir::Origin& origin = one->origin;
    match(
        *one,
        [&](const ir::OpaqueBlock&) {
          state_.refuse<diag::FusionOpaque>(origin.range(), state_.options.macros.title);
        },
        [&](const ir::SetMode& node) {
          if (node.mode == ir::Mode::WorkSystem) {
            for (Place& place : at_)
              place.value = nullptr;
          } else if (node.mode == ir::Mode::Absolute || node.mode == ir::Mode::Incremental) {
            incremental_ = node.mode == ir::Mode::Incremental ? &origin : nullptr;
            overwritten_ = false;
          }
        },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Move, ir::Measure, ir::ProbePower,
                           ir::Comment, ir::Assign, ir::Return, ir::Spindle, ir::Coolant, ir::Dwell, ir::Stop,
                           ir::Alarm> auto&) {});
  }
  if (!rewritten) return false;
  Text codes;
  for (const ir::CycleStatement* one : statements) {
    const ir::Origin& origin = one->origin;
    const auto other = [&] {
      if (!otherCode(*one, codes)) state_.refuse<diag::FusionMixedBlock>(origin.range());
    };
    match(
        *one, [&](const ir::Move& node) { move(node, origin, lines); },
        [&](const ir::Measure& node) { measure(node, origin, lines); },
        [&](const ir::ProbePower& node) {
          if (isMacro(state_, *one))
            switchProbe(node.on, lines);
          else
            other();
        },
        [&](const ir::Store& node) { store(node, origin, lines); },
        [&](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Comment, ir::Assign, ir::Return, ir::Spindle,
                            ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm,
                            ir::OpaqueBlock> auto&) { other(); });
  }
  if (codes.expression() != "\"\"") lines.insert(lines.begin(), std::move(codes));
  return true;
}

const ir::Origin* MacroBlocks::putBack(Text& text) {
  if (incremental_ == nullptr || !overwritten_) return nullptr;
  code(Function::Incremental, "incremental programming", *incremental_, text);
  return incremental_;
}

void MacroBlocks::code(Function function, std::string_view what, const ir::Origin& origin, Text& text) {
  const stdlib::CodeInfo* found = state_.options.control.find(function);
  if (found == nullptr) {
    state_.refuse<diag::NoCode>(origin.range(), state_.options.control.title, what);
    return;
  }
  const std::string code = std::string(1, found->letter) + numberText(found->tenths / 10.0);
  text.add((text.expression() == "\"\"" ? "" : " ") + code);
}

// A code beside a move in the source's block; it acts before the move.
bool MacroBlocks::otherCode(const ir::CycleStatement& statement, Text& text) {
  const ir::Origin& origin = statement.origin;
  return match(
      statement, [&](const ir::SetMode& node) { return modeCode(node, origin, text); },
      [&](const ir::Spindle& node) {
        if (node.state != ir::Spindle::State::Off) return false;
        code(Function::SpindleOff, "the spindle off", origin, text);
        return true;
      },
      [&](const ir::Coolant& node) {
        if (node.state != ir::Coolant::State::Off) return false;
        code(Function::CoolantOff, "the coolant off", origin, text);
        return true;
      },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Move, ir::Measure, ir::ProbePower,
                         ir::Comment, ir::Assign, ir::Return, ir::Dwell, ir::Stop, ir::Alarm,
                         ir::OpaqueBlock> auto&) { return false; });
}

bool MacroBlocks::modeCode(const ir::SetMode& mode, const ir::Origin& origin, Text& text) {
  const auto write = [&](Function function, std::string_view what) {
    code(function, what, origin, text);
    return true;
  };
  switch (mode.mode) {
  case ir::Mode::Absolute:
  case ir::Mode::Incremental: return true; // each move says its own
  case ir::Mode::FeedPerMinute: return write(Function::FeedPerMinute, "feed per minute");
  case ir::Mode::PlaneXY: return write(Function::PlaneXY, "the plane XY");
  case ir::Mode::CutterCompOff: return write(Function::CutterCompOff, "cutter compensation off");
  case ir::Mode::CannedCycleOff: return write(Function::CannedCycleOff, "canned cycles off");
  case ir::Mode::FeedPerRevolution:
  case ir::Mode::PlaneZX:
  case ir::Mode::PlaneYZ:
  case ir::Mode::WorkSystem:
  case ir::Mode::RapidMotion:
  case ir::Mode::FeedMotion: break;
  }
  return false;
}

ir::ExpressionPtr MacroBlocks::place(const ir::Coordinate& coordinate, ir::Axis axis, ir::Frame wanted,
                                     const ir::Origin& origin) {
  const ir::ExpressionPtr& here = at_[ir::indexOf(axis)].value;
  const std::string letter(1, ir::letterOf(axis));
  ir::ExpressionPtr work;
  switch (coordinate.frame) {
  case ir::Frame::Work:
    if (coordinate.system == nullptr) work = coordinate.value;
    break;
  case ir::Frame::Here:
    if (wanted == ir::Frame::Here) return coordinate.value;
    if (here == nullptr) {
      state_.refuse<diag::StartUnknown>(origin.range(), letter);
      return nullptr;
    }
    work = sum(here, coordinate.value);
    break;
  case ir::Frame::Machine:
  case ir::Frame::Start:
  case ir::Frame::Retract: break;
  }
  if (work == nullptr) {
    state_.refuse<diag::FrameRefused>(origin.range(), "a coordinate", "a frame of its own");
    return nullptr;
  }
  if (wanted == ir::Frame::Work) return work;
  if (here == nullptr) {
    state_.refuse<diag::StartUnknown>(origin.range(), letter);
    return nullptr;
  }
  return difference(work, here);
}

void MacroBlocks::moved(const ir::Move& move) {
  for (const ir::Axis axis : ir::kAxes) {
    const auto& coordinate = move.axes[ir::indexOf(axis)];
    if (!coordinate) continue;
    Place& place = at_[ir::indexOf(axis)];
    if (coordinate->frame == ir::Frame::Work && coordinate->system == nullptr)
      place.value = coordinate->value;
    else if (coordinate->frame == ir::Frame::Here && place.value != nullptr)
      place.value = sum(place.value, coordinate->value);
    else
      place.value = nullptr;
  }
}

void MacroBlocks::move(const ir::Move& move, const ir::Origin& origin, std::vector<Text>& lines) {
  if (move.point == ir::ProbePoint::Contact) {
    state_.refuse<diag::FrameRefused>(origin.range(), "a move", "coordinates of the contact point");
    return;
  }
  if (move.motion == ir::Motion::Protected) {
    const auto* signature = state_.options.macros.find(stdlib::Intent::ProtectedMove);
    if (signature == nullptr) {
      state_.refuse<diag::MacroSetCannot>(origin.range(), state_.options.macros.title, "a protected move");
      return;
    }
    std::vector<std::pair<const stdlib::MacroArgument*, ir::ExpressionPtr>> arguments;
    for (const stdlib::MacroArgument& argument : signature->arguments) {
      if (argument.role == stdlib::ArgumentRole::Feed && move.feed != nullptr)
        arguments.emplace_back(&argument, move.feed);
      if (argument.role != stdlib::ArgumentRole::Target) continue;
      const auto& coordinate = move.axes[ir::indexOf(argument.axis)];
      if (coordinate)
        arguments.emplace_back(&argument, place(*coordinate, argument.axis, argument.frame, origin));
    }
    call(*signature, arguments, origin, lines);
    last_ = nullptr; // the macro works in the variables of the results
  } else {
    Text text;
    code(Function::Absolute, "absolute programming", origin, text);
    overwritten_ = true;
    code(move.motion == ir::Motion::Rapid ? Function::Rapid : Function::Feed, "this move", origin, text);
    for (const ir::Axis axis : ir::kAxes) {
      const auto& coordinate = move.axes[ir::indexOf(axis)];
      if (!coordinate) continue;
      const ir::ExpressionPtr value = place(*coordinate, axis, ir::Frame::Work, origin);
      if (value == nullptr) continue;
      text.add(std::string(" ") + ir::letterOf(axis));
      texts_.number(text, value, origin);
    }
    if (move.feed != nullptr) {
      text.add(" F");
      texts_.number(text, move.feed, origin);
    } else if (move.motion == ir::Motion::Feed) {
      state_.diagnostics.report<diag::FeedNotStated>(origin.range());
    }
    lines.push_back(std::move(text));
  }
  moved(move);
}

// The macro corrects the system by measured minus target: right where the target is the nominal.
bool MacroBlocks::requireNominal(const ir::Measure& measure, const ir::Origin& origin) {
  for (const ir::Axis axis : measuredAxes(measure)) {
    const ir::ExpressionPtr& nominal = measure.setting->nominal[ir::indexOf(axis)];
    const std::string letter(1, ir::letterOf(axis));
    if (nominal == nullptr) {
      state_.refuse<diag::MacroSetCannot>(origin.range(), state_.options.macros.title,
                                          "an offset of one axis of a feature alone");
      return false;
    }
    const ir::ExpressionPtr& here = at_[ir::indexOf(axis)].value;
    const ir::ExpressionPtr target =
        measure.target ? place(*measure.target, axis, ir::Frame::Work, origin) : here;
    if (target == nullptr) {
      if (!state_.failed) state_.refuse<diag::StartUnknown>(origin.range(), letter);
      return false;
    }
    if (ir::provenEqual(target, nominal, state_.cycle)) continue;
    const ir::ExpressionPtr away = difference(target, nominal);
    if (const double* known = ir::constantValue(away)) {
      if (std::abs(*known) <= kSame) continue;
      state_.refuse<diag::NominalNotTarget>(origin.range(), letter, numberText(*known),
                                            state_.options.macros.title);
      return false;
    }
    guardArithmetic(state_, away, origin);
    state_.errorIf("Math.abs(" + valueText(state_, away, origin.range()) + ") > 1e-6",
                   "the start and the travel do not lead to the nominal in " + letter +
                       "; the macro would set another offset",
                   origin);
  }
  return true;
}

void MacroBlocks::measure(const ir::Measure& measure, const ir::Origin& origin, std::vector<Text>& lines) {
  const bool bore = measure.feature == ir::Feature::Bore;
  const auto* signature =
      state_.options.macros.find(bore ? stdlib::Intent::Bore : stdlib::Intent::Surface, measure.axis);
  if (signature == nullptr) {
    state_.refuse<diag::MacroSetCannot>(origin.range(), state_.options.macros.title,
                                        bore ? std::string("a bore")
                                             : std::string("a surface along ") + ir::letterOf(measure.axis));
    return;
  }
  const auto* system = signature->find(stdlib::ArgumentRole::System, measure.axis);
  if (measure.setting && system == nullptr) {
    state_.refuse<diag::MacroSetCannot>(origin.range(), state_.options.macros.title, "a work offset");
    return;
  }
  if (measure.setting) {
    for (const ir::Axis axis : ir::kAxes) {
      const auto axes = measuredAxes(measure);
      if (measure.setting->nominal[ir::indexOf(axis)] != nullptr &&
          std::find(axes.begin(), axes.end(), axis) == axes.end())
        state_.refuse<diag::MacroSetCannot>(origin.range(), state_.options.macros.title,
                                            "an offset of an axis that it does not measure");
    }
    if (system->systemRule == stdlib::SystemRule::Error && !requireNominal(measure, origin)) return;
  }
  std::vector<std::pair<const stdlib::MacroArgument*, ir::ExpressionPtr>> arguments;
  for (const stdlib::MacroArgument& argument : signature->arguments) {
    ir::ExpressionPtr value;
    switch (argument.role) {
    case stdlib::ArgumentRole::Target:
      if (measure.target) value = place(*measure.target, argument.axis, argument.frame, origin);
      break;
    case stdlib::ArgumentRole::Diameter: value = measure.diameter; break;
    case stdlib::ArgumentRole::Overtravel: {
      const auto fixed = state_.options.fixedByName.find("overtravel");
      value = fixed != state_.options.fixedByName.end() ? ir::constant(fixed->second)
                                                        : ir::variable(state_.host("overtravel"));
      break;
    }
    case stdlib::ArgumentRole::Nominal:
      if (measure.setting) value = measure.setting->nominal[ir::indexOf(argument.axis)];
      break;
    case stdlib::ArgumentRole::System:
      if (!measure.setting) break;
      value = measure.setting->system;
      if (const double* known = ir::constantValue(ir::simplify(value))) {
        if (*known < kFirstSystem || *known > kLastSystem || *known != std::trunc(*known))
          state_.refuse<diag::SystemRange>(origin.range(), *known);
      } else {
        const std::string text = valueText(state_, value, origin.range(), true);
        state_.errorIf(text + " < 54 || " + text + " > 59 || " + text + " % 1 !== 0",
                       "the work offset is not 54 to 59", origin);
      }
      if (argument.systemCode == stdlib::SystemCode::Index)
        value = difference(value, ir::constant(kFirstSystem - 1));
      break;
    default: break; // a cycle says nothing of it
    }
    if (value != nullptr) arguments.emplace_back(&argument, value);
    if (value == nullptr && argument.required && !state_.failed) {
      const std::string letter(1, argument.letter);
      if (argument.role == stdlib::ArgumentRole::System || argument.role == stdlib::ArgumentRole::Nominal)
        state_.refuse<diag::NeedsOffset>(origin.range(), state_.options.macros.title, letter);
      else
        state_.refuse<diag::MacroArgumentMissing>(origin.range(), signature->program, letter);
    }
  }
  if (state_.failed) return;
  // A system that the call corrects stands last, as posts write it.
  std::stable_partition(arguments.begin(), arguments.end(), [](const auto& one) {
    return one.first->role != stdlib::ArgumentRole::System ||
           one.first->systemRule != stdlib::SystemRule::Error;
  });
  call(*signature, arguments, origin, lines);
  last_ = &measure;
  // The system that was set may be the active one.
  for (const ir::Axis axis : ir::kAxes)
    if (measure.setting && measure.setting->nominal[ir::indexOf(axis)] != nullptr)
      at_[ir::indexOf(axis)].value = nullptr;
}

void MacroBlocks::call(
    const stdlib::MacroSignature& signature,
    const std::vector<std::pair<const stdlib::MacroArgument*, ir::ExpressionPtr>>& arguments,
    const ir::Origin& origin, std::vector<Text>& lines) {
  Text text;
  text.add("G65 P" + std::to_string(signature.program));
  for (const auto& [argument, value] : arguments) {
    if (value == nullptr) return; // refused
    const bool positive =
        argument->role == stdlib::ArgumentRole::Feed || argument->role == stdlib::ArgumentRole::Diameter;
    if (positive && ir::constantValue(ir::simplify(value)) == nullptr)
      state_.errorIf(valueText(state_, value, origin.range()) + " <= 0",
                     std::string(stdlib::roleName(argument->role)) + " of macro " +
                         std::to_string(signature.program) + " is not above 0",
                     origin);
    text.add(std::string(" ") + argument->letter);
    texts_.number(text, value, origin);
  }
  lines.push_back(std::move(text));
}

void MacroBlocks::switchProbe(bool on, std::vector<Text>& lines) {
  Text text;
  text.add("G65 P" +
           std::to_string(
               state_.options.macros.find(on ? stdlib::Intent::ProbeOn : stdlib::Intent::ProbeOff)->program));
  lines.push_back(std::move(text));
  last_ = nullptr;
}

void MacroBlocks::store(const ir::Store& store, const ir::Origin& origin, std::vector<Text>& lines) {
  const auto* result = std::get_if<ir::MeasuredResult>(&store.value->node);
  const double* number = ir::constantValue(store.number);
  if (result == nullptr || number == nullptr) {
    state_.refuse<diag::FusionMixedBlock>(origin.range());
    return;
  }
  const stdlib::MacroSignature* signature =
      last_ == nullptr
          ? nullptr
          : state_.options.macros.find(last_->feature == ir::Feature::Bore ? stdlib::Intent::Bore
                                                                           : stdlib::Intent::Surface,
                                       last_->axis);
  const stdlib::MacroResult* found = signature == nullptr ? nullptr : find(*signature, result->name);
  if (found == nullptr && signature != nullptr && result->name == ir::ResultName::Main) {
    found = find(*signature, nearestOf(*last_));
    if (found != nullptr)
      state_.diagnostics.report<diag::ResultDiffers>(
          store.value->range, found->variable, state_.options.macros.title, describe(nearestOf(*last_)));
  }
  if (found == nullptr) {
    if (state_.failed) return; // the measurement was refused
    state_.refuse<diag::ResultUnknown>(origin.range(), state_.options.macros.title, describe(result->name));
    return;
  }
  Text text;
  text.add("#" + numberText(*number) + "=#" + std::to_string(found->variable));
  lines.push_back(std::move(text));
}

} // namespace dotek::backends::fusion
