// What shapes make together: adding, removing, keeping, in order. Distances that are exact, and cheap bounds
// of them. Private to the part.
#pragma once

#include "sim/geometry/Mesh.h"
#include "sim/geometry/Shape.h"

#include <limits>
#include <memory>
#include <mutex>
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

  // Finds faces, edges and corners; edges of a few blocks, which can always be found, when they are first
  // asked for. false: that takes more than a bounded amount of work, or the curve in which two surfaces meet
  // cannot be followed.
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
  // Whether each shape that is added has a face whose plane keeps the patch away from it by more than
  // `reach`. false: not known.
  bool isBeyond(const Patch& patch, double reach) const;
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
    std::size_t begin = 0, end = 0; // of pieces
  };
  struct Edges {
    std::once_flag found;
    std::vector<Piece> pieces;
    std::vector<Chain> chains;
    double work = 0; // evaluations of a surface, about
  };
  const Edges& edges() const;

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
  bool findEdges() const; // into edges_
  bool mayWait() const;   // findEdges() cannot fail
  bool meet(std::uint32_t i, std::uint32_t j) const;
  bool straight(const Vec& o, const Vec& d, std::uint32_t i, std::uint32_t j) const;
  bool circle(const Vec& centre, const Vec& axis, double radius, std::uint32_t i, std::uint32_t j) const;
  bool rulings(std::uint32_t i, std::uint32_t j) const;
  bool link(const Ruling& a, const Ruling& b, std::uint32_t i, std::uint32_t j, int depth) const;
  Ruling ruling(double angle, std::uint32_t i, std::uint32_t j) const;
  bool smooth(Piece& piece) const;
  double crossing(const Piece& piece, const Surface& surface, double atBegin, double atEnd) const;
  bool keep(const Piece& piece, int depth) const;
  static double bend(const Surface& surface, const Piece& piece, double length);
  bool isOnOwners(const Vec& q, const Piece& piece, double reach) const;
  bool isKept(const Vec& q, const Piece& piece) const;
  // The point of the curve in the plane across the chord at share u of the chord. false: none is found.
  bool onCurve(const Piece& piece, double u, Vec& q) const;
  void nearestOnPiece(const Vec& p, const Piece& piece, double& best, Vec& point) const;
  void addChains(std::size_t begin) const;

  // A box that holds one of the pieces that are added.
  struct Box {
    Vec least, most;
  };
  bool addBoxes(const std::vector<Node>& list); // false: one has no end
  static Box boxOf(const Shape& shape);         // may be without end
  bool mayTouch(std::uint32_t shape, const Box& box) const;

  std::vector<Node> solidNodes_;     // nodes without meshes
  std::vector<Box> boxes_;           // none: not bounded
  std::vector<std::uint32_t> added_; // shapes of boxes_
  std::vector<Box> shapeBoxes_;      // by shape
  std::vector<Surface> surfaces_;
  std::unique_ptr<Edges> edges_ = std::make_unique<Edges>();
  std::vector<Vec> corners_;
  bool waits_ = false; // edges are found when they are asked for
  double mostWork_ = 1e8;
};

} // namespace dotek::sim
