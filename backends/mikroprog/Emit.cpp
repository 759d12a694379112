#include "backends/mikroprog/Emit.h"

#include "backends/mikroprog/State.h"
#include "ir/Fold.h"
#include "ir/Linear.h"
#include "ir/Positions.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace dotek::backends::mikroprog {

namespace {

constexpr std::uint32_t kStep = 10;      // from block to block
constexpr std::uint32_t kTails = 900;    // the first tail, or the next hundred after the main program
constexpr std::uint32_t kCollision = 10; // from there
constexpr std::uint32_t kEnd = 90;       // from there
constexpr std::uint32_t kTailStep = 5, kLongTailStep = 3; // of one that retracts
constexpr std::uint32_t kSubprograms = 5000;              // the first, each at a thousand

bool measures(const ir::Cycle& cycle) {
  return std::any_of(cycle.body.begin(), cycle.body.end(), [](const ir::CycleStatement& statement) {
    const auto* call = std::get_if<ir::CallCycle>(&statement.node);
    return std::holds_alternative<ir::Measure>(statement.node) || (call != nullptr && call->moves);
  });
}

std::uint32_t roundedUp(std::uint32_t value, std::uint32_t to) {
  return (value + to - 1) / to * to;
}

// Writes the statements of the body.
class Body {
public:
  explicit Body(State& state) : s_(state) {}

  void write() {
    const auto& list = s_.cycle.body;
    for (std::size_t i = 0; i < list.size() && !s_.failed; ++i) {
      if (ir::probes(list[i]) && !probed_) {
        probed_ = true;
        settle(i);
      }
      if (s_.done.insert(&list[i]).second) one(list[i], i);
    }
  }

  // Before the program moves by itself: what the source switches off first.
  void settleFirst() {
    const auto& list = s_.cycle.body;
    bool spindle = false, coolant = false; // the first switch was seen
    std::string_view after;                // what the source has before it
    for (std::size_t i = 0; i < list.size() && !s_.failed; ++i) {
      if (ir::probes(list[i])) after = "probe move";
      if (after.empty() && std::holds_alternative<ir::Move>(list[i].node)) after = "move";
      const std::optional<Switch> found = switchOf(list[i]);
      if (!found || std::exchange(found->turns ? spindle : coolant, true) || !found->off) continue;
      (found->turns ? spindleOff_ : coolantOff_) = true;
      if (!after.empty()) {
        writeBefore(i, *found, after);
        continue;
      }
      s_.done.insert(&list[i]);
      one(list[i], i);
    }
  }

private:
  struct Switch {
    bool turns = false; // the spindle, else the coolant
    bool off = false;
  };
  static std::optional<Switch> switchOf(const ir::CycleStatement& statement) {
    return match(
        statement,
        [](const ir::Spindle& node) {
          return std::optional(Switch{true, node.state == ir::Spindle::State::Off});
        },
        [](const ir::Coolant& node) {
          return std::optional(Switch{false, node.state == ir::Coolant::State::Off});
        },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Move, ir::Measure, ir::CallCycle,
                           ir::ProbePower, ir::Comment, ir::Assign, ir::Return, ir::SetMode, ir::Dwell,
                           ir::Stop, ir::Alarm, ir::OpaqueBlock, ir::Port, ir::Print> auto&) {
          return std::optional<Switch>();
        });
  }

  // The switch at `index` of the body, before what the source has before it.
  void writeBefore(std::size_t index, const Switch& one, std::string_view what) {
    const ir::CycleStatement& statement = s_.cycle.body[index];
    s_.diagnostics.report<diag::MovedBefore>(statement.origin.range(),
                                             s_.code(one.turns ? "spindle-off" : "coolant-off"), what);
    s_.done.insert(&statement);
    this->one(statement, index);
  }

