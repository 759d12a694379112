#include "sim/picture/PictureRegion.h"

#include "sim/picture/PicturePlanes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <vector>

namespace dotek::sim {
namespace {

// From here a distance says how far the part reaches, to a few micrometres.
constexpr double kAway = 1e6;

// A part up to this length, mm, or up to so many times the length of what was measured, is shown whole.
constexpr double kWholePart = 300, kWholeShare = 5;

class Bounds {
public:
  void add(const Point3& p) {
    least_ = any_ ? Point3{std::min(least_.x, p.x), std::min(least_.y, p.y), std::min(least_.z, p.z)} : p;
    most_ = any_ ? Point3{std::max(most_.x, p.x), std::max(most_.y, p.y), std::max(most_.z, p.z)} : p;
    any_ = true;
  }
  bool any() const { return any_; }
  Region region() const { return {least_, most_}; }

private:
  bool any_ = false;
  Point3 least_, most_;
};

double longest(const Region& region) {
  const Point3 size = region.most - region.least;
  return std::max({size.x, size.y, size.z});
}

Region grown(const Region& region, double by) {
  const Point3 step{by, by, by};
  return {region.least - step, region.most + step};
}

Region common(const Region& a, const Region& b) {
  return {{std::max(a.least.x, b.least.x), std::max(a.least.y, b.least.y), std::max(a.least.z, b.least.z)},
          {std::min(a.most.x, b.most.x), std::min(a.most.y, b.most.y), std::min(a.most.z, b.most.z)}};
}

Region box(const Region& a, const Region& b) {
  return {{std::min(a.least.x, b.least.x), std::min(a.least.y, b.least.y), std::min(a.least.z, b.least.z)},
          {std::max(a.most.x, b.most.x), std::max(a.most.y, b.most.y), std::max(a.most.z, b.most.z)}};
}

bool isEmpty(const Region& region) {
  return region.least.x > region.most.x || region.least.y > region.most.y || region.least.z > region.most.z;
}

// No side much shorter than the longest one: a view has room for its labels.
Region squat(Region region) {
  const double least = std::max(8.0, 0.16 * longest(region));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = coordinate(region.least, axis), high = coordinate(region.most, axis);
    if (high - low >= least) continue;
    setCoordinate(region.least, axis, (low + high - least) / 2);
    setCoordinate(region.most, axis, (low + high + least) / 2);
  }
  return region;
}

// The run has something to do with the tool setter.
bool isTouched(const Picture& picture) {
  if (!picture.setter || !isDrawn(picture.setter->at)) return false;
  const auto isNear = [&](const Point3& p) {
    return (p - picture.setter->at).length() <= picture.setter->diameter;
  };
  return std::any_of(picture.contacts.begin(), picture.contacts.end(),
                     [&](const PictureContact& contact) { return isNear(contact.point); }) ||
         std::any_of(picture.errors.begin(), picture.errors.end(),
                     [&](const PictureError& error) { return isNear(error.at); });
}

// What the picture is about.
Region focusOf(const Picture& picture) {
  Bounds bounds;
  for (const PictureMove& move : picture.moves) {
    if (move.kind == PathKind::Rapid || !isDrawn(move)) continue;
    bounds.add(move.from);
    bounds.add(move.to);
  }
  for (const PictureContact& contact : picture.contacts) {
    if (isDrawn(contact.point)) bounds.add(contact.point);
  }
  for (const PictureError& error : picture.errors) {
    if (isDrawn(error.at)) bounds.add(error.at);
  }
  if (const std::optional<std::size_t> failure = failureOf(picture))
    if (const auto touch = touchAt(picture, picture.errors[*failure])) bounds.add(touch->point);
  if (isTouched(picture)) {
    const double r = picture.setter->diameter / 2;
    bounds.add(picture.setter->at - Point3{r, r, r});
    bounds.add(picture.setter->at + Point3{r, r, 0});
  }
  if (bounds.any()) return bounds.region();
  for (const PictureMove& move : picture.moves) {
    if (!isDrawn(move)) continue;
    bounds.add(move.from);
    bounds.add(move.to);
  }
  if (bounds.any()) return bounds.region();
  if (picture.part) {
    const Region reach =
        common(reachOf(*picture.part), {{-kDrawn, -kDrawn, -kDrawn}, {kDrawn, kDrawn, kDrawn}});
    if (!isEmpty(reach) && longest(reach) < kDrawn / 10) return reach;
  }
  return {{-10, -10, -10}, {10, 10, 10}};
}

} // namespace

bool Region::contains(const Point3& p) const {
  return p.x >= least.x && p.x <= most.x && p.y >= least.y && p.y <= most.y && p.z >= least.z &&
         p.z <= most.z;
}

