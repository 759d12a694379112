// The edges of a part: curves in which two surfaces meet, cut where other surfaces end them. Lines are kept
// whole, other curves as short pieces that Newton's method puts onto both surfaces.
#include "sim/geometry/Solid.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dotek::sim {
namespace {

constexpr int kRulings = 96;
constexpr int kArcs = 32; // of a circle: each smooth()
constexpr int kDepth = 16;
constexpr double kShort = 1e-3; // mm: a piece is not cut further
constexpr double kParallel = 1e-9;
constexpr double kTangent = 1e-5; // sine: flatter meetings are no edges
constexpr std::size_t kChain = 16;

} // namespace

// A straight line of surface i and where it meets surface j.
struct Solid::Ruling {
  double angle = 0;
  int count = 0;
  double discriminant = 0;
  Vec at[2] = {Vec::Zero(), Vec::Zero()};
};

const Solid::Edges& Solid::edges() const {
  std::call_once(edges_->found, [this] { findEdges(); });
  return *edges_;
}

// Planes meet in lines, each of which all planes cut.
bool Solid::mayWait() const {
  const bool blocks = std::all_of(nodes.begin(), nodes.end(), [&](const Node& node) {
    if (node.action != Action::Add || node.shape < 0) return false;
    const Shape& shape = shapes[static_cast<std::size_t>(node.shape)];
    return shape.kind == Shape::Kind::Block && shape.d == 0;
  });
  const auto planes = static_cast<double>(surfaces_.size()), count = static_cast<double>(shapes.size());
  return blocks && planes * planes / 2 * (1 + planes + (planes + 2) * (2 + 4 * count)) < mostWork_;
}

bool Solid::findEdges() const {
  for (std::uint32_t i = 0; i < surfaces_.size(); ++i) {
    for (std::uint32_t j = i + 1; j < surfaces_.size(); ++j) {
      const std::size_t begin = edges_->pieces.size();
      if (!meet(i, j) || (edges_->work += 1) > mostWork_) return false;
      addChains(begin);
    }
  }
  return true;
}

void Solid::addChains(std::size_t begin) const {
  for (; begin < edges_->pieces.size(); begin += kChain) {
    Chain chain;
    chain.begin = begin;
    chain.end = std::min(begin + kChain, edges_->pieces.size());
    for (std::size_t i = begin; i < chain.end; ++i)
      chain.centre += (edges_->pieces[i].a + edges_->pieces[i].b) / 2;
    chain.centre /= static_cast<double>(chain.end - begin);
    for (std::size_t i = begin; i < chain.end; ++i) {
      const Piece& piece = edges_->pieces[i];
      chain.radius = std::max({chain.radius, (piece.a - chain.centre).norm() + piece.sag,
                               (piece.b - chain.centre).norm() + piece.sag});
    }
    edges_->chains.push_back(chain);
  }
}

