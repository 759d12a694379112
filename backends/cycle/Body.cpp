// The body: statements one by one, jumps as if and else.
#include "backends/cycle/Jumps.h"
#include "backends/cycle/State.h"
#include "ir/Match.h"
#include "ir/Positions.h"
#include "support/Decimal.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::backends::cycle {

namespace {

class Body {
public:
  explicit Body(State& state) : s_(state), list_(state.cycle.body) {
    for (std::size_t i = 0; i < list_.size(); ++i)
      if (const auto* label = std::get_if<ir::Label>(&list_[i].node)) places_[label->label] = i;
  }

  void write() {
    block(0, list_.size());
    if (on_) {
      s_.note(list_.back().origin.range(), "a probe that stays on after the end",
              "a cycle leaves the probe as it found it, so the cycle ends with `probe off`");
      s_.add("probe off", {}, "the source leaves the probe on");
    }
  }

private:
  void block(std::size_t begin, std::size_t end) {
    std::size_t i = begin;
    while (i < end && !s_.failed) {
      const ir::CycleStatement& statement = list_[i];
      const SourceRange range = statement.origin.range();
      ir::match(
          statement, [&](const ir::Branch& node) { i = choice(node, statement.origin, i, end); },
          [&](const ir::Jump& node) {
            const std::size_t to = places_.at(node.target);
            if (!onlyLabels(i + 1, to)) return noForm(range, to);
            i = to;
          },
          [&](const ir::Return&) {
            if (!onlyLabels(i + 1, list_.size()))
              return s_.refuse(range, "an end in the middle of the cycle",
                               "put what follows into `if .. end`");
            i = end;
          },
          [&](const ir::Label& node) { i = loops_.contains(node.label) ? loop(i, end) : i + 1; },
          [&](const ir::OneOf<ir::Store, ir::Move, ir::Measure, ir::CallCycle, ir::ProbePower, ir::Comment,
                              ir::Assign, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop,
                              ir::Alarm, ir::OpaqueBlock, ir::Port, ir::Print> auto&) {
            if (dropped_.contains(i))
              ++i;
            else
              one(statement, i++);
          });
    }
  }

  bool onlyLabels(std::size_t from, std::size_t to) const {
    if (to < from) return false;
    return std::all_of(
        list_.begin() + static_cast<std::ptrdiff_t>(from), list_.begin() + static_cast<std::ptrdiff_t>(to),
        [](const ir::CycleStatement& one) { return std::holds_alternative<ir::Label>(one.node); });
  }

  void noForm(SourceRange range, std::size_t to) {
    Diagnostic& said = s_.diagnostics.report<diag::CycleFormCannot>(
        range, "this jump",
        "the cycle language has `if`, `else` and loops that end, and no jumps; "
        "write the routine with those");
    s_.failed = true;
    if (to < list_.size() && list_[to].origin.range().hasPlace())
      said.note(list_[to].origin.range(), "it leads here");
  }