  // Spindle and coolant at rest before the first probe move, at `first`: what the source writes after it
  // comes before it.
  void settle(std::size_t first) {
    const auto& list = s_.cycle.body;
    bool spindle = spindleOff_, coolant = coolantOff_; // switched off
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::optional<Switch> found = switchOf(list[i]);
      if (!found) continue;
      bool& settled = found->turns ? spindle : coolant;
      if (i < first) {
        settled = found->off;
        continue;
      }
      if (settled) continue;
      if (!found->off) break;
      settled = true;
      writeBefore(i, *found, "probe move");
    }
    const auto missing = [&](bool settled, bool turns) {
      if (settled) return;
      const std::string_view what = turns ? "the spindle" : "the coolant";
      s_.diagnostics.report<diag::SpindleNotStopped>(
          list[first].origin.range(), what,
          turns ? "a turning spindle breaks the stylus" : "coolant moves the stylus",
          s_.options.cycleFile ? fmt::format("`{} off` before it", turns ? "spindle" : "coolant")
                               : s_.code(turns ? "spindle-off" : "coolant-off") + " into the branch");
      s_.remarks.push_back(
          fmt::format("NOTHING HERE STOPS {}: THE CALLER HAS TO", turns ? "THE SPINDLE" : "THE COOLANT"));
    };
    missing(spindle, true);
    missing(coolant, false);
  }

  void one(const ir::CycleStatement& statement, std::size_t index) {
    const ir::Origin& origin = statement.origin;
    const SourceRange range = origin.range();
    match(
        statement, [&](const ir::Move& node) { move(node, origin); },
        [&](const ir::Measure& node) { measure(s_, node, index); },
        [&](const ir::CallCycle& node) { cycle(s_, node, index); },
        [&](const ir::Comment& node) {
          if (isOfStop(index))
            stopText_ += (stopText_.empty() ? "" : " ") + node.text;
          else
            s_.sheet.comment(asciiText(s_, node.text, range), origin);
        },
        [&](const ir::Spindle& node) { spindle(node, origin); },
        [&](const ir::Coolant& node) { coolant(node, origin); },
        [&](const ir::ProbePower& node) { probePower(node, origin); },
        [&](const ir::SetMode& node) { mode(node, origin); },
        [&](const ir::Store& node) { store(node, origin); },
        [&](const ir::Dwell& node) {
          const auto seconds = rangedValueOf(s_, 'E', node.seconds, "a dwell", true, range);
          if (seconds) s_.sheet.add(s_.code("dwell") + " E" + numberWord(s_, *seconds, range), origin);
        },
        [&](const ir::Stop& node) {
          if (node.optional) {
            s_.refuse<diag::MikroprogCannot>(
                range, "a stop that the operator switches",
                "M1 needs a condition, and how its field is set is not known (Q14)");
            return;
          }
          if (node.number != 1)
            s_.diagnostics.report<diag::MessageNumberLost>(range, numberText(node.number), s_.control.title);
          const std::string beside = std::exchange(stopText_, "");
          stop(node.message.empty() ? beside : node.message, origin);
        },
        [&](const ir::Alarm& node) {
          // There are no branches: with its values the program does nothing else. In a post it is written so.
          if (s_.options.cycleFile) {
            s_.refuse<diag::MikroprogCannot>(
                range, fmt::format("with these values the cycle ends in its alarm `{}`", node.message),
                "a program of fixed values would never pass it; give others with `--set`");
            return;
          }
          s_.diagnostics.report<diag::AlarmStops>(range, s_.code("stop"));
          if (s_.remarked.insert("alarm").second)
            s_.remarks.push_back("AN ALARM IS A STOP WITH ITS TEXT AND THE END; ITS NUMBER IS NOT KEPT");
          stop(node.message, origin);
          toEnd(origin);
        },
        [&](const ir::Return&) { toEnd(origin); },
        [&](const ir::OpaqueBlock& node) {
          if (isLength(node)) return length(node, range);
          s_.refuse<diag::OpaqueBlockRefused>(range, addresses(node), "the source's control",
                                              s_.control.title);
        },
        [&](const ir::OneOf<ir::Port, ir::Print> auto&) {
          s_.refuse<diag::MikroprogCannot>(range, "what is printed through the port",
                                           "the control has no function for it");
        },
        [&](const ir::Branch&) {
          s_.refuse<diag::FlowRefused>(range, "what only the running program knows");
        },
        [&](const ir::Assign&) {
          s_.refuse<diag::MikroprogCannot>(range, "a value that only the running program knows",
                                           "whether parameters take sums is not known (Q10)");
        },
        [&](const ir::Label&) { s_.refuse<diag::FlowRefused>(range, "a loop without an end"); },
        [&](const ir::Jump&) {
          s_.refuse<diag::MikroprogCannot>(range, "this statement", "the control has no function for it");
        });
  }

  // Whether the comment at `index` is in the block of a stop, which shows it to the operator.
  bool isOfStop(std::size_t index) const {
    const auto& list = s_.cycle.body;
    const std::uint32_t block = list[index].origin.block;
    for (std::size_t i = index + 1; block != 0 && i < list.size() && list[i].origin.block == block; ++i) {
      const auto* stop = std::get_if<ir::Stop>(&list[i].node);
      if (stop != nullptr && !stop->optional && stop->message.empty()) return true;
    }
    return false;
  }

  static std::string addresses(const ir::OpaqueBlock& block) {
    std::string out;
    for (const ir::Word& word : block.words) {
      const double* value = word.value == nullptr ? nullptr : ir::constantValue(word.value);
      out += (out.empty() ? "" : " ") + std::string(1, word.address) + (value ? numberText(*value) : "..");
    }
    return out;
  }

  // G43 H1 D1: M6 puts the correction of a tool in force, and D is for G41 and G42, which are refused.
  static bool isLength(const ir::OpaqueBlock& block) {
    bool code = false, offset = false;
    for (const ir::Word& word : block.words) {
      const double* const value = word.value == nullptr ? nullptr : ir::constantValue(word.value);
      if (value == nullptr) return false;
      const bool isCode = word.address == 'G' && *value == 43;
      code = code || isCode;
      offset = offset || word.address == 'H';
      if (!isCode && word.address != 'H' && word.address != 'D') return false;
    }
    return code && offset;
  }
  void length(const ir::OpaqueBlock& block, SourceRange range) {
    const std::string text = addresses(block);
    left(range, "`" + text + "`",
         "M6 puts the correction of the tool in the spindle in force, and that has to be the probe's");
    if (s_.remarked.insert(text).second)
      s_.remarks.push_back(text + ": THE CORRECTION OF THE PROBE IS THAT OF M6");
  }

  void move(const ir::Move& move, const ir::Origin& origin) {
    const SourceRange range = origin.range();
    if (move.point == ir::ProbePoint::Contact) {
      s_.refuse<diag::MikroprogCannot>(range, "a move to coordinates of the contact point",
                                       "the control moves the probe, not the surface");
      return;
    }
    if (move.motion == ir::Motion::Protected) return protectedMove(s_, move, origin);
    const bool rapid = move.motion == ir::Motion::Rapid;
    std::string words = s_.code(rapid ? "rapid" : "feed");
    std::string comment;
    if (move.feed != nullptr) {
      s_.feed = rangedValueOf(s_, 'F', move.feed, "a feed", false, range);
      if (!s_.feed) return;
      if (rapid) {
        comment = "F" + numberText(*s_.feed) + " NOT KEPT";
        s_.diagnostics.report<diag::FeedDropped>(range, numberText(*s_.feed),
                                                 s_.code("rapid") + " moves at the machine's top speed");
      }
    }
    bool any = false;
    for (const ir::Axis axis : ir::kAxes) {
      const auto& target = move.axes[ir::indexOf(axis)];
      if (!target) continue;
      const std::optional<double> to = placeOf(s_, *target, axis, range);
      if (!to) return;
      AxisState& now = s_.axes[ir::indexOf(axis)];
      const bool lift =
          move.point == ir::ProbePoint::Lowest && axis == ir::Axis::Z && s_.options.lengthToCentre;
      now.at = lift ? *to + s_.host("tool_radius") : *to;
      s_.reaches(axis, *now.at);
      const double word = ir::exactSum(*now.at, now.shift).value_or(*now.at + now.shift);
      words += " " + axisWord(s_, axis, word, range);
      any = true;
    }
    if (!any) return;
    if (!rapid) {
      if (!s_.feed) {
        s_.refuse<diag::MikroprogCannot>(range, "a feed move without a feed",
                                         "the control begins with F0; write F into the block");
        return;
      }
      words += " F" + numberWord(s_, *s_.feed, range);
    }
    s_.sheet.add(std::move(words), origin, std::move(comment));
  }

  void spindle(const ir::Spindle& spindle, const ir::Origin& origin) {
    using TurnState = ir::Spindle::State;
    if (spindle.state == TurnState::Off) return s_.sheet.add(s_.code("spindle-off"), origin);
    const std::string code =
        s_.code(spindle.state == TurnState::Clockwise ? "spindle-right" : "spindle-left");
    if (spindle.speed == nullptr) {
      s_.refuse<diag::MikroprogCannot>(origin.range(), "a spindle without a speed", code + " needs S");
      return;
    }
    const auto speed = rangedValueOf(s_, 'S', spindle.speed, "a spindle speed", true, origin.range());
    if (speed) s_.sheet.add(code + " S" + numberWord(s_, *speed, origin.range()), origin);
  }

  void coolant(const ir::Coolant& coolant, const ir::Origin& origin) {
    if (coolant.state == ir::Coolant::State::Mist) {
      s_.refuse<diag::MikroprogCannot>(origin.range(), "mist coolant",
                                       "M8 is the only coolant of the control");
      return;
    }
    s_.sheet.add(s_.code(coolant.state == ir::Coolant::State::Off ? "coolant-off" : "coolant-on"), origin);
  }

  void probePower(const ir::ProbePower& power, const ir::Origin& origin) {
    s_.diagnostics.report<diag::ProbePowerDropped>(origin.range(), power.on ? "on" : "off");
    s_.sheet.comment(fmt::format("PROBE {}: NO FUNCTION OF THE CONTROL IS KNOWN", power.on ? "ON" : "OFF"),
                     origin);
    if (s_.remarked.insert("power").second) s_.remarks.push_back("PROBE ON AND OFF");
  }

  void store(const ir::Store& store, const ir::Origin& origin) {
    const double* number = ir::constantValue(store.number);
    const std::string name = number == nullptr ? "[..]" : numberText(*number);
    if (!std::holds_alternative<ir::MeasuredResult>(store.value->node)) {
      s_.refuse<diag::MikroprogCannot>(origin.range(), "a value in #" + name,
                                       "the control has parameters P, and nothing says which is free; take "
                                       "the statement out of the branch");
      return;
    }
    s_.diagnostics.report<diag::ResultDropped>(origin.range(), name);
    s_.sheet.comment(fmt::format("#{} NOT KEPT: SEE THE RECORD", name), origin);
  }

  void left(SourceRange range, std::string_view what, std::string_view why) {
    s_.diagnostics.report<diag::ModeDropped>(range, what, why);
  }

  void mode(const ir::SetMode& mode, const ir::Origin& origin) {
    using ir::Mode;
    const SourceRange range = origin.range();
    switch (mode.mode) {
    // Each coordinate is written absolute, each move says what it is, and the first block says the rest.
    case Mode::Absolute: return left(range, "absolute programming", "it is in force from the first block on");
    case Mode::Incremental:
      return left(range, "incremental programming", "each coordinate is written absolute");
    case Mode::RapidMotion:
    case Mode::FeedMotion: return left(range, "a motion code without an axis", "each move says its own");
    case Mode::FeedPerMinute: return left(range, "feed per minute", "it is in force from the first block on");
    case Mode::PlaneXY: return s_.sheet.add(s_.code("plane-xy"), origin);
    case Mode::PlaneZX: return s_.sheet.add(s_.code("plane-zx"), origin);
    case Mode::PlaneYZ: return s_.sheet.add(s_.code("plane-yz"), origin);
    case Mode::CutterCompOff: return s_.sheet.add(s_.code("compensation-off"), origin);
    case Mode::CannedCycleOff:
      if (s_.remarked.insert("canned").second)
        s_.remarks.push_back("THE END OF CANNED CYCLES: NONE STAYS IN FORCE");
      return left(range, "the end of canned cycles", "the control has none that stays in force");
    case Mode::FeedPerRevolution: s_.refuse<diag::FeedPerRevolution>(range); return;
    case Mode::WorkSystem:
      s_.refuse<diag::MikroprogCannot>(range, "a change of the work system",
                                       "G54 and G55 are stored shifts 3 and 4 here, the others do not exist; "
                                       "choose the shift on the machine");
      return;
    }
  }

  void stop(const std::string& message, const ir::Origin& origin) {
    const std::string text = asciiText(s_, message, origin.range());
    s_.sheet.add(s_.code("stop") + (text.empty() ? "" : " ;" + text), origin);
    s_.guarded = false;
  }

  void toEnd(const ir::Origin& origin) {
    s_.usesEnd = true;
    s_.sheet.jump(s_.code("jump"), s_.end, "", origin);
  }

  State& s_;
  bool probed_ = false;
  bool spindleOff_ = false, coolantOff_ = false; // by settleFirst()
  std::string stopText_;                         // comments of the block of the next stop
};

