#include "sim/picture/Sections.h"

#include "sim/picture/Lattice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace dotek::sim {
namespace {

constexpr double kSkin = 1e-7; // a plane within a face counts as material: rounding decides nothing
constexpr std::uint32_t kNone = 0xffffffff;

double length(const PlanePoint& a, const PlanePoint& b) {
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}

// Marching squares on a lattice that is looked at only where the distances leave the surface a place. Its
// outermost ring of nodes lies on the border and counts as empty, which closes every line.
class Cutter {
public:
  Cutter(const Part& part, std::size_t across, double at, const Region& region)
      : part_(part), across_(across), axes_(planeAxes(across)), at_(at) {
    const double width = coordinate(region.most, axes_[0]) - coordinate(region.least, axes_[0]);
    const double height = coordinate(region.most, axes_[1]) - coordinate(region.least, axes_[1]);
    tolerance_ = std::max(width, height) / 20'000;
    Lattice lattice = sectionLattice(part, across, at, region);
    for (std::size_t i = 0; i < 2; ++i)
      lines_[i] = std::move(lattice.lines[axes_[i]]);
    columns_ = static_cast<std::uint32_t>(lines_[0].size()) + 2;
    rows_ = static_cast<std::uint32_t>(lines_[1].size()) + 2;
    for (std::size_t i = 0; i < 2; ++i) {
      least_[i] = coordinate(region.least, axes_[i]);
      most_[i] = coordinate(region.most, axes_[i]);
    }
    values_.assign(std::size_t{columns_} * rows_, kUnknown);
  }

  Section cut() {
    fill(1, 1, columns_ - 2, rows_ - 2);
    for (std::uint32_t row = 0; row + 1 < rows_; ++row) {
      for (std::uint32_t column = 0; column + 1 < columns_; ++column)
        march(column, row);
    }
    Section out;
    follow(out);
    return out;
  }

private:
  static constexpr float kUnknown = 0, kIn = -1, kOut = 1;

  struct Node {
    std::uint32_t column, row;
  };
  struct Crossing {
    PlanePoint at{};
    std::uint32_t next = kNone;
    bool border = false; // the path to the next one runs along the border of the region
    bool used = false;
  };

  PlanePoint place(Node n) const {
    const auto along = [](std::uint32_t index, const std::vector<double>& lines) {
      return lines[std::min<std::size_t>(index == 0 ? 0 : index - 1, lines.size() - 1)];
    };
    return {along(n.column, lines_[0]), along(n.row, lines_[1])};
  }
  double distance(const PlanePoint& p) const {
    Point3 q;
    setCoordinate(q, across_, at_);
    setCoordinate(q, axes_[0], p[0]);
    setCoordinate(q, axes_[1], p[1]);
    return part_.distance(q) - kSkin;
  }
  bool isRing(Node n) const {
    return n.column == 0 || n.row == 0 || n.column + 1 == columns_ || n.row + 1 == rows_;
  }
  float& value(Node n) { return values_[std::size_t{n.row} * columns_ + n.column]; }
  bool isIn(Node n) { return !isRing(n) && value(n) == kIn; }

  // Nodes from (left, low) to (right, high), both included.
  void fill(std::uint32_t left, std::uint32_t low, std::uint32_t right, std::uint32_t high) {
    if (right - left <= 3 && high - low <= 3) {
      for (std::uint32_t row = low; row <= high; ++row) {
        for (std::uint32_t column = left; column <= right; ++column) {
          float& v = value({column, row});
          if (v == kUnknown) v = distance(place({column, row})) <= 0 ? kIn : kOut;
        }
      }
      return;
    }
    const PlanePoint a = place({left, low}), b = place({right, high});
    const double d = distance({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2});
    if (std::abs(d) > length(a, b) / 2 + 2 * kSkin) {
      for (std::uint32_t row = low; row <= high; ++row) {
        for (std::uint32_t column = left; column <= right; ++column)
          value({column, row}) = d <= 0 ? kIn : kOut;
      }
      return;
    }
    if (right - left >= high - low) {
      const std::uint32_t middle = (left + right) / 2;
      fill(left, low, middle, high);
      fill(middle, low, right, high);
    } else {
      const std::uint32_t middle = (low + high) / 2;
      fill(left, low, right, middle);
      fill(left, middle, right, high);
    }
  }

