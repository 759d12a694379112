// Blocks of another macro set than the source's: from what they mean, by the signatures of the set.
#include "backends/common/CycleTouches.h"
#include "backends/common/MacroCall.h"
#include "backends/common/NamedSystems.h"
#include "backends/fusion/State.h"
#include "ir/Evaluate.h"
#include "ir/Flow.h"
#include "ir/Fold.h"
#include "ir/Linear.h"
#include "ir/Walk.h"
#include "stdlib/KeptResults.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Fusion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dotek::backends::fusion {

namespace {

using stdlib::Function;

constexpr double kSomeRadius = 2.7391; // mm: a path that fits one radius alone does not fit it
constexpr double kSame = 1e-6;         // mm: start + travel is the nominal
constexpr double kFirstSystem = 54, kLastSystem = 59;

ir::ExpressionPtr sum(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::simplify(ir::binary(ir::BinaryOp::Add, a, b));
}
ir::ExpressionPtr difference(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::simplify(ir::binary(ir::BinaryOp::Subtract, a, b));
}

const stdlib::MacroSignature* switchOf(const State& state, const ir::ProbePower& power) {
  return state.options.macros.find(power.on ? stdlib::Intent::ProbeOn : stdlib::Intent::ProbeOff);
}

bool isMacro(const State& state, const ir::CycleStatement& statement) {
  return match(
      statement,
      [&](const ir::ProbePower& node) {
        // A macro of the source's set does not switch the probe here.
        const bool called = statement.origin.addresses.find('P') != std::string::npos;
        return called || switchOf(state, node) != nullptr;
      },
      [](const ir::OneOf<ir::Measure, ir::CallCycle> auto&) { return true; },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Move, ir::Comment, ir::Assign,
                         ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm,
                         ir::OpaqueBlock, ir::Port, ir::Print> auto&) { return false; });
}

bool readsResult(const ir::CycleStatement& statement) {
  bool found = false;
  ir::eachNode(statement, [&](const ir::Expression& node) {
    found = found || std::holds_alternative<ir::MeasuredResult>(node.node);
  });
  return found;
}

} // namespace

MacroBlocks::MacroBlocks(State& state, Texts& texts)
    : state_(state), texts_(texts), calls_(callsMacros(state.cycle)) {
  constexpr std::string_view kStarts[] = {"start_x", "start_y", "start_z"};
  for (const ir::Axis axis : ir::kAxes) {
    const std::size_t i = ir::indexOf(axis);
    const auto fixed = state.options.fixedByName.find(std::string(kStarts[i]));
    at_[i].value = fixed != state.options.fixedByName.end() ? ir::constant(fixed->second)
                                                            : ir::variable(state.host(kStarts[i]));
  }
  planCopies();
}

