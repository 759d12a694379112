// A virtual part: shapes that are added, removed or kept in order, placed in the machine. Lengths in mm,
// angles in degrees. Reading parts from files: sim/geometry/PartFile.h; what touches them:
// sim/geometry/Contact.h.
#pragma once

#include "sim/geometry/Point.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::sim {

class Solid;

// A turn about the part's zero, first about X, then Y, then Z of the frame that does not move; then a shift.
struct Placement {
  Point3 shift;
  Point3 turn; // degrees
};

// A part that cannot be changed any more; copies share it. Distances are of the machine's frame.
class Part {
public:
  // The same part elsewhere: where it is meant to be, and what that is off by. A point goes to
  // nominal.shift + error.shift + error.turn (nominal.turn (point)); what was set before is forgotten.
  Part placed(const Placement& nominal, const Placement& error = {}) const;

  // To the surface, negative inside the material; exact to about 1e-9 mm. Inside, where a mesh and other
  // pieces overlap, it may be less deep than the truth.
  double distance(const Point3& p) const;
  // Nearest point of the surface, and the unit vector that points away from the material there.
  struct Nearest {
    Point3 point, normal;
    double distance = 0;
  };
  Nearest nearest(const Point3& p) const;

  Point3 toPart(const Point3& machine) const;
  Point3 toMachine(const Point3& part) const;
  Point3 turnToPart(const Point3& direction) const;
  Point3 turnToMachine(const Point3& direction) const;
  const Solid& solid() const { return *solid_; } // of one that is not empty
  // Made by no builder: there is nothing that could be touched, and nothing else may be asked.
  bool isEmpty() const { return solid_ == nullptr; }

private:
  friend class PartBuilder;
  std::shared_ptr<const Solid> solid_;
  std::array<double, 9> turn_{1, 0, 0, 0, 1, 0, 0, 0, 1}; // row by row
  Point3 shift_;
};

// Makes a part, shape by shape:
//
//   PartBuilder builder;
//   builder.box({0, 0, -20}, {100, 60, 0});
//   builder.cylinder({50, 30, -20}, {50, 30, 0}, 19.0, PartBuilder::Action::Remove);
//   std::string fault;
//   std::unique_ptr<Part> part = builder.finish(fault);
//
// Each shape works on what the shapes before it (of the same group) have made. Sizes that make no solid are
// refused by finish().
class PartBuilder {
public:
  enum class Action : std::uint8_t { Add, Remove, Keep };
  static constexpr std::size_t kMostShapes = 200;
  static constexpr std::size_t kMostDepth = 16;
  static constexpr double kLeastSize = 0.001; // mm

  PartBuilder();
  ~PartBuilder();
  PartBuilder(const PartBuilder&) = delete;
  PartBuilder& operator=(const PartBuilder&) = delete;

  // Everything behind the plane through `point`; `normal` points out of the material.
  void halfSpace(const Point3& point, const Point3& normal, Action action = Action::Add);
  // Parallel to the axes before it is turned about its middle. The edges along Z are rounded by `corner`.
  void box(const Point3& least, const Point3& most, Action action = Action::Add, double corner = 0,
           const Point3& turn = {});
  // A box by its middle; `axis` is its Z, `side` (across it) its X. Half sizes.
  void block(const Point3& middle, const Point3& axis, const Point3& side, const Point3& half, double corner,
             Action action);
  void cylinder(const Point3& bottom, const Point3& top, double radius, Action action = Action::Add);
  // One of the radii may be 0.
  void cone(const Point3& bottom, double bottomRadius, const Point3& top, double topRadius,
            Action action = Action::Add);
  void sphere(const Point3& centre, double radius, Action action = Action::Add);
  // An STL file's bytes, times `scale`, turned and shifted. What is wrong with it; empty: nothing.
  std::string mesh(std::string_view stl, double scale, const Placement& placement = {});

  // What comes between the two is made for itself; then it works as one shape.
  void beginGroup(Action action);
  void endGroup();

  // How many times, about, a surface may be evaluated to find the edges; 1e8 where it is not called.
  void limitWork(double most);
  // What is wrong so far; empty: nothing.
  const std::string& fault() const { return fault_; }
  std::size_t shapeCount() const;
  // Nothing where a size was refused, the part is empty, or it is more than a bounded amount of work to find
  // its edges; `fault` says what.
  std::unique_ptr<Part> finish(std::string& fault);

private:
  struct State;
  void refuse(const std::string& what);
  std::unique_ptr<State> state_;
  std::string fault_;
};

} // namespace dotek::sim
