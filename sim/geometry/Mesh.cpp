#include "sim/geometry/Mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace dotek::sim {

using Eigen::Vector3d;

namespace {

constexpr std::uint32_t kLeaf = 4;

struct Nearest {
  Vector3d point = Vector3d::Zero();
  int feature = 0; // 0 face, 1 to 3 edge, 4 to 6 vertex
};

Vector3d onSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b, double& u) {
  const Vector3d d = b - a;
  const double square = d.squaredNorm();
  u = square > 0 ? std::clamp((p - a).dot(d) / square, 0.0, 1.0) : 0;
  return a + u * d;
}

Nearest nearestOnTriangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a;
  const Vector3d n = ab.cross(ac);
  const double area = n.squaredNorm();
  const Vector3d corners[3] = {a, b, c};
  if (area > 0) {
    const Vector3d w = p - a;
    const double v = ab.cross(w).dot(n) / area; // weight of c
    const double u = w.cross(ac).dot(n) / area; // weight of b
    if (u > 0 && v > 0 && u + v < 1) return {p - n * (w.dot(n) / area), 0};
  }
  Nearest out;
  double best = std::numeric_limits<double>::infinity();
  for (int e = 0; e < 3; ++e) {
    double u = 0;
    const Vector3d q = onSegment(p, corners[e], corners[(e + 1) % 3], u);
    if (const double d = (p - q).squaredNorm(); d < best) {
      best = d;
      out = {q, u <= 0 ? 4 + e : u >= 1 ? 4 + (e + 1) % 3 : 1 + e};
    }
  }
  return out;
}

// Squared, of two segments.
double segmentsApart(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d u = b - a, v = d - c, w = a - c;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  double best = std::numeric_limits<double>::infinity();
  const double determinant = uu * vv - uv * uv;
  if (determinant > 1e-14 * uu * vv) {
    const double s = (uv * v.dot(w) - vv * u.dot(w)) / determinant;
    const double t = (uu * v.dot(w) - uv * u.dot(w)) / determinant;
    if (s > 0 && s < 1 && t > 0 && t < 1) return (w + s * u - t * v).squaredNorm();
  }
  // At an end of one of them.
  double unused = 0;
  for (const Vector3d& p : {a, b})
    best = std::min(best, (p - onSegment(p, c, d, unused)).squaredNorm());
  for (const Vector3d& p : {c, d})
    best = std::min(best, (p - onSegment(p, a, b, unused)).squaredNorm());
  return best;
}

double segmentToTriangle(const Vector3d& a, const Vector3d& b, const std::array<Vector3d, 3>& t) {
  const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double ha = (a - t[0]).dot(n), hb = (b - t[0]).dot(n);
  if (ha * hb < 0) { // does it go through?
    const Vector3d q = a + ha / (ha - hb) * (b - a);
    if (nearestOnTriangle(q, t[0], t[1], t[2]).feature == 0) return 0;
  }
  double best = std::min((a - nearestOnTriangle(a, t[0], t[1], t[2]).point).squaredNorm(),
                         (b - nearestOnTriangle(b, t[0], t[1], t[2]).point).squaredNorm());
  for (std::size_t e = 0; e < 3; ++e)
    best = std::min(best, segmentsApart(a, b, t[e], t[(e + 1) % 3]));
  return best;
}

} // namespace

double Mesh::segmentDistance(const Vector3d& a, const Vector3d& b) const {
  const Vector3d low = a.cwiseMin(b), high = a.cwiseMax(b);
  std::array<std::uint32_t, 64> stack;
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  double best = std::numeric_limits<double>::infinity();
  while (waiting > 0) {
    const std::uint32_t next = stack[--waiting];
    const Branch& branch = tree_[next];
    if (branch.box.squaredDistance(low, high) >= best) continue;
    if (branch.right == 0) {
      for (std::uint32_t i = branch.begin; i < branch.end; ++i) {
        const auto& t = triangles_[i];
        best = std::min(best, segmentToTriangle(a, b, {vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]}));
      }
      continue;
    }
    const bool left =
        tree_[next + 1].box.squaredDistance(low, high) < tree_[branch.right].box.squaredDistance(low, high);
    stack[waiting++] = left ? branch.right : next + 1; // the nearer one is taken first
    stack[waiting++] = left ? next + 1 : branch.right;
  }
  return std::sqrt(best);
}

