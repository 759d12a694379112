// Long stretches of plain moves, of which lint keeps the blocks that findings can depend on. A CAM prints
// little else: a hundred megabytes of them hold a few thousand blocks that differ in more than their numbers.
#pragma once

#include "frontend/macrob/Ast.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace dotek::frontend::macrob {

// A line of a text, with its end.
struct TextLine {
  std::size_t begin = 0, end = 0;
};

// What is left out is a line of G0 or G1 as before, X, Y, Z, A, B, C with a point and F, each once, among
// others like it. Kept are the first and the last kEdge lines of a stretch, and within it the first one with
// a set of letters, the last one with each letter, those with the least and the largest X, Y and Z, and those
// with which a feed first goes down along Z, to 0 and below it; beside each of them the code of motion before
// it, the Z before it and the one of the last rapid move. So modes, positions after it, what is in the way
// and what is wrong with a block are the same. It is for the caller to know that no jump leads into it and
// that numbers are coordinates, not distances.
class Stretch {
public:
  static constexpr std::size_t kEdge = 16;
  // With fewer lines there is no stretch.
  static constexpr std::size_t kLeast = 4 * kEdge;

  // Reads the stretch that begins with the line at `at`. Nothing is left out where it is short. `numbers`:
  // lines with an N number belong to it.
  Stretch(std::string_view text, std::size_t at, bool numbers);

  // Where the text goes on; `at` of the constructor where the stretch is short.
  std::size_t end() const { return end_; }
  const std::vector<TextLine>& kept() const { return kept_; }
  const LeftOut& leftOut() const { return leftOut_; }
  // After a stretch that is short: none of its lines begins another.
  std::size_t looked() const { return looked_; }

private:
  std::size_t end_ = 0, looked_ = 0;
  std::vector<TextLine> kept_;
  LeftOut leftOut_;
};

// Whether something in the text may go to the number of a block.
bool mayJump(std::string_view text);

// Follows the text for whether its X, Y and Z are coordinates.
class TextModes {
public:
  explicit TextModes(bool jumps) : jumps_(jumps) {}

  // A line that is in no stretch. `header`: a program begins with it.
  void pass(std::string_view line, bool header);
  // As a G90 has said on the only way here.
  bool absolute() const { return absolute_ && !macroAfterMoves_; }

private:
  bool jumps_; // a block with a number is gone to from elsewhere
  bool absolute_ = false, macroAfterMoves_ = false;
};

} // namespace dotek::frontend::macrob
