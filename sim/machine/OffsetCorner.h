// Cutter compensation as geometry: a path in a plane, offset to its side by a radius.
#pragma once

#include <optional>
#include <vector>

namespace dotek::sim {

struct PlanePoint {
  double u = 0, v = 0;
};

// A move as the program has it: straight, or an arc about its centre; one that ends where it begins is a
// circle.
struct PlaneMove {
  PlanePoint from, to;
  bool arc = false, clockwise = false;
  PlanePoint centre{};
};

// How the offset path goes on from one move to the next.
struct OffsetCorner {
  PlanePoint end;                // of the first move
  bool round = false;            // the link is an arc about the corner
  std::vector<PlanePoint> links; // ends of what lies between; the last one is `begin`
  PlanePoint begin;              // of the second move
};

// `radius`: to the left of the path, negative to the right. `round`: an outside corner is an arc, else the
// tangents are prolonged until they meet, or by the radius where the path turns by more than a right angle.
// nullopt: the offset moves of an inside corner do not meet.
std::optional<OffsetCorner> offsetCorner(const PlaneMove& first, const PlaneMove& second, double radius,
                                         bool round);
// At a right angle to the move at its begin and at its end.
PlanePoint offsetBegin(const PlaneMove& move, double radius);
PlanePoint offsetEnd(const PlaneMove& move, double radius);
// The radius of the offset arc; not above 0: the tool does not fit.
double offsetArcRadius(const PlaneMove& arc, double radius);
// The offset move from `begin` to `end` goes against the move itself.
bool goesBack(const PlaneMove& move, PlanePoint begin, PlanePoint end);
bool isSame(PlanePoint a, PlanePoint b, double tolerance = 1e-6);

} // namespace dotek::sim
