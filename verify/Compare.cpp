#include "verify/Compare.h"

#include "support/Ascii.h"
#include "support/Decimal.h"
#include "verify/CompareLeft.h"
#include "verify/CompareParts.h"
#include "verify/Exactness.h"
#include "verify/JoinedCalls.h"
#include "verify/JoinedTouches.h"
#include "verify/PathPieces.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <set>

namespace dotek::verify {
namespace {

using sim::Point3;

constexpr int kLengthShown = 3;    // of a tool
constexpr double kStopping = 0.01; // where a move stops that meets the part, mm

std::string howItEnds(std::string_view who, const Record& record) {
  switch (record.ending) {
  case Ending::Finished: return fmt::format("{} ends", who);
  case Ending::Alarm: return fmt::format("{} stops with {}", who, endText(record));
  case Ending::Inconclusive: break;
  }
  return fmt::format("what {} does is not known: {}", who, record.text);
}

class Comparison {
public:
  Comparison(const Record& source, const Record& target, const CompareRules& rules)
      : source_(source), target_(target), rules_(rules) {}

  std::vector<Difference> run() {
    ending();
    if (!out_.empty()) return {withCause(std::move(out_.front()))};
    path();
    compareMeasures(pair_);
    compareFaults(pair_);
    compareEarlyUses(pair_);
    if (!rules_.atMeasures) compareDeeds(pair_);
    compareSwitches(pair_, rules_.sameAlarmNumbers);
    takeAll(compareIdleMoves(source_, target_, rules_));
    takeAll(compareValues(source_, target_, rules_));
    if (!pair_.stopsInMacros() && !near(source_.end, target_.end, rules_.tolerance))
      add(Aspect::End, fmt::format("it ends at {} against {}", textOf(source_.end), textOf(target_.end)),
          source_.endedAt, target_.endedAt);
    if (source_.ending == Ending::Finished && !rules_.atMeasures) {
      Surroundings left = source_.after;
      if (rules_.switchesProbe) left.probe = Switch::Off;
      compareState(pair_, left, target_.after, " at the end", source_.endedAt, target_.endedAt);
      const auto named = [](const Record& record) {
        return record.tool ? "T" + std::to_string(*record.tool) : std::string("no other T");
      };
      if (source_.tool != target_.tool)
        add(Aspect::State, fmt::format("{} at the end against {}", named(source_), named(target_)),
            source_.endedAt, target_.endedAt);
      takeAll(compareModes(source_, target_, rules_));
    }
    // What the program itself leaves on where it stops with an alarm of its own.
    const auto stopsItself = [](const Record& record) {
      return record.ending == Ending::Alarm && record.alarmKind.empty() && !record.pieces.empty();
    };
    if (stopsItself(source_) && stopsItself(target_) && !rules_.atMeasures)
      compareState(pair_, source_.after, target_.after, " at its alarm", source_.endedAt, target_.endedAt);
    if (!samePrinted())
      add(Aspect::Printed, fmt::format("`{}` against `{}`", source_.printed, target_.printed), {}, {});
    if (source_.portOpen != target_.portOpen && source_.ending == target_.ending)
      add(Aspect::Printed,
          fmt::format("the port is {} at the end against {}", source_.portOpen ? "open" : "closed",
                      target_.portOpen ? "open" : "closed"),
          source_.endedAt, target_.endedAt);
    std::stable_sort(out_.begin(), out_.end(),
                     [](const Difference& a, const Difference& b) { return a.aspect < b.aspect; });
    return std::move(out_);
  }

private:
  // Of a program the same bytes. Macros of another set may leave a result that is rounded otherwise in the
  // last digit that is printed.
  bool samePrinted() const {
    const std::string &a = source_.printed, &b = target_.printed;
    if (rules_.sameProgram || a == b) return a == b;
    std::size_t at = 0, other = 0;
    while (at < a.size() && other < b.size()) {
      const auto isOfNumber = [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; };
      const auto number = [&](const std::string& text, std::size_t& from) {
        const std::size_t begin = from;
        while (from < text.size() && isOfNumber(text[from]))
          ++from;
        return text.substr(begin, from - begin);
      };
      if (!isOfNumber(a[at]) || !isOfNumber(b[other])) {
        if (a[at++] != b[other++]) return false;
        continue;
      }
      const std::string left = number(a, at), right = number(b, other);
      if (left == right) continue;
      const std::size_t point = left.find('.');
      const std::size_t decimals = point == std::string::npos ? 0 : left.size() - point - 1;
      constexpr double kLastDigit = 1.01;
      const auto x = parseNumber(left), y = parseNumber(right);
      if (!x || !y || std::abs(*x - *y) > kLastDigit * std::pow(10.0, -static_cast<double>(decimals)))
        return false;
    }
    return at == a.size() && other == b.size();
  }
  void add(Aspect aspect, std::string text, SourceRange source, SourceRange target) {
    pair_.add(aspect, std::move(text), source, target);
  }