bool Solid::meet(std::uint32_t i, std::uint32_t j) const {
  using Kind = Surface::Kind;
  const Surface *s = &surfaces_[i], *t = &surfaces_[j];
  if (s->shape != t->shape && !mayTouch(s->shape, shapeBoxes_[t->shape])) return true;
  Vec a, b;
  const double ra = shapes[s->shape].bounding(a), rb = shapes[t->shape].bounding(b);
  if ((a - b).norm() > ra + rb + 1e-6) return true;
  if (s->kind > t->kind) {
    std::swap(s, t);
    std::swap(i, j);
  }
  const bool parallel = s->axis.cross(t->axis).norm() < kParallel;
  if (s->kind == Kind::Plane && t->kind == Kind::Plane) {
    if (parallel) return true;
    const Vec d = s->axis.cross(t->axis).normalized();
    Rot m;
    m << s->axis.transpose(), t->axis.transpose(), d.transpose();
    const Vec mid = (a + b) / 2;
    return straight(m.inverse() * Vec(s->axis.dot(s->origin), t->axis.dot(t->origin), d.dot(mid)), d, i, j);
  }
  if (s->kind == Kind::Plane && t->kind == Kind::Sphere) {
    const double h = s->value(t->origin);
    if (std::abs(h) >= t->radius) return true;
    return circle(t->origin - h * s->axis, s->axis, std::sqrt(t->radius * t->radius - h * h), i, j);
  }
  if (s->kind == Kind::Sphere && t->kind == Kind::Sphere) {
    const Vec w = t->origin - s->origin;
    const double d = w.norm();
    if (d < kParallel) return true;
    const double h = (d * d + s->radius * s->radius - t->radius * t->radius) / (2 * d);
    if (std::abs(h) >= s->radius) return true;
    return circle(s->origin + h / d * w, w / d, std::sqrt(s->radius * s->radius - h * h), i, j);
  }
  if (s->kind == Kind::Plane && t->kind == Kind::Cylinder && std::abs(s->axis.dot(t->axis)) < kParallel) {
    const double h = s->value(t->origin);
    if (std::abs(h) >= t->radius) return true;
    const Vec side = std::sqrt(t->radius * t->radius - h * h) * s->axis.cross(t->axis).normalized();
    const Vec foot = t->origin - h * s->axis;
    return straight(foot + side, t->axis, i, j) && straight(foot - side, t->axis, i, j);
  }
  if (s->kind == Kind::Plane && t->kind == Kind::Cylinder && parallel)
    return circle(t->origin - s->value(t->origin) * s->axis, s->axis, t->radius, i, j);
  if (s->kind == Kind::Cylinder && t->kind == Kind::Cylinder && parallel) {
    Vec w = t->origin - s->origin;
    w -= w.dot(s->axis) * s->axis;
    const double d = w.norm();
    if (d < kParallel) return true;
    const double h = (d * d + s->radius * s->radius - t->radius * t->radius) / (2 * d);
    if (std::abs(h) >= s->radius) return true;
    const Vec side = std::sqrt(s->radius * s->radius - h * h) * s->axis.cross(w / d);
    const Vec foot = s->origin + h / d * w;
    return straight(foot + side, s->axis, i, j) && straight(foot - side, s->axis, i, j);
  }
  // The narrower one is cut into rulings: none of its loops falls between two lines of the wider one.
  const auto ruled = [](const Surface& x) { return x.kind == Kind::Cylinder || x.kind == Kind::Cone; };
  if (!ruled(*s) || (ruled(*t) && t->radius < s->radius)) return rulings(j, i);
  return rulings(i, j);
}

bool Solid::straight(const Vec& o, const Vec& d, std::uint32_t i, std::uint32_t j) const {
  double from = -4 * kFar, to = 4 * kFar;
  for (const std::uint32_t k : {i, j}) {
    Vec centre;
    const double radius = shapes[surfaces_[k].shape].bounding(centre) + 1e-6;
    const double middle = (centre - o).dot(d);
    const double square = radius * radius - (o + middle * d - centre).squaredNorm();
    if (square <= 0) return true;
    from = std::max(from, middle - std::sqrt(square));
    to = std::min(to, middle + std::sqrt(square));
  }
  if (from >= to) return true;
  // Of shapes that end before both of them none cuts the edge.
  const Box &one = shapeBoxes_[surfaces_[i].shape], &other = shapeBoxes_[surfaces_[j].shape];
  const Box both{one.least.cwiseMax(other.least), one.most.cwiseMin(other.most)};
  std::vector<double> cuts = {from, to};
  for (std::uint32_t k = 0; k < surfaces_.size(); ++k) {
    if (k == i || k == j || !mayTouch(surfaces_[k].shape, both)) continue;
    double t[2];
    const int count = surfaces_[k].roots(o, d, t);
    for (int n = 0; n < count; ++n) {
      if (t[n] > from && t[n] < to) cuts.push_back(t[n]);
    }
  }
  edges_->work += static_cast<double>(surfaces_.size());
  std::sort(cuts.begin(), cuts.end());
  Piece piece;
  piece.first = i;
  piece.second = j;
  bool open = false; // the last piece may go on
  for (std::size_t n = 1; n < cuts.size(); ++n) {
    if (cuts[n] - cuts[n - 1] < 1e-10) continue;
    const bool kept = isKept(o + (cuts[n - 1] + cuts[n]) / 2 * d, piece);
    if (kept && open) {
      edges_->pieces.back().b = o + cuts[n] * d;
    } else if (kept) {
      piece.a = o + cuts[n - 1] * d;
      piece.b = o + cuts[n] * d;
      edges_->pieces.push_back(piece);
    }
    open = kept;
  }
  return edges_->work < mostWork_;
}