bool MacroBlocks::block(const std::vector<const ir::CycleStatement*>& statements, std::vector<Text>& lines) {
  compared_.clear();
  replaced_.clear();
  const bool rewritten =
      std::any_of(statements.begin(), statements.end(), [&](const ir::CycleStatement* one) {
        return isMacro(state_, *one) || (calls_ && std::holds_alternative<ir::Move>(one->node)) ||
               (readsResult(*one) && !comparesAlike(*one) && !comparesOthers(*one));
      });
  for (const ir::CycleStatement* one : statements) {
    const ir::Origin& origin = one->origin;
    match(
        *one,
        [&](const ir::OpaqueBlock& node) {
          opaque_ = &origin;
          if (calls_ && !leavesModes(node) && !endsBranch(*one, node)) {
            state_.refuse<diag::FusionOpaque>(origin.range(), state_.options.macros.title);
            return;
          }
          if (movesNothing(node)) return;
          // T only turns the magazine, and a tool length is along Z.
          const auto isOnly = [&](std::string_view addresses, double code) {
            return std::all_of(node.words.begin(), node.words.end(), [&](const ir::Word& word) {
              const double* number = word.value == nullptr ? nullptr : ir::constantValue(word.value);
              if (word.address == 'G') return number != nullptr && *number == code;
              return addresses.find(word.address) != std::string_view::npos;
            });
          };
          if (isOnly("NT", -1)) return;
          const bool length = isOnly("NHZ", 43) || isOnly("NHZ", 44) || isOnly("N", 49);
          for (Place& place : at_)
            if (!length || &place == &at_[ir::indexOf(ir::Axis::Z)]) place.value = nullptr;
          setLast(nullptr);
        },
        [&](const ir::Print& node) {
          const stdlib::MacroSet* const source = state_.options.source;
          for (const ir::PrintPiece& piece : node.pieces)
            if (calls_ && piece.number && source != nullptr &&
                std::any_of(source->overwritten.begin(), source->overwritten.end(), [&](const auto& range) {
                  return range.first <= *piece.number && *piece.number <= range.second;
                }))
              state_.refuse<diag::FusionResultPrinted>(origin.range(), *piece.number, *piece.number);
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
        [&](const ir::OneOf<ir::Label, ir::Store> auto&) { flow(*one); },
        [](const ir::OneOf<ir::Jump, ir::Branch, ir::Move, ir::Measure, ir::CallCycle, ir::ProbePower,
                           ir::Comment, ir::Assign, ir::Return, ir::Spindle, ir::Coolant, ir::Dwell, ir::Stop,
                           ir::Alarm, ir::Port> auto&) {});
  }
  if (!rewritten) return false;
  Text codes;
  std::string comment; // after the first block
  for (const ir::CycleStatement* one : statements) {
    const ir::Origin& origin = one->origin;
    const auto other = [&] {
      if (otherCode(*one, codes)) return;
      if (readsResult(*one))
        state_.refuse<diag::FusionResultCompared>(origin.range());
      else
        state_.refuse<diag::FusionMixedBlock>(origin.range());
    };
    match(
        *one, [&](const ir::Move& node) { move(node, origin, lines); },
        [&](const ir::Measure& node) {
          measure(node, origin, lines);
          copyResults(*one, lines);
          setLast(one);
        },
        [&](const ir::CallCycle& node) {
          cycle(node, origin, lines);
          copyResults(*one, lines);
          setLast(one);
        },
        [&](const ir::ProbePower& node) {
          if (isMacro(state_, *one))
            switchProbe(node, origin, lines);
          else
            other();
        },
        [&](const ir::Store& node) {
          if (!moved_.contains(one)) store(node, origin, lines);
          for (Place& place : expected_)
            forgetStored(place, node);
        },
        [&](const ir::Comment& node) { comment += " (" + node.text + ")"; },
        [](const ir::Label&) {}, // its number is before the lines
        [&](const ir::OneOf<ir::Jump, ir::Branch, ir::Assign, ir::Return, ir::Spindle, ir::Coolant,
                            ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm, ir::OpaqueBlock, ir::Port,
                            ir::Print> auto&) { other(); });
  }
  if (codes.expression() != "\"\"") lines.insert(lines.begin(), std::move(codes));
  if (!lines.empty()) lines.front().add(comment);
  return true;
}

const ir::Origin* MacroBlocks::putBack(Text& text) {
  if (incremental_ == nullptr || !overwritten_) return nullptr;
  code(Function::Incremental, "incremental programming", *incremental_, text);
  return incremental_;
}

// Codes that end what the caller has not put in force, say how exactly corners are passed, or wait (G53
// alone).
bool MacroBlocks::movesNothing(const ir::OpaqueBlock& block) const {
  return std::all_of(block.words.begin(), block.words.end(), [&](const ir::Word& word) {
    if (word.address != 'G') return std::string_view("NPQ").find(word.address) != std::string_view::npos;
    const stdlib::CodeInfo* info = codeOf(word);
    return info != nullptr &&
           (info->function == Function::RotationOff || info->function == Function::ScalingOff ||
            info->function == Function::PathMode || info->function == Function::MachineCoordinates);
  });
}

const stdlib::CodeInfo* MacroBlocks::codeOf(const ir::Word& word) const {
  const double* code = word.value == nullptr ? nullptr : ir::constantValue(word.value);
  if (code == nullptr || *code < 0 || *code > 9999) return nullptr;
  return state_.options.control.find(word.address, static_cast<std::uint32_t>(std::lround(*code * 10)));
}

// Nothing moves and no macro runs after the block: what it leaves is for the operations after this one, as
// the source has it. A subprogram may read what the source's macros leave.
bool MacroBlocks::endsBranch(const ir::CycleStatement& statement, const ir::OpaqueBlock& block) const {
  for (const ir::Word& word : block.words) {
    const stdlib::CodeInfo* info = word.address == 'G' || word.address == 'M' ? codeOf(word) : nullptr;
    if (word.address == 'G' && info == nullptr) return false;
    constexpr Function kOthers[] = {Function::SubprogramCall, Function::MacroCall, Function::ModalCall,
                                    Function::Skip,           Function::Return,    Function::ProgramEnd,
                                    Function::ProbeOn,        Function::ProbeOff};
    if (info != nullptr &&
        std::find(std::begin(kOthers), std::end(kOthers), info->function) != std::end(kOthers))
      return false;
  }
  const auto& body = state_.cycle.body;
  const ir::ProgramFlow flow = ir::flowOf(body);
  std::vector<bool> runs(body.size() + 1);
  for (std::size_t i = 0; i < body.size(); ++i)
    runs[i] = isMacro(state_, body[i]) || movesProbe(body[i]);
  const std::vector<bool> leads = ir::leadingTo(runs, flow);
  const auto at = static_cast<std::size_t>(&statement - body.data());
  return at < body.size() && std::none_of(flow.next[at].begin(), flow.next[at].end(),
                                          [&](std::size_t next) { return leads[next]; });
}

// The block moves the machine, changes the tool or takes its length: what macros rely on stays as it is.
bool MacroBlocks::leavesModes(const ir::OpaqueBlock& block) {
  for (const ir::Word& word : block.words) {
    if (word.address != 'G' && word.address != 'M') continue;
    const stdlib::CodeInfo* info = codeOf(word);
    if (info == nullptr) return false;
    switch (info->function) {
    case Function::Absolute:
    case Function::Incremental:
      incremental_ = info->function == Function::Incremental ? opaque_ : nullptr;
      overwritten_ = false;
      break;
    case Function::DataInput: // where the axes are is forgotten below
    case Function::ReferenceReturn:
    case Function::MachineCoordinates:
    case Function::ToolLengthPlus:
    case Function::ToolLengthOff: // our own macros look at it; along Z nothing is known after it
    case Function::ToolChange:
    case Function::Auxiliary:
    case Function::RotationOff: // the caller has none on, nor a scale
    case Function::ScalingOff:
    case Function::PathMode:
    case Function::Rapid:
    case Function::Feed:
    case Function::SpindleOff:
    case Function::CoolantOff: break;
    default: return false;
    }
  }
  return true;
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
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Move, ir::Measure, ir::CallCycle,
                         ir::ProbePower, ir::Comment, ir::Assign, ir::Return, ir::Dwell, ir::Stop, ir::Alarm,
                         ir::OpaqueBlock, ir::Port, ir::Print> auto&) { return false; });
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
  case ir::Mode::WorkSystem: {
    const double* system = mode.system == nullptr ? nullptr : ir::constantValue(ir::simplify(mode.system));
    if (system == nullptr || *system < kFirstSystem || *system > kLastSystem ||
        *system != std::trunc(*system))
      return false;
    text.add((text.expression() == "\"\"" ? "G" : " G") + numberText(*system));
    return true;
  }
  case ir::Mode::FeedPerRevolution:
  case ir::Mode::PlaneZX:
  case ir::Mode::PlaneYZ:
  case ir::Mode::RapidMotion:
  case ir::Mode::FeedMotion: break;
  }
  return false;
}