  void takeAll(std::vector<Difference> found) {
    for (Difference& one : found)
      addFirst(out_, std::move(one));
  }

  // The source's macro stops for a limit that the target compares by itself, with the alarm for that limit,
  // after the same measurement.
  bool comparesLimit() const {
    constexpr std::uint32_t kOwn = 3000;
    const std::string_view text =
        rules_.sameProgram ? std::string_view() : verify::ownTextOf(source_.alarmKind);
    return !text.empty() && target_.alarmKind.empty() && target_.alarm > kOwn && target_.text == text;
  }

  // A number that is not known agrees with any. Controls show texts of different length.
  bool sameOwnAlarm() const {
    if (source_.alarm == 0 || target_.alarm == 0) return true;
    constexpr std::uint32_t kOwn = 3000;
    if (source_.alarm != target_.alarm || source_.alarm < kOwn) return source_.alarm == target_.alarm;
    return sameOwnText();
  }

  // Of `#3000`; one control may show less of it, and a translation writes it in capitals and cuts it after a
  // word where the next one is not shown.
  bool sameOwnText() const {
    constexpr std::size_t kLeastShown = 20; // characters that any control shows
    const std::string one = upperCase(source_.text), other = upperCase(target_.text);
    const std::size_t shown = std::min(one.size(), other.size());
    if (shown == 0 || one.compare(0, shown, other, 0, shown) != 0) return one == other;
    if (one.size() <= other.size()) return one.size() == other.size() || shown >= kLeastShown;
    const std::size_t next = one[shown] == ' ' ? shown + 1 : shown;
    return std::min(one.find(' ', next), one.size()) > rules_.shownText;
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
      same = renumbered() ? sameOwnText() : source_.alarm == target_.alarm && source_.text == target_.text;
    else if (alarms && rules_.sameProgram && same && source_.alarmKind.empty())
      same = sameOwnAlarm();
    else if (alarms && same && renumbered() && target_.alarmKind.empty())
      same = sameOwnText();
    if (!same) {
      add(Aspect::Ending, howItEnds("the source", source_) + ", " + howItEnds("the translation", target_),
          source_.endedAt, target_.endedAt);
    } else if (alarms && rules_.samePlace && source_.endedAt.hasPlace() &&
               !rules_.samePlace(source_.endedAt, target_.endedAt)) {
      add(Aspect::Ending, "the translation stops at another place: " + endText(source_), source_.endedAt,
          target_.endedAt);
    }
  }

  // Where a bend is as small as the tolerance, one side may go straight on and the other end a piece there.
  // So it may where it goes on with another feed, or something else on. `ran`: the side of the longer piece.
  void splitAlike(const std::vector<Piece>& shorter, std::vector<Piece>& longer, std::size_t i,
                  const Record& ran) const {
    if (i + 1 >= shorter.size()) return;
    const Piece &one = shorter[i], &next = shorter[i + 1], &other = longer[i];
    if (next.kind != one.kind) return;
    if ((next.with != one.with || next.feed != one.feed) &&
        !between(one.from, one.to, next.to, 2 * rules_.tolerance))
      return;
    if (one.kind != other.kind || one.kind == sim::PathKind::Measuring ||
        !near(one.from, other.from, rules_.tolerance) || near(one.to, other.to, rules_.tolerance) ||
        !between(other.from, one.to, other.to, 2 * rules_.tolerance))
      return;
    Piece rest = other;
    rest.from = longer[i].to = one.to;
    rest.range = rangeFrom(ran, other, rest.from);
    longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(i) + 1, std::move(rest));
  }

