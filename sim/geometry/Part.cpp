#include "sim/geometry/Part.h"

#include "sim/geometry/Solid.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace dotek::sim {
namespace {

Vec vec(const Point3& p) {
  return {p.x, p.y, p.z};
}
Point3 point(const Vec& v) {
  return {v.x(), v.y(), v.z()};
}

bool isFinite(const Point3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}
bool isNear(const Point3& p) {
  return isFinite(p) && std::abs(p.x) <= kFar && std::abs(p.y) <= kFar && std::abs(p.z) <= kFar;
}

// Right angles are exact.
void sineCosine(double degrees, double& s, double& c) {
  const double turn = std::remainder(degrees, 360.0);
  const double quarters = turn / 90;
  if (quarters == std::floor(quarters)) {
    constexpr double kSine[4] = {0, 1, 0, -1};
    const int n = (static_cast<int>(quarters) + 4) % 4;
    s = kSine[n];
    c = kSine[(n + 1) % 4];
    return;
  }
  s = std::sin(turn * std::numbers::pi / 180);
  c = std::cos(turn * std::numbers::pi / 180);
}

Rot turned(const Point3& turn) {
  double s = 0, c = 1;
  Rot x, y, z;
  sineCosine(turn.x, s, c);
  x << 1, 0, 0, 0, c, -s, 0, s, c;
  sineCosine(turn.y, s, c);
  y << c, 0, s, 0, 1, 0, -s, 0, c;
  sineCosine(turn.z, s, c);
  z << c, -s, 0, s, c, 0, 0, 0, 1;
  return z * y * x;
}

// Axes with the given Z. Along an axis of the frame they are exact.
Rot axesAlong(const Vec& z) {
  Rot out;
  const Vec x = std::abs(z.z()) > 0.9 ? Vec(Vec::UnitX() - z.x() * z).normalized() : across(z);
  out << x, z.cross(x), z;
  return out;
}

} // namespace

Part Part::placed(const Placement& nominal, const Placement& error) const {
  Part out = *this;
  const Rot turn = turned(error.turn) * turned(nominal.turn);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      out.turn_[static_cast<std::size_t>(row * 3 + column)] = turn(row, column);
  }
  out.shift_ = nominal.shift + error.shift;
  return out;
}

Point3 Part::turnToPart(const Point3& d) const {
  return {turn_[0] * d.x + turn_[3] * d.y + turn_[6] * d.z, turn_[1] * d.x + turn_[4] * d.y + turn_[7] * d.z,
          turn_[2] * d.x + turn_[5] * d.y + turn_[8] * d.z};
}
Point3 Part::turnToMachine(const Point3& d) const {
  return {turn_[0] * d.x + turn_[1] * d.y + turn_[2] * d.z, turn_[3] * d.x + turn_[4] * d.y + turn_[5] * d.z,
          turn_[6] * d.x + turn_[7] * d.y + turn_[8] * d.z};
}
Point3 Part::toPart(const Point3& machine) const {
  return turnToPart(machine - shift_);
}
Point3 Part::toMachine(const Point3& part) const {
  return turnToMachine(part) + shift_;
}

double Part::distance(const Point3& p) const {
  return solid_->foot(vec(toPart(p))).distance;
}

Part::Nearest Part::nearest(const Point3& p) const {
  const Foot foot = solid_->foot(vec(toPart(p)));
  return {toMachine(point(foot.point)), turnToMachine(point(foot.normal)), foot.distance};
}

// ---- making

struct PartBuilder::State {
  Solid solid;
  std::vector<std::vector<Solid::Node>> open; // lists that are not closed yet, the outermost first
  std::vector<Solid::Action> actions;         // of the groups they become

  static Solid::Action of(Action action) {
    return action == Action::Add      ? Solid::Action::Add
           : action == Action::Remove ? Solid::Action::Remove
                                      : Solid::Action::Keep;
  }
  void add(const Shape& shape, Action action) {
    Solid::Node node;
    node.action = of(action);
    node.shape = static_cast<std::int32_t>(solid.shapes.size());
    solid.shapes.push_back(shape);
    open.back().push_back(node);
  }
};

