// NC blocks: statements of one block of the source share a line.
#include "backends/common/ToolLength.h"
#include "backends/fanuc/PrintText.h"
#include "backends/fanuc/State.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>

namespace dotek::backends::fanuc {

namespace {

using stdlib::Function;

constexpr std::size_t kFirst = 0, kLast = 10000;

struct BlockWord {
  char address = 0;
  std::string text;
  bool leads = false; // added by us: is before the words of the source
};

class Block {
public:
  explicit Block(State& state) : state_(state) {}

  // Adds the words of a statement that may share a line.
  void add(const ir::CycleStatement& statement) {
    const ir::Origin& origin = statement.origin;
    match(
        statement, [&](const ir::Move& node) { plainMove(node, origin); },
        [&](const ir::SetMode& node) { setMode(node, origin); },
        [&](const ir::Spindle& node) { setSpindle(node, origin); },
        [&](const ir::Coolant& node) { code(coolantCode(node.state), "this coolant", origin); },
        [&](const ir::Dwell& node) { pause(node, origin); },
        [&](const ir::Stop& node) { setStop(node, origin); },
        [&](const ir::ProbePower& node) {
          code(node.on ? Function::ProbeOn : Function::ProbeOff, "the probe", origin);
        },
        // Lines of their own (isAlone), and what Flow.cpp writes.
        [](const ir::OneOf<ir::Measure, ir::CallCycle, ir::OpaqueBlock, ir::Assign, ir::Store, ir::Label,
                           ir::Jump, ir::Branch, ir::Return, ir::Alarm, ir::Comment, ir::Port,
                           ir::Print> auto&) {});
    ranges_.insert(ranges_.end(), origin.ranges.begin(), origin.ranges.end());
  }

  void write(const ir::Origin& first) {
    ir::Origin origin = first;
    origin.ranges = ranges_;
    sort(first.addresses);
    std::string text;
    for (const BlockWord& word : words_)
      text += (text.empty() ? "" : " ") + word.text;
    if (!text.empty()) state_.sheet.add(text, origin);
    origin.reason = "distance mode put back";
    if (after_ != nullptr) state_.sheet.add(codeText(*after_), origin);
  }

private:
  static Function coolantCode(ir::Coolant::State state) {
    if (state == ir::Coolant::State::Flood) return Function::CoolantFlood;
    return state == ir::Coolant::State::Mist ? Function::CoolantMist : Function::CoolantOff;
  }

  const stdlib::CodeInfo* find(Function function, std::string_view what, const ir::Origin& origin) {
    const auto* found = state_.control.find(function);
    if (found == nullptr) state_.refuse<diag::NoCode>(origin.range(), state_.control.title, what);
    return found;
  }

  void code(Function function, std::string_view what, const ir::Origin& origin, bool leads = false) {
    const auto* found = find(function, what, origin);
    if (found == nullptr) return;
    const std::string text = codeText(*found);
    const bool stands =
        std::any_of(words_.begin(), words_.end(), [&](const BlockWord& word) { return word.text == text; });
    if (!stands) words_.push_back({found->letter, text, leads});
  }

  void value(char address, const ir::ExpressionPtr& expression, Form form, const ir::Origin& origin) {
    if (expression != nullptr)
      words_.push_back({address, word(state_, address, expression, form, origin), false});
  }

  void setMode(const ir::SetMode& mode, const ir::Origin& origin) {
    switch (mode.mode) {
    case ir::Mode::Absolute: return code(Function::Absolute, "absolute programming", origin);
    case ir::Mode::Incremental: return code(Function::Incremental, "incremental programming", origin);
    case ir::Mode::FeedPerMinute: return code(Function::FeedPerMinute, "feed per minute", origin);
    case ir::Mode::FeedPerRevolution:
      // Feeds of the cycle are mm/min.
      state_.refuse<diag::FeedPerRevolution>(origin.range());
      return;
    case ir::Mode::PlaneXY: return code(Function::PlaneXY, "the plane XY", origin);
    case ir::Mode::PlaneZX: return code(Function::PlaneZX, "the plane ZX", origin);
    case ir::Mode::PlaneYZ: return code(Function::PlaneYZ, "the plane YZ", origin);
    case ir::Mode::CutterCompOff: return code(Function::CutterCompOff, "cutter compensation off", origin);
    case ir::Mode::CannedCycleOff: return code(Function::CannedCycleOff, "canned cycles off", origin);
    case ir::Mode::RapidMotion: return code(Function::Rapid, "rapid", origin);
    case ir::Mode::FeedMotion: return code(Function::Feed, "feed", origin);
    case ir::Mode::WorkSystem:
      if (mode.system == nullptr) return;
      guardSystem(state_, mode.system, origin);
      return value('G', mode.system, Form::Whole, origin);
    }
  }

