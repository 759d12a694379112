#include "sim/picture/Lattice.h"

#include "sim/geometry/Solid.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace dotek::sim {
namespace {

constexpr double kCellsOfShape = 6;  // across the thinnest way through a shape
constexpr double kCellsOfCorner = 3; // across a rounded corner
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec vec(const Point3& p) {
  return {p.x, p.y, p.z};
}

// Along one axis: a stretch in which lines are to be this close.
struct Wish {
  double from, to, step;
};

// Of a shape along an axis of the machine: from where to where it reaches, and how long the way through its
// middle is.
struct Extent {
  double from = -kInfinity, to = kInfinity, chord = kInfinity;
  double corner = 0; // radius of edges that run across the axis
};

Extent extentOf(const Part& part, const Shape& shape, std::size_t axis) {
  Point3 direction;
  setCoordinate(direction, axis, 1);
  const Vec inPart = vec(part.turnToPart(direction)), local = shape.axes.transpose() * inPart;
  const double zero = coordinate(part.toMachine({}), axis);
  Extent out;
  out.from = zero - shape.support(-inPart);
  out.to = zero + shape.support(inPart);
  const auto through = [&](double half, double share) {
    if (std::abs(share) > 1e-9) out.chord = std::min(out.chord, 2 * half / std::abs(share));
  };
  switch (shape.kind) {
  case Shape::Kind::HalfSpace: break;
  case Shape::Kind::Sphere: through(shape.a, 1); break;
  case Shape::Kind::Cone:
    through(std::max(shape.a, shape.b), std::sqrt(local.x() * local.x() + local.y() * local.y()));
    through(shape.c, local.z());
    break;
  case Shape::Kind::Block:
    through(shape.a, local.x());
    through(shape.b, local.y());
    through(shape.c, local.z());
    if (std::max(std::abs(local.x()), std::abs(local.y())) > 0.999) out.corner = shape.d;
    break;
  }
  return out;
}

class LatticeMaker {
public:
  LatticeMaker(const Part& part, const Region& region, double step) : region_(region), step_(step) {
    for (const Shape& shape : part.solid().shapes) {
      std::array<Extent, 3> extents;
      bool isThere = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        extents[axis] = extentOf(part, shape, axis);
        isThere = isThere && extents[axis].from <= coordinate(region.most, axis) &&
                  extents[axis].to >= coordinate(region.least, axis);
      }
      if (isThere) shapes_.push_back(extents);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::array<Extent, 3>& shape : shapes_)
        addWishes(shape[axis], wishes_[axis]);
    }
  }

  // `most`: lines along one axis.
  Lattice make(std::size_t most) const {
    Lattice out;
    for (std::size_t axis = 0; axis < 3; ++axis)
      out.lines[axis] = linesOf(axis, most);
    for (const std::array<Extent, 3>& shape : shapes_)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (shape[axis].chord > out.missed && isMissed(shape[axis], out.lines[axis]))
          out.missed = shape[axis].chord;
    return out;
  }