ir::ExpressionPtr MacroBlocks::place(const ir::Coordinate& coordinate, ir::Axis axis, ir::Frame wanted,
                                     const ir::Origin& origin, bool reads) {
  const std::string letter(1, ir::letterOf(axis));
  const bool travels = coordinate.system == nullptr && coordinate.frame != wanted &&
                       (coordinate.frame == ir::Frame::Here || wanted == ir::Frame::Here);
  ir::ExpressionPtr here = at_[ir::indexOf(axis)].value;
  if (here == nullptr && travels && reads) here = positionNow(axis);
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
    if (const auto axis = axisNotTaken(*signature, move))
      state_.refuse<diag::MacroSetCannot>(origin.range(), state_.options.macros.title,
                                          std::string("a protected move along ") + ir::letterOf(*axis));
    call(macroCall(*signature, move, values(origin)), origin, lines);
    // Else the macro may work in the variables of the results.
    if (!stdlib::keepsResults(*signature)) setLast(nullptr);
  } else {
    Text text;
    code(Function::Absolute, "absolute programming", origin, text);
    overwritten_ = true;
    code(move.motion == ir::Motion::Rapid ? Function::Rapid : Function::Feed, "this move", origin, text);
    for (const ir::Axis axis : ir::kAxes) {
      const auto& coordinate = move.axes[ir::indexOf(axis)];
      if (!coordinate) continue;
      const ir::ExpressionPtr value = place(*coordinate, axis, ir::Frame::Work, origin, true);
      if (value == nullptr) continue;
      text.add(std::string(" ") + ir::letterOf(axis));
      valueOfWord(text, value, origin);
    }
    if (waits_) wait(lines);
    if (move.feed != nullptr) {
      text.add(" F");
      valueOfWord(text, move.feed, origin);
    } else if (move.motion == ir::Motion::Feed) {
      state_.diagnostics.report<diag::FeedNotStated>(origin.range());
    }
    lines.push_back(std::move(text));
  }
  moved(move);
}

