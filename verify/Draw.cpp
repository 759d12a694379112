#include "verify/Draw.h"

#include "verify/Bounds.h"
#include "verify/Random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace dotek::verify {
namespace {

using ir::Kind;

constexpr double kMost = 999;       // numbers stay below
constexpr double kMostFeed = 99999; // so do feeds, whose limits are often wider
constexpr double kWide = 100;       // mm: how far a length goes
constexpr std::uint32_t kFirstSystem = 54, kLastSystem = 59;
constexpr double kMostShift = 0.3; // mm, X and Y
constexpr double kLeastRise = 0.02, kMostRise = 0.4;
constexpr double kMostTurn = 0.3; // degrees

constexpr std::array<double, 10> kPowers{1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};

double unitsOf(int decimals) {
  return kPowers[static_cast<std::size_t>(std::clamp(decimals, 0, 9))];
}
double stepOf(const DrawField& field) {
  return 1 / unitsOf(field.decimals);
}
// The nearest multiple of the last place, as a reader of its digits gets it.
double rounded(double value, int decimals) {
  const double units = unitsOf(decimals);
  const double out = std::round(value * units) / units;
  return out == 0 ? 0 : out; // no -0
}
double thousandths(double value) {
  return rounded(value, 3);
}
double towardsZero(double value) {
  const double out = std::trunc(value * 1000) / 1000;
  return out == 0 ? 0 : out;
}

// The greatest size of a value: feeds go beyond the limits that the checks have for them.
double mostOf(const DrawField& field) {
  double most = std::max(kMost - stepOf(field), std::abs(field.initial.value_or(0)));
  if (field.kind == Kind::Feed)
    for (const double threshold : field.thresholds)
      if (std::abs(threshold) <= kMostFeed) most = std::max(most, std::abs(threshold) + kWide);
  return most;
}

double limited(const DrawField& field, double value) {
  const double most = mostOf(field);
  return rounded(std::clamp(value, -most, most), field.decimals);
}

// Each doubling is as likely as the next; no logarithms, whose last digits differ between platforms.
double spread(double least, double most, Random& random) {
  const int whole = std::ilogb(most / least);
  const int doublings = std::max(1, std::ldexp(least, whole) < most ? whole + 1 : whole);
  const double low = std::ldexp(least, static_cast<int>(random.below(static_cast<std::uint64_t>(doublings))));
  return random.between(low, std::min(2 * low, most));
}

// How likely a field keeps its first value: the more attempts were in vain, the nearer to what the programmer
// tried himself. Every other attempt stays free: the first values need not be legal. Of many fields as many
// change as of few: each that changes may meet a check that rejects it, and all have to pass.
double keeps(std::uint32_t attempt, std::size_t fields) {
  constexpr double kChanged = 24;
  const double most = 1 - kChanged / static_cast<double>(std::max<std::size_t>(fields, 1));
  const double vain = attempt % 2 != 0 ? 0.08
                      : attempt < 8    ? 0.08
                      : attempt < 32   ? 0.2
                      : attempt < 128  ? 0.4
                                       : 0.7;
  return std::max(vain, most);
}

bool isWhole(double value) {
  return value == std::round(value);
}

// After, between or before the constants that checks compare with.
double besideThresholds(const DrawField& field, const std::vector<double>& sorted, Random& random) {
  const double first = field.initial.value_or(sorted.front());
  auto n = static_cast<std::size_t>(std::upper_bound(sorted.begin(), sorted.end(), first) - sorted.begin());
  if (!field.initial || random.chance(0.4)) n = random.below(sorted.size() + 1);
  if (random.chance(0.1)) return sorted[random.below(sorted.size())];
  if (n == 0) return sorted.front() - spread(stepOf(field), kWide, random);
  if (n == sorted.size()) return sorted.back() + spread(stepOf(field), kWide, random);
  const double inside = random.between(sorted[n - 1], sorted[n]);
  // Where all that is known is whole, so are most values that mean something.
  return isWhole(first) && isWhole(sorted[n - 1]) && random.chance(0.8) ? std::round(inside) : inside;
}

// Constants that tell more than the sign does.
std::vector<double> usableThresholds(const DrawField& field) {
  std::vector<double> out;
  const double most = field.kind == Kind::Feed ? kMostFeed : kMost;
  for (const double threshold : field.thresholds)
    if (std::abs(threshold) < most && threshold != 0) out.push_back(threshold);
  std::sort(out.begin(), out.end());
  return out;
}

double feedValue(const DrawField& field, bool near, Random& random) {
  const double first = std::abs(field.initial.value_or(0));
  return near && first > 0 ? first * spread(0.25, 4, random) : spread(10, kMost, random);
}

double lengthValue(const DrawField& field, bool near, Random& random) {
  const double first = field.initial.value_or(0), step = stepOf(field);
  bool negative = random.chance(near ? 0.1 : 0.3) != (first < 0);
  double size = 0;
  if (near && first != 0) {
    size = std::abs(first) * spread(0.25, 4, random);
  } else {
    const double most = std::max(kWide, 2 * std::abs(first)), least = std::min(1.0, std::max(step, 0.001));
    const double choice = random.share();
    size = choice < 0.2   ? spread(least, most, random)
           : choice < 0.5 ? random.between(0, most)
                          : spread(1, most, random);
  }
  return negative ? -size : size;
}

double smallNumber(const DrawField& field, std::int64_t least, Random& random) {
  const auto first = static_cast<std::int64_t>(std::clamp(field.initial.value_or(1), -kMost, kMost));
  std::int64_t middle = first;
  if (!field.thresholds.empty() && random.chance(0.5)) {
    const double threshold = field.thresholds[random.below(field.thresholds.size())];
    middle = static_cast<std::int64_t>(std::clamp(threshold, -kMost, kMost));
  }
  return static_cast<double>(std::max(least, middle + random.whole(-2, 2)));
}

double angleValue(const DrawField& field, bool near, Random& random) {
  const double first = field.initial.value_or(0);
  const bool negative = random.chance(near ? 0.1 : 0.3) != (first < 0);
  const double size = random.chance(0.3)   ? static_cast<double>(15 * random.whole(0, 12))
                      : near && first != 0 ? std::min(180.0, std::abs(first) * spread(0.25, 4, random))
                                           : random.between(0, 180);
  return negative ? -size : size;
}

double hostValue(const std::string& name, Random& random) {
  if (name == "tool_radius")
    return thousandths(random.chance(0.8) ? random.between(1, 3) : random.between(0.5, 4));
  if (name == "start_x" || name == "start_y") return thousandths(random.between(-kWide, kWide));
  if (name == "start_z") return thousandths(random.between(100, 160));
  if (name == "clearance" || name == "retract") return thousandths(random.between(1, 60));
  if (name == "overtravel") return thousandths(random.between(2, 10));
  if (name == "return_feed" || name == "approach_feed" || name == "measuring_feed")
    return static_cast<double>(10 * random.whole(10, 90));
  if (name == "tool_number" || name == "tool_offset") return static_cast<double>(random.whole(1, 20));
  return thousandths(random.between(1, 60));
}

// Where the path crosses at `highest` from touches to others, the faces of partOf() end below; else far down.
double facesBelow(const DrawnPath& path, double highest) {
  constexpr double kFar = -1e9, kGap = 0.5; // mm
  if (path.touches.empty()) return kFar;
  bool crosses = false;
  for (std::size_t n = path.touches.front().move + 1; n <= path.touches.back().move; ++n) {
    const sim::Point3 &from = path.points[n - 1], &to = path.points[n];
    crosses |=
        from.z >= highest - 1e-9 && to.z >= highest - 1e-9 && std::hypot(to.x - from.x, to.y - from.y) > 1e-9;
  }
  if (!crosses) return kFar;
  double out = kFar;
  for (const DrawnTouch& each : path.touches)
    if (each.touch.direction.z == 0) out = std::max(out, each.touch.point.z + kFaceHalf + kGap);
  return out;
}

} // namespace

