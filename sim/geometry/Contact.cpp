#include "sim/geometry/Contact.h"

#include "sim/geometry/Solid.h"

#include <algorithm>
#include <cmath>

namespace dotek::sim {
namespace {

constexpr double kFloor = 5e-4;  // mm: the least step of a ball
constexpr double kFarAway = 0.2; // mm
constexpr double kTouch = 1e-10; // mm: closer is touching
constexpr double kExact = 1e-10; // mm: of the place of contact on the path
constexpr double kSafe = kCollisionMargin;
constexpr int kMostCells = 100'000;

Vec vec(const Point3& p) {
  return {p.x, p.y, p.z};
}

class Ball {
public:
  Ball(const Solid& solid, double radius, const Vec& from, const Vec& to)
      : solid_(solid), radius_(radius), from_(from), length_((to - from).norm()) {
    if (length_ > 0) direction_ = (to - from) / length_;
    floor_ = std::max(kFloor, length_ * 1e-6);
  }

  // Way to the contact; negative: there is none.
  double run(bool& atStart) {
    double clear = clearance(0);
    double at = 0;
    atStart = false;
    if (clear <= kTouch) {
      atStart = true;
      if (!leave(at, clear)) return at;
      atStart = false;
      if (clear <= kTouch) return -1; // the path ends before it is free
    }
    while (at < length_) {
      const double jump = clear < 0.05 || at == 0 ? freeWay(at) : 0;
      const double next = std::min(length_, at + std::max({clear, floor_, jump}));
      const double there = clearance(next);
      if (there <= kTouch) return refine(at, clear, next, there);
      at = next;
      clear = there;
    }
    return -1;
  }

private:
  // Far away the cheap bound will do.
  double clearance(double at) const {
    const Vec p = from_ + at * direction_;
    if (const double bound = solid_.bound(p) - radius_; bound > kFarAway) return bound;
    return solid_.foot(p).distance - radius_;
  }

  // Out of the material. false: it goes deeper or stays.
  bool leave(double& at, double& clear) const {
    if (!(length_ > 0)) return false;
    double most = clear;
    bool moved = false;
    while (clear <= kTouch && at < length_) {
      const double next = std::min(length_, at + std::max(std::abs(clear), floor_));
      const double there = clearance(next);
      const double rise = there - (moved ? most : clear);
      if (rise <= 1e-9 * (next - at)) return false;
      moved = true;
      most = std::max(most, there);
      at = next;
      clear = there;
    }
    return true;
  }

  // How far the cheap bound says that nothing is met: along a face or an edge that is far.
  double freeWay(double at) const {
    double free = 0;
    for (double ahead = 8 * floor_; free < length_ - at; ahead *= 4) {
      const double end = std::min(ahead, length_ - at);
      const Vec half = (end - free) / 2 * direction_;
      const Patch patch{from_ + (at + free) * direction_ + half, half, Vec::Zero()};
      if (!(solid_.lowest(patch) > radius_ + kTouch)) break;
      free = end;
    }
    return free;
  }

  // The first place that touches, between one that is free and one that touches. Where the ball slides along
  // a face many do, so that one which does is not enough.
  double refine(double low, double lowClear, double high, double highClear) const {
    double lowAir = lowClear - kTouch, highAir = highClear - kTouch;
    int last = 0;
    for (int n = 0; n < 100 && high - low > kExact; ++n) {
      // Illinois; every third step halves, which bounds their number.
      double at = n % 3 == 2 ? (low + high) / 2 : (low * highAir - high * lowAir) / (highAir - lowAir);
      if (!(at > low && at < high)) at = (low + high) / 2;
      const double air = clearance(at) - kTouch;
      const double beside = air > 0 ? at + kExact : at - kExact;
      const bool close = std::abs(air) < kExact && beside > low && beside < high;
      const double airBeside = close ? clearance(beside) - kTouch : 0;
      if (air > 0) {
        if (close && airBeside <= 0) return beside;
        low = close ? beside : at;
        lowAir = close ? airBeside : air;
        if (last > 0) highAir /= 2;
        last = 1;
      } else {
        if (close && airBeside > 0) return at;
        high = close ? beside : at;
        highAir = close ? airBeside : air;
        if (last < 0) lowAir /= 2;
        last = -1;
      }
    }
    return high;
  }

  const Solid& solid_;
  double radius_;
  Vec from_;
  double length_;
  Vec direction_ = Vec::Zero();
  double floor_ = kFloor;
};

// The path of a capsule's axis is a parallelogram: shares of the path t and of the axis s. Cells are halved
// until they are free, hit or too small; the earlier half is looked at first.
class Sweep {
public:
  // `any`: where it touches first is not asked.
  Sweep(const Solid& solid, double radius, const Vec& a, const Vec& b, const Vec& way, bool any)
      : solid_(solid), radius_(radius), a_(a), axis_(b - a), way_(way), any_(any) {}

  double run() {
    for (const Mesh& mesh : solid_.meshes)
      advance(mesh);
    if (solid_.shapes.empty()) return best_;
    const double reach = axis_.norm() * way_.norm();
    if (reach > 0 && axis_.cross(way_).norm() < 1e-9 * reach) return alongItself();
    search(0, way_.norm() > 0 ? 1 : 0, 0, axis_.norm() > 0 ? 1 : 0);
    return best_;
  }

