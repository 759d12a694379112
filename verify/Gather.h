// A program without macros measures by bare skip moves and goes back by itself. Here they become the measures
// that another program makes by one call each, so that both can be compared.
#pragma once

#include "verify/Record.h"

#include <vector>

namespace dotek::verify {

struct Gathered {
  Record record; // with one measure for each call of the other program; what no call makes are measures, too
  // A move of a measure beside its touches, after the first `touches` of them.
  struct Between {
    std::size_t touches = 0;
    Piece piece;
  };
  // Of each measure: the skip moves that make it, the moves before, between and after them that no straight
  // path back is, and what the program does beside moving until it goes on.
  struct Parts {
    std::vector<Measure> touches;
    std::vector<Between> moves;
    std::vector<Mark> marks;
  };
  std::vector<Parts> parts;
  std::vector<Mark> loose; // marks that belong to no measure; stops left out
};

// `like`: what the other program does. A measure takes as many skip moves as that of `like` has surfaces,
// then moves in feed until it is where that of `like` ends; a longer straight move that passes there is cut
// in two. `tolerance`: of these places, `middle`: of those in the middle of several walls (mm).
Gathered gather(const Record& like, const Record& ran, double tolerance, double middle);

} // namespace dotek::verify
