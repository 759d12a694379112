#include "verify/Compare.h"

#include "support/Decimal.h"
#include "verify/CompareLeft.h"
#include "verify/Exactness.h"
#include "verify/JoinedCalls.h"
#include "verify/PathPieces.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <set>

namespace dotek::verify {
namespace {

using sim::Point3;

constexpr int kShown = 6;                 // decimals
constexpr int kLengthShown = 3;           // of a tool
constexpr double kPrintedHalf = 0.000501; // of the last place of a word, mm
constexpr double kStopping = 0.01;        // where a move stops that meets the part, mm

std::string_view switchName(Switch state) {
  switch (state) {
  case Switch::NotSwitched: return "not switched";
  case Switch::Off: return "off";
  case Switch::On: return "on";
  }
  return "";
}

std::string_view faultName(sim::Outcome outcome) {
  switch (outcome) {
  case sim::Outcome::Contact: return "a contact";
  case sim::Outcome::EarlyContact: return "a contact that no measuring move makes";
  case sim::Outcome::Miss: return "no contact";
  case sim::Outcome::NotArmed: return "a touch with the probe off";
  case sim::Outcome::NoSignal: return "a touch without a signal";
  case sim::Outcome::Overtravel: return "a stylus that is pushed too far";
  case sim::Outcome::StemCollision: return "a collision of the stem";
  case sim::Outcome::BodyCollision: return "a collision of the probe's body";
  case sim::Outcome::RapidIntoPart: return "a rapid into the part";
  case sim::Outcome::OutsideTravel: return "a move out of the machine's travel";
  case sim::Outcome::SetterMiss: return "no contact with the tool setter";
  case sim::Outcome::SetterHit: return "a collision with the tool setter";
  case sim::Outcome::NotModelled: return "a rotary or second axis off zero";
  }
  return "";
}

std::string deedText(const Deed& deed) {
  switch (deed.kind) {
  case Deed::Kind::ToolChange: return fmt::format("a change to tool {}", numberText(deed.value));
  case Deed::Kind::Auxiliary: return "M" + numberText(deed.value);
  case Deed::Kind::Stop: return deed.text.empty() ? "a stop" : fmt::format("a stop ({})", deed.text);
  case Deed::Kind::Dwell: return fmt::format("a dwell of {} s", numberText(deed.value));
  }
  return "";
}

class Comparison {
public:
  Comparison(const Record& source, const Record& target, const CompareRules& rules)
      : source_(source), target_(target), rules_(rules) {}

  std::vector<Difference> run() {
    ending();
    if (!out_.empty()) return {withCause(std::move(out_.front()))};
    path();
    measures();
    faults();
    early();
    if (!rules_.atMeasures) deeds();
    if (rules_.sameAlarmNumbers) switches();
    takeAll(compareIdleMoves(source_, target_, rules_));
    takeAll(compareValues(source_, target_, rules_));
    if (!stopsInMacros() && !near(source_.end, target_.end, rules_.tolerance))
      add(Aspect::End, fmt::format("it ends at {} against {}", textOf(source_.end), textOf(target_.end)),
          source_.endedAt, target_.endedAt);
    if (source_.ending == Ending::Finished && !rules_.atMeasures) {
      Surroundings left = source_.after;
      if (rules_.switchesProbe) left.probe = Switch::Off;
      state(left, target_.after, " at the end", source_.endedAt, target_.endedAt);
      const auto named = [](const Record& record) {
        return record.tool ? "T" + std::to_string(*record.tool) : std::string("no other T");
      };
      if (source_.tool != target_.tool)
        add(Aspect::State, fmt::format("{} at the end against {}", named(source_), named(target_)),
            source_.endedAt, target_.endedAt);
      takeAll(compareModes(source_, target_, rules_));
    }
    if (rules_.sameProgram && source_.printed != target_.printed)
      add(Aspect::Printed, fmt::format("`{}` against `{}`", source_.printed, target_.printed), {}, {});
    std::stable_sort(out_.begin(), out_.end(),
                     [](const Difference& a, const Difference& b) { return a.aspect < b.aspect; });
    return std::move(out_);
  }

private:
  void add(Aspect aspect, std::string text, SourceRange source, SourceRange target) {
    addFirst(out_, {aspect, std::move(text), source, target});
  }