// Above all that lies between, in the coordinates of the source, where it is known at which Z the operator
// starts: that Z, or the clearance plane where it is higher.
std::optional<double> safeHeight(const State& state) {
  const auto& given = state.start[ir::indexOf(ir::Axis::Z)];
  if (!given) return std::nullopt;
  const auto clearance = state.options.hosts.find("clearance");
  return clearance == state.options.hosts.end() ? *given : std::max(*given, clearance->second);
}

// Up from a start below the clearance plane, before anything moves across.
void retractFirst(State& state) {
  AxisState& now = state.axes[ir::indexOf(ir::Axis::Z)];
  const double height = *safeHeight(state);
  if (*now.at >= height) return;
  ir::Move move;
  move.motion = ir::Motion::Protected;
  move.axes[ir::indexOf(ir::Axis::Z)] = ir::Coordinate{ir::constant(height), ir::Frame::Work, nullptr};
  state.remarks.push_back(fmt::format("BEFORE IT Z GOES UP TO {}, THE CLEARANCE", numberText(height)));
  protectedMove(state, move, made("up to the clearance plane"));
}

void writeModes(State& state) {
  const ir::Origin origin = made("beginning");
  const bool mill = state.control.hasAxis('Y');
  state.sheet.add(fmt::format("{} {} {}", state.code(mill ? "plane-xy" : "plane-zx"), state.code("absolute"),
                              state.code("feed-per-minute")),
                  origin);
}

