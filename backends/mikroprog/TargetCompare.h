// Private to Target*.cpp: what a program for Mikroprog does, in the terms of the program that is its source.
// The rules are in docs/verify.md.
#pragma once

#include "stdlib/MikroprogControl.h"
#include "verify/Compare.h"

#include <vector>

namespace dotek::targets {

// How far a datum in the middle of a bore may lie beside it: half of the last step of the walk, and the
// rounding of its first one, mm.
inline constexpr double kMiddleTolerance = 0.0015;

struct MikroprogFacts {
  const stdlib::MikroprogControl& control;
  sim::Point3 zero;        // of the active system at entry, in the machine
  double overtravel = 0;   // with which the program was written, mm
  double ballRadius = 0;   // mm
  double returnFeed = 0;   // of the path back after a contact, mm/min
  bool byOperator = false; // the datum is a stop with a text, not G92
  bool height = false;     // the program knows at which Z it begins
  double tolerance = 1e-6; // mm
};

// `source` goes on in its datums as the target does (verify::Stand::Way::MovePath), unless an operator sets
// them; `ran` has its ending. The first difference of each aspect.
std::vector<verify::Difference> compareWithSource(verify::Record source, const verify::Record& ran,
                                                  const MikroprogFacts& facts);

} // namespace dotek::targets
