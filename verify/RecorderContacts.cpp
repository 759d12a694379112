// Where skip moves make their contact: in the world, in a rehearsal, or where an interference puts it.
#include "verify/Recorder.h"

#include <algorithm>
#include <cmath>

namespace dotek::verify {

namespace {

constexpr double kSameSignal = 1e-6; // mm: two signals of one place
constexpr double kSameDirection = 0.999;

} // namespace

double Recorder::rehearsedContact(const sim::SkipMove& move) {
  const sim::Point3 from = lowest(move.machineFrom), path = lowest(move.machineTo) - from;
  const double length = path.length();
  if (!(length > kTouchSlack)) return 1;
  const sim::Point3 direction = path * (1 / length);
  if (call_.depth > 0) return expectedContact(from, direction, length);
  for (const Touch& known : rehearsed_) {
    const double along = (known.point - from).dot(direction);
    if (known.direction.dot(direction) > kSameDirection && along > kTouchSlack && along <= length)
      return along / length;
  }
  rehearsed_.push_back({from + path * *rehearsal_, direction});
  return *rehearsal_;
}

double Recorder::expectedContact(const sim::Point3& from, const sim::Point3& direction, double length) const {
  const double radius = std::abs(direction.z) < 0.5 ? world_.probe().ballRadius() : 0;
  if (!call_.measures) return 1;
  for (const Touch& expected : record_.measures.back().nominal) {
    const double along = (expected.point - from).dot(direction) - radius;
    if (expected.direction.dot(direction) > kSameDirection && along > kTouchSlack && along <= length)
      return along / length;
  }
  return 1;
}

// The nearest on the line of the travel. The post may print its places with fewer digits than the path has.
std::optional<sim::Point3> Recorder::drawnOnWay(const Measure& measure) const {
  constexpr double kPrinted = 0.01; // mm
  if (!measure.travels || measure.nominal.size() != 1) return std::nullopt;
  const sim::Point3 moved{pathMoved_[0], pathMoved_[1], pathMoved_[2]};
  const Touch& end = measure.nominal.front();
  const double ball = end.direction.z == 0 ? world_.probe().ballRadius() : 0;
  const sim::Point3 from = measure.start + sim::Point3{0, 0, ball};
  const double way = (end.point - from).dot(end.direction);
  std::optional<sim::Point3> out;
  double nearest = way + kPrinted;
  for (const Touch& one : drawn_) {
    const sim::Point3 there = one.point + moved - from;
    const double along = there.dot(end.direction);
    const double beside = (there - end.direction * along).length();
    if (!(one.direction.dot(end.direction) > kSameDirection) || beside > kPrinted || !(along > 0) ||
        along > nearest)
      continue;
    nearest = along;
    out = one.point + moved;
  }
  return out;
}

std::optional<double> Recorder::contact(const sim::SkipMove& move) {
  const SourceRange here = place();
  positions_ = move.positions ||
               (call_.depth == 0 && watching_ != nullptr && watching_->contains({here.file, here.begin}));
  aim_ = lowest(move.machineTo);
  if (rehearsal_) return call_.moves || positions_ ? std::nullopt : std::optional(rehearsedContact(move));
  sim::SkipMove longer = move;
  double length = 0;
  for (std::size_t i = 0; i < 3; ++i)
    length = std::hypot(length, move.machineTo[i] - move.machineFrom[i]);
  std::optional<std::size_t> search;
  if (length > 0 && call_.depth == 0) {
    std::size_t& count = positions_ ? record_.protectedMoves : record_.searches;
    const std::size_t number = count++;
    if (!positions_) search = number;
    const bool disturbed =
        positions_ ? interference_.obstacle == number : isMissed(interference_.missing, number);
    if (disturbed) {
      disturb(1);
      return positions_ ? std::optional(obstacleAt(length)) : std::nullopt;
    }
  }
  std::optional<double> disturbed;
  if (length > 0 && call_.depth > 0 && interferesInCall(length, disturbed)) return disturbed;
  const double nearer = interference_.unlike ? nearerBy(search) : 0;
  for (std::size_t i = 0; i < 3 && length > 0; ++i)
    longer.machineTo[i] += (move.machineTo[i] - move.machineFrom[i]) * ((kTouchSlack + nearer) / length);
  std::optional<double> share = world_.contact(longer);
  if (share && length > 0) {
    constexpr double kLeast = 0.05; // mm
    const double distance = *share * (length + kTouchSlack + nearer);
    share = std::min(1.0, (nearer > 0 ? std::max(std::min(distance, kLeast), distance - nearer) : distance) /
                              length);
  }
  return search && interference_.placed ? placedContact(move, length, *search, share) : share;
}

bool Recorder::isMissed(std::optional<std::size_t> wanted, std::size_t number) const {
  return wanted && (*wanted == number || (interference_.andLater && *wanted < number));
}

// `search`: nothing within a call.
double Recorder::nearerBy(std::optional<std::size_t> search) const {
  const std::optional<std::size_t> number = search ? search : call_.measures ? call_.number : std::nullopt;
  const Interference::Unlike& unlike = *interference_.unlike;
  if (!number || *number < unlike.from) return 0;
  return unlike.by * (unlike.changing ? static_cast<double>((*number - unlike.from) % 3) : 1);
}

double Recorder::obstacleAt(double length) const {
  return interference_.beforeEnd > 0 ? std::max(0.0, 1 - interference_.beforeEnd / length) : 0.5;
}

// `share`: where the signal comes; nothing: it does not.
bool Recorder::interferesInCall(double length, std::optional<double>& share) {
  if (!call_.moves && !call_.measures) return false;
  if (!call_.number) call_.number = (call_.moves ? record_.protectedMoves : record_.calls)++;
  if (call_.moves ? interference_.obstacle != call_.number || !world_.on()
                  : !isMissed(interference_.missedCall, *call_.number))
    return false;
  if (call_.moves) share = obstacleAt(length);
  return true;
}

std::optional<double> Recorder::placedContact(const sim::SkipMove& move, double length, std::size_t search,
                                              std::optional<double> share) const {
  constexpr double kUp = 0.623; // no contact of a drawn part lies where this turns
  double distance = share.value_or(0) * length;
  if (interference_.placed->search == search)
    distance = interference_.placed->distance;
  else if (!share)
    return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) {
    const double way = move.machineTo[i] - move.machineFrom[i];
    if (std::abs(std::abs(way) - length) > kSameSignal) continue; // it goes along this axis alone
    const double at = move.machineFrom[i] + (way < 0 ? -distance : distance);
    distance = std::abs(std::floor(at / kStep + kUp) * kStep - move.machineFrom[i]);
  }
  return std::min(1.0, distance / length);
}

bool Recorder::isThere(const sim::SkipMove& here) {
  if (rehearsal_) return false;
  const std::size_t number = record_.questions.size();
  record_.questions.push_back({record_.pieces.size(), record_.marks.size()});
  if (interference_.touching == number) {
    disturb(0);
    return true;
  }
  return world_.isThere(here);
}

void Recorder::disturb(std::size_t pieces) {
  if (!record_.disturbed) record_.disturbed = {record_.pieces.size() + pieces, record_.marks.size()};
}
} // namespace dotek::verify