// The path to the start point. Where its height is known, spindle and coolant rest and contact is asked for
// before anything moves.
void writeStart(State& state, Body& body) {
  std::string words;
  for (const ir::Axis axis : ir::kAxes) {
    const auto given = state.options.hosts.find(fmt::format("start_{}", "xyz"[ir::indexOf(axis)]));
    if (given == state.options.hosts.end() || !state.control.hasAxis(ir::letterOf(axis))) continue;
    const std::size_t i = ir::indexOf(axis);
    state.start[i] = state.axes[i].at = given->second;
    if (axis != ir::Axis::Z) words += " " + axisWord(state, axis, given->second, {});
  }
  if (words.empty()) return;
  // The source's cycle begins where the CAM has brought the probe; here that is up to the operator.
  const bool height = state.start[ir::indexOf(ir::Axis::Z)].has_value();
  const auto clearance = state.options.hosts.find("clearance");
  const std::string least = clearance == state.options.hosts.end()
                                ? ""
                                : fmt::format(", AT Z{} OR HIGHER", numberText(clearance->second));
  state.remarks.push_back(
      fmt::format("THE FIRST MOVE GOES TO{} AT THE HEIGHT WHERE Z IS{}", words,
                  height ? ", WHICH HAS TO BE Z" + numberText(*state.start[ir::indexOf(ir::Axis::Z)])
                         : ": BEGIN WITH Z ABOVE ALL THAT LIES BETWEEN" + least));
  // Each way of a cycle counts from where it starts.
  if (height && state.options.cycleFile && *state.start[ir::indexOf(ir::Axis::Z)] < *safeHeight(state))
    state.refuse<diag::MikroprogCannot>(
        state.cycle.range,
        fmt::format(
            "the cycle would start at Z{}, below the clearance plane of {}, to which the program goes first",
            numberText(*state.start[ir::indexOf(ir::Axis::Z)]), numberText(*safeHeight(state))),
        "give a `--host start_z` that is not below the clearance, or a clearance that is not above the "
        "start");
  if (height) {
    body.settleFirst();
    guard(state, made("contact before anything moves"));
    retractFirst(state);
  }
  state.sheet.add(state.code("rapid") + words, made("start point"));
}

