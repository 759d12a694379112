#include "backends/mikroprog/TargetWay.h"

#include "verify/PathPieces.h"

#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace dotek::targets {

namespace {

using sim::PathKind;
using sim::Point3;
using stdlib::ArgumentRole;
using verify::Aspect;
using verify::Difference;
using verify::Piece;
using verify::Touch;

struct Leg {
  PathKind kind = PathKind::Protected;
  Point3 to;
};

class Walls {
public:
  Walls(const verify::Measure& want, const verify::Gathered::Parts& parts, const MikroprogWay& way)
      : want_(want), parts_(parts), way_(way), home_(want.start) {
    const Touch& first = want.nominal.front();
    outside_ = way.middle && (first.point - want.nominal[1].point).dot(first.direction) < 0;
    if (!outside_) return;
    const auto given = want.options.find(ArgumentRole::Clearance);
    const Point3 before = first.point - parts.touches.front().start;
    clearance_ = given == want.options.end() ? before.dot(first.direction) - way.ballRadius : given->second;
  }

  std::optional<Difference> fault() {
    for (std::size_t i = 0; i < parts_.touches.size(); ++i) {
      if (outside_)
        if (auto off = legsFault(i)) return off;
      const Point3 from = startOf(i), at = parts_.touches[i].start;
      if (!verify::near(from, at, way_.tolerance))
        return Difference{
            Aspect::Path,
            fmt::format("the search begins at {} against {}", verify::textOf(from), verify::textOf(at)),
            want_.range, parts_.touches[i].range};
      found_ = foundBeside(i);
      if (!way_.middle && way_.sets) home_ = home_ + found_;
    }
    return outside_ ? legsFault(parts_.touches.size()) : std::nullopt;
  }

private:
  // By how much the surface lay beside its place, along the way to it.
  Point3 foundBeside(std::size_t i) const {
    const Touch& wall = want_.nominal[i];
    const double radius = wall.direction.z == 0 ? way_.ballRadius : 0;
    const Point3 found = parts_.touches[i].end + wall.direction * radius;
    const Point3 meant = want_.drawn && i == 0 ? *want_.drawn : wall.point;
    return wall.direction * (found - meant).dot(wall.direction);
  }

  // Of the ball's lowest point, where search `i` begins; the one before it has found its surface.
  Point3 startOf(std::size_t i) const {
    const Touch& wall = want_.nominal[i];
    if (outside_) {
      Point3 out = wall.point - wall.direction * (way_.ballRadius + clearance_);
      out.z = wall.point.z - way_.ballRadius;
      return i % 2 == 1 && way_.sets ? out + found_ : out;
    }
    if (!way_.middle) return home_;
    Point3 middle = want_.start;
    if (i > 1 && way_.sets) middle.x = wall.point.x; // where the walk has led
    if (i % 2 == 0 || !way_.sets) return middle;
    // Off the wall by half of what is expected between the two.
    const Touch& before = want_.nominal[i - 1];
    const double half = (before.point - middle).dot(before.direction) - way_.ballRadius;
    return parts_.touches[i - 1].end - before.direction * half;
  }

  // Before touch `i` of walls that are touched from outside: off the wall before, up, over and down.
  std::vector<Leg> legs(std::size_t i) const {
    std::vector<Leg> out;
    const auto up = [&](Point3 place) { return Point3{place.x, place.y, want_.start.z}; };
    if (i > 0) {
      const Point3 off = way_.sets ? parts_.touches[i - 1].end - want_.nominal[i - 1].direction * clearance_
                                   : startOf(i - 1);
      out.push_back({PathKind::Feed, off});
      out.push_back({PathKind::Protected, up(off)});
      if (i % 2 == 0 && !way_.sets) out.push_back({PathKind::Protected, want_.start});
    }
    if (i < parts_.touches.size()) {
      out.push_back({PathKind::Protected, up(startOf(i))});
      out.push_back({PathKind::Protected, startOf(i)});
    }
    return out;
  }

  // The walk to a middle that is found by comparing is left out: where it leads is compared.
  std::vector<const Piece*> moves(std::size_t i) const {
    std::vector<const Piece*> out;
    for (const verify::Gathered::Between& one : parts_.moves) {
      if (one.touches != i || verify::near(one.piece.from, one.piece.to, way_.tolerance)) continue;
      if (way_.sets && i > 0 && i % 2 == 0 && out.size() > 1 && one.piece.kind == PathKind::Feed) continue;
      out.push_back(&one.piece);
    }
    return out;
  }

  std::optional<Difference> legsFault(std::size_t i) const {
    const std::vector<Leg> wanted = legs(i);
    const std::vector<const Piece*> found = moves(i);
    const SourceRange search = parts_.touches[std::min(i, parts_.touches.size() - 1)].range;
    for (std::size_t k = 0; k < std::max(wanted.size(), found.size()); ++k) {
      const bool both = k < wanted.size() && k < found.size();
      if (both && wanted[k].kind == found[k]->kind &&
          verify::near(wanted[k].to, found[k]->to, way_.tolerance))
        continue;
      const auto text = [](PathKind kind, const Point3& to) {
        return fmt::format("a {} move to {}", sim::pathKindName(kind), verify::textOf(to));
      };
      const std::string one = k < wanted.size() ? text(wanted[k].kind, wanted[k].to) : "no move",
                        other = k < found.size() ? text(found[k]->kind, found[k]->to) : "none";
      return Difference{Aspect::Path, "beside the walls " + one + " against " + other, want_.range,
                        k < found.size() ? found[k]->range : search};
    }
    return std::nullopt;
  }

  const verify::Measure& want_;
  const verify::Gathered::Parts& parts_;
  const MikroprogWay& way_;
  bool outside_ = false;
  double clearance_ = 0; // beside a wall, from the ball
  Point3 home_;          // where a touch of a single surface begins
  Point3 found_;         // foundBeside() of the last touch
};

} // namespace

std::optional<Difference> wayFault(const verify::Measure& want, const verify::Gathered::Parts& parts,
                                   const MikroprogWay& way) {
  if (parts.touches.empty() || parts.touches.size() != want.nominal.size()) return std::nullopt;
  return Walls(want, parts, way).fault();
}

} // namespace dotek::targets