Draws::Draws(std::vector<DrawField> fields, std::vector<std::string> hosts,
             std::map<std::string, double> fixedHosts, std::uint64_t seed,
             std::shared_ptr<const Bounds> bounds, std::uint64_t edges)
    : fields_(std::move(fields)), hosts_(std::move(hosts)), fixedHosts_(std::move(fixedHosts)), seed_(seed),
      bounds_(std::move(bounds)) {
  for (std::size_t n = 0; n < fields_.size(); ++n) {
    fieldNames_.push_back({n, Random::hash(fields_[n].name)});
    thresholds_.push_back(usableThresholds(fields_[n]));
  }
  std::sort(fieldNames_.begin(), fieldNames_.end(),
            [&](const Name& a, const Name& b) { return fields_[a.index].name < fields_[b.index].name; });
  std::erase_if(hosts_, [&](const std::string& name) { return fixedHosts_.contains(name); });
  std::sort(hosts_.begin(), hosts_.end());
  hosts_.erase(std::unique(hosts_.begin(), hosts_.end()), hosts_.end());
  for (std::size_t n = 0; n < hosts_.size(); ++n)
    hostNames_.push_back({n, Random::hash(hosts_[n])});

  edges_ = boundEdges(edges);
  // One of each field after the other, so that few cases see many fields.
  std::vector<std::vector<Edge>> each;
  std::size_t most = 0;
  for (std::size_t n = 0; n < fields_.size(); ++n) {
    each.push_back(edgesOf(n, edges));
    most = std::max(most, each.back().size());
  }
  for (std::size_t row = 0; row < most && edges_.size() < edges; ++row) {
    for (const std::vector<Edge>& list : each)
      if (row < list.size()) edges_.push_back(list[row]);
  }
}