  void takeAll(std::vector<Difference> found) {
    for (Difference& one : found)
      addFirst(out_, std::move(one));
  }

  // Where other macros stop with their alarm is their own business; but after a measurement that is out of
  // its limits they have come back to where it began.
  bool stopsInMacros() const {
    return !rules_.sameAlarmNumbers && source_.ending == Ending::Alarm && !source_.alarmKind.empty() &&
           ownTextOf(source_.alarmKind).empty();
  }

  // What a translation says that compares a limit by itself (docs/convert.md, Calls); "": it compares none.
  static std::string_view ownTextOf(std::string_view alarmKind) {
    using stdlib::MacroAlarm;
    static constexpr std::pair<MacroAlarm, std::string_view> kTexts[] = {
        {MacroAlarm::OutOfTolerance, "OUT OF TOLERANCE"},
        {MacroAlarm::OutOfPosition, "OUT OF POSITION"},
        {MacroAlarm::OutOfAngle, "ANGLE OUT OF TOLERANCE"},
        {MacroAlarm::UpperLimit, "UPPER LIMIT"}};
    for (const auto& [kind, text] : kTexts)
      if (stdlib::macroAlarmName(kind) == alarmKind) return text;
    return "";
  }

  // The source's macro stops for a limit that the target compares by itself, with the alarm for that limit,
  // after the same measurement.
  bool comparesLimit() const {
    constexpr std::uint32_t kOwn = 3000;
    const std::string_view text = rules_.sameProgram ? std::string_view() : ownTextOf(source_.alarmKind);
    return !text.empty() && target_.alarmKind.empty() && target_.alarm > kOwn && target_.text == text;
  }

  // A number that is not known agrees with any. Controls show texts of different length.
  bool sameOwnAlarm() const {
    if (source_.alarm == 0 || target_.alarm == 0) return true;
    constexpr std::uint32_t kOwn = 3000;
    if (source_.alarm != target_.alarm || source_.alarm < kOwn) return source_.alarm == target_.alarm;
    const std::size_t shown = std::min(source_.text.size(), target_.text.size());
    return source_.text.compare(0, shown, target_.text, 0, shown) == 0 &&
           (shown > 0 || source_.text == target_.text);
  }

  // A translation numbers the alarms of the source's own text anew and keeps their texts.
  bool renumbered() const {
    constexpr std::uint32_t kOwn = 3000;
    return !rules_.sameProgram && source_.alarmKind.empty() && source_.alarm > kOwn && target_.alarm > kOwn;
  }

  void ending() {
    const bool alarms = source_.ending == Ending::Alarm && target_.ending == Ending::Alarm;
    bool same = source_.ending == target_.ending;
    if (alarms && (!source_.alarmKind.empty() || !target_.alarmKind.empty()))
      same = source_.alarmKind == target_.alarmKind || comparesLimit();
    if (alarms && rules_.sameAlarmNumbers && same)
      same = (renumbered() || source_.alarm == target_.alarm) && source_.text == target_.text;
    else if (alarms && rules_.sameProgram && same && source_.alarmKind.empty())
      same = sameOwnAlarm();
    if (!same) {
      add(Aspect::Ending, endText(source_) + " against " + endText(target_), source_.endedAt,
          target_.endedAt);
    } else if (alarms && rules_.samePlace && source_.endedAt.hasPlace() &&
               !rules_.samePlace(source_.endedAt, target_.endedAt)) {
      add(Aspect::Ending, endText(source_) + " comes from another place", source_.endedAt, target_.endedAt);
    }
  }

