// What the programmer of a cycle saw: ToolPath.mac executed on a point, and the touches that it shows. The
// rules are in docs/verify.md.
#pragma once

#include "frontend/gibbs/Run.h"
#include "sim/geometry/Part.h"
#include "verify/Record.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dotek::verify {

// A feed move along one axis, downward if Z, which the next move takes back along the same axis. In X and Y
// the move ends where the ball's centre is, the contact lies one radius further, at the height of the ball's
// centre (one radius above the path); in Z it ends at the contact. The path back from a touch is no touch
// itself as long as it ends on the path that led there.
struct DrawnTouch {
  Touch touch;
  std::size_t move = 0; // place in DrawnPath::points of its end
  SourceRange range;
};

struct DrawnPath {
  std::vector<sim::Point3> points; // `start` first, then the end of each move; lowest points of the ball
  std::vector<SourceRange> ranges; // of each point; of the start none
  std::vector<DrawnTouch> touches; // in the order of the path

  std::vector<Touch> nominal() const;
};

// `start`: where the stylus's lowest point is before, the point of the operation in X and Y; Z of the
// path counts from `retract`. `start` and the result are in one system of coordinates, mm. A move along one
// axis leaves the others where they were, at the beginning those of `start`.
DrawnPath drawnPath(const std::vector<frontend::gibbs::PathMove>& path, const sim::Point3& start,
                    double retract, double ballRadius);

// Where the part is off its nominal place: moved, and turned about Z through the middle of its touches.
struct PartError {
  sim::Point3 shift; // mm
  double turn = 0;   // degrees
};

// How far the faces of partOf() go above and below the ball's centre, mm.
constexpr double kFaceHalf = 3;
// A part that has the surfaces which these touches expect: opposite touches that look outward from one
// middle, two pairs of one size, are a bore (looking inward: a boss; one pair looking inward: a web), as are
// three at angles to the axes that look from one middle over one distance; other
// touches get a block each, as small as the ball, the error and a search beyond the surface need (`reach`,
// mm), and smaller where the ball of another touch would meet it on its known way (Touch::way). nullopt:
// there are no touches, or more than a part can have.
std::optional<sim::Part> partOf(const std::vector<Touch>& touches, double ballRadius, double reach,
                                const PartError& error);
// What partOf() made for these touches without an error, placed with one; cheap.
sim::Part withError(const sim::Part& nominal, const std::vector<Touch>& touches, const PartError& error);
// How far the error moves a surface at most, mm.
double mostOff(const std::vector<Touch>& touches, const PartError& error);

// Why no part could be reached on this way; "" where that depends on the part: it touches nothing, or ends
// lower than it was.
std::string whyNoWay(const DrawnPath& path);
// The path meets the part nowhere but at its touches, ends nowhere lower than it was (it comes out where it
// went in), and each touch lies where the ball gets to. "" or why not, in one line. `off`: by how much a
// contact may come earlier or later than drawn (of a part with an error: mostOff()); the path back begins at
// the contact.
// `near`: how far a measuring move keeps away from what it does not measure.
std::string whyNotReached(const DrawnPath& path, const sim::Part& part, const sim::Probe& probe,
                          double off = 0, double near = 0);

} // namespace dotek::verify