bool Draws::isDrawn(const char* host) const {
  return std::binary_search(hosts_.begin(), hosts_.end(), host);
}

double Draws::value(std::size_t index, bool near, std::uint32_t attempt, Random& random) const {
  const DrawField& field = fields_[index];
  if (field.fixed) return *field.fixed;
  if (!field.extended.empty() && (field.extendedAlone || random.chance(0.25)))
    return field.extended[random.below(field.extended.size())];
  if (field.kind == Kind::WorkOffset)
    return field.firstSystem + static_cast<double>(random.whole(0, kLastSystem - kFirstSystem));
  if (!field.choices.empty()) return field.choices[random.below(field.choices.size())];
  // Under 0 no tool has its length.
  const bool usable = field.kind != Kind::ToolOffset || field.initial.value_or(0) >= 1;
  if (field.initial && random.chance(keeps(attempt, fields_.size())) && usable)
    return rounded(std::min(*field.initial, field.most), field.decimals);
  if (field.usual && random.chance(0.8)) {
    constexpr double kBeside = 0.5;
    const double beside = random.chance(0.5) ? 0 : random.between(-kBeside, kBeside);
    return limited(field, *field.usual + beside);
  }
  switch (field.kind) {
  case Kind::Flag: return static_cast<double>(random.whole(0, 1));
  case Kind::Count: return smallNumber(field, 0, random);
  case Kind::ToolOffset: return std::min(smallNumber(field, 1, random), field.most);
  case Kind::Text: return rounded(field.initial.value_or(0), field.decimals);
  case Kind::WorkOffset:
  case Kind::Angle:
  case Kind::Feed:
  case Kind::Number:
  case Kind::Length:
  case Kind::Ratio: break;
  }
  const std::vector<double>& thresholds = thresholds_[index];
  const double drawn = !thresholds.empty() && random.chance(0.6) ? besideThresholds(field, thresholds, random)
                       : field.kind == Kind::Angle               ? angleValue(field, near, random)
                       : field.kind == Kind::Feed                ? feedValue(field, near, random)
                                                                 : lengthValue(field, near, random);
  const double out = limited(field, drawn);
  return field.kind == Kind::Feed ? std::max(out, stepOf(field)) : out;
}

void Draws::drawSystem(Case& drawn, Random& random) const {
  const auto first = static_cast<std::uint32_t>(random.below(6));
  for (std::uint32_t n = 0; n < 6; ++n) {
    drawn.system = kFirstSystem + (first + n) % 6;
    const bool taken = std::any_of(fields_.begin(), fields_.end(), [&](const DrawField& field) {
      return field.kind == Kind::WorkOffset && field.systemOf(drawn.values.at(field.name)) == drawn.system;
    });
    if (!taken) return;
  }
}

Case Draws::propose(std::uint64_t index, std::uint32_t attempt) const {
  const std::uint64_t base = Random::sub(Random::sub(seed_, index), attempt);
  Case out;
  out.hosts = fixedHosts_;
  Random random(base);
  // Half of the cases stay near the first values, the others go anywhere.
  const bool near = random.chance(0.5);
  for (const Name& name : fieldNames_) {
    const DrawField& field = fields_[name.index];
    Random own(base ^ name.hash);
    out.values.emplace_hint(out.values.end(), field.name, value(name.index, near, attempt, own));
  }
  for (const Name& name : hostNames_) {
    const std::string& host = hosts_[name.index];
    Random own(base ^ name.hash);
    out.hosts.emplace_hint(fixedHosts_.empty() ? out.hosts.end() : out.hosts.lower_bound(host), host,
                           hostValue(host, own));
  }
  drawSystem(out, random);

  const auto radius = out.hosts.find("tool_radius");
  const double most = std::min(kMostShift, (radius == out.hosts.end() ? 0.5 : radius->second) / 3);
  if (!random.chance(0.1)) {
    out.error.shift.x = towardsZero(random.between(-most, most));
    out.error.shift.y = towardsZero(random.between(-most, most));
    out.error.turn = thousandths(random.between(-kMostTurn, kMostTurn));
  }
  out.error.shift.z = thousandths(random.between(kLeastRise, kMostRise));
  out.stream = random.next();
  return out;
}