  // The place between two points on which the sign changes.
  PlanePoint root(PlanePoint in, PlanePoint out) const {
    double a = distance(in), b = distance(out);
    for (int i = 0; i < 60 && length(in, out) > tolerance_ / 50; ++i) {
      double share = a / (a - b);
      if (i % 3 == 2 || !(share > 0.02 && share < 0.98)) share = 0.5;
      const PlanePoint m{in[0] + (out[0] - in[0]) * share, in[1] + (out[1] - in[1]) * share};
      const double d = distance(m);
      if (std::abs(d) < 1e-9) return m;
      (d <= 0 ? in : out) = m;
      (d <= 0 ? a : b) = d;
    }
    return {(in[0] + out[0]) / 2, (in[1] + out[1]) / 2};
  }

  std::uint32_t crossing(Node a, Node b) {
    if (b.column < a.column || b.row < a.row) std::swap(a, b);
    const std::uint64_t key = (std::uint64_t{a.row} * columns_ + a.column) * 2 + (b.row > a.row ? 1 : 0);
    const auto [it, isNew] = numbers_.try_emplace(key, static_cast<std::uint32_t>(crossings_.size()));
    if (isNew) {
      Crossing c;
      c.at = isRing(a)   ? place(b)
             : isRing(b) ? place(a)
             : isIn(a)   ? root(place(a), place(b))
                         : root(place(b), place(a));
      crossings_.push_back(c);
    }
    return it->second;
  }

  void march(std::uint32_t column, std::uint32_t row) {
    const Node corners[4] = {{column, row}, {column + 1, row}, {column + 1, row + 1}, {column, row + 1}};
    int in = 0;
    bool border = false;
    bool is[4];
    for (int i = 0; i < 4; ++i) {
      is[i] = isIn(corners[i]);
      in += is[i] ? 1 : 0;
      border = border || isRing(corners[i]);
    }
    if (in == 0 || in == 4) return;
    const auto connect = [&](int from, int to) { // numbers of edges: i is from corner i to i + 1
      const std::uint32_t a = crossing(corners[from], corners[(from + 1) % 4]);
      const std::uint32_t b = crossing(corners[to], corners[(to + 1) % 4]);
      crossings_[a].next = b;
      crossings_[a].border = border;
    };
    const bool saddle = in == 2 && is[0] == is[2];
    bool joined = false;
    if (saddle) {
      const PlanePoint a = place(corners[0]), b = place(corners[2]);
      joined = distance({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2}) <= 0;
    }
    for (int i = 0; i < 4; ++i) {
      // Counterclockwise around the cell, material ends on edge i: a line begins there with it on its left.
      if (!is[i] || is[(i + 1) % 4]) continue;
      int to = (i + 1) % 4;
      if (saddle && !joined) to = (i + 3) % 4;
      while (is[to] || !is[(to + 1) % 4])
        to = (to + 1) % 4;
      connect(i, to);
    }
  }

  // Points between a and b where the line leaves the chord, without the two.
  void refine(const PlanePoint& a, const PlanePoint& b, int depth, std::vector<PlanePoint>& out) const {
    const double l = length(a, b);
    if (depth == 0 || l < 2 * tolerance_) return;
    const PlanePoint middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    const double d = distance(middle);
    if (std::abs(d) < tolerance_) return;
    // Material is to the left: from within go to the right.
    const double side = d <= 0 ? 1 : -1;
    const PlanePoint normal{(b[1] - a[1]) / l * side, -(b[0] - a[0]) / l * side};
    PlanePoint before = middle;
    double t = std::abs(d);
    while (t < 2 * l) {
      const PlanePoint p{middle[0] + normal[0] * t, middle[1] + normal[1] * t};
      if (p[0] < least_[0] || p[0] > most_[0] || p[1] < least_[1] || p[1] > most_[1]) return;
      if ((distance(p) <= 0) == (d <= 0)) {
        before = p;
        t *= 1.6;
        continue;
      }
      const PlanePoint found = d <= 0 ? root(before, p) : root(p, before);
      refine(a, found, depth - 1, out);
      out.push_back(found);
      refine(found, b, depth - 1, out);
      return;
    }
  }