bool Solid::circle(const Vec& centre, const Vec& axis, double radius, std::uint32_t i,
                   std::uint32_t j) const {
  const Vec x = across(axis) * radius, y = axis.cross(x);
  const auto point = [&](int n) {
    const double angle = 2 * std::numbers::pi * (n % kArcs) / kArcs;
    return Vec(centre + std::cos(angle) * x + std::sin(angle) * y);
  };
  for (int n = 0; n < kArcs; ++n) {
    Piece piece;
    piece.a = point(n);
    piece.b = point(n + 1);
    piece.first = i;
    piece.second = j;
    if (smooth(piece) && !keep(piece, 0)) return false;
  }
  return true;
}

Solid::Ruling Solid::ruling(double angle, std::uint32_t i, std::uint32_t j) const {
  const Surface& s = surfaces_[i];
  const Surface& other = surfaces_[j];
  edges_->work += 1;
  const Vec e1 = across(s.axis), e2 = s.axis.cross(e1);
  const Vec radial = std::cos(angle) * e1 + std::sin(angle) * e2;
  const bool cone = s.kind == Surface::Kind::Cone;
  const Vec o = cone ? s.origin : Vec(s.origin + s.radius * radial);
  const Vec d = cone ? Vec(s.cosine * s.axis + s.sine * radial) : s.axis;
  Ruling out;
  out.angle = angle;
  double t[2];
  const int count = other.roots(o, d, t, &out.discriminant);
  if (out.discriminant < 0) return out;
  for (int n = 0; n < count; ++n) {
    const Vec q = o + t[n] * d;
    if (cone && t[n] < 0) continue;
    if (other.kind == Surface::Kind::Cone && (q - other.origin).dot(other.axis) < 0) continue;
    out.at[out.count++] = q;
  }
  return out;
}

bool Solid::rulings(std::uint32_t i, std::uint32_t j) const {
  std::vector<Ruling> list;
  const double step = 2 * std::numbers::pi / kRulings;
  for (int n = 0; n <= kRulings; ++n)
    list.push_back(ruling(n * step, i, j));
  list.back().at[0] = list.front().at[0];
  list.back().at[1] = list.front().at[1];
  list.back().count = list.front().count;
  // A loop, or a gap, between two rulings: there the discriminant has an extreme value of the other sign.
  std::vector<Ruling> extra;
  for (int n = 0; n < kRulings; ++n) {
    const auto at = [&](int k) {
      return list[static_cast<std::size_t>((k + kRulings) % kRulings)].discriminant;
    };
    const double sign = at(n) < 0 ? 1 : -1; // looked for: a greatest value, or a least one
    if (at(n - 1) * at(n) < 0 || at(n) * at(n + 1) < 0) continue;
    if (sign * at(n - 1) > sign * at(n) || sign * at(n + 1) > sign * at(n)) continue;
    // Between rulings it gains about an eighth of its second difference.
    if (std::abs(at(n)) > std::abs(at(n - 1) - 2 * at(n) + at(n + 1))) continue;
    double from = (n - 1) * step, to = (n + 1) * step;
    for (int k = 0; k < 60; ++k) {
      const double one = from + (to - from) * 0.382, two = from + (to - from) * 0.618;
      if (sign * ruling(one, i, j).discriminant > sign * ruling(two, i, j).discriminant)
        to = two;
      else
        from = one;
    }
    Ruling found = ruling((from + to) / 2, i, j);
    if (found.discriminant * at(n) >= 0) continue;
    if (found.angle < 0) found.angle += 2 * std::numbers::pi;
    extra.push_back(found);
  }
  list.insert(list.end(), extra.begin(), extra.end());
  std::stable_sort(list.begin(), list.end(),
                   [](const Ruling& a, const Ruling& b) { return a.angle < b.angle; });
  for (std::size_t n = 1; n < list.size(); ++n) {
    if (!link(list[n - 1], list[n], i, j, 0)) return false;
  }
  return true;
}