void numberSheets(State& state, std::vector<EmittedLine>& out) {
  std::map<Mark, std::uint32_t> numbers;
  const bool tails = state.usesNotFound || state.usesCollision || state.usesEnd;
  const std::string jump = state.code("jump"), stop = state.code("stop");
  const ir::Origin none = made("end of the program");
  if (tails) state.sheet.jump(jump, state.end, "", none);
  Sheet notFound, collision, end;
  // Up, once the operator has read it and goes on. Before each datum and after it, so the highest of them.
  const std::optional<double> height = safeHeight(state);
  const bool retracts = height && state.options.hosts.contains("return_feed");
  const auto retract = [&](Sheet& sheet) {
    if (!retracts) return;
    const double top = std::max(*height, state.highest.value_or(*height));
    sheet.add(fmt::format("{} {} F{}", state.code("feed"),
                          axisWord(state, ir::Axis::Z, top + state.raised, {}),
                          numberWord(state, state.host("return_feed"), {})),
              made("up after a stop"));
  };
  if (state.usesNotFound) {
    const ir::Origin tail = made("tail: the surface was not found");
    notFound.place(state.notFound);
    notFound.add(stop + " ;" + state.control.notFound, tail);
    retract(notFound);
    notFound.jump(jump, state.end, "", tail);
  }
  if (state.usesCollision) {
    collision.place(state.collision);
    collision.add(stop + " ;" + state.control.collision, made("tail: contact where none was expected"));
    retract(collision);
  }
  end.place(state.end);
  end.add(state.code("end"), none);

  state.sheet.number(kStep, kStep, numbers);
  const std::uint32_t behind = static_cast<std::uint32_t>(state.sheet.blocks()) * kStep + 1;
  const std::uint32_t base = std::max(kTails, roundedUp(behind, 100));
  const std::uint32_t step = retracts ? kLongTailStep : kTailStep;
  notFound.number(base, step, numbers);
  collision.number(base + kCollision, step, numbers);
  end.number(tails ? base + kEnd : behind - 1 + kStep, kStep, numbers);
  std::uint32_t entry = std::max(kSubprograms, roundedUp(base + kEnd + 1, 1000));
  for (Subprogram& sub : state.subprograms) {
    sub.sheet.number(entry, kStep, numbers);
    entry = roundedUp(entry + static_cast<std::uint32_t>(sub.sheet.blocks()) * kStep + 1, 1000);
  }
  for (const Sheet* sheet : {&state.sheet, &notFound, &collision, &end})
    sheet->print(numbers, out);
  for (const Subprogram& sub : state.subprograms)
    sub.sheet.print(numbers, out);
}

} // namespace

