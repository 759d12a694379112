// Parts of a case on which the cycle goes another way because of what it measures: beside each place where a
// comparison turns, and between two of them, the program has to do what the cycle does.
#include "targets/CycleFileCasesParts.h"
#include "targets/Stage.h"

#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <set>

namespace dotek::targets {

namespace {

constexpr double kSteps = 2000; // a mm, of what a part is off: half of what a control counts
constexpr long kPlaces[] = {-4000, -1000, -200, -24, 0, 24, 200, 1000, 4000};
constexpr long kApart = 8;                // steps beside a turn: the last digits of two controls lie between
constexpr std::size_t kMostTouches = 8;   // whose surfaces are moved one by one
constexpr std::size_t kMostOfOne = 2;     // turns from one way to another that are looked at
constexpr std::size_t kMostRuns = 800;    // of the cycle, for each case
constexpr std::size_t kMostCompared = 80; // of these with the program
constexpr long kAlone = 634;              // steps; on no limit that somebody would give

} // namespace

class CycleFileRunner::OtherParts {
public:
  // All outlive it. `played` agrees.
  OtherParts(CycleFileRunner& runner, const Played& played, CaseResult& result)
      : runner_(runner), played_(played), result_(result) {
    compared_.insert(played.way.turns);
  }

  void look() {
    scan({How::Grown});
    const std::size_t touches = played_.surfaces.size();
    for (std::size_t i = 0; touches > 1 && i < std::min(touches, kMostTouches); ++i) {
      // A circle through touches at angles is hardly one any more, and each last digit counts many times.
      if (!isAlongAxis(played_.surfaces[i].direction)) continue;
      scan({How::Alone, i});
      compare({How::Alone, i}, kAlone);
    }
    for (const How how : {How::AlongX, How::AlongY, How::AlongZ, How::Turned})
      scan({how});
  }

private:
  // How the part is off.
  enum class How : std::uint8_t { Grown, Alone, AlongX, AlongY, AlongZ, Turned };
  struct Direction {
    How how = How::Grown;
    std::size_t touch = 0;
  };
  using Ways = std::map<long, std::optional<std::uint64_t>>;

  bool ends() const { return !result_.findings.empty() || runner_.stopped_.has_value(); }

  std::unique_ptr<Played> playAt(const Direction& direction, long steps) const {
    const double by = static_cast<double>(steps) / kSteps;
    auto out = std::make_unique<Played>();
    out->drawn = played_.drawn;
    out->surfaces = played_.surfaces;
    verify::PartError error = out->drawn.error;
    switch (direction.how) {
    case How::Grown:
      for (verify::Touch& one : out->surfaces)
        one.point = one.point + one.direction * by;
      break;
    case How::Alone: {
      verify::Touch& one = out->surfaces[direction.touch];
      one.point = one.point + one.direction * by;
      break;
    }
    case How::AlongX: error.shift.x += by; break;
    case How::AlongY: error.shift.y += by; break;
    case How::AlongZ: error.shift.z += by; break;
    case How::Turned: error.turn += by; break;
    }
    const sim::Probe probe = probeFor(runner_.plan_, out->drawn);
    out->part =
        verify::partOf(out->surfaces, probe.ballRadius(), std::max(probe.ballRadius(), kReach), error);
    if (!out->part) return nullptr;
    sim::World world(*out->part, probe, runner_.limits());
    out->record = runner_.runCycle(out->drawn, world, false, {}, &out->way);
    SourceRange at;
    const bool says = counts(out->record) && !touchesAtOnce(out->record, probe.ballRadius(), at);
    return says ? std::move(out) : nullptr;
  }

  static bool isAlongAxis(const sim::Point3& direction) {
    constexpr double kSame = 1e-9;
    return std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z) < 1 + kSame;
  }

  // It has found all that it looks for.
  static bool counts(const verify::Record& record) {
    return record.events.empty() && (record.ending == verify::Ending::Finished ||
                                     (record.ending == verify::Ending::Alarm && record.alarmKind.empty()));
  }

  // nullopt: on that part the cycle comes to nothing.
  std::optional<std::uint64_t> wayAt(const Direction& direction, long steps, Ways& ways) {
    const auto [known, isNew] = ways.try_emplace(steps);
    if (!isNew) return known->second;
    if (steps == 0) return known->second = played_.way.turns;
    if (++runs_ > kMostRuns) return std::nullopt;
    if (const std::unique_ptr<Played> there = playAt(direction, steps)) known->second = there->way.turns;
    return known->second;
  }

  void turns(const Direction& direction, long from, long to, Ways& ways, std::set<long>& out) {
    const auto one = wayAt(direction, from, ways), other = wayAt(direction, to, ways);
    if (!one || !other || one == other) return;
    if (to - from > 1) {
      const long middle = from + (to - from) / 2;
      turns(direction, from, middle, ways, out);
      turns(direction, middle, to, ways, out);
      return;
    }
    std::size_t& seen = seen_[std::minmax(*one, *other)];
    if (seen++ < kMostOfOne) out.insert(from);
  }

  // The way is the same a little beside the place: it is on no turn, which two controls compute otherwise.
  bool isWithin(const Direction& direction, long place, const std::optional<std::uint64_t>& way, Ways& ways) {
    const auto same = [&](long steps) { return wayAt(direction, steps, ways) == way; };
    return same(place) && same(place - kApart) && same(place + kApart);
  }

