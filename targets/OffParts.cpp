#include "targets/OffParts.h"

#include "support/Decimal.h"
#include "verify/CompareParts.h"
#include "verify/SameWay.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

namespace dotek::targets {

namespace {

constexpr double kBeyond = 1.25;  // of the limit
constexpr double kMost = 2;       // mm: searches go farther
constexpr double kMostTurn = 3;   // degrees
constexpr double kOwnLimit = 0.3; // mm, for comparisons of the program's own
constexpr double kSearch = 10;    // mm beyond a surface, of vendors' macros by themselves
constexpr double kOfSearch = 0.9; // the part lies within it

// How a part is off besides: surfaces moved along their touches, all of it moved along X, turned.
using Off = std::tuple<double, double, double>;

void add(double grown, double moved, double turned, std::set<Off>& out) {
  const auto rounded = [](double value) { return std::round(value * 1000) / 1000; };
  const Off one{rounded(grown), rounded(moved), rounded(turned)};
  if (one == Off{} || std::abs(grown) > kMost || std::abs(moved) > kMost || std::abs(turned) > kMostTurn)
    return;
  out.insert(one);
}

// Beyond the limits that the calls state. A size is off by twice what a surface is, a true position by twice
// what its middle is.
std::set<Off> offsOf(const verify::Record& source, bool compares) {
  using Role = stdlib::ArgumentRole;
  std::set<Off> out;
  for (const verify::Measure& measure : source.measures)
    for (const auto& [role, value] : measure.options) {
      const double limit = std::abs(value) * kBeyond + 0.002;
      switch (role) {
      case Role::SizeTolerance:
      case Role::UpperLimit:
        for (const double grown : {limit / 2, -limit / 2})
          add(grown, 0, 0, out);
        if (measure.nominal.size() == 1) add(limit, 0, 0, out);
        break;
      case Role::PositionTolerance: add(0, limit / 2, 0, out); break;
      case Role::AngleTolerance: add(0, 0, limit, out); break;
      default: break;
      }
    }
  if (compares)
    for (const double grown : {kOwnLimit, -kOwnLimit})
      add(grown, 0, 0, out);
  return out;
}

// How much farther the surfaces may lie for the source to find all of them; 0: it searches for none beyond
// where it expects it. `most`: farther no translation has to search.
double searchOf(const verify::Record& source, std::optional<double> most) {
  double out = most.value_or(kSearch);
  for (const verify::Measure& measure : source.measures) {
    if (measure.travels || measure.nominal.size() != 1) return 0;
    const auto stated = measure.options.find(stdlib::ArgumentRole::Overtravel);
    if (stated != measure.options.end()) out = std::min(out, stated->second);
  }
  return source.measures.empty() ? 0 : std::max(out, 0.0) * kOfSearch;
}

std::string textOf(const Off& off) {
  const auto& [grown, moved, turned] = off;
  if (grown != 0) return fmt::format("each surface {} mm farther along its touch", numberText(grown));
  if (off == Off{}) return "each surface where it is expected";
  if (moved != 0) return fmt::format("all of it {} mm farther along X", numberText(moved));
  return fmt::format("it turned by {} degrees more", numberText(turned));
}

// A macro has stopped it because a result is beyond a limit of the call.
bool isOfLimit(const verify::Record& source) {
  return source.ending == verify::Ending::Alarm && !source.alarmKind.empty() &&
         !verify::ownTextOf(source.alarmKind).empty();
}

// What it does can be held against another set's macros: it has found all its surfaces.
bool counts(const verify::Record& source) {
  return source.ending == verify::Ending::Finished ||
         (source.ending == verify::Ending::Alarm && (source.alarmKind.empty() || isOfLimit(source)));
}

// What moves, and how far.
struct Moving {
  SourceQuestions::Growth growth; // `by` and `moved` of one millimetre
  std::string what;               // "each surface"
};

// Runs of the source with its surfaces farther along their touches.
class Grown {
public:
  Grown(SourceQuestions& questions, const verify::PartError& more, const Moving& moving)
      : questions_(questions), more_(more), moving_(moving) {}

  // In steps. nullopt: there is no such run.
  const std::optional<verify::Record>& at(long steps) {
    const auto [known, isNew] = runs_.try_emplace(steps);
    if (isNew)
      look(steps, 0, [&, at = known](const verify::Record& record, sim::World&) { at->second = record; });
    return known->second;
  }
  void look(long steps, double tie, const std::function<void(const verify::Record&, sim::World&)>& shown) {
    SourceQuestions::Growth growth = moving_.growth;
    growth.by *= millimetres(steps);
    growth.moved = growth.moved * millimetres(steps);
    growth.tie = tie;
    questions_.elsewhere(more_, growth, shown);
  }
  bool sameWayAt(long one, long other) {
    return at(one) && at(other) && verify::sameWay(*at(one), *at(other));
  }
  // The last step of each way, as far as they show between these places.
  template <std::size_t N> std::set<long> turns(const long (&places)[N]) {
    std::set<long> out;
    for (std::size_t i = 0; i + 1 < N; ++i)
      verify::findTurns(
          places[i], places[i + 1], true, [&](long steps) -> const auto& { return at(steps); }, out);
    return out;
  }
  static double millimetres(long steps) { return static_cast<double>(steps) / kSteps; }

private:
  static constexpr double kSteps = 2000; // each half of what a control counts: a size counts it twice