  void setSpindle(const ir::Spindle& spindle, const ir::Origin& origin) {
    const Function function = spindle.state == ir::Spindle::State::Off ? Function::SpindleOff
                              : spindle.state == ir::Spindle::State::Clockwise
                                  ? Function::SpindleClockwise
                                  : Function::SpindleCounterClockwise;
    value('S', spindle.speed, Form::Whole, origin);
    code(function, "this spindle state", origin);
  }

  void pause(const ir::Dwell& dwell, const ir::Origin& origin) {
    code(Function::Dwell, "a dwell", origin);
    if (state_.control.dwellLetter == 'X') {
      value('X', dwell.seconds, Form::Length, origin); // seconds with a point
      return;
    }
    const ir::ExpressionPtr seconds = tidy(dwell.seconds);
    if (const double* known = ir::constantValue(seconds))
      value('P', ir::constant(std::round(*known * 1000), seconds->range), Form::Whole, origin);
    else
      state_.refuse<diag::DwellComputed>(origin.range(), state_.control.title);
  }

  void setStop(const ir::Stop& stop, const ir::Origin& origin) {
    const bool shows = !stop.message.empty() || stop.number != 1;
    if (shows && !stop.optional && state_.control.variables.message) {
      const std::string text = stopText(state_, stop, origin);
      state_.sheet.add(text, origin);
      return;
    }
    if (stop.number != 1)
      state_.diagnostics.report<diag::MessageNumberLost>(origin.range(), numberText(stop.number),
                                                         state_.control.title);
    if (!stop.message.empty())
      state_.sheet.comment(commentText(state_, stop.message, origin.range()), origin);
    code(stop.optional ? Function::OptionalStop : Function::Stop, "a stop", origin);
  }

  // Whether every axis counts from `frame`.
  static bool all(const ir::Move& move, ir::Frame frame) {
    return std::all_of(move.axes.begin(), move.axes.end(),
                       [&](const auto& axis) { return !axis || axis->frame == frame; });
  }

  bool positionsKnown(const ir::Move& move) {
    return std::all_of(std::begin(ir::kAxes), std::end(ir::kAxes), [&](ir::Axis axis) {
      return !move.axes[ir::indexOf(axis)] || workPosition(state_, axis) != nullptr;
    });
  }

  // The distance mode that the words of the move need; it is written where another one, or an unknown one, is
  // in force.
  void need(Distance wanted, const ir::Origin& origin) {
    const Distance now = state_.body->distance[state_.at];
    if (now == wanted) return;
    const bool absolute = wanted == Distance::Absolute;
    code(absolute ? Function::Absolute : Function::Incremental, "this distance mode", origin, true);
    if (now != Distance::Unknown)
      after_ = find(absolute ? Function::Incremental : Function::Absolute, "this distance mode", origin);
  }

  void plainMove(const ir::Move& move, const ir::Origin& origin) {
    if (isOfContact(state_, move, origin)) return;
    const bool moves = std::any_of(move.axes.begin(), move.axes.end(), [](const auto& axis) { return axis; });
    const bool machine = moves && all(move, ir::Frame::Machine);
    const bool travel = moves && all(move, ir::Frame::Here) &&
                        (state_.body->distance[state_.at] != Distance::Absolute || !positionsKnown(move));
    if (machine && move.motion != ir::Motion::Rapid) {
      state_.refuse<diag::FrameRefused>(origin.range(), "a feed move", "machine coordinates");
      return;
    }
    if (moves) need(travel ? Distance::Incremental : Distance::Absolute, origin);
    if (machine) code(Function::MachineCoordinates, "machine coordinates", origin, true);
    code(move.motion == ir::Motion::Rapid ? Function::Rapid : Function::Feed, "this move", origin);
    for (const ir::Axis axis : ir::kAxes) {
      const auto& coordinate = move.axes[ir::indexOf(axis)];
      if (!coordinate) continue;
      const bool direct = travel || machine;
      value(ir::letterOf(axis),
            direct ? coordinate->value : place(state_, *coordinate, axis, ir::Frame::Work, origin.range()),
            Form::Length, origin);
    }
    value('F', move.feed, Form::Length, origin);
    if (move.motion == ir::Motion::Feed && move.feed == nullptr && !state_.body->feed[state_.at]) {
      state_.diagnostics.report<diag::FeedNotStated>(origin.range());
      if (state_.reported.insert("feed of a move").second)
        state_.remarks.push_back("A FEED MOVE STATES NO FEED: IT TAKES THE ONE IN FORCE");
    }
  }