  // Where a bend is as small as the tolerance, one side may go straight on and the other end a piece there.
  void splitAlike(const std::vector<Piece>& shorter, std::vector<Piece>& longer, std::size_t i) const {
    if (i + 1 >= shorter.size()) return;
    const Piece &one = shorter[i], &next = shorter[i + 1], &other = longer[i];
    if (next.kind != one.kind || next.with != one.with || next.feed != one.feed) return;
    if (one.kind != other.kind || one.kind == sim::PathKind::Measuring ||
        !near(one.from, other.from, rules_.tolerance) || near(one.to, other.to, rules_.tolerance) ||
        !between(other.from, one.to, other.to, 2 * rules_.tolerance))
      return;
    Piece rest = other;
    rest.from = longer[i].to = one.to;
    longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(i) + 1, std::move(rest));
  }

  // A move that is not much longer than the tolerance may come to nothing where both its ends are rounded.
  void dropVanished(std::vector<Piece>& longer, const std::vector<Piece>& other, std::size_t i) const {
    if (i + 1 >= longer.size() || i >= other.size()) return;
    const Piece &one = longer[i], &next = longer[i + 1], &there = other[i];
    if (one.kind == sim::PathKind::Measuring || !near(one.from, one.to, 2 * rules_.tolerance)) return;
    const bool goesOn = next.kind == there.kind && near(next.from, there.from, 2 * rules_.tolerance) &&
                        near(next.to, there.to, rules_.tolerance);
    if (goesOn) longer.erase(longer.begin() + static_cast<std::ptrdiff_t>(i));
  }

  // An edge that is grazed stops a protected move at a height that a last digit beside it changes.
  double ofLastPiece() const {
    const bool obstructed = source_.ending == Ending::Alarm &&
                            source_.alarmKind == stdlib::macroAlarmName(stdlib::MacroAlarm::PathObstructed);
    return obstructed && stopsInMacros() ? std::max(kStopping, rules_.tolerance) : rules_.tolerance;
  }

  // ---- what came before a different ending

  // The first thing that the two did differently before one of them stopped, and then the ending.
  Difference withCause(Difference ending) {
    out_.clear();
    cause();
    if (out_.empty()) return ending;
    Difference out = std::move(out_.front());
    out.text += "; then " + ending.text;
    return out;
  }