bool movesY(const ir::Cycle& cycle) {
  constexpr std::size_t kY = ir::indexOf(ir::Axis::Y);
  return std::any_of(cycle.body.begin(), cycle.body.end(), [](const ir::CycleStatement& statement) {
    return match(
        statement,
        [](const ir::Measure& node) { return node.feature == ir::Feature::Bore || node.axis == ir::Axis::Y; },
        [](const ir::CallCycle& node) {
          return node.moves && node.axis.value_or(ir::Axis::Y) == ir::Axis::Y;
        },
        [](const ir::Move& node) { return node.axes[kY].has_value(); },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::ProbePower, ir::Comment,
                           ir::Assign, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop,
                           ir::Alarm, ir::OpaqueBlock, ir::Port, ir::Print> auto&) { return false; });
  });
}

std::vector<std::string> missingHosts(const ir::Cycle& cycle, const stdlib::MikroprogControl& control,
                                      const std::map<std::string, double>& hosts) {
  std::vector<std::string> wanted;
  if (measures(cycle)) wanted = {"tool_radius", "clearance", "overtravel", "return_feed"};
  for (const char* start : {"start_x", "start_y"})
    if (control.hasAxis(start[6] == 'x' ? 'X' : 'Y')) wanted.emplace_back(start);
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    const ir::Variable& variable = cycle.variable(id);
    if (variable.role == ir::Role::Host && ir::uses(cycle, id) &&
        std::find(wanted.begin(), wanted.end(), variable.name) == wanted.end())
      wanted.push_back(variable.name);
  }
  std::erase_if(wanted, [&](const std::string& name) { return hosts.contains(name); });
  return wanted;
}

