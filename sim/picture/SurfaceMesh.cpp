#include "sim/picture/SurfaceMesh.h"

#include "sim/picture/Lattice.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dotek::sim {
namespace {

constexpr double kSkin = 1e-7; // a lattice plane within a face: rounding decides nothing
constexpr std::uint32_t kNone = 0xffffffff;

using Vec = Eigen::Vector3d;

Vec vec(const Point3& p) {
  return {p.x, p.y, p.z};
}
Point3 point(const Vec& v) {
  return {v.x(), v.y(), v.z()};
}

// Dual contouring: one vertex in each cell of a lattice that the surface passes, where the planes that touch
// the surface on the cell's edges meet best; four cells around an edge with a change of sign make a face.
// The outermost ring of nodes lies on the border and counts as empty; no face is made there.
class Mesher {
public:
  Mesher(const Part& part, Lattice lattice)
      : part_(part), lattice_(std::move(lattice)), step_(lattice_.finest()) {
    for (std::size_t i = 0; i < 3; ++i)
      count_[i] = static_cast<std::uint32_t>(lattice_.lines[i].size()) + 2;
    out_.missed = lattice_.missed;
    values_.assign(std::size_t{count_[0]} * count_[1] * count_[2], 0);
    cells_.assign(values_.size(), kNone);
  }

  SurfaceMesh make() {
    fill({1, 1, 1}, {count_[0] - 2, count_[1] - 2, count_[2] - 2});
    findEdges();
    placeVertices();
    for (const Edge& edge : edges_)
      face(edge);
    return std::move(out_);
  }

private:
  using Node = std::array<std::uint32_t, 3>;
  struct Edge {
    Node from;
    std::uint8_t axis;
    bool fromIn;
    Vec at, normal;
  };
  // Of one cell: what is needed to find its vertex.
  struct Cell {
    Eigen::Matrix3d normals = Eigen::Matrix3d::Zero(); // sum of n n^T
    Vec right = Vec::Zero();                           // sum of n (n . p)
    Vec sum = Vec::Zero();
    int crossings = 0;
    Vec least, most;
  };