bool Solid::link(const Ruling& a, const Ruling& b, std::uint32_t i, std::uint32_t j, int depth) const {
  if (edges_->work > mostWork_) return false;
  if (a.count == 0 && b.count == 0) return true;
  const auto split = [&] {
    const Ruling middle = ruling((a.angle + b.angle) / 2, i, j);
    return link(a, middle, i, j, depth + 1) && link(middle, b, i, j, depth + 1);
  };
  if (a.discriminant * b.discriminant < 0 && (a.discriminant < 0 || b.discriminant < 0)) {
    // The curve turns back: up to where its two ways meet.
    const bool falls = a.discriminant > 0;
    double in = falls ? a.angle : b.angle, out = falls ? b.angle : a.angle;
    for (int n = 0; n < 100 && in != (in + out) / 2 && out != (in + out) / 2; ++n)
      (ruling((in + out) / 2, i, j).discriminant >= 0 ? in : out) = (in + out) / 2;
    Ruling last = ruling(in, i, j);
    if (last.count == 2) { // where the two ways meet, one point of the curve
      last.at[0] = last.at[1] = (last.at[0] + last.at[1]) / 2;
    }
    last.discriminant = 0;
    return falls ? link(a, last, i, j, depth) : link(last, b, i, j, depth);
  }
  Piece pieces[2];
  int count = std::min(a.count, b.count);
  // The nearer pairing: one root may have gone through infinity.
  const bool crossed =
      a.count == 2 && b.count == 2
          ? (a.at[0] - b.at[1]).norm() + (a.at[1] - b.at[0]).norm() <
                (a.at[0] - b.at[0]).norm() + (a.at[1] - b.at[1]).norm()
          : count == 1 &&
                (a.count == 2 ? (a.at[1] - b.at[0]).norm() < (a.at[0] - b.at[0]).norm()
                              : b.count == 2 && (a.at[0] - b.at[1]).norm() < (a.at[0] - b.at[0]).norm());
  for (int n = 0; n < count; ++n) {
    pieces[n].a = a.at[crossed && (a.count == 2) && count == 1 ? 1 : n];
    pieces[n].b = b.at[crossed && b.count == 2 ? 1 - n : n];
    pieces[n].first = i;
    pieces[n].second = j;
  }
  for (int n = 0; n < count; ++n) {
    Piece& piece = pieces[n];
    const double length = (piece.b - piece.a).norm();
    if (length < 1e-9) continue;
    if (!isOnOwners((piece.a + piece.b) / 2, piece, 2 * length)) continue; // far from both shapes
    if (smooth(piece)) continue;
    if (depth < kDepth) return split();
    if (length > 0.01) return false;
    piece.sag = length;
  }
  for (int n = 0; n < count; ++n) {
    const double length = (pieces[n].b - pieces[n].a).norm();
    if (length < 1e-9 || !isOnOwners((pieces[n].a + pieces[n].b) / 2, pieces[n], 2 * length)) continue;
    if (!keep(pieces[n], 0)) return false;
  }
  return true;
}