void Draws::settleHosts(Case& drawn, const DrawnPath& path) const {
  Random random(drawn.stream);
  const double down = random.share(), up = random.share();
  if (path.points.size() > 1) {
    // What moves before the first height keeps that of the entry, to which the path has to come back.
    std::size_t first = 1;
    while (first + 1 < path.points.size() && path.points[first].z == path.points[0].z)
      ++first;
    const bool beside = first > 1;
    double highest = path.points[first].z, second = -1e9;
    for (std::size_t n = first; n < path.points.size(); ++n)
      highest = std::max(highest, path.points[n].z);
    for (std::size_t n = first; n < path.points.size(); ++n)
      if (path.points[n].z < highest - 1e-9) second = std::max(second, path.points[n].z);
    if (second == -1e9) second = highest;
    if (isDrawn("clearance")) {
      const double least = std::min(highest, std::max(second, facesBelow(path, highest)));
      const double at = thousandths(least + (highest - least) * down);
      drawn.hosts["clearance"] = at >= least && at <= highest ? at : highest;
    }
    if (isDrawn("start_z")) {
      const auto clearance = drawn.hosts.find("clearance");
      const double least = clearance == drawn.hosts.end() ? highest : std::max(highest, clearance->second);
      const double above = beside ? 0 : 60 * up;
      drawn.hosts["start_z"] = std::ceil((least + above) * 1000 - 1e-6) / 1000;
    }
  }

  // Never beyond a third of the ball, nor of the path that a touch has.
  double least = 1e9, leastDown = 1e9, radius = 1e9, arm = 0;
  sim::Point3 middle;
  for (const DrawnTouch& each : path.touches)
    middle = middle + each.touch.point * (1 / static_cast<double>(path.touches.size()));
  for (const DrawnTouch& each : path.touches) {
    const sim::Point3 &end = path.points[each.move], way = end - path.points[each.move - 1];
    const double length = std::sqrt(way.dot(way));
    if (each.touch.direction.z != 0) {
      leastDown = std::min(leastDown, length);
      continue;
    }
    radius = each.touch.point.z - end.z;
    least = std::min(least, length);
    arm = std::max(arm, std::hypot(each.touch.point.x - middle.x, each.touch.point.y - middle.y));
  }
  const double most = std::min({kMostShift, radius / 3, least / 3});
  sim::Point3& shift = drawn.error.shift;
  shift.x = towardsZero(std::clamp(shift.x, -most, most));
  shift.y = towardsZero(std::clamp(shift.y, -most, most));
  if (leastDown < 1e9)
    shift.z = towardsZero(std::clamp(shift.z, std::min(kLeastRise, leastDown / 2), leastDown / 2));
  else if (random.chance(0.5))
    shift.z = -shift.z;
  if (least == 1e9) {
    drawn.error.turn = 0;
  } else {
    const double limit = std::min(radius, least) / 3 / std::max(arm, 1e-3) * 180 / 3.14159265358979;
    drawn.error.turn = towardsZero(std::clamp(drawn.error.turn, -limit, limit));
  }
}

// ---- edges

