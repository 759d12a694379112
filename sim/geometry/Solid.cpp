#include "sim/geometry/Solid.h"

#include <algorithm>
#include <cmath>

namespace dotek::sim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Material and gaps thinner than twice this (mm) do not count: faces that should coincide never do to the
// last digit.
constexpr double kSkin = 1e-7;

std::vector<Solid::Node> withoutMeshes(const std::vector<Solid::Node>& list) {
  std::vector<Solid::Node> out;
  for (const Solid::Node& node : list) {
    if (node.mesh >= 0) continue;
    out.push_back(node);
    out.back().group = withoutMeshes(node.group);
  }
  return out;
}

constexpr double kOpen = 1e-6; // mm: material above a mouth

// Whether a plane shows that `other` does not appear in front of that face of `cutter` which looks along
// `out`.
bool isClear(const Shape& other, const Shape& cutter, const Vec& out) {
  if (other.support(out) <= cutter.support(out) + kOpen) return true;
  Vec there, here;
  other.bounding(there);
  cutter.bounding(here);
  Vec between = here - there;
  between -= between.dot(out) * out;
  if (between.norm() > 1e-9 && other.support(between.normalized()) <= -cutter.support(-between.normalized()))
    return true;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vec u = side * cutter.axes.col(axis);
      if (std::abs(u.dot(out)) < 0.5 && other.support(u) <= -cutter.support(-u)) return true;
    }
  }
  return false;
}

// The same for all that a list may hold; what it removes is not taken off.
bool isClear(const std::vector<Solid::Node>& list, const std::vector<Shape>& shapes, const Shape& cutter,
             const Vec& out) {
  return std::all_of(list.begin(), list.end(), [&](const Solid::Node& node) {
    if (node.action != Solid::Action::Add) return true;
    return node.shape >= 0 ? isClear(shapes[static_cast<std::size_t>(node.shape)], cutter, out)
                           : isClear(node.group, shapes, cutter, out);
  });
}

} // namespace

// What is cut from a face on may be cut from far above it: where nothing is there, the part is the same.
// The bound is then the true distance in the mouth, too, instead of that to a lid which is not there.
void Solid::openMouths(std::vector<Node>& list) {
  std::vector<Node> before;
  for (Node& node : list) {
    if (node.shape < 0) openMouths(node.group);
    Shape* const shape = node.shape < 0 ? nullptr : &shapes[static_cast<std::size_t>(node.shape)];
    if (node.action == Action::Remove && shape != nullptr && shape->kind == Shape::Kind::Block) {
      double* const halves[3] = {&shape->a, &shape->b, &shape->c};
      for (int axis = shape->d > 0 ? 2 : 0; axis < 3; ++axis) {
        double& half = *halves[axis];
        for (const double side : {-1.0, 1.0}) {
          const Vec out = side * shape->axes.col(axis);
          if (half > kFar / 2 || !isClear(before, shapes, *shape, out)) continue;
          half += kFar / 4;
          shape->origin += kFar / 4 * out;
        }
      }
    }
    before.push_back(node);
  }
}

bool Solid::build() {
  if (meshes.empty()) openMouths(nodes);
  solidNodes_ = withoutMeshes(nodes);
  surfaces_.clear();
  edges_ = std::make_unique<Edges>();
  corners_.clear();
  shapeBoxes_.clear();
  for (const Shape& shape : shapes)
    shapeBoxes_.push_back(boxOf(shape));
  boxes_.clear();
  added_.clear();
  if (!addBoxes(nodes)) boxes_.clear();
  std::vector<Apex> apexes;
  for (std::uint32_t i = 0; i < shapes.size(); ++i)
    addSurfaces(shapes[i], i, surfaces_, apexes);
  for (const Apex& apex : apexes) {
    if (isBoundary(apex.point, apex.axis)) corners_.push_back(apex.point);
  }
  waits_ = mayWait();
  if (waits_) return true;
  bool out = false;
  std::call_once(edges_->found, [&] { out = findEdges(); });
  return out;
}

// What has a surface has an edge or a corner, or a face without any: a ball, a cylinder or a plane without
// end.
bool Solid::isEmpty() const {
  if (waits_ || !meshes.empty() || !edges_->pieces.empty() || !corners_.empty()) return false;
  return std::none_of(surfaces_.begin(), surfaces_.end(), [&](const Surface& s) {
    if (s.kind == Surface::Kind::Plane) return isBoundary(s.origin, s.axis);
    const Vec n = across(s.axis);
    if (s.kind == Surface::Kind::Cone) return false; // its apex or its rim would be there
    return isBoundary(s.origin + s.radius * n, n);
  });
}