// With the first values of the fields, and a ball of any radius, the target is not the nominal, wherever the
// cycle starts.
bool MacroBlocks::missesNominal(const ir::Measure& measure, const ir::Origin& origin) {
  const ir::Cycle& cycle = state_.cycle;
  ir::Environment known(cycle.variables.size());
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    const ir::Variable& variable = cycle.variable(id);
    const auto given = state_.options.defaults.find(id);
    if (variable.role == ir::Role::Host && variable.name == "tool_radius")
      known[id] = ir::Scalar::of(kSomeRadius);
    if (variable.role != ir::Role::Parameter) continue;
    if (given != state_.options.defaults.end())
      known[id] = ir::Scalar::of(given->second);
    else if (variable.defaultValue)
      known[id] = ir::Scalar::of(*variable.defaultValue);
  }
  for (const ir::CycleStatement& statement : cycle.checks)
    if (const auto* assign = std::get_if<ir::Assign>(&statement.node))
      known[assign->variable] = ir::evaluate(*assign->value, known);
  const std::vector<ir::Axis> axes = measuredAxes(measure);
  return std::any_of(axes.begin(), axes.end(), [&](ir::Axis axis) {
    const ir::ExpressionPtr& nominal = measure.setting->nominal[ir::indexOf(axis)];
    if (nominal == nullptr || state_.failed) return false;
    const ir::ExpressionPtr target =
        measure.target ? place(*measure.target, axis, ir::Frame::Work, origin) : at_[ir::indexOf(axis)].value;
    if (target == nullptr) return false;
    const ir::ExpressionPtr between = difference(target, nominal);
    if (const double* fixed = ir::constantValue(between)) return std::abs(*fixed) > kSame;
    const ir::Scalar away = ir::evaluate(*between, known);
    return away.known() && std::abs(away.value) > kSame;
  });
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
    state_.errorIf("Math.abs(" + valueText(state_, away, origin.range()) + ") > " + std::string(kHalfDigit),
                   std::string(kMissedNominal) + letter + "; the macro would set another offset", origin);
  }
  return true;
}