double coordinate(const Point3& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

void setCoordinate(Point3& p, std::size_t axis, double value) {
  (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = value;
}

bool isDrawn(const Point3& p) {
  return std::abs(p.x) <= kDrawn && std::abs(p.y) <= kDrawn && std::abs(p.z) <= kDrawn; // false for no number
}

bool isDrawn(const PictureMove& move) {
  return isDrawn(move.from) && isDrawn(move.to);
}

bool hasProbe(const Picture& picture) {
  return picture.probeStated || picture.probe.length > 0 || !picture.probe.lengthToTip;
}

Region reachOf(const Part& part) {
  Region out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Point3 p = part.toMachine({});
    const double middle = coordinate(p, axis);
    setCoordinate(p, axis, middle + kAway);
    setCoordinate(out.most, axis, middle + kAway - part.distance(p));
    setCoordinate(p, axis, middle - kAway);
    setCoordinate(out.least, axis, middle - kAway + part.distance(p));
  }
  return out;
}

Region regionOf(const Picture& picture) {
  const Region focus = focusOf(picture);
  const Region near = grown(focus, std::max(25.0, 0.75 * longest(focus)));
  Bounds bounds;
  bounds.add(focus.least);
  bounds.add(focus.most);
  for (const PictureMove& move : picture.moves) {
    if (!isDrawn(move)) continue;
    for (const Point3& p : {move.from, move.to}) {
      if (near.contains(p)) bounds.add(p);
    }
  }
  if (picture.part) {
    Region seen = reachOf(*picture.part);
    const Region both = box(seen, focus);
    const bool apart = isEmpty(common(seen, near));
    if (apart && longest(both) < kDrawn / 10) {
      // What went wrong far from the part is seen beside it.
    } else if (longest(both) > std::max(kWholePart, kWholeShare * longest(focus))) {
      // A side that ends near by is shown whole; of one that does not, a piece is enough. It holds the part
      // also where that lies deeper than such a piece.
      const Region piece = grown(focus, std::max(15.0, 0.3 * longest(focus)));
      const double depth = std::max(10.0, 0.1 * longest(focus));
      const Region whole = seen;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double least = coordinate(whole.least, axis), most = coordinate(whole.most, axis);
        if (least < coordinate(near.least, axis))
          setCoordinate(seen.least, axis,
                        std::max(least, std::min(coordinate(piece.least, axis), most - depth)));
        if (most > coordinate(near.most, axis))
          setCoordinate(seen.most, axis,
                        std::min(most, std::max(coordinate(piece.most, axis), least + depth)));
      }
    }
    if (!isEmpty(seen)) {
      bounds.add(seen.least);
      bounds.add(seen.most);
    }
  }
  const Region region = bounds.region();
  return squat(grown(region, std::max(1.0, 0.05 * longest(region))));
}

std::vector<std::string> cutSidesOf(const Picture& picture, const Region& region) {
  std::vector<std::string> out;
  if (!picture.part) return out;
  const Region reach = reachOf(*picture.part);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, "XYZ"[axis]);
    if (coordinate(reach.least, axis) < coordinate(region.least, axis)) out.push_back(name + "-");
    if (coordinate(reach.most, axis) > coordinate(region.most, axis)) out.push_back(name + "+");
  }
  return out;
}

std::string cutNote(const Picture& picture, const Region& region) {
  const std::vector<std::string> sides = cutSidesOf(picture, region);
  return sides.empty() ? ""
                       : fmt::format("the part goes on beyond the picture at {}; it is cut open there",
                                     fmt::join(sides, ", "));
}

std::optional<WorkZero> workZeroOf(const Picture& picture) {
  std::vector<std::size_t> moves(picture.frames.size());
  for (const PictureMove& move : picture.moves)
    if (move.frame < moves.size()) moves[move.frame] += move.kind == PathKind::Rapid ? 1 : 1000;
  const auto most = std::max_element(moves.begin(), moves.end());
  if (most == moves.end() || *most == 0) return std::nullopt;
  const auto place = static_cast<std::size_t>(most - moves.begin());
  const PictureFrame& frame = picture.frames[place];
  // The shift holds the length of the tool that was in the spindle.
  const auto move =
      static_cast<std::size_t>(std::find_if(picture.moves.begin(), picture.moves.end(),
                                            [&](const PictureMove& one) { return one.frame == place; }) -
                               picture.moves.begin());
  const ToolPoint point = toolPointAt(picture, move);
  WorkZero out{frame.name, frame.shift, 0, 0, point.name};
  out.at.z -= point.below;
  if (!isDrawn(out.at)) return std::nullopt;
  constexpr double kSame = 1e-6; // mm
  if (frame.length && std::abs(point.below - *frame.length) > kSame) {
    out.above = point.below - *frame.length;
    out.length = *frame.length;
  }
  return out;
}

} // namespace dotek::sim