  // The branch at `at`, with all that it decides on; where the list goes on.
  std::size_t choice(const ir::Branch& branch, const ir::Origin& origin, std::size_t at, std::size_t end) {
    const std::size_t to = places_.at(branch.target);
    if (to <= at) {
      refuseLoop(origin.range());
      return end;
    }
    if (to > end) {
      noForm(origin.range(), to);
      return end;
    }
    std::size_t thenEnd = to, after = to;
    const ir::CycleStatement* last = to > at + 1 ? &list_[to - 1] : nullptr;
    if (const auto* jump = last == nullptr ? nullptr : std::get_if<ir::Jump>(&last->node)) {
      const std::size_t other = places_.at(jump->target);
      if (other > to && other <= end && !onlyLabels(to, other)) {
        thenEnd = to - 1;
        after = other;
      }
    }
    const std::string condition = conditionText(s_, ir::negate(branch.condition), origin.range());
    if (condition.empty()) return end;
    const std::size_t head = s_.lines.size();
    s_.add("if " + condition + " then", origin);
    const auto measured = s_.measured;
    const auto places = s_.at;
    block(at + 1, thenEnd);
    const std::size_t middle = s_.lines.size();
    if (after != to) {
      s_.add("else", origin);
      s_.measured = measured;
      s_.at = {};
      block(to, after);
      if (s_.lines.size() == middle + 1) {
        s_.lines.pop_back();
      } else if (middle == head + 1) { // there is an `else` alone
        s_.lines.erase(s_.lines.begin() + static_cast<std::ptrdiff_t>(middle));
        s_.lines[head].text = "if " + conditionText(s_, branch.condition, origin.range()) + " then";
      }
    }
    const bool nothing = s_.lines.size() == head + 1;
    const bool ends = after == to && thenEnd > at + 1 && endsAt(thenEnd - 1);
    if (nothing)
      s_.lines.pop_back();
    else
      s_.add("end", origin);
    if (nothing || ends) { // one way goes on
      s_.measured = measured;
      s_.at = places;
      return after;
    }
    leaveWay();
    return after;
  }

  bool endsAt(std::size_t at) const { return std::holds_alternative<ir::Alarm>(list_[at].node); }

  void refuseLoop(SourceRange range) {
    s_.refuse(range, "a loop", "write `while .. at most N times`, with the most runs that make sense");
  }

  // The loop that begins at the label; where the list goes on.
  std::size_t loop(std::size_t label, std::size_t end) {
    const std::optional<Loop> found = loopAt(s_, label);
    const ir::CycleStatement& first = list_[label + 1 < list_.size() ? label + 1 : label];
    const SourceRange range = first.origin.range();
    if (!found || found->after > end || (found->most.empty() && !found->mostOf)) {
      refuseLoop(range);
      return end;
    }
    if (found->onlyCounts) {
      s_.add("repeat " + found->most + " times", first.origin);
    } else {
      const std::string condition =
          conditionText(s_, ir::negate(std::get<ir::Branch>(list_[found->branch].node).condition), range);
      if (condition.empty()) return end;
      std::string most = found->most;
      if (found->mostOf) {
        most = s_.names[*found->mostOf];
        if (found->mostPlus != 0)
          most +=
              fmt::format(" {} {}", found->mostPlus < 0 ? "-" : "+", numberText(std::abs(found->mostPlus)));
      }
      s_.add(fmt::format("while {} at most {} times", condition, most), first.origin);
    }
    leaveWay();
    block(found->branch + 1, found->back);
    s_.add("end", list_[found->back].origin);
    leaveWay();
    return found->after;
  }

  std::set<std::size_t> counters() const {
    std::set<std::size_t> out;
    for (std::size_t i = 0; i < list_.size(); ++i) {
      const auto* label = std::get_if<ir::Label>(&list_[i].node);
      if (label == nullptr || !loops_.contains(label->label)) continue;
      if (const std::optional<Loop> found = loopAt(s_, i))
        out.insert(found->dropped.begin(), found->dropped.end());
    }
    return out;
  }

  // Where the probe is, and what was measured last, depends on the way here.
  void leaveWay() {
    s_.measured.clear();
    s_.joined = true;
    s_.at = {};
  }

