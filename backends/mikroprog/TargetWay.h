// Private to Target*.cpp: from where a program for Mikroprog looks for the surfaces of one measure, and how
// it comes there. The rules are in docs/verify.md.
#pragma once

#include "verify/Compare.h"
#include "verify/Gather.h"

#include <optional>

namespace dotek::targets {

struct MikroprogWay {
  double ballRadius = 0; // mm
  double tolerance = 0;  // mm
  bool middle = false;   // between walls, a pair along each axis
  bool sets = false;     // a position is set, of a middle after a walk to it
};

// The first search that begins at another place than `want` leads to, or the first move beside walls that are
// touched from outside that goes elsewhere. `want` is the source's, its second pair of walls where the walk
// along the first has led.
std::optional<verify::Difference> wayFault(const verify::Measure& want, const verify::Gathered::Parts& parts,
                                           const MikroprogWay& way);

} // namespace dotek::targets