  // Drops points that the line without them passes within the tolerance (Douglas and Peucker).
  static void thin(const std::vector<PlanePoint>& all, std::size_t first, std::size_t last, double tolerance,
                   std::vector<PlanePoint>& out) {
    std::vector<std::array<std::size_t, 2>> open{{first, last}};
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      const double l = length(all[a], all[b]);
      double worst = tolerance;
      std::size_t at = 0;
      for (std::size_t i = a + 1; i < b; ++i) {
        const double away = l < 1e-12 ? length(all[a], all[i])
                                      : std::abs((all[b][0] - all[a][0]) * (all[i][1] - all[a][1]) -
                                                 (all[b][1] - all[a][1]) * (all[i][0] - all[a][0])) /
                                            l;
        if (away <= worst) continue;
        worst = away;
        at = i;
      }
      if (at == 0) {
        out.push_back(all[a]);
        continue;
      }
      open.push_back({at, b});
      open.push_back({a, at});
    }
  }

  SectionLine open(const std::vector<PlanePoint>& points) const {
    SectionLine out;
    thin(points, 0, points.size() - 1, tolerance_ / 4, out.points);
    out.points.push_back(points.back());
    return out;
  }
  SectionLine closed(std::vector<PlanePoint> points) const {
    std::size_t far = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (length(points[0], points[i]) > length(points[0], points[far])) far = i;
    }
    points.push_back(points[0]);
    SectionLine out;
    out.closed = true;
    thin(points, 0, far, tolerance_ / 4, out.points);
    thin(points, far, points.size() - 1, tolerance_ / 4, out.points);
    // Where the line began is no corner of it by itself.
    if (out.points.size() > 3) {
      std::vector<PlanePoint> kept;
      thin({out.points.back(), out.points[0], out.points[1]}, 0, 2, tolerance_ / 4, kept);
      if (kept.size() == 1) out.points.erase(out.points.begin());
    }
    return out;
  }

  void follow(Section& out) {
    for (std::uint32_t start = 0; start < crossings_.size(); ++start) {
      if (crossings_[start].used) continue;
      std::vector<std::uint32_t> loop;
      for (std::uint32_t i = start; i != kNone && !crossings_[i].used; i = crossings_[i].next) {
        crossings_[i].used = true;
        loop.push_back(i);
      }
      // from after a border on, so that no line is broken in two.
      const auto border =
          std::find_if(loop.begin(), loop.end(), [&](std::uint32_t i) { return crossings_[i].border; });
      const bool hasBorder = border != loop.end();
      if (hasBorder) std::rotate(loop.begin(), border + 1, loop.end());

      std::vector<PlanePoint> all, piece;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Crossing& from = crossings_[loop[i]];
        const Crossing& to = crossings_[loop[(i + 1) % loop.size()]];
        all.push_back(from.at);
        if (from.border) {
          if (piece.size() > 1) out.lines.push_back(open(piece));
          piece.clear();
          continue;
        }
        if (piece.empty()) piece.push_back(from.at);
        std::vector<PlanePoint> between;
        refine(from.at, to.at, 10, between);
        all.insert(all.end(), between.begin(), between.end());
        piece.insert(piece.end(), between.begin(), between.end());
        piece.push_back(to.at);
      }
      SectionLine area = closed(all);
      if (area.points.size() < 3) continue;
      if (!hasBorder) out.lines.push_back(area);
      out.areas.push_back(std::move(area));
    }
  }

  const Part& part_;
  std::size_t across_;
  std::array<std::size_t, 2> axes_;
  double at_;
  double tolerance_ = 0.01;
  std::array<std::vector<double>, 2> lines_; // of the lattice
  std::uint32_t columns_ = 0, rows_ = 0;
  PlanePoint least_{}, most_{};
  std::vector<float> values_;
  std::vector<Crossing> crossings_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
};

} // namespace

std::array<std::size_t, 2> planeAxes(std::size_t across) {
  return across == 0   ? std::array<std::size_t, 2>{1, 2}
         : across == 1 ? std::array<std::size_t, 2>{0, 2}
                       : std::array<std::size_t, 2>{0, 1};
}

Section sectionOf(const Part& part, std::size_t across, double at, const Region& region) {
  return Cutter(part, across, at, region).cut();
}

} // namespace dotek::sim