  // Along its own axis only its leading end meets anything new.
  double alongItself() {
    const Vec lead = axis_.dot(way_) > 0 ? Vec(a_ + axis_) : a_;
    search(0, 0, 0, 1);
    if (best_ <= 1) return best_;
    bool atStart = false;
    const double way = Ball(solid_, radius_, lead, lead + way_).run(atStart);
    return way < 0 ? best_ : std::min(way / way_.norm(), 1.0);
  }

private:
  // Against a mesh the distance of the whole axis is known, so that steps of that size are free.
  void advance(const Mesh& mesh) {
    if (mesh.distance(a_) < 0) best_ = 0;
    const double length = way_.norm();
    for (double at = 0; best_ > 1 || at < best_ * length;) {
      const Vec a = a_ + (length > 0 ? at / length : 0) * way_;
      const double clear = mesh.segmentDistance(a, a + axis_) - radius_;
      if (clear < kSafe / 2) {
        best_ = std::min(best_, length > 0 ? at / length : 0);
        return;
      }
      if (at >= length) return;
      at = std::min(length, at + clear);
    }
  }

  void search(double t0, double t1, double s0, double s1) {
    if (t0 >= best_ || (best_ <= 1 && (any_ || (best_ - t0) * way_.norm() < kSafe / 10))) return;
    const Vec middle = a_ + (t0 + t1) / 2 * way_ + (s0 + s1) / 2 * axis_;
    const Vec halfWay = (t1 - t0) / 2 * way_, halfAxis = (s1 - s0) / 2 * axis_;
    const double along = halfWay.norm(), across = halfAxis.norm();
    const double bound = solid_.shapesBound(middle);
    if (bound - along - across > radius_) return;
    if (solid_.shapesLowest({middle, halfWay, halfAxis}) > radius_) return;
    const Foot foot = solid_.shapesFoot(middle);
    if (foot.distance - along - across > radius_) return;
    if (foot.distance <= radius_) best_ = std::min(best_, (t0 + t1) / 2);
    // In a crowd the answer is coarser, not slower.
    const double least = ++cells_ > 10 * kMostCells ? 100 * kSafe
                         : cells_ > kMostCells      ? 20 * kSafe
                                                    : kSafe / 2;
    if (along + across < least) {
      best_ = std::min(best_, t0);
      return;
    }
    // Where the surface lies along one side of the cell, halving that side says nothing.
    const double gainWay = std::abs(halfWay.dot(foot.normal)) + 0.05 * along;
    const double gainAxis = std::abs(halfAxis.dot(foot.normal)) + 0.05 * across;
    if (gainWay >= gainAxis) {
      search(t0, (t0 + t1) / 2, s0, s1);
      search((t0 + t1) / 2, t1, s0, s1);
    } else {
      search(t0, t1, s0, (s0 + s1) / 2);
      search(t0, t1, (s0 + s1) / 2, s1);
    }
  }

  const Solid& solid_;
  double radius_;
  Vec a_, axis_, way_;
  bool any_;
  double best_ = 2; // more than 1: nothing is met
  int cells_ = 0;
};

} // namespace

std::optional<Touch> firstContact(const Part& part, double radius, const Point3& from, const Point3& to) {
  const Vec start = vec(part.toPart(from)), end = vec(part.toPart(to));
  const Vec reach = Vec::Constant(radius + kFarAway);
  if (!part.solid().mayLieIn(start.cwiseMin(end) - reach, start.cwiseMax(end) + reach)) return std::nullopt;
  const Patch path{(start + end) / 2, (end - start) / 2, Vec::Zero()};
  if (part.solid().isBeyond(path, radius + kSafe)) return std::nullopt;
  Touch out;
  const double length = (end - start).norm();
  const double way = Ball(part.solid(), radius, start, end).run(out.atStart);
  if (way < 0) return std::nullopt;
  out.share = length > 0 ? std::min(way / length, 1.0) : 0;
  out.centre = from + (to - from) * out.share;
  const Part::Nearest nearest = part.nearest(out.centre);
  out.point = nearest.point;
  out.normal = nearest.normal;
  return out;
}

namespace {

// More than 1: nothing is met.
double sweep(const Part& part, const Capsule& capsule, const Point3& way, bool any) {
  const Vec a = vec(part.toPart(capsule.a)), b = vec(part.toPart(capsule.b));
  const Vec turned = vec(part.turnToPart(way));
  const Vec reach = Vec::Constant(capsule.radius + kFarAway);
  const Vec least = a.cwiseMin(b), most = a.cwiseMax(b);
  if (!part.solid().mayLieIn(least.cwiseMin(least + turned) - reach, most.cwiseMax(most + turned) + reach))
    return 2;
  const Patch path{(a + b + turned) / 2, (b - a) / 2, turned / 2};
  if (part.solid().isBeyond(path, capsule.radius + kSafe)) return 2;
  return Sweep(part.solid(), capsule.radius, a, b, turned, any).run();
}

} // namespace

std::optional<double> firstCollision(const Part& part, const Capsule& capsule, const Point3& way) {
  const double share = sweep(part, capsule, way, false);
  return share > 1 ? std::nullopt : std::optional(share);
}

bool collides(const Part& part, const Capsule& capsule, const Point3& way) {
  return sweep(part, capsule, way, true) <= 1;
}

} // namespace dotek::sim
