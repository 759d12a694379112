#include "sim/picture/PicturePlanes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dotek::sim {
namespace {

// A face whose normal has less of an axis is cut from the side by a plane across that axis.
constexpr double kAcross = 0.3;

// What the region holds of the box around the part; the region itself where it holds none.
Region partIn(const Part& part, const Region& region) {
  const Region reach = reachOf(part);
  Region out = region;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double least = std::max(coordinate(reach.least, axis), coordinate(region.least, axis));
    const double most = std::min(coordinate(reach.most, axis), coordinate(region.most, axis));
    if (!(least < most)) return region;
    setCoordinate(out.least, axis, least);
    setCoordinate(out.most, axis, most);
  }
  return out;
}

// The deepest place of the material in the region, of a coarse grid; of material that is thinner than that,
// one below the surface nearest to it.
std::optional<Point3> insideOf(const Part& part, const Region& region) {
  constexpr int kSteps = 12;
  std::optional<Point3> best;
  double deepest = std::numeric_limits<double>::infinity();
  const Point3 size = region.most - region.least;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      for (int k = 0; k < kSteps; ++k) {
        const Point3 p = region.least + Point3{size.x * (i + 0.5) / kSteps, size.y * (j + 0.5) / kSteps,
                                               size.z * (k + 0.5) / kSteps};
        const double distance = part.distance(p);
        if (distance >= deepest) continue;
        deepest = distance;
        best = p;
      }
    }
  }
  if (!best || deepest < 0) return best;
  const Part::Nearest near = part.nearest(*best);
  for (double depth = 0.5; depth > 1e-3; depth /= 2)
    if (const Point3 p = near.point - near.normal * depth; part.distance(p) < 0 && region.contains(p))
      return p;
  return std::nullopt;
}

// Whether the plane across `axis` cuts material in the region, seen on a coarse grid.
bool cutsMaterial(const Part& part, const Region& region, std::size_t axis, double at) {
  constexpr int kSteps = 24;
  const Point3 size = region.most - region.least;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double u = (i + 0.5) / kSteps, v = (j + 0.5) / kSteps;
      Point3 p = region.least + (axis == 0   ? Point3{0, size.y * u, size.z * v}
                                 : axis == 1 ? Point3{size.x * u, 0, size.z * v}
                                             : Point3{size.x * u, size.y * v, 0});
      setCoordinate(p, axis, at);
      if (part.distance(p) < 0) return true;
    }
  }
  return false;
}

// A place in the material next to a touched point, at most `depth` along the axis.
std::optional<double> behindFace(const Part& part, const Part::Nearest& touched, std::size_t axis,
                                 double depth) {
  const double here = coordinate(touched.point, axis);
  for (int i = 0; i < 8; ++i, depth /= 2) {
    for (const double step : {-depth, depth}) {
      Point3 p = touched.point - touched.normal * (depth / 4); // at an edge the other face is left, too
      setCoordinate(p, axis, here + step);
      if (part.distance(p) < -1e-6) return coordinate(p, axis);
    }
  }
  return std::nullopt;
}

} // namespace

std::optional<std::size_t> lastMissOf(const Picture& picture) {
  const auto last = std::find_if(picture.moves.rbegin(), picture.moves.rend(),
                                 [](const PictureMove& move) { return move.kind == PathKind::Measuring; });
  if (last == picture.moves.rend()) return std::nullopt;
  const auto move = static_cast<std::size_t>(last.base() - picture.moves.begin()) - 1;
  for (std::size_t i = picture.errors.size(); i-- > 0;)
    if (isMiss(picture.errors[i]) && picture.errors[i].move == move) return i;
  return std::nullopt;
}

std::optional<std::size_t> failureOf(const Picture& picture) {
  const auto has = [&](std::size_t place) {
    return place < picture.errors.size() && isDrawn(picture.errors[place].at);
  };
  if (picture.result && picture.result->error && has(*picture.result->error)) return picture.result->error;
  if (const std::optional<std::size_t> miss = lastMissOf(picture); miss && has(*miss)) return miss;
  if (!picture.result || picture.result->verdict != Verdict::Fail) return std::nullopt;
  for (std::size_t i = picture.errors.size(); i-- > 0;)
    if (isMiss(picture.errors[i]) && has(i)) return i;
  return std::nullopt;
}

std::optional<Part::Nearest> touchAt(const Picture& picture, const PictureError& error) {
  const bool probe = error.move >= picture.moves.size() || picture.moves[error.move].tool == 0;
  if (!picture.part || !hasProbe(picture) || !probe || !isDrawn(error.at)) return std::nullopt;
  constexpr double kNear = 0.05; // mm; a signal comes after the touch, a collision is found before it
  const Probe& p = picture.probe;
  if (picture.part->distance(error.at) - p.ballRadius() < kNear) return picture.part->nearest(error.at);
  double nearest = kNear, least = 0, most = 0; // the heights above the ball that are as near
  const auto look = [&](double height, double radius) {
    constexpr double kSame = 0.001; // mm: along a wall it is the middle
    const double gap = picture.part->distance(error.at + Point3{0, 0, height}) - radius;
    if (!(gap < nearest + kSame)) return;
    if (gap < nearest - kSame || nearest == kNear) {
      nearest = gap;
      least = height;
    }
    most = height;
  };
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps && p.stemDiameter > 0; ++i)
    look(p.stemLength * i / kSteps, p.stemDiameter / 2);
  // The round end of the body lies within it.
  const double radius = p.bodyDiameter / 2;
  for (int i = 0; i <= kSteps && p.stemDiameter > 0 && radius > 0; ++i)
    look(p.stemLength + radius + std::max(0.0, p.bodyLength - radius) * i / kSteps, radius);
  if (nearest == kNear) return std::nullopt;
  return picture.part->nearest(error.at + Point3{0, 0, (least + most) / 2});
}