// Whether the piece is so short that it is nearly straight; sets its sag, with a margin.
bool Solid::smooth(Piece& piece) const {
  edges_->work += 20;
  Vec q;
  const double length = (piece.b - piece.a).norm();
  if (!onCurve(piece, 0.5, q)) return false;
  const double sag = (q - (piece.a + piece.b) / 2).norm();
  piece.sag = 2 * sag + 1e-12;
  return sag <= 0.03 * length;
}

bool Solid::isOnOwners(const Vec& q, const Piece& piece, double reach) const {
  return std::abs(shapes[surfaces_[piece.first].shape].distance(q)) <= reach &&
         std::abs(shapes[surfaces_[piece.second].shape].distance(q)) <= reach;
}

bool Solid::isKept(const Vec& q, const Piece& piece) const {
  edges_->work += 2;
  if (!isOnOwners(q, piece, 1e-6)) return false;
  edges_->work += 4 * static_cast<double>(shapes.size());
  const Vec n = surfaces_[piece.first].normal(q), m = surfaces_[piece.second].normal(q);
  return n.cross(m).norm() > kTangent && isEdge(q, n, m);
}

// How far the surface's value may lie off the straight line between the ends of a piece.
double Solid::bend(const Surface& surface, const Piece& piece, double length) {
  if (surface.kind == Surface::Kind::Plane) return 2 * piece.sag;
  if (surface.kind == Surface::Kind::Cone || length > surface.radius / 4) return length;
  return 2 * piece.sag + length * length / (2 * surface.radius);
}

// Where the surface crosses the piece, whose ends lie on different sides of it.
double Solid::crossing(const Piece& piece, const Surface& surface, double atBegin, double atEnd) const {
  double from = 0, to = 1;
  int last = 0;
  for (int n = 0; n < 60 && to - from > 1e-15; ++n) {
    const double u = n < 40 ? (from * atEnd - to * atBegin) / (atEnd - atBegin) : (from + to) / 2;
    edges_->work += 20;
    Vec q;
    if (!onCurve(piece, u, q)) q = piece.a + u * (piece.b - piece.a);
    const double value = surface.value(q);
    if (std::abs(value) < 1e-13) return u;
    // Illinois: an end that stays twice counts half.
    if (value * atBegin > 0) {
      from = u;
      atBegin = value;
      if (last > 0) atEnd /= 2;
      last = 1;
    } else {
      to = u;
      atEnd = value;
      if (last < 0) atBegin /= 2;
      last = -1;
    }
  }
  return (from + to) / 2;
}

// Cuts a curved piece where other surfaces cross it and keeps what is an edge of the part.
bool Solid::keep(const Piece& piece, int depth) const {
  if (edges_->work > mostWork_) return false;
  const double length = (piece.b - piece.a).norm(), reach = length + piece.sag + 1e-6;
  const Vec centre = (piece.a + piece.b) / 2;
  if (!isOnOwners(centre, piece, reach)) return true;
  edges_->work += static_cast<double>(shapes.size());
  // Far from all that is left of the part it is no edge, and cuts in it would be for nothing.
  if (std::abs(shapesBound(centre)) > reach) return true;
  edges_->work += static_cast<double>(2 * surfaces_.size());
  std::vector<double> cuts = {0, 1};
  bool halve = false;
  for (std::uint32_t k = 0; k < surfaces_.size(); ++k) {
    if (k == piece.first || k == piece.second) continue;
    const double va = surfaces_[k].value(piece.a), vb = surfaces_[k].value(piece.b);
    if (std::abs(va) < 1e-9 && std::abs(vb) < 1e-9) continue; // goes along with it
    const bool crosses = va * vb < 0;
    const bool mayCrossTwice = !crosses && std::abs(va) + std::abs(vb) < 1.2 * length && length > kShort &&
                               std::min(std::abs(va), std::abs(vb)) <= bend(surfaces_[k], piece, length);
    if (!crosses && !mayCrossTwice) continue;
    edges_->work += 1;
    // A surface has no end; its shape has.
    if (std::abs(shapes[surfaces_[k].shape].distance(centre)) > reach) continue;
    if (crosses)
      cuts.push_back(crossing(piece, surfaces_[k], va, vb));
    else
      halve = true;
  }
  Vec middle;
  if (halve && depth < 24 && onCurve(piece, 0.5, middle)) {
    Piece left = piece, right = piece;
    left.b = right.a = middle;
    return (!smooth(left) || keep(left, depth + 1)) && (!smooth(right) || keep(right, depth + 1));
  }
  std::sort(cuts.begin(), cuts.end());
  const auto point = [&](double u) {
    Vec q;
    if (u <= 0) return piece.a;
    if (u >= 1) return piece.b;
    return onCurve(piece, u, q) ? q : Vec(piece.a + u * (piece.b - piece.a));
  };
  for (std::size_t n = 1; n < cuts.size(); ++n) {
    if (cuts[n] - cuts[n - 1] < 1e-12) continue;
    if (!isKept(point((cuts[n - 1] + cuts[n]) / 2), piece)) continue;
    Piece part = piece;
    part.a = point(cuts[n - 1]);
    part.b = point(cuts[n]);
    edges_->pieces.push_back(part);
  }
  return true;
}