  SourceQuestions& questions_;
  const verify::PartError more_;
  const Moving moving_;
  std::map<long, std::optional<verify::Record>> runs_;
};

using Compare =
    std::function<std::vector<verify::Difference>(const verify::Record& source, sim::World& world)>;

constexpr long kPlaces[] = {-4000, -600, 0, 600, 4000}; // steps, between which turns are looked for
constexpr std::size_t kMostTurns = 8;                   // of more it goes another way with each step

const Moving kEachSurface{{.by = 1}, "each surface"};

// Just where the source goes another way because of what it has measured.
std::vector<verify::Difference> compareTurns(const TargetCase& now, bool exact, const Compare& compare) {
  constexpr long kApart = 6; // steps: the last digits of two controls lie between
  verify::PartError more;
  if (exact) { // what the part is off by is on no step
    more.shift = now.drawn.error.shift * -1;
    more.turn = -now.drawn.error.turn;
  }
  Grown grown(*now.questions, more, kEachSurface);
  const std::set<long> turns = grown.turns(kPlaces);
  std::vector<verify::Difference> found;
  for (const long turn : turns) {
    if (turns.size() > kMostTurns) break;
    for (const long place : {exact ? turn : turn - kApart, exact ? turn + 1 : turn + 1 + kApart}) {
      if (!found.empty() || !grown.sameWayAt(place, place > turn ? turn + 1 : turn)) continue;
      grown.look(place, 0, [&](const verify::Record& meant, sim::World& world) {
        if (counts(meant)) found = compare(meant, world);
      });
      for (verify::Difference& one : found)
        one.text =
            fmt::format("with the part off, {}: {}", textOf({Grown::millimetres(place), 0, 0}), one.text);
    }
  }
  return found;
}

// There both sides take what they have measured for the limit itself. `exact`: OffRules::exact.
std::vector<verify::Difference> compareTies(const TargetCase& now, const Moving& moving, bool exact,
                                            const Compare& compare) {
  constexpr double kTie = 0.003; // mm; more than a step, and than what other arithmetic or macros leave
  Grown grown(*now.questions, {}, moving);
  const std::set<long> turns = grown.turns(kPlaces);
  std::vector<verify::Difference> found;
  if (turns.size() > kMostTurns) return found;
  for (const long turn : turns) {
    // Where a search ends two macros do not share the last digit. A limit of a call stops what is beyond it,
    // so there the run counts that goes on.
    const verify::Record &one = *grown.at(turn), &other = *grown.at(turn + 1);
    const bool meets = verify::meetsEach(one), meetsNext = verify::meetsEach(other);
    if (!(meets && meetsNext) && !(meets && isOfLimit(other)) && !(meetsNext && isOfLimit(one))) continue;
    const long place = meets ? turn : turn + 1;
    bool alike = exact; // else what differs there by itself is a matter of the last digits
    if (!exact)
      grown.look(place, 0, [&](const verify::Record& meant, sim::World& world) {
        alike = compare(meant, world).empty();
      });
    if (!alike) continue;
    grown.look(place, kTie, [&](const verify::Record& meant, sim::World& world) {
      if (counts(meant)) found = compare(meant, world);
    });
    for (verify::Difference& each : found)
      each.text = fmt::format("with {} {} mm farther, so that a measured value is exactly a limit: {}",
                              moving.what, numberText(Grown::millimetres(place)), each.text);
    if (!found.empty()) return found;
  }
  return found;
}

// Touches of the path by measurement: the first and how many; none where the source measures more often than
// the path touches, or less. One that measures what another one measures is left out.
std::vector<std::pair<std::size_t, std::size_t>> touchesByMeasure(const verify::Record& source,
                                                                  std::size_t drawn) {
  const auto sharesPlace = [](const verify::Measure& one, const verify::Measure& other) {
    constexpr double kSame = 0.02; // mm
    return std::any_of(one.nominal.begin(), one.nominal.end(), [&](const verify::Touch& touch) {
      return std::any_of(other.nominal.begin(), other.nominal.end(), [&](const verify::Touch& there) {
        return (touch.point - there.point).length() <= kSame;
      });
    });
  };
  std::vector<std::pair<std::size_t, std::size_t>> out;
  std::size_t touches = 0;
  for (const verify::Measure& measure : source.measures) {
    const std::size_t count = std::max<std::size_t>(measure.nominal.size(), 1);
    const bool alone = count == 1 || std::none_of(source.measures.begin(), source.measures.end(),
                                                  [&](const verify::Measure& other) {
                                                    return &other != &measure && sharesPlace(measure, other);
                                                  });
    if (alone) out.emplace_back(touches, count);
    touches += count;
  }
  if (touches != drawn) out.clear();
  return out;
}

// One measurement of several: its touches, and how they are called.
struct Alone {
  std::size_t touch = 0, count = 1;
  std::string what;
};

// Of very many the first, the last and some between.
std::vector<Alone> measuredAlone(const TargetCase& now) {
  constexpr std::size_t kMostMeasures = 6;
  const auto measures = touchesByMeasure(*now.source, now.questions->touches());
  std::vector<Alone> out;
  if (measures.size() < 2) return out;
  const std::size_t most = std::min(measures.size(), kMostMeasures);
  for (std::size_t i = 0; i < most; ++i) {
    const auto& [touch, count] = measures[i * (measures.size() - 1) / (most - 1)];
    out.push_back({touch, count,
                   count == 1 ? fmt::format("the surface of touch {}", touch + 1)
                              : fmt::format("the surfaces of touches {} to {}", touch + 1, touch + count)});
  }
  return out;
}

// What one measurement finds off and the others not: what a program compares between two.
std::vector<verify::Difference> compareApart(const TargetCase& now, const Compare& compare) {
  // mm; on no limit that somebody would give
  constexpr double kApart[] = {0.3171, -1.0433};
  // Its size a little off as well: a difference of exactly 0 has no sign for two macros to agree on.
  const sim::Point3 kMoved{0.2171, -0.4433, 0};
  constexpr double kHardly = 0.0131;
  std::vector<verify::Difference> found;
  const auto look = [&](const SourceQuestions::Growth& growth, const std::string& where) {
    now.questions->elsewhere({}, growth, [&](const verify::Record& meant, sim::World& world) {
      if (counts(meant)) found = compare(meant, world);
    });
    for (verify::Difference& one : found)
      one.text = fmt::format("with {}: {}", where, one.text);
    return !found.empty();
  };
  for (const auto& [touch, count, what] : measuredAlone(now)) {
    for (const double by : kApart)
      if (look({by, touch, count}, fmt::format("{} {} mm farther", what, numberText(by)))) return found;
    if (count > 1 &&
        look({kHardly, touch, count, kMoved},
             fmt::format("{} moved by X{} Y{}", what, numberText(kMoved.x), numberText(kMoved.y))))
      return found;
  }
  return found;
}

// All of them, and one after the other.
std::vector<verify::Difference> compareEachTie(const TargetCase& now, bool exact, const Compare& compare) {
  std::vector<verify::Difference> found = compareTies(now, kEachSurface, exact, compare);
  for (const auto& [touch, count, what] : measuredAlone(now)) {
    if (!found.empty()) return found;
    Moving moving{{.by = 1, .touch = touch, .count = count}, what};
    if (count > 1) { // its size as it is, and its middle at an angle to both axes
      moving.growth.by = 0;
      moving.growth.moved = {0.6, 0.8, 0};
    }
    found = compareTies(now, moving, exact, compare);
  }
  return found;
}

} // namespace

std::vector<verify::Difference> compareOffParts(const TargetCase& now, const OffRules& rules,
                                                const Compare& compare) {
  std::vector<verify::Difference> found;
  if (now.source == nullptr || now.questions == nullptr || now.posted == nullptr) return found;
  const auto& body = now.posted->body;
  const bool compares = std::any_of(body.begin(), body.end(), [](const ir::ProgramStatement& one) {
    return std::holds_alternative<ir::Branch>(one.node);
  });
  std::set<Off> offs = offsOf(*now.source, compares);
  const double search = searchOf(*now.source, rules.search);
  if (search > 0) offs.insert({std::round(search * 1000) / 1000, 0, 0});
  for (const Off& off : offs) {
    verify::PartError more;
    more.shift.x = std::get<1>(off);
    more.turn = std::get<2>(off);
    now.questions->elsewhere(more, {std::get<0>(off)}, [&](const verify::Record& meant, sim::World& world) {
      if (!counts(meant)) return;
      if (std::get<0>(off) > kMost && meant.ending != verify::Ending::Finished) return;
      found = compare(meant, world);
    });
    for (verify::Difference& one : found)
      one.text = fmt::format("with the part off, {}: {}", textOf(off), one.text);
    if (!found.empty()) return found;
  }
  if (!compares) return found;
  found = compareApart(now, compare);
  if (found.empty()) found = compareTurns(now, false, compare);
  if (found.empty() && rules.exact) found = compareTurns(now, true, compare);
  if (found.empty() && rules.ties) found = compareEachTie(now, rules.exact, compare);
  return found;
}

void addOffParts(const TargetCase& now, const OffRules& rules,
                 const std::function<TargetRun(const verify::Record& source, sim::World& world)>& run,
                 TargetRun& out) {
  std::vector<TargetDifference> last; // of the run that is compared
  std::vector<verify::Difference> found =
      compareOffParts(now, rules, [&](const verify::Record& source, sim::World& world) {
        last = run(source, world).differences;
        std::vector<verify::Difference> differences;
        for (const TargetDifference& one : last)
          differences.push_back(one.difference);
        return differences;
      });
  for (std::size_t i = 0; i < found.size(); ++i)
    out.differences.push_back({std::move(found[i]), last[i].line, ""});
}

} // namespace dotek::targets