std::vector<Draws::Edge> Draws::edgesOf(std::size_t index, std::uint64_t most) const {
  using Means = Edge::Means;
  const DrawField& field = fields_[index];
  std::vector<Edge> out;
  if (field.fixed) return out;
  const double step = stepOf(field), largest = 1000 - step;
  std::set<double> known;
  const auto add = [&](double value) {
    value = rounded(value, field.decimals);
    if (known.insert(value).second) out.push_back({index, Means::Value, value, 0});
  };
  if (field.kind == Kind::WorkOffset) {
    const double first = field.firstSystem, last = first + kLastSystem - kFirstSystem;
    out.push_back({index, Means::System, first, 0});
    add(first - 1);
    add(last + 1);
    if (field.decimals > 0) add(first + 0.5);
    add(0);
    out.push_back({index, Means::System, last, 0});
    add(-first);
    add(first - step);
    add(last + step);
    add(largest);
    return out;
  }
  const bool isSize = field.kind == Kind::Length || field.kind == Kind::Number;
  if (isSize) out.push_back({index, Means::Radius, 1, 0});
  add(0);
  if (isSize) out.push_back({index, Means::Radius, -1, 0});
  for (const double threshold : field.thresholds) {
    if (out.size() >= most) return out;
    if (std::abs(threshold) > std::max(largest, mostOf(field))) continue;
    add(threshold);
    add(threshold - step);
    add(threshold + step);
  }
  if (isSize) {
    out.push_back({index, Means::Radius, 1, -1});
    out.push_back({index, Means::Radius, 1, 1});
    out.push_back({index, Means::Radius, 2, 0});
    out.push_back({index, Means::Radius, -1, 1});
    out.push_back({index, Means::Radius, 2, 1});
  }
  add(largest);
  add(-largest);
  add(step);
  add(-step);
  if (field.initial) add(-*field.initial);
  if (field.kind == Kind::Angle) {
    add(90);
    add(180);
    add(360);
  }
  add(100 - step); // one digit fewer
  add(1 - step);
  return out;
}

// Each comparison that some proposals meet: there, and one step to each side. More than `most` are not
// wanted.
std::vector<Draws::Edge> Draws::boundEdges(std::uint64_t most) const {
  std::vector<Edge> out;
  if (bounds_ == nullptr) return out;
  constexpr std::uint32_t kSamples = 12;
  std::vector<Case> samples;
  for (std::uint32_t n = 0; n < kSamples; ++n)
    samples.push_back(propose(n, 1000));
  const std::vector<Bound> bounds = bounds_->find(fields_, samples, isDrawn("tool_radius"), most);
  for (const int steps : {0, -1, 1})
    for (const Bound& bound : bounds)
      out.push_back({bound.field, Edge::Means::Bound, 0, steps, bound.comparison});
  return out;
}

void Draws::apply(const Edge& edge, Case& drawn) const {
  const DrawField& field = fields_[edge.field];
  double& value = drawn.values[field.name];
  switch (edge.means) {
  case Edge::Means::Value: value = edge.value; return;
  case Edge::Means::System:
    value = edge.value;
    drawn.system = field.systemOf(edge.value);
    return;
  case Edge::Means::Bound:
    if (const auto met = bounds_->meet({edge.comparison, edge.field}, fields_, drawn, isDrawn("tool_radius")))
      drawn = *met;
    if (edge.steps == 0)
      drawn.values[field.name] = rounded(drawn.values[field.name], field.decimals);
    else
      drawn.values[field.name] = bounds_->beside(drawn, field)[edge.steps < 0 ? 0 : 1];
    return;
  case Edge::Means::Radius: {
    const auto radius = drawn.hosts.find("tool_radius");
    const double size = rounded(radius == drawn.hosts.end() ? 1 : radius->second, field.decimals);
    // A radius that the field can say, so that it is met exactly.
    if (isDrawn("tool_radius") && size > 0) radius->second = size;
    value = rounded(size * edge.value + edge.steps * stepOf(field), field.decimals);
    return;
  }
  }
}

Case Draws::edge(std::uint64_t index) const {
  const std::uint64_t stream = Random::sub(seed_ ^ 0x65646765u, index); // apart from the proposals
  Random random(stream);
  // Around the first values or some others; few of them are illegal for another reason.
  Case out = propose(stream, random.chance(0.5) ? 0 : 1000);
  out.edge = true;
  if (edges_.empty()) return out;
  // The second one first: the own one of this case is the one that counts.
  if (index >= edges_.size()) apply(edges_[random.below(edges_.size())], out);
  const Edge& own = edges_[index % edges_.size()];
  if (own.means != Edge::Means::Bound) {
    apply(own, out);
    return out;
  }
  // Around values that no other check rejects, where some are found: there the comparison decides.
  const auto applied = [&](Case base, int steps) {
    Edge edge = own;
    edge.steps = steps;
    apply(edge, base);
    return base;
  };
  constexpr std::uint32_t kAround = 16;
  for (std::uint32_t n = 0; n < kAround; ++n) {
    Case other = n == 0 ? out : propose(Random::sub(stream, n), n % 2 == 0 ? 0 : 1000);
    other.edge = true;
    if (bounds_->rejects(applied(other, -1)) != bounds_->rejects(applied(other, 1)))
      return applied(std::move(other), own.steps);
  }
  apply(own, out);
  return out;
}

} // namespace dotek::verify