double Solid::boundOf(const std::vector<Node>& list, const Vec& p, std::int32_t* nearest) const {
  double out = kInfinity;
  for (const Node& node : list) {
    std::int32_t which = node.shape;
    double d = 0;
    if (node.shape >= 0)
      d = shapes[static_cast<std::size_t>(node.shape)].distance(p);
    else if (node.mesh >= 0)
      d = meshes[static_cast<std::size_t>(node.mesh)].distance(p);
    else
      d = boundOf(node.group, p, nearest == nullptr ? nullptr : &which);
    if (node.action == Action::Remove) d = -d;
    const bool taken = node.action == Action::Add ? d < out : d > out;
    if (!taken) continue;
    out = d;
    if (nearest != nullptr) *nearest = which;
  }
  return out;
}

Solid::Box Solid::boxOf(const Shape& shape) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec unit = Vec::Unit(axis);
    box.most[axis] = shape.support(unit);
    box.least[axis] = -shape.support(-unit);
  }
  return box;
}

bool Solid::mayTouch(std::uint32_t shape, const Box& box) const {
  constexpr double kSlack = 1e-3;
  const Box& own = shapeBoxes_[shape];
  return (own.least.array() <= box.most.array() + kSlack).all() &&
         (own.most.array() + kSlack >= box.least.array()).all();
}

// What is removed or kept makes nothing larger.
bool Solid::addBoxes(const std::vector<Node>& list) {
  for (const Node& node : list) {
    if (node.action != Action::Add) continue;
    if (node.mesh >= 0) return false;
    if (node.shape < 0) {
      if (!addBoxes(node.group)) return false;
      continue;
    }
    const Box& box = shapeBoxes_[static_cast<std::size_t>(node.shape)];
    if (!box.most.allFinite() || !box.least.allFinite()) return false;
    boxes_.push_back(box);
    added_.push_back(static_cast<std::uint32_t>(node.shape));
  }
  return true;
}

bool Solid::mayLieIn(const Vec& least, const Vec& most) const {
  if (boxes_.empty()) return true;
  for (const Box& box : boxes_)
    if ((box.least.array() <= most.array()).all() && (box.most.array() >= least.array()).all()) return true;
  return false;
}

bool Solid::isBeyond(const Patch& patch, double reach) const {
  if (boxes_.empty()) return false;
  return std::all_of(added_.begin(), added_.end(), [&](std::uint32_t index) {
    const Shape& shape = shapes[index];
    const Vec half = shape.kind == Shape::Kind::Block ? Vec(shape.a, shape.b, shape.c)
                     : shape.kind == Shape::Kind::Cone
                         ? Vec(std::max(shape.a, shape.b), std::max(shape.a, shape.b), shape.c)
                         : Vec::Constant(shape.a);
    const Vec middle = shape.axes.transpose() * (patch.middle - shape.origin);
    const Vec a = shape.axes.transpose() * patch.a, b = shape.axes.transpose() * patch.b;
    return (middle.cwiseAbs() - a.cwiseAbs() - b.cwiseAbs() - half).maxCoeff() > reach;
  });
}

double Solid::bound(const Vec& p) const {
  return boundOf(nodes, p, nullptr);
}

// The greatest value is needed of what is removed only.
double Solid::endOf(const std::vector<Node>& list, const Patch& patch, bool least) const {
  double out = kInfinity;
  for (const Node& node : list) {
    const bool wanted = least == (node.action != Action::Remove);
    double d = 0;
    if (node.shape >= 0) {
      const Shape& shape = shapes[static_cast<std::size_t>(node.shape)];
      d = wanted ? shape.least(patch) : shape.most(patch);
    } else if (node.mesh >= 0) {
      const double reach = patch.a.norm() + patch.b.norm();
      d = meshes[static_cast<std::size_t>(node.mesh)].distance(patch.middle) + (wanted ? -reach : reach);
    } else {
      d = endOf(node.group, patch, wanted);
    }
    if (node.action == Action::Remove) d = -d;
    out = node.action == Action::Add ? std::min(out, d) : std::max(out, d);
  }
  return out;
}