  void scan(const Direction& direction) {
    if (ends()) return;
    Ways ways;
    std::set<long> found;
    for (std::size_t i = 0; i + 1 < std::size(kPlaces); ++i)
      turns(direction, kPlaces[i], kPlaces[i + 1], ways, found);
    // Of each way that is new the run in the middle of where it holds: there a factor or a sign shows.
    for (auto at = ways.begin(); at != ways.end();) {
      auto last = at, next = std::next(at);
      for (; next != ways.end() && next->second == at->second; ++next)
        last = next;
      if (at->second && !compared_.contains(*at->second)) {
        const long middle = at->first + (last->first - at->first) / 2;
        for (const long place : {middle, middle - kApart, middle + kApart, at->first})
          if (isWithin(direction, place, at->second, ways)) {
            compare(direction, place);
            break;
          }
      }
      at = next;
    }
    for (const long turn : found) {
      for (const long place : {turn - kApart, turn + 1 + kApart})
        if (wayAt(direction, place, ways) == wayAt(direction, place > turn ? turn + 1 : turn, ways))
          compare(direction, place);
    }
  }

  void compare(const Direction& direction, long steps) {
    if (ends() || runs_ > kMostRuns || comparisons_ >= kMostCompared) return;
    const std::unique_ptr<Played> there = playAt(direction, steps);
    ++runs_;
    if (!there) return;
    ++comparisons_;
    const TargetRun ran = runner_.runTarget(*there, nullptr, nullptr);
    if (!ran.stopped.empty() || ran.refused || ran.undecided) return;
    compared_.insert(there->way.turns);
    runner_.noteCompared(there->record, there->way);
    runner_.takeDifferences(result_, ran);
    for (CaseFinding& finding : result_.findings)
      finding.text = fmt::format("with the part off, {}: {}", textOf(direction, steps), finding.text);
  }

  static std::string textOf(const Direction& direction, long steps) {
    const std::string by = numberText(static_cast<double>(steps) / kSteps);
    switch (direction.how) {
    case How::Grown: return fmt::format("each surface {} mm farther along its touch", by);
    case How::Alone:
      return fmt::format("the surface of touch {} {} mm farther along it", direction.touch + 1, by);
    case How::AlongX: return fmt::format("all of it {} mm farther along X", by);
    case How::AlongY: return fmt::format("all of it {} mm farther along Y", by);
    case How::AlongZ: return fmt::format("all of it {} mm farther along Z", by);
    case How::Turned: return fmt::format("it turned by {} degrees more", by);
    }
    return "";
  }

  CycleFileRunner& runner_;
  const Played& played_;
  CaseResult& result_;
  std::set<std::uint64_t> compared_; // ways
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::size_t> seen_;
  std::size_t runs_ = 0, comparisons_ = 0;
};

void CycleFileRunner::runOnOtherParts(const Played& played, CaseResult& result) {
  if (plan_.part || played.surfaces.empty()) return;
  const auto& body = cycle().body;
  if (std::any_of(body.begin(), body.end(),
                  [](const ir::CycleStatement& one) { return std::holds_alternative<ir::Branch>(one.node); }))
    OtherParts(*this, played, result).look();
}

void CycleFileRunner::noteCompared(const verify::Record& record, const sim::CycleWay& way) {
  // One of a macro, such as for a touch without contact, is none of the alarms that the cycle raises there.
  if (record.ending == verify::Ending::Alarm && record.alarmKind.empty()) met_.push_back(record.endedAt);
  const auto& body = cycle().body;
  reached_.resize(body.size());
  for (std::size_t i = 0; i < way.reached.size(); ++i) {
    if (!way.reached[i] || reached_[i]) continue;
    reached_[i] = true;
    newly_.push_back(body[i].origin.range());
  }
}

std::vector<SourceRange> CycleFileRunner::alarms() const {
  std::vector<SourceRange> out;
  // Those before anything moves are met by edge cases and by callers who break each check.
  for (const ir::CycleStatement& statement : cycle().body)
    if (std::holds_alternative<ir::Alarm>(statement.node) && statement.origin.range().hasPlace())
      out.push_back(statement.origin.range());
  return out;
}

namespace {

// It does something by itself, or asks.
bool runs(const ir::CycleStatement& statement) {
  return ir::match(
      statement, [](const ir::OneOf<ir::Label, ir::Jump, ir::Comment> auto&) { return false; },
      [](const ir::OneOf<ir::Move, ir::Measure, ir::CallCycle, ir::OpaqueBlock, ir::Port, ir::Print,
                         ir::Branch, ir::Store, ir::Assign, ir::ProbePower, ir::Return, ir::Spindle,
                         ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm> auto&) { return true; });
}

// No target prints a report; and a question alone does nothing.
bool isCompared(const ir::CycleStatement& statement) {
  const auto* const call = std::get_if<ir::CallCycle>(&statement.node);
  return !std::holds_alternative<ir::Branch>(statement.node) &&
         (call == nullptr || call->cycle != ir::kReport);
}

} // namespace

std::vector<SourceRange> CycleFileRunner::unreached(const Places& reached) const {
  std::vector<SourceRange> out;
  std::optional<SourceRange> first; // of a part that is not reached
  bool toldApart = false;           // by its alarm
  bool does = false;                // something that shows
  const auto close = [&] {
    const auto same = [&](const SourceRange& one) {
      return one.file == first->file && one.begin == first->begin;
    };
    if (first && does && !toldApart && std::none_of(out.begin(), out.end(), same)) out.push_back(*first);
    first.reset();
    toldApart = does = false;
  };
  for (const ir::CycleStatement& statement : cycle().body) {
    const SourceRange range = statement.origin.range();
    if (!range.hasPlace() || !runs(statement)) continue;
    if (reached.contains({range.file, range.begin})) {
      close();
      continue;
    }
    if (!first) first = range;
    does = does || isCompared(statement);
    toldApart = std::holds_alternative<ir::Alarm>(statement.node);
    if (toldApart) close();
  }
  close();
  return out;
}

} // namespace dotek::targets