SectionPlanes sectionPlanesOf(const Picture& picture, const Region& region) {
  SectionPlanes out;
  const Point3 middle = (region.least + region.most) * 0.5;
  for (std::size_t axis = 0; axis < 3; ++axis)
    out.at[axis] = coordinate(middle, axis);
  if (!picture.part) return out;

  const Part& part = *picture.part;
  const Region seen = partIn(part, region); // a thin part is a small share of a picture that is wide
  const Point3 size = region.most - region.least;
  const double depth = std::max(0.5, 0.01 * std::max({size.x, size.y, size.z})); // after a face
  std::optional<Point3> inside;
  const std::optional<std::size_t> failure = failureOf(picture);
  const PictureError* const failed =
      failure && region.contains(picture.errors[*failure].at) ? &picture.errors[*failure] : nullptr;
  const std::optional<Part::Nearest> touch = failed != nullptr ? touchAt(picture, *failed) : std::nullopt;
  // Through the failure, or just inside the face that is there.
  const auto showFailure = [&](std::size_t axis) {
    if (failed == nullptr) return false;
    const double here = coordinate(failed->at, axis);
    const bool isFace = touch && std::abs(coordinate(touch->normal, axis)) >= kAcross;
    const bool cuts = part.distance(failed->at) < 0 ? true
                      : touch                       ? !isFace
                                                    : cutsMaterial(part, seen, axis, here);
    if (cuts) {
      const bool aside = touch && part.distance(failed->at) >= 0;
      out.at[axis] = aside ? coordinate(touch->point, axis) : here;
      out.error[axis] = failure;
      return true;
    }
    const Part::Nearest face = touch ? *touch : part.nearest(failed->at);
    const std::optional<double> behind = behindFace(part, face, axis, depth);
    if (!behind) return false;
    out.at[axis] = *behind;
    out.beside[axis] = failure;
    return true;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (showFailure(axis)) continue;
    struct Candidate {
      double at;
      std::size_t contact;
    };
    std::vector<Candidate> sideways;
    std::optional<double> behind[2]; // after faces that look against the axis, along it
    for (std::size_t i = 0; i < picture.contacts.size() && i < 1000; ++i) {
      const Point3& p = picture.contacts[i].point;
      if (!region.contains(p)) continue;
      if (std::abs(coordinate(part.nearest(p).normal, axis)) < kAcross) {
        sideways.push_back({coordinate(p, axis), i});
        continue;
      }
      const std::optional<double> side = behindFace(part, part.nearest(p), axis, depth);
      if (!side) continue;
      std::optional<double>& first = behind[*side < coordinate(p, axis) ? 1 : 0];
      if (!first) first = side;
    }
    if (!sideways.empty()) {
      // The coordinate that most contacts share; of equals the first.
      std::size_t best = 0, most = 0;
      for (std::size_t i = 0; i < sideways.size(); ++i) {
        const auto same =
            static_cast<std::size_t>(std::count_if(sideways.begin(), sideways.end(), [&](const Candidate& c) {
              return std::abs(c.at - sideways[i].at) < 1e-3;
            }));
        if (same > most) {
          most = same;
          best = i;
        }
      }
      out.at[axis] = sideways[best].at;
      out.contact[axis] = sideways[best].contact;
      continue;
    }
    if (behind[0] || behind[1]) { // touched from both sides: between them
      out.at[axis] = behind[0] && behind[1] ? (*behind[0] + *behind[1]) / 2
                     : behind[0]            ? *behind[0]
                                            : *behind[1];
      continue;
    }
    std::optional<double> least, most;
    for (const PictureMove& move : picture.moves) {
      if (!isDrawn(move) || move.kind == PathKind::Rapid) continue;
      const double end = coordinate(move.to, axis);
      least = std::min(least.value_or(end), end);
      most = std::max(most.value_or(end), end);
    }
    if (least) out.at[axis] = (*least + *most) / 2;
    if (cutsMaterial(part, seen, axis, out.at[axis])) continue;
    const double half = (coordinate(seen.least, axis) + coordinate(seen.most, axis)) / 2;
    if (cutsMaterial(part, seen, axis, half)) {
      out.at[axis] = half;
      continue;
    }
    if (!inside) inside = insideOf(part, seen);
    if (inside) out.at[axis] = coordinate(*inside, axis);
  }
  return out;
}

} // namespace dotek::sim
