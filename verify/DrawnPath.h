// What the programmer of a cycle saw: ToolPath.mac executed on a point, and the touches that it shows.
#pragma once

#include "frontend/gibbs/Run.h"
#include "sim/Part.h"
#include "verify/Record.h"

#include <cstddef>
#include <vector>

namespace dotek::verify {

// A feed move along one axis, downward if Z, which the next move takes back along the same axis. In X and Y
// the move ends where the ball's centre is, the contact lies one radius further; in Z it ends at the contact.
struct DrawnTouch {
  Touch touch;
  std::size_t move = 0; // place in DrawnPath::points of its end
  SourceRange range;
};

struct DrawnPath {
  std::vector<sim::Point3> points; // `start` first, then the end of each move
  std::vector<SourceRange> ranges; // of each point; of the start none
  std::vector<DrawnTouch> touches;
};

// `start`: where the stylus's lowest point stands before, the point of the operation in X and Y; Z of the
// path counts from `retract`. `start` and the result are in one system of coordinates, mm.
DrawnPath drawnPath(const std::vector<frontend::gibbs::PathMove>& path, const sim::Point3& start,
                    double retract, double ballRadius);

// Where the part is off its nominal place: moved, and turned about Z through the middle of its touches.
struct PartError {
  sim::Point3 shift; // mm
  double turn = 0;   // degrees
};

// A part that has the surfaces which these touches expect: opposite touches that look outward from one
// middle, two pairs of one size, are a bore (looking inward: a boss); other touches get a block each, as
// small as the ball, the error and a search beyond the surface need (`reach`, mm). nullopt: there are no
// touches.
std::optional<sim::Part> partOf(const std::vector<Touch>& touches, double ballRadius, double reach,
                                const PartError& error);

// The way meets the part nowhere but at its touches, ends nowhere lower than it was (it comes out where it
// went in), and each touch lies where the ball gets to. "" or why not.
std::string whyNotReached(const DrawnPath& path, const sim::Part& part, const sim::Probe& probe);

} // namespace dotek::verify
