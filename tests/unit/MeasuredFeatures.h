// Features of exact geometry, placed at random, with the calls of each macro set that measure them and what
// is true of them.
#pragma once

#include "sim/geometry/Part.h"
#include "verify/Random.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::tests {

struct MeasuredResult {
  std::uint32_t variable = 0;
  double value = 0;
  double touches = 1; // how much of the noise of one touch it can hold
};

struct MeasuredFeature {
  std::string name;
  double ball = 3;                                       // radius
  sim::Point3 start;                                     // of the stylus's lowest point, G54
  sim::Part part;                                        // in the machine
  std::map<std::string, std::string, std::less<>> calls; // by macro set; they set G55
  // By axis: the coordinate of G54 at which the macro finds the feature, where it is expected, and the one
  // that calls with a nominal give it.
  std::map<std::size_t, double> found, expected, wanted;
  std::vector<MeasuredResult> results; // of Inspection Plus and of our own macros
};

inline constexpr std::string_view kMeasuredFeatures[] = {
    "surface x", "surface y", "surface z",    "bore",         "boss",    "pocket x", "pocket y",
    "web x",     "web y",     "inner corner", "outer corner", "angle x", "angle y"};
// At an angle to the axes. EasyProbe has none of them.
inline constexpr std::string_view kAngledFeatures[] = {"angled surface", "angled pocket", "angled web",
                                                       "three-point bore", "three-point boss"};

// Where the part is off its place, beside a random shift.
struct MeasuredPlace {
  double turn = 0; // about Z, degrees, through the middle of the feature
  double tilt = 0; // about X, of a face that is touched along Z
  // A surface lies so much (mm) beyond where the search for it ends, instead of the shift. nullopt: all are
  // near.
  std::optional<double> beyond;
};

// What the macros find is off by the known error of the method where it is turned (docs/verify.md).
MeasuredFeature measuredFeature(std::string_view name, verify::Random& random,
                                const MeasuredPlace& place = {});

} // namespace dotek::tests