std::string shortFileName(const std::string& cycle) {
  std::string out;
  for (const char c : cycle)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      out += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  if (out.size() > 8) out = out.substr(0, 3) + out.substr(out.size() - 5);
  return out.empty() ? "CYCLE" : out;
}

std::optional<std::vector<EmittedLine>> emit(const ir::Cycle& cycle, const EmitOptions& options,
                                             Diagnostics& diagnostics) {
  State state(cycle, options, diagnostics);
  state.notFound = state.mark();
  state.collision = state.mark();
  state.end = state.mark();
  writeModes(state);
  Body body(state);
  writeStart(state, body);
  body.write();
  if (state.failed) return std::nullopt;
  if (!cycle.measurementStated)
    state.remarks.push_back("THE SOURCE IS A PATH: CONTACTS ARE RECORDED, NOTHING IS SET");
  if (state.probeMoves > 1) {
    const std::string times = state.guards == 1 ? "once" : fmt::format("{} times", state.guards);
    diagnostics.report<diag::GuardOnce>({}, times, state.probeMoves);
    state.remarks.push_back("O7 IS ASKED BEFORE EACH CHAIN OF PROBE MOVES, NOT BEFORE EACH");
  }
  if (!state.relied.empty()) {
    std::vector<std::string> texts;
    for (const std::uint32_t number : state.relied)
      texts.push_back(fmt::format("Q{} ({})", number, state.control.question(number)->title));
    diagnostics.report<diag::QuestionsAssumed>({}, fmt::format("{}", fmt::join(texts, ", ")));
  }
  std::vector<EmittedLine> lines;
  for (std::string& text : headerLines(state))
    lines.push_back({std::move(text), {}, "header"});
  numberSheets(state, lines);
  if (state.failed) return std::nullopt;
  return lines;
}

} // namespace dotek::backends::mikroprog