  // The source's order of addresses.
  void sort(const std::string& addresses) {
    std::vector<std::pair<std::size_t, BlockWord>> keyed;
    std::vector<bool> used(addresses.size(), false);
    for (BlockWord& word : words_) {
      std::size_t key = word.leads ? kFirst : kLast;
      for (std::size_t i = 0; i < addresses.size() && key == kLast; ++i) {
        if (used[i] || addresses[i] != word.address) continue;
        used[i] = true;
        key = i + 1;
      }
      // A code that the source leaves to what is in force is before the axes, as people write it.
      if (key == kLast && word.address == 'G') key = kFirst;
      keyed.emplace_back(key, std::move(word));
    }
    if (!addresses.empty())
      std::stable_sort(keyed.begin(), keyed.end(),
                       [](const auto& a, const auto& b) { return a.first < b.first; });
    else
      std::stable_partition(keyed.begin(), keyed.end(), [](const auto& k) { return k.second.leads; });
    words_.clear();
    for (auto& [key, word] : keyed)
      words_.push_back(std::move(word));
  }

  State& state_;
  std::vector<BlockWord> words_;
  std::vector<SourceRange> ranges_;
  const stdlib::CodeInfo* after_ = nullptr;
};

// Is on a line of its own.
bool isAlone(const State& state, const ir::CycleStatement& statement) {
  return match(
      statement, [](const ir::Move& node) { return node.motion == ir::Motion::Protected; },
      [&](const ir::ProbePower& node) {
        return state.macros.find(node.on ? stdlib::Intent::ProbeOn : stdlib::Intent::ProbeOff) != nullptr ||
               state.control.find(node.on ? Function::ProbeOn : Function::ProbeOff) == nullptr;
      },
      [](const ir::OneOf<ir::Measure, ir::CallCycle, ir::OpaqueBlock, ir::Port, ir::Print> auto&) {
        return true;
      },
      [](const ir::OneOf<ir::SetMode, ir::Spindle, ir::Coolant, ir::Dwell, ir::Stop, ir::Assign, ir::Store,
                         ir::Label, ir::Jump, ir::Branch, ir::Return, ir::Alarm, ir::Comment> auto&) {
        return false;
      });
}

bool isBlock(const ir::CycleStatement& statement) {
  return match(
      statement,
      [](const ir::OneOf<ir::Move, ir::SetMode, ir::Spindle, ir::Coolant, ir::ProbePower, ir::Dwell,
                         ir::Stop> auto&) { return true; },
      [](const ir::OneOf<ir::Measure, ir::CallCycle, ir::OpaqueBlock, ir::Assign, ir::Store, ir::Label,
                         ir::Jump, ir::Branch, ir::Return, ir::Alarm, ir::Comment, ir::Port,
                         ir::Print> auto&) { return false; });
}

// The only code of a block, where it limits how far the source's control reads ahead (G103 of a Haas) and the
// target does not support it. nullptr: another block.
const stdlib::CodeInfo* readAheadLimit(const State& state, const ir::OpaqueBlock& block) {
  const stdlib::Control& from = state.options.sourceControl;
  const stdlib::CodeInfo* out = nullptr;
  for (const ir::Word& word : block.words) {
    if (word.address == 'N') continue;
    const double* number = word.value == nullptr ? nullptr : ir::constantValue(word.value);
    if (word.address == 'P' && number != nullptr) continue;
    if (word.address != 'G' || number == nullptr || *number < 0 || *number > 9999) return nullptr;
    const auto tenths = static_cast<std::uint32_t>(std::lround(*number * 10));
    const stdlib::CodeInfo* info = from.find('G', tenths);
    const bool stops =
        std::binary_search(from.readAheadStops.begin(), from.readAheadStops.end(), std::pair('G', tenths));
    if (out != nullptr || info == nullptr || !stops || info->function != Function::Auxiliary ||
        state.control.find('G', tenths) != nullptr)
      return nullptr;
    out = info;
  }
  return out;
}

void writeOpaque(State& state, const ir::OpaqueBlock& block, const ir::Origin& origin) {
  if (const stdlib::CodeInfo* code = readAheadLimit(state, block)) {
    // Without P it lifts the limit.
    const bool limits = std::any_of(block.words.begin(), block.words.end(),
                                    [](const ir::Word& word) { return word.address == 'P'; });
    state.diagnostics.report<diag::ReadAheadLeftOut>(
        origin.range(), codeText(*code), state.options.sourceControl.title, state.control.title,
        limits ? "a block that waits replaces it" : "it is left out");
    if (limits) writeWait(state, origin);
    return;
  }
  const std::string text = copiedText(state, block, origin);
  if (text.empty()) return;
  for (const LengthOffset& offset : lengthOffsets(state.cycle, state.control)) {
    const ir::ExpressionPtr& number = offset.word->value;
    if (offset.at != state.at || ir::constantValue(number) != nullptr) continue;
    const auto same = [&](const ir::ExpressionPtr& other) { return ir::equal(other, number); };
    if (state.options.branch || !offset.always || !isOfArguments(state.cycle, number))
      writeLengthAlarm(state, number, origin);
    else if (std::none_of(state.lengths.begin(), state.lengths.end(), same))
      state.lengths.push_back(number); // before anything moves
  }
  state.sheet.add(text, origin);
}

} // namespace

void writeLengthAlarm(State& state, const ir::ExpressionPtr& offset, const ir::Origin& origin) {
  alarmIf(state, ir::compare(ir::Relation::LessEqual, offset, ir::constant(0)), "TOOL OFFSET NOT ABOVE 0",
          origin);
  const int last = state.control.variables.toolCount;
  if (last == 0 || last >= state.options.sourceControl.variables.toolCount) return;
  alarmIf(state, ir::compare(ir::Relation::Greater, offset, ir::constant(last)),
          fmt::format("TOOL OFFSET ABOVE {}", last), origin);
}

namespace {

void writeAlone(State& state, const ir::CycleStatement& statement) {
  match(
      statement, [&](const ir::Move& node) { writeProtectedMove(state, node, statement.origin); },
      [&](const ir::Measure& node) { writeMeasure(state, node, statement.origin); },
      [&](const ir::CallCycle& node) { writeCycle(state, node, statement.origin); },
      [&](const ir::ProbePower& node) { writeProbePower(state, node.on, statement.origin); },
      [&](const ir::OpaqueBlock& node) { writeOpaque(state, node, statement.origin); },
      [&](const ir::Port& node) { state.sheet.add(portText(node), statement.origin); },
      [&](const ir::Print& node) { state.sheet.add(printText(node), statement.origin); },
      // isAlone() says no.
      [](const ir::OneOf<ir::SetMode, ir::Spindle, ir::Coolant, ir::Dwell, ir::Stop, ir::Assign, ir::Store,
                         ir::Label, ir::Jump, ir::Branch, ir::Return, ir::Alarm, ir::Comment> auto&) {});
}

} // namespace

std::size_t writeBlock(State& state, const std::vector<ir::CycleStatement>& list, std::size_t at) {
  if (isAlone(state, list[at])) {
    writeAlone(state, list[at]);
    return at + 1;
  }
  Block block(state);
  const ir::Origin& first = list[at].origin;
  std::size_t i = at;
  do {
    state.at = i;
    block.add(list[i]);
    ++i;
  } while (i < list.size() && first.block != 0 && list[i].origin.block == first.block && isBlock(list[i]) &&
           !isAlone(state, list[i]));
  block.write(first);
  return i;
}

} // namespace dotek::backends::fanuc