bool Solid::onCurve(const Piece& piece, double u, Vec& q) const {
  const Surface &s = surfaces_[piece.first], &t = surfaces_[piece.second];
  const Vec chord = piece.b - piece.a;
  const double length = chord.norm();
  if (!(length > 0)) return false;
  const Vec c = chord / length;
  const Vec start = piece.a + u * chord;
  q = start;
  for (int n = 0; n < 20; ++n) {
    const Vec ns = s.normal(q), nt = t.normal(q);
    const Vec residual(s.value(q), t.value(q), (q - start).dot(c));
    Rot m;
    m << ns.transpose(), nt.transpose(), c.transpose();
    const double determinant = m.determinant();
    if (std::abs(determinant) < 1e-9) return false;
    const Vec step = m.inverse() * residual;
    q -= step;
    if ((q - start).norm() > length) return false;
    if (step.norm() < 1e-12 * (1 + q.norm())) return true;
  }
  return false;
}

void Solid::nearestOnPiece(const Vec& p, const Piece& piece, double& best, Vec& point) const {
  const Vec chord = piece.b - piece.a;
  const auto take = [&](const Vec& q) {
    if (const double d = (p - q).norm(); d < best) {
      best = d;
      point = q;
    }
  };
  // How far p lies ahead along the curve: the root is the nearest point.
  const auto ahead = [&](const Vec& q) {
    Vec tangent = surfaces_[piece.first].normal(q).cross(surfaces_[piece.second].normal(q));
    const double length = tangent.norm();
    if (!(length > 0)) return chord.dot(p - q) / chord.norm();
    if (tangent.dot(chord) < 0) tangent = -tangent;
    return tangent.dot(p - q) / length;
  };
  double from = 0, to = 1, hf = ahead(piece.a), ht = ahead(piece.b);
  if (hf <= 0) take(piece.a);
  if (ht >= 0) take(piece.b);
  if (hf <= 0 || ht >= 0) return;
  Vec q = piece.a;
  int last = 0;
  for (int n = 0; n < 60; ++n) {
    const double u = n < 40 ? (from * ht - to * hf) / (ht - hf) : (from + to) / 2;
    if (!onCurve(piece, u, q)) {
      take(piece.a);
      take(piece.b);
      return;
    }
    const double h = ahead(q);
    if (std::abs(h) < 1e-9 || to - from < 1e-14) break;
    // Illinois: an end that stays twice counts half.
    if (h > 0) {
      from = u;
      hf = h;
      if (last > 0) ht /= 2;
      last = 1;
    } else {
      to = u;
      ht = h;
      if (last < 0) hf /= 2;
      last = -1;
    }
  }
  take(q);
}

} // namespace dotek::sim