// Whether material lies on one side of q and none on the other. A skin that is left where two faces coincide
// is no surface, nor is a wall between two pieces that touch.
bool Solid::isBoundary(const Vec& q, const Vec& normal) const {
  return (shapesBound(q + kSkin * normal) > 0) != (shapesBound(q - kSkin * normal) > 0);
}

bool Solid::isEdge(const Vec& q, const Vec& first, const Vec& second) const {
  int outside = 0;
  for (const double s : {-kSkin, kSkin}) {
    for (const double t : {-kSkin, kSkin})
      outside += shapesBound(q + s * first + t * second) > 0 ? 1 : 0;
  }
  return outside != 0 && outside != 4;
}

void Solid::footOnEdges(const Vec& p, double& best, Vec& point) const {
  for (const Vec& corner : corners_) {
    if (const double d = (p - corner).norm(); d < best) {
      best = d;
      point = corner;
    }
  }
  const Edges& known = edges();
  for (const Chain& chain : known.chains) {
    if ((p - chain.centre).norm() - chain.radius >= best) continue;
    for (std::size_t i = chain.begin; i < chain.end; ++i) {
      const Piece& piece = known.pieces[i];
      const Vec chord = piece.b - piece.a;
      const double square = chord.squaredNorm();
      const double u = square > 0 ? std::clamp((p - piece.a).dot(chord) / square, 0.0, 1.0) : 0;
      const Vec q = piece.a + u * chord;
      const double d = (p - q).norm();
      if (d - piece.sag >= best) continue;
      if (piece.sag > 0) {
        nearestOnPiece(p, piece, best, point);
      } else if (d < best) {
        best = d;
        point = q;
      }
    }
  }
}

// Nearest point of a boundary: on a face, where its foot is a point of the boundary, or on an edge or corner.
// The bound is met in most cases and then ends the search.
void Solid::footOnShapes(const Vec& p, Foot& best) const {
  std::int32_t nearest = -1;
  const double bound = boundOf(solidNodes_, p, &nearest);
  const double least = std::abs(bound);
  if (!std::isfinite(bound) || nearest < 0) return;
  Vec g;
  const Shape& shape = shapes[static_cast<std::size_t>(nearest)];
  const double own = shape.distance(p, g);
  // On a wall between two pieces the bound vanishes as well.
  const bool within =
      bound < 0 || (bound < kSkin && shapesBound(p + kSkin * g) <= 0 && shapesBound(p - kSkin * g) <= 0);
  const double side = within ? -1 : 1;
  if (Vec q = p - own * g; isBoundary(q, g)) {
    best = {q, own * bound < 0 ? Vec(-g) : g, bound};
    return;
  }
  double found = kInfinity;
  Vec point = Vec::Zero(), normal = Vec::Zero();
  for (const Surface& surface : surfaces_) {
    const double value = surface.value(p);
    const double d = std::abs(value);
    if (d >= found || d < least - 1e-9) continue;
    const Vec n = surface.normal(p);
    const Vec q = p - value * n;
    // After the apex of a cone there is no side.
    if (surface.kind == Surface::Kind::Cone && (q - surface.origin).dot(surface.axis) <= 0) continue;
    if (!isBoundary(q, n)) continue;
    found = d;
    point = q;
    normal = value * side < 0 ? Vec(-n) : n;
    if (d <= least + 1e-12) break;
  }
  double edge = found;
  footOnEdges(p, edge, point);
  if (edge < found) {
    found = edge;
    normal = edge > 0 ? Vec(side * (p - point) / edge) : g;
  }
  // Where no feature is near, the bound is on the safe side.
  if (!std::isfinite(found)) {
    found = least;
    point = p - own * g;
    normal = g;
  }
  best = {point, normal, side * found};
}

Foot Solid::shapesFoot(const Vec& p) const {
  Foot best;
  footOnShapes(p, best);
  return best;
}

Foot Solid::foot(const Vec& p) const {
  Foot best;
  if (!shapes.empty()) footOnShapes(p, best);
  for (const Mesh& mesh : meshes) {
    Vec point, normal;
    const double d = mesh.distance(p, &point, &normal);
    if (d < best.distance) best = {point, normal, d};
  }
  return best;
}

} // namespace dotek::sim
