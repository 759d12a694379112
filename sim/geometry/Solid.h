// What shapes make together: adding, removing, keeping, in order. Distances that are exact, and cheap bounds
// of them. Private to the part.
#pragma once

#include "sim/geometry/Mesh.h"
#include "sim/geometry/Shape.h"

#include <limits>
#include <vector>

namespace dotek::sim {

// The nearest point of a surface. `normal` points away from the material, as seen from the point asked.
struct Foot {
  Vec point = Vec::Zero(), normal = Vec::UnitZ();
  double distance = std::numeric_limits<double>::infinity(); // negative inside the material
};

class Solid {
public:
  enum class Action : std::uint8_t { Add, Remove, Keep };

  // A list of nodes is worked off in order: what an `Add` gives is united with what is there, and so on.
  struct Node {
    Action action = Action::Add;
    std::int32_t shape = -1; // of shapes; -1: a group, its list follows
    std::int32_t mesh = -1;  // of meshes
    std::vector<Node> group;
  };

  std::vector<Shape> shapes;
  std::vector<Mesh> meshes; // in lists of Add only
  std::vector<Node> nodes;

  // Finds faces, edges and corners. false: that takes more than a bounded amount of work, or the curve in
  // which two surfaces meet cannot be followed.
  bool build();
  // As PartBuilder::limitWork.
  void limitWork(double most) { mostWork_ = most; }

  // Never more than the true distance; its sign is right. Cheap.
  double bound(const Vec& p) const;
  // A lower bound of the distance on a patch.
  double lowest(const Patch& patch) const { return endOf(nodes, patch, true); }
  // The true distance to the surface, to about 1e-9 mm. Inside a part of several pieces that overlap a mesh
  // it is a bound.
  Foot foot(const Vec& p) const;

  // The same without the meshes; there are shapes.
  double shapesBound(const Vec& p) const { return boundOf(solidNodes_, p, nullptr); }
  double shapesLowest(const Patch& patch) const { return endOf(solidNodes_, patch, true); }
  Foot shapesFoot(const Vec& p) const;
  // Whether anything of it may lie between the corners `least` and `most` of a box.
  bool mayLieIn(const Vec& least, const Vec& most) const;
  // Whether nothing is left of it.
  bool isEmpty() const;

private:
  // A short way along the curve in which two surfaces meet, from a to b.
  struct Piece {
    Vec a, b;
    double sag = 0; // the curve stays within this of the chord
    std::uint32_t first = 0, second = 0;
  };
  struct Chain {
    Vec centre = Vec::Zero();
    double radius = 0;
    std::size_t begin = 0, end = 0; // of pieces_
  };

  double boundOf(const std::vector<Node>& list, const Vec& p, std::int32_t* nearest) const;
  // The least value on a patch, or the greatest; a bound.
  double endOf(const std::vector<Node>& list, const Patch& patch, bool least) const;
  void openMouths(std::vector<Node>& list);
  bool isBoundary(const Vec& q, const Vec& normal) const;
  bool isEdge(const Vec& q, const Vec& first, const Vec& second) const;
  void footOnShapes(const Vec& p, Foot& best) const;
  void footOnEdges(const Vec& p, double& best, Vec& point) const;

  // ---- Edges.cpp
  struct Ruling;
  bool findEdges();
  bool meet(std::uint32_t i, std::uint32_t j);
  bool straight(const Vec& o, const Vec& d, std::uint32_t i, std::uint32_t j);
  bool circle(const Vec& centre, const Vec& axis, double radius, std::uint32_t i, std::uint32_t j);
  bool rulings(std::uint32_t i, std::uint32_t j);
  bool link(const Ruling& a, const Ruling& b, std::uint32_t i, std::uint32_t j, int depth);
  Ruling ruling(double angle, std::uint32_t i, std::uint32_t j);
  bool smooth(Piece& piece) const;
  bool keep(const Piece& piece, int depth);
  static double bend(const Surface& surface, const Piece& piece, double length);
  bool isOnOwners(const Vec& q, const Piece& piece, double reach) const;
  bool isKept(const Vec& q, const Piece& piece);
  // The point of the curve in the plane across the chord at share u of the chord. false: none is found.
  bool onCurve(const Piece& piece, double u, Vec& q) const;
  void nearestOnPiece(const Vec& p, const Piece& piece, double& best, Vec& point) const;
  void addChains(std::size_t begin);

  // A box that holds one of the pieces that are added.
  struct Box {
    Vec least, most;
  };
  bool addBoxes(const std::vector<Node>& list); // false: one has no end
  static Box boxOf(const Shape& shape);         // may be without end
  bool mayTouch(std::uint32_t shape, const Box& box) const;

  std::vector<Node> solidNodes_; // nodes without meshes
  std::vector<Box> boxes_;       // none: not bounded
  std::vector<Box> shapeBoxes_;  // by shape
  std::vector<Surface> surfaces_;
  std::vector<Piece> pieces_;
  std::vector<Chain> chains_;
  std::vector<Vec> corners_;
  double work_ = 0, mostWork_ = 1e8; // of build(): evaluations of a surface, about
};

} // namespace dotek::sim