  void one(const ir::CycleStatement& statement, std::size_t index) {
    const ir::Origin& origin = statement.origin;
    const SourceRange range = origin.range();
    ir::match(
        statement, [&](const ir::Move& node) { move(node, origin); },
        [&](const ir::Measure& node) {
          arm(origin);
          writeMeasure(s_, node, origin);
        },
        [&](const ir::CallCycle& node) {
          if (node.moves) arm(origin);
          writeCall(s_, node, origin);
        },
        [&](const ir::Comment& node) {
          if (!isOfStop(index)) s_.add("// " + oneLine(node.text), origin);
        },
        [&](const ir::Assign& node) {
          if (repeats(node)) return;
          const std::string value = valueText(s_, node.value, s_.cycle.variable(node.variable).kind, range);
          if (!value.empty()) s_.add(s_.names[node.variable] + " = " + value, origin);
        },
        [&](const ir::Store& node) { writeResult(s_, node, origin); },
        [&](const ir::Spindle& node) {
          if (node.state != ir::Spindle::State::Off)
            return s_.refuse(range, "a spindle that is started",
                             "a probing cycle stops it; start it in the program");
          s_.add("spindle off", origin);
        },
        [&](const ir::Coolant& node) {
          s_.add(node.state == ir::Coolant::State::Off     ? "coolant off"
                 : node.state == ir::Coolant::State::Flood ? "coolant flood"
                                                           : "coolant mist",
                 origin);
        },
        [&](const ir::ProbePower& node) {
          if (on_ != node.on) s_.add(node.on ? "probe on" : "probe off", origin);
          on_ = node.on;
        },
        [&](const ir::SetMode& node) { mode(node, range); },
        [&](const ir::Dwell& node) {
          const std::string value = valueText(s_, node.seconds, ir::Kind::Number, range);
          if (ir::constantValue(node.seconds) == nullptr)
            return s_.refuse(range, "a dwell that is computed", "write its seconds");
          s_.add("dwell " + value + " s", origin);
        },
        [&](const ir::Stop& node) {
          if (node.optional)
            return s_.refuse(range, "a stop that the operator switches",
                             "write `stop`, or ask for it with a flag");
          const std::string text = node.message.empty() ? stopText(index) : node.message;
          s_.add("stop" + quoted(text.empty() ? "Go on" : text), origin);
        },
        [&](const ir::Alarm& node) {
          s_.add("alarm" + quoted(node.message.empty() ? "Alarm of the source" : node.message), origin);
        },
        [&](const ir::OneOf<ir::Port, ir::Print> auto&) {
          s_.refuse(
              range, "what is printed through the port",
              "the cycle language has no words for it; show it with a `stop`, or return it as a result");
        },
        [&](const ir::OpaqueBlock& node) {
          std::string words;
          for (const ir::Word& word : node.words) {
            const double* value = word.value == nullptr ? nullptr : ir::constantValue(word.value);
            words += fmt::format("{}{}{}", words.empty() ? "" : " ", word.address,
                                 value == nullptr ? ".." : numberText(*value));
          }
          s_.refuse(
              range, fmt::format("the block `{}`", words),
              "a tool change, a reference point or a move of a control alone belongs to the program that "
              "calls the cycle");
        },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Return> auto&) {});
  }

  // The name of a touch says the value by itself.
  bool repeats(const ir::Assign& node) {
    if (!s_.aliases.contains(node.variable)) return false;
    const auto* result = std::get_if<ir::MeasuredResult>(&bare(node.value).node);
    const auto found = result == nullptr ? s_.measured.end() : s_.measured.find(result->name);
    if (found == s_.measured.end() || found->second.find(' ') != std::string::npos) return false;
    s_.names[node.variable] = found->second;
    return true;
  }

  static std::string oneLine(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
    return text;
  }

  // Whether the comment is the text of a stop in the same block.
  bool isOfStop(std::size_t index) const {
    const std::uint32_t block = list_[index].origin.block;
    for (std::size_t i = index + 1; block != 0 && i < list_.size() && list_[i].origin.block == block; ++i) {
      const auto* stop = std::get_if<ir::Stop>(&list_[i].node);
      if (stop != nullptr && stop->message.empty()) return true;
    }
    return false;
  }
  std::string stopText(std::size_t index) const {
    std::string out;
    const std::uint32_t block = list_[index].origin.block;
    std::size_t begin = index;
    while (block != 0 && begin > 0 && list_[begin - 1].origin.block == block)
      --begin;
    for (std::size_t i = begin; i < index; ++i)
      if (const auto* comment = std::get_if<ir::Comment>(&list_[i].node))
        out += (out.empty() ? "" : " ") + oneLine(comment->text);
    return out;
  }