private:
  void addWishes(const Extent& extent, std::vector<Wish>& wishes) const {
    const auto add = [&](double from, double to, double step) {
      if (step < step_ && step > 0) wishes.push_back({from - step, to + step, step});
    };
    add(extent.from, extent.to, extent.chord / kCellsOfShape);
    if (extent.corner <= 0) return;
    add(extent.from, extent.from + extent.corner, extent.corner / kCellsOfCorner);
    add(extent.to - extent.corner, extent.to, extent.corner / kCellsOfCorner);
  }

  std::vector<double> linesOf(std::size_t axis, std::size_t most) const {
    const double length = coordinate(region_.most, axis) - coordinate(region_.least, axis);
    if (length <= 0) return {coordinate(region_.least, axis)};
    std::vector<double> out = march(axis, 0, most);
    double low = step_ / 1e6, high = step_; // floors
    while (out.size() > most && high / low > 1.02) {
      const double middle = std::sqrt(low * high);
      (march(axis, middle, most).size() > most ? low : high) = middle;
      if (high / low <= 1.02) out = march(axis, high, most);
    }
    return out;
  }

  // With steps of at least `floor`. More than `most` lines: the rest is left out.
  std::vector<double> march(std::size_t axis, double floor, std::size_t most) const {
    const double least = coordinate(region_.least, axis), end = coordinate(region_.most, axis);
    std::vector<double> out{least};
    if (wishes_[axis].empty() || floor >= step_) {
      const double count = std::max(1.0, std::ceil((end - least) / step_ - 1e-9));
      for (double i = 1; i < count; ++i)
        out.push_back(least + i * step_);
      out.push_back(end);
      return out;
    }
    for (double at = least; out.size() <= most;) {
      double step = step_;
      for (const Wish& wish : wishes_[axis])
        if (wish.from <= at && at < wish.to) step = std::min(step, std::max(wish.step, floor));
      double stop = end;
      for (const Wish& wish : wishes_[axis])
        if (wish.from > at && std::max(wish.step, floor) < step) stop = std::min(stop, wish.from);
      at = stop - at < 1.3 * step ? stop : at + step;
      out.push_back(at);
      if (at >= end) break;
    }
    return out;
  }

  // Whether fewer than two lines may go through the shape.
  static bool isMissed(const Extent& extent, const std::vector<double>& lines) {
    if (lines.size() < 2) return false;
    auto at = std::lower_bound(lines.begin(), lines.end(), extent.from);
    if (at == lines.begin()) ++at;
    for (; at != lines.end(); ++at) {
      if (extent.chord < 2 * (*at - *(at - 1))) return true;
      if (*at >= extent.to) break;
    }
    return false;
  }

  Region region_;
  double step_;
  std::vector<std::array<Extent, 3>> shapes_;
  std::array<std::vector<Wish>, 3> wishes_;
};

double longestSide(const Region& region) {
  return std::max(
      {region.most.x - region.least.x, region.most.y - region.least.y, region.most.z - region.least.z});
}

// With so many lines that `cost` stays within the limit, though never with fewer than the plain steps take.
template <class Cost>
Lattice within(const LatticeMaker& maker, std::size_t most, std::size_t least, double limit, Cost cost) {
  Lattice out = maker.make(most);
  while (cost(out) > limit && most > least) {
    most = std::max(least, most * 7 / 8);
    out = maker.make(most);
  }
  return out;
}

} // namespace

double Lattice::finest() const {
  double out = kInfinity;
  for (const std::vector<double>& list : lines)
    for (std::size_t i = 1; i < list.size(); ++i)
      out = std::min(out, list[i] - list[i - 1]);
  return out;
}

Lattice surfaceLattice(const Part& part, const Region& region, std::uint32_t cells) {
  const Solid& solid = part.solid();
  double mostFaces = 150'000; // of cells, where all lines go through the part
  if (solid.shapes.size() > 30 || !solid.meshes.empty()) {
    cells = std::min(cells, 80u);
    mostFaces = 80'000;
  }
  if (solid.shapes.size() > 90) {
    cells = std::min(cells, 48u);
    mostFaces = 30'000;
  }
  cells = std::max(cells, 4u);
  const LatticeMaker maker(part, region, longestSide(region) / cells);
  return within(maker, 600, cells + 2, mostFaces, [](const Lattice& lattice) {
    const auto count = [&](std::size_t axis) { return static_cast<double>(lattice.lines[axis].size()); };
    return 2 * (count(0) * count(1) + count(1) * count(2) + count(2) * count(0));
  });
}

Lattice sectionLattice(const Part& part, std::size_t across, double at, const Region& region) {
  const Solid& solid = part.solid();
  const std::size_t cells = solid.shapes.size() > 60 || !solid.meshes.empty() ? 160 : 256;
  Region plane = region;
  setCoordinate(plane.least, across, at);
  setCoordinate(plane.most, across, at);
  const LatticeMaker maker(part, plane, longestSide(plane) / static_cast<double>(cells));
  return within(maker, 1'500, cells + 2, 500'000, [&](const Lattice& lattice) {
    double nodes = 1;
    for (const std::vector<double>& list : lattice.lines)
      nodes *= static_cast<double>(list.size());
    return nodes;
  });
}

std::string missedNote(double missed) {
  if (missed == 0) return "";
  return fmt::format("the part has shapes of {} mm and less that are too fine for this picture: they may be "
                     "drawn wrong or not at all; the run knows them",
                     numberText(std::ceil(missed * 100) / 100));
}

} // namespace dotek::sim
