// Blocks of functions, coordinates, feed and speed.
#include "frontend/nc/Lifter.h"
#include "support/messages/Nc.h"

#include <algorithm>

namespace dotek::frontend::nc {

using stdlib::Function;

namespace {

// The code moves nothing by itself: coordinates beside it are a move by G0 or G1, G90 or G91 as in force.
bool leavesCoordinates(const stdlib::CodeInfo* code) {
  if (code == nullptr) return true; // M: a G code that no table has may have any effect
  switch (code->function) {
  case Function::Rapid:
  case Function::Feed:
  case Function::PlaneXY:
  case Function::PlaneZX:
  case Function::PlaneYZ:
  case Function::CutterCompOff:
  case Function::CutterCompLeft:
  case Function::CutterCompRight:
  case Function::ToolLengthPlus:
  case Function::ToolLengthMinus:
  case Function::ToolLengthOff:
  case Function::ScalingOff:
  case Function::RotationOff:
  case Function::MirrorOff:
  case Function::PolarOff:
  case Function::WorkSystem:
  case Function::ExtendedWorkSystem:
  case Function::CannedCycleOff:
  case Function::ReturnInitial:
  case Function::ReturnR:
  case Function::Absolute:
  case Function::Incremental:
  case Function::FeedPerMinute:
  case Function::FeedPerRevolution:
  case Function::PathMode:
  case Function::Stop:
  case Function::OptionalStop:
  case Function::SpindleClockwise:
  case Function::SpindleCounterClockwise:
  case Function::SpindleOff:
  case Function::CoolantMist:
  case Function::CoolantFlood:
  case Function::CoolantOff:
  case Function::ProbeOn:
  case Function::ProbeOff:
  case Function::Auxiliary: return true;
  default: return false;
  }
}

} // namespace

bool Lifter::words() {
  Plan plan;
  for (const Code& code : codes_) {
    if (!function(code, plan)) return false;
  }
  leftOver(plan);
  if (plan.dwell && plan.motion)
    return refuse<diag::TwoFunctions>(block_.range, "G4", *plan.motion == ir::Motion::Rapid ? "G0" : "G1");
  if (plan.opaque.empty() && find('F') != nullptr && !plan.dwell) {
    bool perMinute = context_.state.feedPerMinute == true;
    for (const ir::SetMode& mode : plan.modes) {
      if (mode.mode == ir::Mode::FeedPerMinute) perMinute = true;
      if (mode.mode == ir::Mode::FeedPerRevolution) perMinute = false;
    }
    if (!perMinute) plan.opaque = "F"; // not mm/min
  }
  if (!plan.opaque.empty()) return opaque(plan);

  ir::ExpressionPtr feed;
  if (const Word* word = find('F')) {
    if (!inRange(*word, "a feed", false)) return false;
    feed = value(*word, {ir::Kind::Feed, false});
    if (!feed) return false;
    context_.state.feed = feed;
  }
  modalCodes(plan);
  for (const ir::SetMode& mode : plan.modes)
    add(mode);
  if (plan.probe) add(*plan.probe);
  if (plan.spindle) {
    if (const Word* speed = find('S')) {
      if (!inRange(*speed, "a spindle speed", true)) return false;
      plan.spindle->speed = value(*speed, {});
      if (!plan.spindle->speed) return false;
    }
    add(*plan.spindle);
  }
  if (plan.coolant) add(*plan.coolant);
  if (plan.dwell && feed) feedAlone();
  if (plan.dwell && !dwell()) return false;
  if (!plan.dwell && !motion(feed)) return false;
  if (plan.stop) add(*plan.stop);
  return true;
}

// What the code adds to the plan; false where it was refused.
bool Lifter::function(const Code& code, Plan& plan) {
  const auto mode = [&](ir::Mode one) {
    plan.modes.push_back({one, nullptr});
    return true;
  };
  const auto foreign = [&](bool anyEffect) {
    if (plan.opaque.empty()) plan.opaque = wordText(*code.word);
    plan.anyEffect = plan.anyEffect || anyEffect;
    return true;
  };
  // A G code that the table lacks may be a macro of the builder; an M code goes to the machine's logic.
  if (code.info == nullptr) return foreign(code.word->address == 'G');
  switch (code.info->function) {
  case Function::Rapid: plan.motion = ir::Motion::Rapid; return true;
  case Function::Feed: plan.motion = ir::Motion::Feed; return true;
  case Function::Dwell: plan.dwell = true; return true;
  case Function::PlaneXY: return mode(ir::Mode::PlaneXY);
  case Function::PlaneZX: return mode(ir::Mode::PlaneZX);
  case Function::PlaneYZ: return mode(ir::Mode::PlaneYZ);
  case Function::CutterCompOff: return mode(ir::Mode::CutterCompOff);
  case Function::CannedCycleOff: return mode(ir::Mode::CannedCycleOff);
  case Function::Absolute: return mode(ir::Mode::Absolute);
  case Function::Incremental: return mode(ir::Mode::Incremental);
  case Function::FeedPerMinute: return mode(ir::Mode::FeedPerMinute);
  case Function::FeedPerRevolution: return mode(ir::Mode::FeedPerRevolution);
  case Function::WorkSystem:
    for (const Code& other : codes_) {
      // The group is not known for every control.
      if (other.word != code.word && other.info != nullptr && other.info->function == Function::WorkSystem)
        return refuse<diag::TwoFunctions>(code.word->range, wordText(*other.word), wordText(*code.word));
    }
    plan.modes.push_back({ir::Mode::WorkSystem, ir::constant(code.tenths / 10, code.word->range)});
    return true;
  case Function::Inch: return refuse<diag::InchInBranch>(code.word->range, wordText(*code.word));
  case Function::Metric:
    // The emitted program demands it of its caller.
    context_.diagnostics.report<diag::WordLeftOut>(
        code.word->range, wordText(*code.word),
        "the result counts in millimetres; a Fanuc program checks that its caller does");
    return true;
  case Function::ProgramEnd:
  case Function::Return: return refuse<diag::EndInBranch>(code.word->range, wordText(*code.word));
  case Function::SubprogramCall: return foreign(true);
  case Function::Stop:
  case Function::OptionalStop:
  case Function::SpindleClockwise:
  case Function::SpindleCounterClockwise:
  case Function::SpindleOff:
  case Function::CoolantMist:
  case Function::CoolantFlood:
  case Function::CoolantOff:
  case Function::ProbeOn:
  case Function::ProbeOff: return miscellaneous(code, plan);
  // Known to the control, and to the simulator perhaps; not translated.
  default: return foreign(false);
  }
}

bool Lifter::miscellaneous(const Code& code, Plan& plan) {
  const auto once = [&](auto& slot, auto node) {
    if (slot) {
      const auto same = [&](const Code& one) { return one.word != code.word && one.word->address == 'M'; };
      const auto other = std::find_if(codes_.begin(), codes_.end(), same);
      return refuse<diag::TwoFunctions>(
          code.word->range, other == codes_.end() ? "M" : wordText(*other->word), wordText(*code.word));
    }
    slot = std::move(node);
    return true;
  };
  using State = ir::Spindle::State;
  using Coolant = ir::Coolant::State;
  switch (code.info->function) {
  case Function::Stop: return once(plan.stop, ir::Stop{false, ""});
  case Function::OptionalStop: return once(plan.stop, ir::Stop{true, ""});
  case Function::SpindleClockwise: return once(plan.spindle, ir::Spindle{State::Clockwise, nullptr});
  case Function::SpindleCounterClockwise:
    return once(plan.spindle, ir::Spindle{State::CounterClockwise, nullptr});
  case Function::SpindleOff: return once(plan.spindle, ir::Spindle{State::Off, nullptr});
  case Function::CoolantMist: return once(plan.coolant, ir::Coolant{Coolant::Mist});
  case Function::CoolantFlood: return once(plan.coolant, ir::Coolant{Coolant::Flood});
  case Function::CoolantOff: return once(plan.coolant, ir::Coolant{Coolant::Off});
  case Function::ProbeOn: return once(plan.probe, ir::ProbePower{true});
  case Function::ProbeOff: return once(plan.probe, ir::ProbePower{false});
  default: return true;
  }
}

// A word that nothing of the plan takes makes the block opaque.
void Lifter::leftOver(Plan& plan) {
  if (!plan.opaque.empty()) return;
  for (const Word& word : block_.words) {
    bool taken = word.address == 'G' || word.address == 'M';
    if (plan.dwell) {
      taken = taken || word.address == 'X' || word.address == 'P';
    } else {
      taken = taken || word.address == 'F' || (word.address >= 'X' && word.address <= 'Z') ||
              (word.address == 'S' && plan.spindle && plan.spindle->state != ir::Spindle::State::Off);
    }
    if (taken) continue;
    plan.opaque = wordText(word);
    return;
  }
}

// Modes of the block in the state; G0 and G1 without an axis set the mode alone.
void Lifter::modalCodes(Plan& plan) {
  for (const ir::SetMode& mode : plan.modes) {
    if (mode.mode == ir::Mode::Absolute) context_.state.absolute = true;
    if (mode.mode == ir::Mode::Incremental) context_.state.absolute = false;
    if (mode.mode == ir::Mode::FeedPerMinute) context_.state.feedPerMinute = true;
    if (mode.mode == ir::Mode::FeedPerRevolution) context_.state.feedPerMinute = false;
  }
  if (!plan.motion) return;
  context_.state.motion = plan.motion;
  const bool moves = !plan.dwell && (find('X') != nullptr || find('Y') != nullptr || find('Z') != nullptr);
  if (!moves)
    plan.modes.push_back(
        {*plan.motion == ir::Motion::Rapid ? ir::Mode::RapidMotion : ir::Mode::FeedMotion, nullptr});
}

void Lifter::feedAlone() {
  context_.diagnostics.report<diag::WordLeftOut>(find('F')->range, wordText(*find('F')),
                                                 "it is written with the moves that run at it");
}

bool Lifter::inRange(const Word& word, std::string_view what, bool zero) {
  const std::optional<double> known = knownNumber(*word.value);
  if (!known || *known > 0 || (zero && *known == 0)) return true;
  return refuse<diag::ValueOutOfRange>(word.range, word.address, numberText(*known), what,
                                       zero ? "0 or more" : "above 0");
}

bool Lifter::motion(const ir::ExpressionPtr& feed) {
  ir::Move move;
  bool any = false;
  for (const ir::Axis axis : ir::kAxes) {
    const Word* word = find(ir::letterOf(axis));
    if (word == nullptr) continue;
    if (!context_.state.motion)
      return refuse<diag::ModeNotKnown>(word->range, wordText(*word), "G0 or G1", "G0 or G1");
    if (!context_.state.absolute)
      return refuse<diag::ModeNotKnown>(word->range, wordText(*word), "G90 or G91", "G90 or G91");
    const ir::ExpressionPtr read = value(*word, {ir::Kind::Length, true});
    if (!read) return false;
    const ir::Frame frame = *context_.state.absolute ? ir::Frame::Work : ir::Frame::Here;
    move.axes[ir::indexOf(axis)] = ir::Coordinate{read, frame, nullptr};
    any = true;
  }
  if (!any) {
    if (feed) feedAlone();
    return true;
  }
  move.motion = *context_.state.motion;
  if (move.motion == ir::Motion::Feed && context_.state.feedPerMinute != true)
    return refuse<diag::ModeNotKnown>(block_.range, "the feed", "G94 or G95", "G94");
  move.feed = move.motion == ir::Motion::Feed ? context_.state.feed : feed;
  add(std::move(move));
  return true;
}

bool Lifter::dwell() {
  const Word* seconds = find('X');
  const Word* milliseconds = find('P');
  if ((seconds == nullptr) == (milliseconds == nullptr)) return refuse<diag::DwellForm>(block_.range);
  const Word& word = seconds == nullptr ? *milliseconds : *seconds;
  if (!inRange(word, "a dwell", true)) return false;
  // P1. is a second there, and what a computed P counts in no source.
  const bool byP = context_.control.dwellLetter == 'P';
  const std::optional<double> literal = byP && word.value ? knownNumber(*word.value) : std::nullopt;
  if (byP && (seconds != nullptr || !literal)) return refuse<diag::DwellForm>(block_.range);
  ir::ExpressionPtr read = value(word, {ir::Kind::Number, seconds != nullptr});
  if (!read) return false;
  if (seconds == nullptr && !(byP && ir::numberWithoutPoint(rawValue(word)) == nullptr)) {
    if (const double* constant = ir::constantValue(read))
      read = ir::constant(*constant / 1000, word.range);
    else
      read = ir::binary(ir::BinaryOp::Divide, read, ir::constant(1000, word.range), word.range);
  }
  add(ir::Dwell{read});
  return true;
}

// The program gets its modes from a caller: a copied move needs its own as a translated one does.
bool Lifter::knownModes(const Plan& plan) {
  if (plan.anyEffect || !std::all_of(codes_.begin(), codes_.end(),
                                     [](const Code& code) { return leavesCoordinates(code.info); }))
    return true;
  const auto coordinate = std::find_if(block_.words.begin(), block_.words.end(), [](const Word& word) {
    return std::string_view("XYZABCUVW").find(word.address) != std::string_view::npos;
  });
  if (coordinate == block_.words.end()) return true;
  const auto has = [&](ir::Mode one, ir::Mode other) {
    return std::any_of(plan.modes.begin(), plan.modes.end(),
                       [&](const ir::SetMode& mode) { return mode.mode == one || mode.mode == other; });
  };
  const bool code = plan.opaque.front() == 'G';
  if (!plan.motion && !context_.state.motion)
    return refuse<diag::ModeNotKnown>(coordinate->range, wordText(*coordinate), "G0 or G1",
                                      code ? "G0 " + plan.opaque : "G0 or G1");
  if (!has(ir::Mode::Absolute, ir::Mode::Incremental) && !context_.state.absolute)
    return refuse<diag::ModeNotKnown>(coordinate->range, wordText(*coordinate), "G90 or G91", "G90 or G91");
  return true;
}

bool Lifter::opaque(const Plan& plan) {
  if (!knownModes(plan)) return false;
  ir::OpaqueBlock opaque;
  for (const Word& word : block_.words) {
    const ir::ExpressionPtr read = rawValue(word);
    if (!read) return false;
    opaque.words.push_back({word.address, read, word.range});
  }
  context_.diagnostics.report<diag::OpaqueBlock>(block_.range, plan.opaque);
  ModalState& state = context_.state;
  if (plan.anyEffect) state = {std::nullopt, std::nullopt, std::nullopt, nullptr};
  Plan known = plan;
  modalCodes(known);
  const Word* feed = find('F');
  if (feed != nullptr) {
    state.feed = nullptr; // read under a mode that is not known to be mm/min
    for (const ir::Word& word : opaque.words) {
      if (word.address == 'F' && state.feedPerMinute == true) state.feed = word.value;
    }
  }
  // An arc or a canned cycle takes the coordinates that follow, until G0 or G1 is there.
  const stdlib::CodeInfo* rapid = context_.control.find(Function::Rapid);
  const stdlib::CodeInfo* cycleOff = context_.control.find(Function::CannedCycleOff);
  for (const Code& code : codes_) {
    if (code.info == nullptr || !code.info->group || code.info == cycleOff || plan.motion) continue;
    for (const stdlib::CodeInfo* one : {rapid, cycleOff}) {
      if (one != nullptr && one->group == code.info->group) state.motion = std::nullopt;
    }
  }
  add(std::move(opaque));
  return true;
}

} // namespace dotek::frontend::nc