PartBuilder::PartBuilder() : state_(std::make_unique<State>()) {
  state_->open.emplace_back();
}
PartBuilder::~PartBuilder() = default;

void PartBuilder::refuse(const std::string& what) {
  if (fault_.empty()) fault_ = what;
}

std::size_t PartBuilder::shapeCount() const {
  return state_->solid.shapes.size() + state_->solid.meshes.size();
}

void PartBuilder::halfSpace(const Point3& at, const Point3& normal, Action action) {
  const Vec n = vec(normal);
  if (!isNear(at) || !isFinite(normal) || !(n.norm() > 1e-9)) return refuse("a half-space has no normal");
  Shape shape;
  shape.kind = Shape::Kind::HalfSpace;
  shape.origin = vec(at);
  shape.axes = axesAlong(n.normalized());
  state_->add(shape, action);
}

void PartBuilder::box(const Point3& least, const Point3& most, Action action, double corner,
                      const Point3& turn) {
  const Rot axes = turned(turn);
  block((least + most) * 0.5, point(axes.col(2)), point(axes.col(0)), (most - least) * 0.5, corner, action);
}

void PartBuilder::block(const Point3& middle, const Point3& axis, const Point3& side, const Point3& half,
                        double corner, Action action) {
  if (!isNear(middle) || !isNear(half) || !isFinite(axis) || !isFinite(side))
    return refuse(fmt::format("a box reaches beyond {} mm", kFar));
  if (!(std::min({half.x, half.y, half.z}) * 2 >= kLeastSize))
    return refuse(fmt::format("a box has a side below {} mm", kLeastSize));
  if (!(corner >= 0) || corner > std::min(half.x, half.y) * (1 + 1e-12))
    return refuse("the corners of a box are rounder than its sides are wide");
  const Vec z = vec(axis).normalized();
  const Vec x = (vec(side) - vec(side).dot(z) * z).normalized();
  Shape shape;
  shape.kind = Shape::Kind::Block;
  shape.origin = vec(middle);
  shape.axes << x, z.cross(x), z;
  if (!shape.axes.allFinite() || std::abs(shape.axes.determinant() - 1) > 1e-6)
    return refuse("a box has no axes");
  shape.a = half.x;
  shape.b = half.y;
  shape.c = half.z;
  shape.d = std::min({corner, half.x, half.y});
  state_->add(shape, action);
}

void PartBuilder::cylinder(const Point3& bottom, const Point3& top, double radius, Action action) {
  const Vec axis = vec(top) - vec(bottom);
  if (!isNear(bottom) || !isNear(top) || !(radius <= kFar))
    return refuse(fmt::format("a cylinder reaches beyond {} mm", kFar));
  if (!(axis.norm() >= kLeastSize) || !(radius * 2 >= kLeastSize))
    return refuse(fmt::format("a cylinder has a size below {} mm", kLeastSize));
  Shape shape;
  shape.kind = Shape::Kind::Block;
  shape.origin = (vec(bottom) + vec(top)) / 2;
  shape.axes = axesAlong(axis.normalized());
  shape.a = shape.b = shape.d = radius;
  shape.c = axis.norm() / 2;
  state_->add(shape, action);
}

void PartBuilder::cone(const Point3& bottom, double bottomRadius, const Point3& top, double topRadius,
                       Action action) {
  if (bottomRadius == topRadius) return cylinder(bottom, top, bottomRadius, action);
  const Vec axis = vec(top) - vec(bottom);
  const double height = axis.norm();
  if (!isNear(bottom) || !isNear(top) || !(bottomRadius <= kFar) || !(topRadius <= kFar))
    return refuse(fmt::format("a cone reaches beyond {} mm", kFar));
  const auto usable = [](double r) { return r == 0 || r * 2 >= kLeastSize; };
  if (!(height >= kLeastSize) || !usable(bottomRadius) || !usable(topRadius))
    return refuse(fmt::format("a cone has a size below {} mm", kLeastSize));
  // Flatter or steeper ones are plates and cylinders but for the last digits.
  if (const double slope = std::abs(bottomRadius - topRadius) / height; slope < 1e-6 || slope > 1e6)
    return refuse("a cone has almost the angle of a cylinder or of a plane");
  Shape shape;
  shape.kind = Shape::Kind::Cone;
  shape.origin = (vec(bottom) + vec(top)) / 2;
  shape.axes = axesAlong(axis / height);
  shape.a = bottomRadius;
  shape.b = topRadius;
  shape.c = height / 2;
  state_->add(shape, action);
}

