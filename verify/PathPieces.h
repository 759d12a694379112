// Points and straight pieces of paths, as comparisons see them.
#pragma once

#include "verify/Record.h"

#include <string>
#include <vector>

namespace dotek::verify {

// X, Y and Z with six decimals.
std::string textOf(const sim::Point3& p);

// Each coordinate is equal up to `tolerance`, mm.
bool near(const sim::Point3& a, const sim::Point3& b, double tolerance);

// `b` lies on the path from `a` to `c`, up to `tolerance`.
bool between(const sim::Point3& a, const sim::Point3& b, const sim::Point3& c, double tolerance);

// Without what moves nothing, and with straight runs as one piece; `kinds`: only of one kind, feed and state,
// and measures stay.
std::vector<Piece> straight(const std::vector<Piece>& pieces, bool kinds, double tolerance);

} // namespace dotek::verify
