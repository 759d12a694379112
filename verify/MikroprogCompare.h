// A posted program beside what a program of Mikroprog does. The rules are in docs/verify.md.
#pragma once

#include "verify/Compare.h"
#include "verify/MikroprogRun.h"

#include <functional>
#include <string>
#include <vector>

namespace dotek::verify {

struct MikroprogFacts {
  explicit MikroprogFacts(const stdlib::MikroprogControl& of) : control(of) {}

  const stdlib::MikroprogControl& control;
  std::uint32_t system = 54;                            // active at entry
  sim::Point3 zero;                                     // of that system at entry, in the machine
  double overtravel = 0;                                // with which the program was written, mm
  bool byOperator = false;                              // the datum is a stop with a text, not G92
  double tolerance = 1e-6;                              // mm
  std::function<SourceRange(std::uint32_t line)> place; // of the program's text
};

// How far a datum in the middle of a bore may lie beside it: half of the last step of the walk, and the
// rounding of its first one, mm.
inline constexpr double kMiddleTolerance = 0.0015;

// Whether the source moves the zero of `system`, which is active, and so its own path from there on. The
// target has no other system than the active one, and is written for a source that keeps its own: not
// comparable.
bool goesOnInItsDatum(const Record& source, std::uint32_t system);

struct MikroprogComparison {
  std::vector<Difference> differences; // the first of each aspect
  // Why what differs says nothing of the program, "" where it does: after a datum it goes beside the path of
  // the source, and there that path meets the part, or the source itself has come to nothing.
  std::string undecided;
};

// `world`: in which both ran; it is run again.
MikroprogComparison compare(const Record& source, const MikroprogRecord& target, sim::World& world,
                            const MikroprogFacts& facts);

} // namespace dotek::verify
