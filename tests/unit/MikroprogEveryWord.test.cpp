// Each code of the control of a lathe, with each address that could be beside it, converted to Mikroprog: the
// word is in the result, in a message, or in an error at its line.
#include "MikroprogConversion.h"
#include "support/Decimal.h"
#include "tests/Draws.h"

#include <fmt/format.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

constexpr const char* kBegin = "O1\nT0101\nS500 M3\nG0 X40. Z5.\nG1 X39. F0.3\n";
constexpr std::uint32_t kLine = 6; // of the block in question

struct Said {
  std::string all; // all that a user sees
  bool refused = false, elsewhere = false;
};

Said saidOf(const std::string& block, const std::string& next) {
  const Converted one = converted(kBegin + block + "\n" + next + "M30\n");
  Said out;
  if (one.lines) out.all = one.text();
  for (const Diagnostic& d : one.diagnostics.all())
    out.all += std::string(d.code) + d.message + "\n";
  const auto lines = one.errorLines();
  out.refused = lines.contains(kLine);
  out.elsewhere = !out.refused && !lines.empty();
  return out;
}

std::string codeName(const stdlib::CodeInfo& code) {
  return code.letter + numberText(code.tenths / 10.0);
}

// A value of its own for each address, so that no word passes for another. T and P name what exists.
std::string wordOf(char letter) {
  if (letter == 'T') return "T0404";
  if (letter == 'S') return "S612";
  return fmt::format("{}{}.", letter, 61 + (letter - 'A'));
}

// Moves that take a feed, and moves that take the code too.
constexpr const char* kMoves = "G1 X31. Z-3. F0.7\nG0 X77.\n";
constexpr const char* kNext = "X31. Z-3.\nG1 X33. Z-4.\nG0 X77.\n";

} // namespace

TEST_CASE("mikroprog every word: no address beside a code is lost") {
  const stdlib::Control& lathe = sourceControl(true);
  std::vector<std::string> blocks = {"", "G0", "G1"};
  for (const stdlib::CodeInfo& code : lathe.codes)
    blocks.push_back(codeName(code));
  std::size_t words = 0, refused = 0;
  for (const std::string& block : blocks) {
    const Said without = saidOf(block, kMoves);
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
      if (std::string_view("GMNO").find(letter) != std::string_view::npos) continue;
      const std::string whole = (block.empty() ? "" : block + " ") + wordOf(letter);
      CAPTURE(whole);
      const Said with = saidOf(whole, kMoves);
      CHECK((with.refused || with.all != without.all));
      ++words;
      refused += with.refused;
    }
    if (fewDraws() && words > 400) break;
  }
  CHECK(words > 300);
  CHECK(refused > 100);
}

TEST_CASE("mikroprog every word: no code is lost") {
  const stdlib::Control& lathe = sourceControl(true);
  const auto inForce = [](const std::string& name) { // so that it changes nothing
    return name == "G1" || name == "M98" || name == "M99" || name == "M30" || name == "M2";
  };
  std::size_t codes = 0;
  for (const stdlib::CodeInfo& code : lathe.codes) {
    const std::string name = codeName(code);
    CAPTURE(name);
    for (const std::string beside : {"", " X50. Z1.", " U3.", " P1500"}) {
      CAPTURE(beside);
      const Said with = saidOf(name + beside, kNext), without = saidOf(beside, kNext);
      CHECK((inForce(name) || with.refused || with.all != without.all));
      ++codes;
    }
  }
  CHECK(codes > 300);
}