  // The source probes here, and switches the probe on farther down.
  void arm(const ir::Origin& origin) {
    if (on_ || !switches_) return;
    s_.diagnostics.report<diag::CycleFormProbeOff>(origin.range());
    s_.add("probe on", origin, "before the first move that needs it");
    on_ = true;
  }

  void move(const ir::Move& move, const ir::Origin& origin) {
    const SourceRange range = origin.range();
    if (move.point == ir::ProbePoint::Contact)
      return s_.refuse(range, "a move to coordinates of the contact point", "move the ball's centre");
    bool relative = true, any = false;
    for (const auto& axis : move.axes)
      if (axis) {
        any = true;
        relative = relative && axis->frame == ir::Frame::Here && axis->system == nullptr;
      }
    if (!any) return;
    std::string places;
    for (const ir::Axis axis : ir::kAxes) {
      const auto& to = move.axes[ir::indexOf(axis)];
      if (!to) continue;
      std::string place;
      if (relative) {
        const std::string value = valueText(s_, to->value, ir::Kind::Length, range);
        if (!value.empty()) place = fmt::format("{} {}", "xyz"[ir::indexOf(axis)], value);
      } else {
        place = placeText(s_, *to, axis, range);
      }
      if (place.empty()) return;
      places += (places.empty() ? "" : ", ") + place;
      const bool simple =
          to->frame == ir::Frame::Work && to->system == nullptr &&
          (place.find(' ', 2) == std::string::npos || ir::constantValue(to->value) != nullptr);
      s_.at[ir::indexOf(axis)] = simple ? place.substr(2) : "";
    }
    std::string_view kind = "protected move";
    if (move.motion == ir::Motion::Protected) arm(origin);
    std::string feed;
    if (move.motion == ir::Motion::Rapid) kind = "rapid move";
    if (move.motion == ir::Motion::Feed) kind = "feed move";
    if (move.feed != nullptr) {
      feed_ = valueText(s_, move.feed, ir::Kind::Feed, range);
      if (feed_.empty()) return;
      if (move.motion == ir::Motion::Rapid)
        s_.note(range, "the feed beside a rapid move", "it moves at the machine's top speed");
      else
        feed = feed_;
    } else if (move.motion == ir::Motion::Feed) {
      if (feed_.empty()) return s_.refuse(range, "a feed move without a feed", "write F into the block");
      feed = feed_;
    }
    s_.add(
        fmt::format("{} {} {}{}", kind, relative ? "by" : "to", places, feed.empty() ? "" : " feed " + feed),
        origin);
  }

  void mode(const ir::SetMode& node, SourceRange range) {
    if (node.mode == ir::Mode::WorkSystem)
      return s_.refuse(range, "a change of the active work offset",
                       "a cycle works in that of its caller; select it in the program, before the call");
    if (node.mode == ir::Mode::FeedPerRevolution)
      return s_.refuse(range, "a feed per revolution", "state feeds in mm/min");
    s_.note(range, "a modal code of the control",
            "every line of a cycle says itself how it moves and from where it counts");
  }

  State& s_;
  const std::vector<ir::CycleStatement>& list_;
  std::unordered_map<ir::LabelId, std::size_t> places_;
  const std::set<ir::LabelId> loops_ = loopLabels(list_);
  std::set<std::size_t> dropped_ = counters(); // statements of counters that `repeat` takes the place of
  bool on_ = false;                            // the probe
  const bool switches_ = std::any_of(list_.begin(), list_.end(), [](const ir::CycleStatement& one) {
    const auto* power = std::get_if<ir::ProbePower>(&one.node);
    return power != nullptr && power->on;
  });
  std::string feed_;
};

} // namespace

void writeBody(State& state) {
  Body(state).write();
}

} // namespace dotek::backends::cycle