  void cause() {
    const std::vector<Piece> a = straight(pieces(source_), true, rules_.tolerance);
    const std::vector<Piece> b = straight(pieces(target_), true, rules_.tolerance);
    std::size_t measure = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()) && out_.empty(); ++i) {
      // The last piece of a side that stops may be cut short.
      const bool cut = (i + 1 == a.size() && source_.ending != Ending::Finished) ||
                       (i + 1 == b.size() && target_.ending != Ending::Finished);
      const bool same = a[i].kind == b[i].kind && near(a[i].from, b[i].from, rules_.tolerance) &&
                        (cut || near(a[i].to, b[i].to, rules_.tolerance));
      if (!same) {
        addMoves(a[i], b[i]);
        return;
      }
      if (cut && !framesText(a[i], b[i]).empty()) {
        add(Aspect::Path,
            framesText(a[i], b[i]) +
                fmt::format("a {} move from {}", pathKindName(a[i].kind), textOf(a[i].from)),
            a[i].range, b[i].range);
        return;
      }
      state(a[i].with, b[i].with, fmt::format(" at a {} move", pathKindName(a[i].kind)), a[i].range,
            b[i].range);
      if (a[i].kind != sim::PathKind::Measuring) continue;
      if (measure < source_.measures.size() && measure < target_.measures.size()) {
        nominal(source_.measures[measure], target_.measures[measure]);
        if (!rules_.atMeasures) aims(source_.measures[measure], target_.measures[measure]);
      }
      ++measure;
    }
  }

  // Other coordinates than those of the source; "" where they are the same.
  std::string framesText(const Piece& a, const Piece& b) const {
    if (rules_.atMeasures || a.frame.system == 0 || b.frame.system == 0) return "";
    if (a.frame.system != b.frame.system)
      return fmt::format("it runs in {}, the source in {}: ", systemName(b.frame.system),
                         systemName(a.frame.system));
    if (std::abs(a.frame.toolLength - b.frame.toolLength) > rules_.results)
      return fmt::format(
          "it runs with a tool length of {}, the source of {}: ", fixedText(b.frame.toolLength, kLengthShown),
          fixedText(a.frame.toolLength, kLengthShown));
    return "";
  }

  void addMoves(const Piece& a, const Piece& b) {
    add(Aspect::Path,
        framesText(a, b) + fmt::format("a {} move to {} against a {} move to {}", pathKindName(a.kind),
                                       textOf(a.to), pathKindName(b.kind), textOf(b.to)),
        a.range, b.range);
  }

  // Those of a side, with what counts of them.
  std::vector<Piece> pieces(const Record& record) const {
    std::vector<Piece> out = record.pieces;
    for (Piece& piece : out)
      if (rules_.atMeasures) piece.with = {}, piece.modes = {}, piece.feed.reset();
    return out;
  }

  void path() {
    std::vector<Piece> a = straight(pieces(source_), true, rules_.tolerance);
    std::vector<Piece> b = straight(pieces(target_), true, rules_.tolerance);
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      if (i >= a.size()) {
        add(Aspect::Path,
            fmt::format("nothing against a {} move to {}", pathKindName(b[i].kind), textOf(b[i].to)),
            a.empty() ? SourceRange{} : a.back().range, b[i].range);
        return;
      }
      if (i >= b.size()) {
        add(Aspect::Path,
            fmt::format("a {} move to {} against nothing", pathKindName(a[i].kind), textOf(a[i].to)),
            a[i].range, b.empty() ? SourceRange{} : b.back().range);
        return;
      }
      splitAlike(a, b, i);
      splitAlike(b, a, i);
      dropVanished(a, b, i);
      dropVanished(b, a, i);
      const bool last = i + 1 == a.size() && i + 1 == b.size();
      const bool same = a[i].kind == b[i].kind && near(a[i].from, b[i].from, rules_.tolerance) &&
                        near(a[i].to, b[i].to, last ? ofLastPiece() : rules_.tolerance);
      if (!same) {
        addMoves(a[i], b[i]);
        return;
      }
      state(a[i].with, b[i].with, "", a[i].range, b[i].range);
      feed(a[i], b[i]);
      underModes(a[i], b[i]);
    }
  }

  // What a macro that switches the probe does on its way is in no source: it is called under the same modes.
  void switches() {
    const std::vector<SwitchCall>&a = source_.switches, &b = target_.switches;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()) && a[i].program == b[i].program; ++i)
      for (std::size_t k = 0; k < a[i].modes.size(); ++k)
        if (a[i].modes[k] != b[i].modes[k] && a[i].modes[k] != 0 && b[i].modes[k] != 0)
          return add(Aspect::Modal,
                     fmt::format("P{} called under G{} against G{}", a[i].program,
                                 numberText(a[i].modes[k] / 10.0), numberText(b[i].modes[k] / 10.0)),
                     a[i].range, b[i].range);
  }

  // A macro of the vendor counts on them, and a feed means another speed.
  void underModes(const Piece& a, const Piece& b) {
    for (std::size_t i = 0; i < a.modes.size(); ++i) {
      if (a.modes[i] == b.modes[i] || a.modes[i] == 0 || b.modes[i] == 0) continue;
      if (i == 1 && a.kind == sim::PathKind::Rapid) continue;
      add(Aspect::Modal,
          fmt::format("a {} move under G{} against G{}", pathKindName(a.kind), numberText(a.modes[i] / 10.0),
                      numberText(b.modes[i] / 10.0)),
          a.range, b.range);
    }
  }

  void feed(const Piece& a, const Piece& b) {
    const auto shown = [](const Piece& piece) {
      return piece.feed ? "F" + numberText(*piece.feed) : std::string("no feed");
    };
    const bool same = a.feed && b.feed ? std::abs(*a.feed - *b.feed) <= rules_.results
                                       : a.feed.has_value() == b.feed.has_value();
    if (!same) add(Aspect::State, shown(a) + " against " + shown(b), a.range, b.range);
  }

  void state(const Surroundings& a, const Surroundings& b, std::string_view when, SourceRange source,
             SourceRange target) {
    if (a == b) return;
    std::string text;
    const auto tell = [&](std::string_view what, std::string_view one, std::string_view other) {
      if (one != other) text += fmt::format("{}{} {} against {}", text.empty() ? "" : ", ", what, one, other);
    };
    static constexpr std::string_view kSpindle[] = {"off", "clockwise", "counterclockwise"};
    static constexpr std::string_view kCoolant[] = {"not switched", "off", "flood", "mist"};
    tell("probe", switchName(a.probe), switchName(b.probe));
    tell("spindle", kSpindle[a.spindle], kSpindle[b.spindle]);
    tell("coolant", kCoolant[static_cast<std::size_t>(a.coolant)],
         kCoolant[static_cast<std::size_t>(b.coolant)]);
    tell("speed", "S" + numberText(a.speed), "S" + numberText(b.speed));
    add(Aspect::State, text + std::string(when), source, target);
  }

  // Tools, M codes, stops: which, in which order, where, and with what on.
  void deeds() {
    const std::vector<Deed>&a = source_.deeds, &b = target_.deeds;
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      const std::string one = i < a.size() ? deedText(a[i]) : "nothing";
      const std::string other = i < b.size() ? deedText(b[i]) : "nothing";
      const SourceRange here = i < a.size() ? a[i].range : SourceRange{};
      const SourceRange there = i < b.size() ? b[i].range : SourceRange{};
      if (one != other) {
        add(Aspect::State, one + " against " + other, here, there);
        return;
      }
      if (a[i].measures != b[i].measures) {
        add(Aspect::State, fmt::format("{} after {} measures against {}", one, a[i].measures, b[i].measures),
            here, there);
        return;
      }
      if (!near(a[i].at, b[i].at, rules_.tolerance)) {
        add(Aspect::State, fmt::format("{} at {} against {}", one, textOf(a[i].at), textOf(b[i].at)), here,
            there);
        return;
      }
      state(a[i].with, b[i].with, " at " + one, here, there);
    }
  }

  // What the probe meets besides its contacts, also within calls. After a fault of the source the
  // case is undecided anyway.
  void faults() {
    if (!source_.events.empty() || target_.events.empty()) return;
    const auto& [event, where] = target_.events.front();
    add(Aspect::Contact,
        fmt::format("nothing against {} at {}", faultName(event.outcome), textOf(event.centre)),
        lastMeasure(source_), where);
  }

  void measures() {
    const auto& a = source_.measures;
    const auto& b = target_.measures;
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      if (i >= a.size() || i >= b.size()) {
        add(Aspect::Nominal, fmt::format("{} measures against {}", a.size(), b.size()),
            i < a.size() ? a[i].range : SourceRange{}, i < b.size() ? b[i].range : SourceRange{});
        return;
      }
      if (!a[i].unstated.empty() || !b[i].unstated.empty()) unstated(a[i], b[i]);
      nominal(a[i], b[i]);
      if (!rules_.atMeasures) aims(a[i], b[i]);
      if (!rules_.atMeasures) options(a[i], b[i]);
      contacts(a[i], b[i]);
      if (rules_.atMeasures) settled(a[i], b[i]);
      if (rules_.atMeasures) datums(a[i], b[i]);
      if (!stopsInMacros() && !near(a[i].end, b[i].end, rules_.tolerance))
        add(Aspect::Path,
            fmt::format("the measure leaves the probe at {} against {}", textOf(a[i].end), textOf(b[i].end)),
            a[i].range, b[i].range);
    }
  }

  // Of a call whose work is not known all that the macro can see is the same.
  void unstated(const Measure& a, const Measure& b) {
    const auto told = [](const Measure& measure) {
      std::string out =
          measure.unstated.empty() ? "a call that is known" : fmt::format("P{}", measure.program);
      for (const auto& [number, value] : measure.locals)
        out += fmt::format(" #{}={}", number, numberText(value));
      return out;
    };
    const bool same = a.unstated == b.unstated && a.program == b.program &&
                      std::equal(a.locals.begin(), a.locals.end(), b.locals.begin(), b.locals.end(),
                                 [&](const auto& one, const auto& other) {
                                   return one.first == other.first &&
                                          std::abs(one.second - other.second) <= rules_.tolerance;
                                 });
    if (!same) add(Aspect::Nominal, told(a) + " against " + told(b), a.range, b.range);
  }

  void nominal(const Measure& a, const Measure& b) {
    if (a.nominal.size() != b.nominal.size()) {
      add(Aspect::Nominal, fmt::format("{} surfaces against {}", a.nominal.size(), b.nominal.size()), a.range,
          b.range);
      return;
    }
    for (std::size_t i = 0; i < a.nominal.size(); ++i) {
      const Touch &one = a.nominal[i], &other = b.nominal[i];
      if (near(one.point, other.point, rules_.tolerance) && near(one.direction, other.direction, 1e-9))
        continue;
      add(Aspect::Nominal,
          fmt::format("the surface is expected at {} against {}", textOf(one.point), textOf(other.point)),
          a.range, b.range);
      return;
    }
  }

  // How far a bare skip move looks for its surface; the contact comes before.
  void aims(const Measure& a, const Measure& b) {
    if (!a.aim || !b.aim || near(*a.aim, *b.aim, rules_.tolerance)) return;
    add(Aspect::Nominal,
        fmt::format("the surface is looked for as far as {} against {}", textOf(*a.aim), textOf(*b.aim)),
        a.range, b.range);
  }

  // How a measure is made; of another vendor's macro how far it searches, where the source says so, and how
  // far it keeps beside a feature, where both say so.
  void options(const Measure& a, const Measure& b) {
    const auto shown = [](const Measure& measure, stdlib::ArgumentRole role) {
      const auto found = measure.options.find(role);
      return found == measure.options.end() ? "nothing" : numberText(found->second);
    };
    std::set<stdlib::ArgumentRole> roles;
    for (const Measure* one : {&a, &b})
      for (const auto& [role, value] : one->options)
        if (rules_.sameAlarmNumbers || role == stdlib::ArgumentRole::Overtravel ||
            (role == stdlib::ArgumentRole::Clearance && a.options.contains(role) && b.options.contains(role)))
          roles.insert(role);
    for (const stdlib::ArgumentRole role : roles) {
      const auto one = a.options.find(role), other = b.options.find(role);
      if (one != a.options.end() && other != b.options.end() &&
          std::abs(one->second - other->second) <= rules_.results)
        continue;
      if (role == stdlib::ArgumentRole::Overtravel && one == a.options.end() && rules_.overtravel &&
          std::abs(other->second - *rules_.overtravel) <= kPrintedHalf)
        continue;
      add(Aspect::Nominal,
          fmt::format("{} {} against {}", stdlib::roleName(role), shown(a, role), shown(b, role)), a.range,
          b.range);
      return;
    }
  }

  // The control reads ahead: without a block that waits it reads an earlier position, or moves what is still
  // to be moved to.
  void early() {
    if (!rules_.waits) return;
    for (const EarlyUse& use : target_.early) {
      const bool known = std::any_of(source_.early.begin(), source_.early.end(), [&](const EarlyUse& one) {
        return one.write == use.write &&
               (rules_.samePlace ? rules_.samePlace(one.range, use.range) : one.number == use.number);
      });
      if (known) continue;
      add(use.write ? Aspect::Offset : Aspect::Variable,
          fmt::format("nothing against #{}, which is {} before the motion before it has ended", use.number,
                      use.write ? "written" : "read"),
          {}, use.range);
    }
  }

  void contacts(const Measure& a, const Measure& b) {
    if (a.contacts.size() != b.contacts.size()) {
      add(Aspect::Contact, fmt::format("{} contacts against {}", a.contacts.size(), b.contacts.size()),
          a.range, b.range);
      return;
    }
    const double equal =
        isOblique(a) && !rules_.sameAlarmNumbers ? std::max(rules_.results, kObliqueWord) : rules_.results;
    for (std::size_t i = 0; i < a.contacts.size(); ++i) {
      // Where the ball's middle is, is measured: on a narrow bore the point of the wall lies farther beside.
      if (near(a.contacts[i].point, b.contacts[i].point, equal) ||
          near(a.contacts[i].centre, b.contacts[i].centre, equal))
        continue;
      add(Aspect::Contact,
          fmt::format("contact at {} against {}", textOf(a.contacts[i].point), textOf(b.contacts[i].point)),
          a.range, b.range);
      return;
    }
  }

  // What is on where it measures.
  void settled(const Measure& a, const Measure& b) {
    Surroundings one = a.with, other = b.with;
    one.probe = other.probe;
    one.speed = other.speed;
    const auto flows = [](const Surroundings& with) {
      return with.coolant != sim::Machine::Coolant::NotSwitched && with.coolant != sim::Machine::Coolant::Off;
    };
    // What the caller has left on and the source goes on with, the target may have switched off already.
    if (a.with.spindle != 0 && a.with.spindle == source_.before.spindle) one.spindle = other.spindle;
    if (flows(a.with) && a.with.coolant == source_.before.coolant) one.coolant = other.coolant;
    const bool switched = b.with.coolant != sim::Machine::Coolant::NotSwitched;
    if (a.with.coolant == sim::Machine::Coolant::NotSwitched || (switched && flows(a.with) == flows(b.with)))
      one.coolant = other.coolant;
    state(one, other, " at a measure", a.range, b.range);
  }

  void datums(const Measure& a, const Measure& b) {
    const SourceRange where = b.datumRange.hasPlace() ? b.datumRange : b.range;
    const auto along = [](const Measure& measure, std::uint32_t axis) {
      return std::find_if(measure.datums.begin(), measure.datums.end(),
                          [&](const auto& one) { return one.first.second == axis; });
    };
    for (const auto& [key, zero] : a.datums) {
      const auto other = along(b, key.second);
      if (other != b.datums.end() && std::abs(other->second - zero) <= rules_.results) continue;
      add(Aspect::Offset,
          fmt::format("the zero of G{} along {} lies at {} of the machine against {}", key.first,
                      "XYZ"[key.second], fixedText(zero, kShown),
                      other == b.datums.end() ? "nothing" : fixedText(other->second, kShown)),
          a.range, where);
    }
    for (const auto& [key, zero] : b.datums)
      if (along(a, key.second) == a.datums.end())
        add(Aspect::Offset, fmt::format("nothing against a datum along {}", "XYZ"[key.second]), a.range,
            where);
  }

  // What follows the last measure made it.
  SourceRange lastMeasure(const Record& record) const {
    return record.measures.empty() ? SourceRange{} : record.measures.back().range;
  }

  const Record& source_;
  const Record& target_;
  const CompareRules& rules_;
  std::vector<Difference> out_;
};

} // namespace

bool runsAlike(const Record& one, const Record& other, const CompareRules& rules) {
  SourceRange at;
  if (!whyNoEvidence(one, at).empty() || !whyNoEvidence(other, at).empty()) return false;
  const std::vector<Difference> found = compare(one, other, rules);
  return std::all_of(found.begin(), found.end(),
                     [](const Difference& each) { return each.aspect == Aspect::Modal; });
}

std::vector<Difference> compare(const Record& source, const Record& target, const CompareRules& wanted) {
  const CompareRules rules = asExactAs(source, wanted);
  if (!rules.sameAlarmNumbers && !rules.sameProgram && !rules.atMeasures)
    if (const std::optional<Record> joined = joinedCalls(source, target, rules.tolerance))
      return Comparison(source, *joined, rules).run();
  return Comparison(source, target, rules).run();
}

} // namespace dotek::verify