  // Of the pieces that were joined the one that goes on from a place.
  SourceRange rangeFrom(const Record& record, const Piece& joined, const Point3& place) const {
    for (std::size_t n = firstOf(record, joined); n < record.pieces.size(); ++n) {
      const Piece& one = record.pieces[n];
      if (one.kind != joined.kind) break;
      if (near(one.to, place, 2 * rules_.tolerance)) continue;
      if (near(one.from, place, 2 * rules_.tolerance) ||
          between(one.from, place, one.to, 2 * rules_.tolerance))
        return one.range;
    }
    return joined.range;
  }

  // So short that the last digits of its ends decide whether it is one.
  bool mayVanish(const Piece& piece) const {
    return piece.kind != sim::PathKind::Measuring && near(piece.from, piece.to, 2 * rules_.tolerance);
  }

  // A move that is not much longer than the tolerance may come to nothing where both its ends are rounded.
  void dropVanished(std::vector<Piece>& longer, const std::vector<Piece>& other, std::size_t i) const {
    if (i + 1 >= longer.size() || i >= other.size()) return;
    const Piece &one = longer[i], &next = longer[i + 1], &there = other[i];
    if (!mayVanish(one)) return;
    const bool goesOn = next.kind == there.kind && near(next.from, there.from, 2 * rules_.tolerance) &&
                        near(next.to, there.to, rules_.tolerance);
    if (goesOn) longer.erase(longer.begin() + static_cast<std::ptrdiff_t>(i));
  }

