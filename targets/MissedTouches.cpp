#include "targets/MissedTouches.h"

#include "support/Decimal.h"
#include "verify/SameWay.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>

namespace dotek::targets {

namespace {

constexpr std::size_t kMost = 12; // touches; of a loop, the first

// Where one touch has to find its surface for the source to go another way than a step before.
class Turns {
public:
  Turns(SourceQuestions& questions, std::size_t search) : questions_(questions), search_(search) {}

  // In steps from where the touch begins: the last one of each way and the first one of the next, between
  // these.
  void find(long from, long to) {
    const std::optional<verify::Record>&one = at(from), &other = at(to);
    if (!one || !other || verify::sameWay(*one, *other)) return;
    if (to - from <= 1) {
      found_.insert(from);
      found_.insert(to);
      return;
    }
    const long middle = from + (to - from) / 2;
    find(from, middle);
    find(middle, to);
  }
  const std::set<long>& found() const { return found_; }

  // nullopt: what the source does is not known, or it has been asked often enough.
  const std::optional<verify::Record>& at(long steps) {
    constexpr std::size_t kMostRuns = 160;
    const auto known = runs_.find(steps);
    if (known != runs_.end()) return known->second;
    std::optional<verify::Record>& out = runs_[steps];
    if (runs_.size() > kMostRuns) return out;
    SourceQuestions::Ran ran = questions_.disturbed(placed(steps));
    if (ran.answer == SourceQuestions::Answer::Runs) out = std::move(ran.record);
    return out;
  }
  verify::Interference placed(long steps) const {
    verify::Interference out;
    out.placed = {search_, static_cast<double>(steps) * verify::kStep};
    return out;
  }

private:
  SourceQuestions& questions_;
  const std::size_t search_;
  std::map<long, std::optional<verify::Record>> runs_;
  std::set<long> found_;
};

// One protected move, where the source turns before its end.
class Turning {
public:
  Turning(const DisturbedSides& sides, std::size_t move) : sides_(sides), move_(move) {}