void MacroBlocks::measure(const ir::Measure& measure, const ir::Origin& origin, std::vector<Text>& lines) {
  const auto* signature = signatureOf(state_.options.macros, measure);
  const auto cannot = [&](const std::string& what) {
    state_.refuse<diag::MacroSetCannot>(origin.range(), state_.options.macros.title, what);
  };
  if (signature == nullptr) return cannot(featureName(measure));
  const auto* system = signature->find(stdlib::ArgumentRole::System, measure.axis);
  CallValues given = values(origin);
  if (measure.setting) {
    if (system == nullptr) return cannot("a work offset");
    if (setsAnotherAxis(measure)) cannot("an offset of an axis that it does not measure");
    const bool own = !tellsNominal(measure) || missesNominal(measure, origin);
    given.setsSystem = system->systemRule != stdlib::SystemRule::Error || !own ||
                       !offsetObstacle(*signature, *measure.setting).empty();
    if (given.setsSystem && system->systemRule == stdlib::SystemRule::Error &&
        !requireNominal(measure, origin))
      return;
    guardSystem(measure.setting->system, *signature, given.setsSystem, origin);
    if (!given.setsSystem) checkShift(*measure.setting, lines, origin);
  }
  for (const ir::Axis axis : ir::kAxes)
    expected_[ir::indexOf(axis)].value =
        measure.target && axis == measure.axis && measure.target->frame == ir::Frame::Work
            ? measure.target->value
            : at_[ir::indexOf(axis)].value;
  ir::Measure sent = measure;
  if (sent.setting && given.setsSystem)
    sent.setting->system = systemForCall(sent.setting->system, *signature);
  MacroCall out = macroCall(*signature, sent, given);
  // A system that the call corrects is last, as posts write it.
  std::stable_partition(out.arguments.begin(), out.arguments.end(), [](const GivenArgument& one) {
    return one.argument->role != stdlib::ArgumentRole::System ||
           one.argument->systemRule != stdlib::SystemRule::Error;
  });
  call(out, origin, lines);
  if (state_.failed) return;
  if (const auto on = searchesOn(state_.options.source, state_.options.macros, *signature, measure);
      on && !state_.options.fixedByName.contains("overtravel") && !std::exchange(saysSearch_, true))
    state_.diagnostics.report<diag::SearchGoesOn>(origin.range(), signature->program, numberText(*on));
  if (!given.setsSystem) writeOffset(*measure.setting, *signature, lines, origin);
  // The system that was set may be the active one.
  for (const ir::Axis axis : ir::kAxes)
    if (measure.setting && measure.setting->nominal[ir::indexOf(axis)] != nullptr)
      at_[ir::indexOf(axis)].value = nullptr;
}

CallValues MacroBlocks::values(const ir::Origin& origin) {
  CallValues out;
  out.cycle = &state_.cycle;
  out.place = [this, &origin](const ir::Coordinate& coordinate, ir::Axis axis, ir::Frame frame) {
    return place(coordinate, axis, frame, origin, true);
  };
  // The operation has none: without `--host` the macro takes its own, as the source's does.
  if (const auto given = state_.options.fixedByName.find("overtravel");
      given != state_.options.fixedByName.end())
    out.overtravel = [over = given->second] { return ir::constant(over); };
  if (state_.options.source != nullptr)
    out.beyond = [this](ir::Axis axis) { return overtravelOf(state_.options.source, axis); };
  return out;
}

// Nothing is written where something was refused.
void MacroBlocks::call(const MacroCall& call, const ir::Origin& origin, std::vector<Text>& lines) {
  if (!state_.failed) refuseMissing(state_, state_.options.macros, call, origin.range());
  if (state_.failed) return;
  if (call.endsAtSurface)
    state_.diagnostics.report<diag::SearchEndsAtSurface>(origin.range(), call.signature->program);
  const stdlib::MacroSignature& signature = *call.signature;
  Text text;
  text.add("G65 P" + std::to_string(signature.program));
  for (const auto& [argument, value] : call.arguments) {
    const bool positive =
        argument->role == stdlib::ArgumentRole::Feed || argument->role == stdlib::ArgumentRole::Diameter;
    // What a variable of the control holds is for its macro to look at.
    if (positive && !needsControl(value) && ir::constantValue(ir::simplify(value)) == nullptr)
      state_.errorIf(valueText(state_, value, origin.range()) + " <= 0",
                     std::string(stdlib::roleName(argument->role)) + " of macro " +
                         std::to_string(signature.program) + " is not above 0",
                     origin);
    text.add(std::string(" ") + argument->letter);
    valueOfWord(text, value, origin);
  }
  if (waits_) wait(lines);
  lines.push_back(std::move(text));
}

void MacroBlocks::switchProbe(const ir::ProbePower& power, const ir::Origin& origin,
                              std::vector<Text>& lines) {
  const Function function = power.on ? Function::ProbeOn : Function::ProbeOff;
  Text text;
  if (const stdlib::MacroSignature* signature = switchOf(state_, power))
    text.add("G65 P" + std::to_string(signature->program));
  else if (state_.options.control.find(function) != nullptr)
    code(function, "", origin, text);
  else
    state_.refuse<diag::NoProbeCode>(origin.range(), state_.options.control.title,
                                     state_.options.macros.title, power.on ? "on" : "off");
  lines.push_back(std::move(text));
  setLast(nullptr);
}

} // namespace dotek::backends::fusion