  std::size_t index(const Node& n) const { return (std::size_t{n[2]} * count_[1] + n[1]) * count_[0] + n[0]; }
  Vec place(const Node& n) const {
    Vec out;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::vector<double>& lines = lattice_.lines[i];
      out[static_cast<Eigen::Index>(i)] =
          lines[std::min<std::size_t>(n[i] == 0 ? 0 : n[i] - 1, lines.size() - 1)];
    }
    return out;
  }
  bool isRing(const Node& n) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (n[i] == 0 || n[i] + 1 == count_[i]) return true;
    }
    return false;
  }
  double distance(const Vec& p) const { return part_.distance(point(p)) - kSkin; }

  // Nodes from `low` to `high`, both included.
  void fill(const Node& low, const Node& high) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (high[i] - low[i] > high[longest] - low[longest]) longest = i;
    }
    const bool small = high[longest] - low[longest] <= 2;
    std::int8_t all = 0;
    if (!small) {
      const Vec a = place(low), b = place(high);
      const double d = distance((a + b) / 2);
      if (std::abs(d) > (b - a).norm() / 2 + 2 * kSkin) all = d <= 0 ? 1 : -1;
    }
    if (!small && all == 0) {
      Node middle = high;
      middle[longest] = (low[longest] + high[longest]) / 2;
      fill(low, middle);
      middle = low;
      middle[longest] = (low[longest] + high[longest]) / 2;
      fill(middle, high);
      return;
    }
    for (std::uint32_t z = low[2]; z <= high[2]; ++z) {
      for (std::uint32_t y = low[1]; y <= high[1]; ++y) {
        for (std::uint32_t x = low[0]; x <= high[0]; ++x) {
          std::int8_t& v = values_[index({x, y, z})];
          if (all != 0)
            v = all;
          else if (v == 0)
            v = distance(place({x, y, z})) <= 0 ? 1 : -1;
        }
      }
    }
  }

  bool isIn(const Node& n) const { return values_[index(n)] == 1; } // the ring stays 0

  Vec root(Vec in, Vec out) const {
    double a = distance(in), b = distance(out);
    for (int i = 0; i < 40 && (out - in).squaredNorm() > step_ * step_ * 1e-6; ++i) {
      double share = a / (a - b);
      if (i % 3 == 2 || !(share > 0.02 && share < 0.98)) share = 0.5;
      Vec m = in + (out - in) * share;
      const double d = distance(m);
      if (std::abs(d) < 1e-7) return m;
      (d <= 0 ? in : out) = m;
      (d <= 0 ? a : b) = d;
    }
    return (in + out) / 2;
  }

  void findEdges() {
    Node n{};
    for (n[2] = 0; n[2] < count_[2]; ++n[2]) {
      for (n[1] = 0; n[1] < count_[1]; ++n[1]) {
        for (n[0] = 0; n[0] < count_[0]; ++n[0]) {
          const bool in = isIn(n);
          for (std::uint8_t axis = 0; axis < 3; ++axis) {
            if (n[axis] + 1 == count_[axis]) continue;
            Node to = n;
            ++to[axis];
            if (isIn(to) == in || isRing(n) || isRing(to)) continue; // a cut is open
            Edge edge{n, axis, in, Vec::Zero(), Vec::Zero()};
            edge.at = in ? root(place(n), place(to)) : root(place(to), place(n));
            edge.normal = vec(part_.nearest(point(edge.at)).normal);
            edges_.push_back(edge);
          }
        }
      }
    }
  }

  // The four cells around an edge, counterclockwise as seen against its axis.
  std::array<Node, 4> around(const Edge& edge) const {
    const std::size_t u = (edge.axis + 1u) % 3, v = (edge.axis + 2u) % 3;
    std::array<Node, 4> out{edge.from, edge.from, edge.from, edge.from};
    --out[0][u], --out[0][v];
    --out[1][v];
    --out[3][u];
    return out;
  }

  void placeVertices() {
    std::vector<Cell> found;
    for (const Edge& edge : edges_) {
      for (const Node& n : around(edge)) {
        std::uint32_t& number = cells_[index(n)];
        if (number == kNone) {
          number = static_cast<std::uint32_t>(found.size());
          found.emplace_back();
          found.back().least = place(n);
          found.back().most = place({n[0] + 1, n[1] + 1, n[2] + 1});
        }
        Cell& cell = found[number];
        cell.normals += edge.normal * edge.normal.transpose();
        cell.right += edge.normal * edge.normal.dot(edge.at);
        cell.sum += edge.at;
        ++cell.crossings;
      }
    }
    out_.vertices.reserve(found.size());
    for (const Cell& cell : found) {
      // From the middle of the crossings only in directions in which the normals say something.
      const Vec middle = cell.sum / cell.crossings;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(cell.normals);
      const Vec rest = solver.eigenvectors().transpose() * (cell.right - cell.normals * middle);
      Vec step = Vec::Zero();
      for (int i = 0; i < 3; ++i) {
        const double weight = solver.eigenvalues()[i];
        if (weight > 0.05 * cell.crossings) step += solver.eigenvectors().col(i) * (rest[i] / weight);
      }
      const Vec at = (middle + step).cwiseMax(cell.least).cwiseMin(cell.most);
      out_.vertices.push_back(point(at));
    }
  }

  void face(const Edge& edge) {
    std::array<std::uint32_t, 4> corners{};
    const std::array<Node, 4> cells = around(edge);
    for (std::size_t i = 0; i < 4; ++i)
      corners[i] = cells_[index(cells[i])];
    if (!edge.fromIn) std::swap(corners[1], corners[3]);
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      out_.triangles.push_back({corners[a], corners[b], corners[c]});
    };
    // Along the diagonal that folds less: of two ways the one whose triangles face alike.
    const auto fold = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
      const Vec p = vec(out_.vertices[corners[a]]), q = vec(out_.vertices[corners[b]]),
                r = vec(out_.vertices[corners[c]]), s = vec(out_.vertices[corners[d]]);
      const Vec n = (q - p).cross(r - p), m = (r - p).cross(s - p);
      const double size = n.norm() * m.norm();
      return size > 0 ? n.dot(m) / size : 1.0;
    };
    if (fold(0, 1, 2, 3) >= fold(1, 2, 3, 0)) {
      add(0, 1, 2);
      add(0, 2, 3);
    } else {
      add(1, 2, 3);
      add(1, 3, 0);
    }
  }

  const Part& part_;
  Lattice lattice_;
  double step_;
  std::array<std::uint32_t, 3> count_{};
  std::vector<std::int8_t> values_; // 1 in, -1 out, 0 the ring
  std::vector<std::uint32_t> cells_;
  std::vector<Edge> edges_;
  SurfaceMesh out_;
};

} // namespace

SurfaceMesh surfaceOf(const Part& part, const Region& region, std::uint32_t cells) {
  return Mesher(part, surfaceLattice(part, region, cells)).make();
}

} // namespace dotek::sim