  // Steps before the end: the last one where it goes on as if it had come there, and so the first one where
  // it does not is the next; 0: there is none.
  long find() const {
    constexpr long kFar = 1000; // of a limit that programs ask for
    long near = 1, far = kFar;
    const std::optional<verify::Record> one = sides_.source(at(near)), other = sides_.source(at(far));
    if (!one || !other || verify::sameWay(*one, *other)) return 0;
    while (far - near > 1) {
      const long middle = near + (far - near) / 2;
      const std::optional<verify::Record> now = sides_.source(at(middle));
      if (!now) return 0;
      (verify::sameWay(*now, *one) ? near : far) = middle;
    }
    return near;
  }
  verify::Interference at(long steps) const {
    verify::Interference out;
    out.obstacle = move_;
    out.beforeEnd = static_cast<double>(steps) * verify::kStep;
    return out;
  }

private:
  const DisturbedSides& sides_;
  const std::size_t move_;
};

std::vector<verify::Difference> compareUnder(const verify::Interference& by, const DisturbedSides& sides,
                                             const std::string& where) {
  const std::optional<verify::Record> meant = sides.source(by);
  if (!meant) return {};
  verify::Record ran = sides.target(by);
  ran.events.clear(); // the part is where the probe finds nothing
  std::vector<verify::Difference> found = verify::compare(*meant, ran, sides.rules(*meant));
  for (verify::Difference& one : found)
    one.text = where + ": " + one.text;
  return found;
}

// Whether the move that is stopped half way is of so few steps that another control may round it to none, or
// its macro counts the rest as none: what it meets there says nothing.
bool stopsWithinSteps(const std::optional<verify::Record>& stopped) {
  if (!stopped) return false;
  for (auto piece = stopped->pieces.rbegin(); piece != stopped->pieces.rend(); ++piece)
    if (piece->kind == sim::PathKind::Protected)
      return (piece->to - piece->from).length() <= 2 * verify::kStep;
  return false;
}

std::vector<verify::Difference> compareObstructed(std::size_t move, const DisturbedSides& sides) {
  verify::Interference half;
  half.obstacle = move;
  const std::string which = fmt::format("protected move {} meets something", move + 1);
  std::vector<verify::Difference> found = compareUnder(half, sides, "where " + which);
  if (!found.empty() && stopsWithinSteps(sides.source(half))) return {};
  const Turning turning(sides, move);
  const long turns = found.empty() ? turning.find() : 0;
  constexpr long kApart = 3; // steps: the last digits of two controls lie between
  for (const long steps : {turns - kApart, turns + kApart})
    if (found.empty() && turns > kApart)
      found = compareUnder(turning.at(steps), sides,
                           fmt::format("where {} {} mm before its end", which,
                                       fixedText(static_cast<double>(steps) * verify::kStep, 3)));
  return found;
}

// It measures what it has measured before.
bool measuresAgain(const verify::Record& source) {
  constexpr double kSame = 0.02; // mm
  const auto placeOf = [](const verify::Measure& measure) {
    return !measure.nominal.empty() ? measure.nominal.front().point : measure.aim.value_or(measure.end);
  };
  const auto& all = source.measures;
  for (std::size_t i = 0; i < std::min(all.size(), kMost); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if ((placeOf(all[i]) - placeOf(all[k])).length() <= kSame &&
          (all[i].start - all[k].start).length() <= kSame)
        return true;
  return false;
}

// Where the source tries again: nothing is found ever after, and what is measured again does not repeat.
std::vector<verify::Difference> compareRepeated(const verify::Record& source, const verify::Record& ran,
                                                const DisturbedSides& sides) {
  if (source.searches != ran.searches || source.calls != ran.calls) return {};
  std::vector<verify::Difference> found;
  verify::Interference nothing;
  nothing.andLater = true;
  if (source.searches > 0) nothing.missing = 0;
  if (source.calls > 0) nothing.missedCall = 0;
  const std::optional<verify::Record> meant = sides.source(nothing);
  if (meant && (meant->searches > 1 || meant->calls > 1))
    found = compareUnder(nothing, sides, "where nothing is ever found");
  // mm; on no limit that somebody would give
  constexpr double kApart[] = {0.3171, 1.0433};
  const std::size_t measures = measuresAgain(source) ? std::max(source.searches, source.calls) : 0;
  for (std::size_t from = 0; from < std::min(measures, kMost) && measures > 1; ++from)
    for (const double by : kApart) {
      if (!found.empty()) return found;
      verify::Interference unlike;
      unlike.unlike = {from, by, from == 0};
      found = compareUnder(unlike, sides,
                           from == 0 ? fmt::format("where measurements differ by {} mm in turn", by)
                                     : fmt::format("where measurement {} and later ones find the surface {} "
                                                   "mm earlier",
                                                   from + 1, by));
    }
  return found;
}

} // namespace

std::vector<verify::Difference> compareDisturbed(const verify::Record& source, const verify::Record& ran,
                                                 const DisturbedSides& sides) {
  std::vector<verify::Difference> found;
  const auto each = [&](std::size_t one, std::size_t other, const auto& look) {
    for (std::size_t i = 0; one == other && i < std::min(one, kMost) && found.empty(); ++i)
      found = look(i);
  };
  each(source.searches, ran.searches, [&](std::size_t search) {
    verify::Interference none;
    none.missing = search;
    return compareUnder(none, sides, fmt::format("where touch {} finds nothing", search + 1));
  });
  each(source.calls, ran.calls, [&](std::size_t call) {
    verify::Interference none;
    none.missedCall = call;
    return compareUnder(none, sides, fmt::format("where measuring call {} finds nothing", call + 1));
  });
  each(source.protectedMoves, ran.protectedMoves,
       [&](std::size_t move) { return compareObstructed(move, sides); });
  if (found.empty()) found = compareRepeated(source, ran, sides);
  return found;
}

std::vector<verify::Difference>
compareMissed(const TargetCase& now, const verify::Record& ran,
              const std::function<verify::Record(const verify::Interference&)>& run,
              const std::function<verify::CompareRules(const verify::Record&)>& rules, bool exact) {
  if (now.source == nullptr || now.questions == nullptr) return {};
  const DisturbedSides sides{[&](const verify::Interference& by) -> std::optional<verify::Record> {
                               SourceQuestions::Ran meant = now.questions->disturbed(by);
                               if (meant.answer != SourceQuestions::Answer::Runs) return std::nullopt;
                               return std::move(meant.record);
                             },
                             run, rules};
  std::vector<verify::Difference> found = compareDisturbed(*now.source, ran, sides);
  if (!found.empty() || !exact || now.source->searches != ran.searches) return found;
  std::size_t search = 0;
  for (const verify::Measure& measure : now.source->measures) {
    if (!measure.aim || search >= kMost) continue;
    Turns turns(*now.questions, search++);
    const auto steps = [&](const sim::Point3& to) {
      return std::lround((to - measure.start).length() / verify::kStep);
    };
    const long here = std::max(1L, steps(measure.end)), last = steps(*measure.aim);
    turns.find(1, here);
    turns.find(here, last);
    for (const long at : turns.found()) {
      const std::optional<verify::Record>& meant = turns.at(at);
      if (!meant) continue;
      found = verify::compare(*meant, run(turns.placed(at)), rules(*meant));
      for (verify::Difference& one : found)
        one.text = fmt::format("where touch {} finds its surface {} mm from its start: {}", search,
                               fixedText(static_cast<double>(at) * verify::kStep, 3), one.text);
      if (!found.empty()) return found;
    }
  }
  return {};
}

} // namespace dotek::targets