double Mesh::Box::squaredDistance(const Vector3d& low, const Vector3d& high) const {
  return (least - high).cwiseMax(low - most).cwiseMax(0).squaredNorm();
}

std::string Mesh::set(std::vector<Vector3d> vertices, std::vector<std::array<std::uint32_t, 3>> triangles) {
  vertices_ = std::move(vertices);
  triangles_ = std::move(triangles);
  return finish();
}

// Corners three by three; those with the same coordinates are one vertex.
std::string Mesh::addCorners(std::vector<Vector3d>& corners) {
  std::vector<std::uint32_t> order(corners.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto less = [&](std::uint32_t i, std::uint32_t j) {
    const Vector3d &a = corners[i], &b = corners[j];
    if (a.x() != b.x()) return a.x() < b.x();
    if (a.y() != b.y()) return a.y() < b.y();
    return a.z() < b.z();
  };
  std::sort(order.begin(), order.end(), less);
  std::vector<std::uint32_t> vertex(corners.size());
  vertices_.clear();
  for (std::size_t n = 0; n < order.size(); ++n) {
    if (n == 0 || less(order[n - 1], order[n])) vertices_.push_back(corners[order[n]]);
    vertex[order[n]] = static_cast<std::uint32_t>(vertices_.size() - 1);
  }
  triangles_.clear();
  for (std::size_t n = 0; n + 2 < vertex.size(); n += 3) {
    const std::array<std::uint32_t, 3> t = {vertex[n], vertex[n + 1], vertex[n + 2]};
    // Two corners in one place: its two edges are one and the same, in both paths.
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles_.push_back(t);
  }
  return finish();
}

std::string Mesh::finish() {
  if (triangles_.empty()) return "it holds no triangle";
  if (std::string fault = checkClosed(); !fault.empty()) return fault;
  double volume = 0;
  for (const auto& t : triangles_)
    volume += (vertices_[t[0]] - vertices_[0])
                  .dot((vertices_[t[1]] - vertices_[0]).cross(vertices_[t[2]] - vertices_[0]));
  if (!(volume > 0))
    return "its triangles face inward, so that the material would be outside; turn them round in the CAD";
  makeTree();
  makeNormals();
  return "";
}

std::string Mesh::checkClosed() {
  // Each edge once in each path.
  std::vector<std::array<std::uint32_t, 3>> edges; // least, greatest, 1: in that path
  edges.reserve(triangles_.size() * 3);
  for (const auto& t : triangles_) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t a = t[e], b = t[(e + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1u : 0u});
    }
  }
  std::sort(edges.begin(), edges.end());
  std::size_t open = 0, many = 0, turned = 0;
  for (std::size_t n = 0; n < edges.size();) {
    std::size_t end = n, forward = 0;
    for (; end < edges.size() && edges[end][0] == edges[n][0] && edges[end][1] == edges[n][1]; ++end)
      forward += edges[end][2];
    if (end - n == 1)
      ++open;
    else if (end - n > 2)
      ++many;
    else if (forward != 1)
      ++turned;
    n = end;
  }
  if (open > 0)
    return fmt::format(
        "it is not closed: {} edges belong to one triangle only, so inside and outside are not "
        "told apart; repair it in the CAD",
        open);
  if (many > 0) return fmt::format("{} edges belong to more than two triangles; repair it in the CAD", many);
  if (turned > 0)
    return fmt::format("at {} edges two triangles face opposite sides; repair it in the CAD", turned);
  return "";
}

void Mesh::place(const Eigen::Matrix3d& turn, const Vector3d& shift) {
  for (Vector3d& v : vertices_)
    v = turn * v + shift;
  makeTree();
  makeNormals();
}