void PartBuilder::sphere(const Point3& centre, double radius, Action action) {
  if (!isNear(centre) || !(radius <= kFar)) return refuse(fmt::format("a sphere reaches beyond {} mm", kFar));
  if (!(radius * 2 >= kLeastSize)) return refuse(fmt::format("a sphere is smaller than {} mm", kLeastSize));
  Shape shape;
  shape.origin = vec(centre);
  shape.a = radius;
  state_->add(shape, action);
}

std::string PartBuilder::mesh(std::string_view stl, double scale, const Placement& placement) {
  Mesh mesh;
  if (std::string fault = mesh.readStl(stl, scale); !fault.empty()) return fault;
  if (!isNear(placement.shift) || !isFinite(placement.turn)) return "it is placed nowhere";
  mesh.place(turned(placement.turn), vec(placement.shift));
  Solid::Node node;
  node.mesh = static_cast<std::int32_t>(state_->solid.meshes.size());
  state_->solid.meshes.push_back(std::move(mesh));
  state_->open.back().push_back(node);
  return "";
}

void PartBuilder::beginGroup(Action action) {
  state_->actions.push_back(State::of(action));
  state_->open.emplace_back();
}

void PartBuilder::endGroup() {
  if (state_->actions.empty()) return refuse("a group ends that has not begun");
  Solid::Node node;
  node.action = state_->actions.back();
  node.group = std::move(state_->open.back());
  if (node.group.empty()) refuse("a group is empty");
  state_->actions.pop_back();
  state_->open.pop_back();
  state_->open.back().push_back(std::move(node));
}

namespace {

// A list that only adds, as far as it holds a mesh; and that begins with adding.
std::string checkList(const std::vector<Solid::Node>& list, bool& mesh, std::size_t depth) {
  if (depth > PartBuilder::kMostDepth) return "groups are nested too deeply";
  bool others = false;
  bool here = false;
  for (const Solid::Node& node : list) {
    if (&node == list.data() && node.action != Solid::Action::Add)
      return "the first shape of a list removes or keeps, and nothing is there yet";
    bool inside = node.mesh >= 0;
    if (std::string fault = checkList(node.group, inside, depth + 1); !fault.empty()) return fault;
    here = here || inside;
    others = others || node.action != Solid::Action::Add;
  }
  mesh = mesh || here;
  if (here && others)
    return "a list with a mesh removes or keeps something; edges with a mesh are not known; model it in the "
           "CAD";
  return "";
}

} // namespace

void PartBuilder::limitWork(double most) {
  state_->solid.limitWork(most);
}

std::unique_ptr<Part> PartBuilder::finish(std::string& fault) {
  if (!state_->actions.empty()) refuse("a group is not ended");
  state_->solid.nodes = std::move(state_->open.front());
  if (state_->solid.nodes.empty()) refuse("the part has no shape");
  if (shapeCount() > kMostShapes) refuse(fmt::format("the part has more than {} shapes", kMostShapes));
  bool mesh = false;
  if (fault_.empty()) fault_ = checkList(state_->solid.nodes, mesh, 0);
  if (fault_.empty() && !state_->solid.build())
    refuse(
        "too many of its shapes cross each other, or two surfaces touch in a path that cannot be followed");
  if (fault_.empty() && state_->solid.isEmpty()) refuse("nothing is left of the part");
  fault = fault_;
  if (!fault_.empty()) return nullptr;
  auto part = std::make_unique<Part>();
  part->solid_ = std::make_shared<const Solid>(std::move(state_->solid));
  state_ = std::make_unique<State>();
  state_->open.emplace_back();
  return part;
}

} // namespace dotek::sim