  // An edge that is grazed stops a protected move at a height that a last digit beside it changes.
  double ofLastPiece() const {
    const bool obstructed = source_.ending == Ending::Alarm &&
                            source_.alarmKind == stdlib::macroAlarmName(stdlib::MacroAlarm::PathObstructed);
    return obstructed && pair_.stopsInMacros() ? std::max(kStopping, rules_.tolerance) : rules_.tolerance;
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
        if (!writtenApart(a, b, i)) addMoves(a[i], b[i]);
        return;
      }
      if (cut && !framesText(a[i], b[i]).empty()) {
        add(Aspect::Path,
            framesText(a[i], b[i]) +
                fmt::format("a {} move from {}", pathKindName(a[i].kind), textOf(a[i].from)),
            a[i].range, b[i].range);
        return;
      }
      compareState(pair_, a[i].with, b[i].with, fmt::format(" at a {} move", pathKindName(a[i].kind)),
                   a[i].range, b[i].range);
      if (a[i].kind != sim::PathKind::Measuring) continue;
      if (measure < source_.measures.size() && measure < target_.measures.size()) {
        compareNominal(pair_, source_.measures[measure], target_.measures[measure]);
      }
      ++measure;
    }
    if (out_.empty()) writtenApart(a, b, std::min(a.size(), b.size()));
  }

  // An offset that was written before the piece moves what follows.
  bool writtenApart(const std::vector<Piece>& a, const std::vector<Piece>& b, std::size_t i) {
    if (rules_.atMeasures) return false;
    const auto before = [i](const Record& record, const std::vector<Piece>& joined) {
      const bool measures = i < joined.size() && joined[i].kind == sim::PathKind::Measuring;
      const std::size_t own = i < joined.size() ? firstOf(record, joined[i]) : record.pieces.size();
      if (measures) return own == 0 ? 0 : own - 1;
      const std::size_t next = i + 1 < joined.size() ? firstOf(record, joined[i + 1]) : own;
      return std::max(own, next == 0 ? next : next - 1);
    };
    std::optional<Difference> found =
        earlierOffset(source_, target_, rules_, before(source_, a), before(target_, b));
    if (!found) return false;
    addFirst(out_, std::move(*found));
    return true;
  }

  // Of the pieces that were joined, where the first one is in the record.
  static std::size_t firstOf(const Record& record, const Piece& joined) {
    const auto found = std::find_if(record.pieces.begin(), record.pieces.end(), [&](const Piece& one) {
      return one.range == joined.range && one.kind == joined.kind && near(one.from, joined.from, 0);
    });
    return static_cast<std::size_t>(found - record.pieces.begin());
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

  // A millionth of a feed is its last digits.
  bool sameFeed(double one, double other) const {
    constexpr double kDigits = 1e-6;
    return std::abs(one - other) <= std::max(rules_.results, kDigits * std::abs(one));
  }

  // Where the feed differs, too, it is why the pieces do: " at F2500".
  std::string feedOf(const Piece& piece, const Piece& other) const {
    if (piece.kind != other.kind || !piece.feed || !other.feed || sameFeed(*piece.feed, *other.feed))
      return "";
    return " at F" + numberText(*piece.feed);
  }

  void addMoves(const Piece& a, const Piece& b) {
    add(Aspect::Path,
        framesText(a, b) + fmt::format("a {} move to {}{} against a {} move to {}{}", pathKindName(a.kind),
                                       textOf(a.to), feedOf(a, b), pathKindName(b.kind), textOf(b.to),
                                       feedOf(b, a)),
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
      const bool alone = i >= std::min(a.size(), b.size()) && i + 1 == std::max(a.size(), b.size());
      if (alone && mayVanish(i < a.size() ? a[i] : b[i])) return;
      if (i >= a.size()) {
        add(Aspect::Path,
            fmt::format("the translation goes on by a {} move to {}, the source does not",
                        pathKindName(b[i].kind), textOf(b[i].to)),
            a.empty() ? SourceRange{} : a.back().range, b[i].range);
        return;
      }
      if (i >= b.size()) {
        add(Aspect::Path,
            fmt::format("the source goes on by a {} move to {}, the translation does not",
                        pathKindName(a[i].kind), textOf(a[i].to)),
            a[i].range, b.empty() ? SourceRange{} : b.back().range);
        return;
      }
      splitAlike(a, b, i, target_);
      splitAlike(b, a, i, source_);
      dropVanished(a, b, i);
      dropVanished(b, a, i);
      const bool last = i + 1 == a.size() && i + 1 == b.size();
      const bool same = a[i].kind == b[i].kind && near(a[i].from, b[i].from, rules_.tolerance) &&
                        near(a[i].to, b[i].to, last ? ofLastPiece() : rules_.tolerance);
      if (!same) {
        addMoves(a[i], b[i]);
        return;
      }
      compareState(pair_, a[i].with, b[i].with, "", a[i].range, b[i].range);
      goesOn(a[i], b[i]);
      feed(a[i], b[i]);
      underModes(a[i], b[i]);
    }
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

  void goesOn(const Piece& a, const Piece& b) {
    if (a.goesOn == b.goesOn) return;
    const auto text = [](const Piece& piece) {
      return piece.goesOn ? "raises no alarm" : "stops with an alarm";
    };
    add(Aspect::Path,
        fmt::format("a protected move that {} where it meets something against one that {}", text(a),
                    text(b)),
        a.range, b.range);
  }

  void feed(const Piece& a, const Piece& b) {
    const auto shown = [](const Piece& piece) {
      return piece.feed ? "F" + numberText(*piece.feed) : std::string("no feed");
    };
    const bool same =
        a.feed && b.feed ? sameFeed(*a.feed, *b.feed) : a.feed.has_value() == b.feed.has_value();
    if (!same) add(Aspect::State, shown(a) + " against " + shown(b), a.range, b.range);
  }

  const Record& source_;
  const Record& target_;
  const CompareRules& rules_;
  std::vector<Difference> out_;
  const ComparedPair pair_{source_, target_, rules_, out_};
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
  if (!rules.sameAlarmNumbers && !rules.sameProgram && !rules.atMeasures) {
    if (const std::optional<Record> joined = joinedCalls(source, target, rules.tolerance))
      return Comparison(source, *joined, rules).run();
    if (const std::optional<Record> joined = joinedTouches(source, target, rules.tolerance))
      return Comparison(*joined, target, rules).run();
  }
  return Comparison(source, target, rules).run();
}

} // namespace dotek::verify