void Mesh::makeNormals() {
  normals_.assign(triangles_.size(),
                  {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()});
  vertexNormals_.assign(vertices_.size(), Vector3d::Zero());
  struct Half {
    std::uint32_t least, greatest, triangle, edge;
  };
  std::vector<Half> halves;
  halves.reserve(triangles_.size() * 3);
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    const auto& t = triangles_[i];
    const Vector3d n =
        (vertices_[t[1]] - vertices_[t[0]]).cross(vertices_[t[2]] - vertices_[t[0]]).stableNormalized();
    normals_[i][0] = n;
    for (std::uint32_t e = 0; e < 3; ++e) {
      const std::uint32_t a = t[e], b = t[(e + 1) % 3], c = t[(e + 2) % 3];
      halves.push_back({std::min(a, b), std::max(a, b), i, e});
      const Vector3d u = vertices_[b] - vertices_[a], v = vertices_[c] - vertices_[a];
      vertexNormals_[a] += std::atan2(u.cross(v).norm(), u.dot(v)) * n;
    }
  }
  std::sort(halves.begin(), halves.end(), [](const Half& a, const Half& b) {
    return std::tie(a.least, a.greatest, a.triangle) < std::tie(b.least, b.greatest, b.triangle);
  });
  for (std::size_t n = 0; n + 1 < halves.size(); n += 2) { // closed: they come in pairs
    const Half &a = halves[n], &b = halves[n + 1];
    const Vector3d sum = normals_[a.triangle][0] + normals_[b.triangle][0];
    normals_[a.triangle][1 + a.edge] = sum;
    normals_[b.triangle][1 + b.edge] = sum;
  }
}

void Mesh::makeTree() {
  tree_.clear();
  tree_.reserve(triangles_.size());
  std::vector<Vector3d> centres;
  for (const auto& t : triangles_)
    centres.push_back((vertices_[t[0]] + vertices_[t[1]] + vertices_[t[2]]) / 3);
  std::vector<std::uint32_t> order(triangles_.size());
  std::iota(order.begin(), order.end(), 0u);
  split(0, static_cast<std::uint32_t>(order.size()), centres, order);
  std::vector<std::array<std::uint32_t, 3>> sorted;
  sorted.reserve(order.size());
  for (const std::uint32_t i : order)
    sorted.push_back(triangles_[i]);
  triangles_ = std::move(sorted);
}

// Halves of equal size, so its depth is the logarithm of the number of triangles.
void Mesh::split(std::uint32_t begin, std::uint32_t end, std::vector<Vector3d>& centres,
                 std::vector<std::uint32_t>& order) {
  const std::size_t self = tree_.size();
  tree_.emplace_back();
  Vector3d least = Vector3d::Constant(std::numeric_limits<double>::infinity()), most = -least;
  for (std::uint32_t n = begin; n < end; ++n) {
    for (const std::uint32_t v : triangles_[order[n]]) {
      least = least.cwiseMin(vertices_[v]);
      most = most.cwiseMax(vertices_[v]);
    }
  }
  tree_[self].box = {least, most};
  tree_[self].begin = begin;
  tree_[self].end = end;
  if (end - begin <= kLeaf) return;
  int axis = 0;
  (most - least).maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis]
                                                                 : a < b;
                   });
  split(begin, middle, centres, order);
  tree_[self].right = static_cast<std::uint32_t>(tree_.size());
  split(middle, end, centres, order);
}

double Mesh::distance(const Vector3d& p, Vector3d* point, Vector3d* normal) const {
  struct Wait {
    std::uint32_t branch;
    double square;
  };
  std::array<Wait, 64> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, tree_[0].box.squaredDistance(p)};
  double best = std::numeric_limits<double>::infinity();
  Nearest nearest;
  std::uint32_t which = 0;
  while (waiting > 0) {
    const Wait next = stack[--waiting];
    if (next.square >= best) continue;
    const Branch& branch = tree_[next.branch];
    if (branch.right == 0) {
      for (std::uint32_t i = branch.begin; i < branch.end; ++i) {
        const auto& t = triangles_[i];
        const Nearest found = nearestOnTriangle(p, vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]);
        if (const double square = (p - found.point).squaredNorm(); square < best) {
          best = square;
          nearest = found;
          which = i;
        }
      }
      continue;
    }
    Wait left{next.branch + 1, tree_[next.branch + 1].box.squaredDistance(p)};
    Wait right{branch.right, tree_[branch.right].box.squaredDistance(p)};
    if (left.square < right.square) std::swap(left, right); // the nearer one is taken first
    stack[waiting++] = left;
    stack[waiting++] = right;
  }
  const auto feature = static_cast<std::size_t>(nearest.feature);
  const Vector3d n = feature < 4 ? normals_[which][feature] : vertexNormals_[triangles_[which][feature - 4]];
  const double d = std::sqrt(best);
  const double side = (p - nearest.point).dot(n) < 0 ? -1 : 1;
  if (point != nullptr) *point = nearest.point;
  if (normal != nullptr) *normal = d > 1e-9 ? Vector3d(side * (p - nearest.point) / d) : n.normalized();
  return side * d;
}

} // namespace dotek::sim
