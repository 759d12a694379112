// Numbers of blocks given anew: what follows them, and what is refused.
#include "frontend/macrob/Renumber.h"
#include "tests/unit/MacroBHelper.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <random>

using namespace dotek;
using namespace dotek::tests;
using frontend::macrob::RenumberOptions;

namespace {

// "": refused, with the message in `why`.
std::string renumbered(const std::string& text, const RenumberOptions& options = {},
                       std::string* why = nullptr) {
  MacroFile file(text);
  const auto out = frontend::macrob::renumber(file.file, options, file.sources, file.diagnostics);
  if (why != nullptr)
    for (const Diagnostic& one : file.diagnostics.all())
      *why += one.message;
  return out.value_or("");
}

bool refused(const std::string& text) {
  std::string why;
  return renumbered(text, {}, &why).empty() && !why.empty();
}

} // namespace

TEST_CASE("renumber follows each way to name a block") {
  CHECK(renumbered("O1\nN5 GOTO 5\n") == "O1\nN10 GOTO 10\n");
  CHECK(renumbered("O1\nN7 X1.\nIF[#1 EQ 2]GOTO 7\nIF[#1 EQ 2]THEN GOTO 7\n") ==
        "O1\nN10 X1.\nIF[#1 EQ 2]GOTO 10\nIF[#1 EQ 2]THEN GOTO 10\n");
  CHECK(renumbered("O1\nN7 X1.\n#3=7\nGOTO#3\n") == "O1\nN10 X1.\n#3=10\nGOTO#3\n");
  CHECK(renumbered("O1\nN7 X1.\n#3=#4114\nGOTO#3\n") == "O1\nN10 X1.\n#3=#4114\nGOTO#3\n");
  CHECK(renumbered("O1\nN7 X1.\nIF[#[4000+114]NE 7]GOTO 7\n") ==
        "O1\nN10 X1.\nIF[#[4000+114]NE 10]GOTO 10\n");
  CHECK(renumbered("O1\nM97 P7\nM30\nN7 X1.\nM99\n") == "O1\nM97 P10\nM30\nN10 X1.\nM99\n");
  CHECK(renumbered("O1\nN7 X1.\nM99 P7\n") == "O1\nN10 X1.\nM99 P10\n");
  CHECK(renumbered("O1\nG71 P7 Q8 U1.\nN7 X1.\nN8 Z1.\n") == "O1\nG71 P10 Q20 U1.\nN10 X1.\nN20 Z1.\n");
  CHECK(renumbered("O1\nG73 X1. Z-2. R1. P7 Q8 F1.\nN7 X1.\nN8 Z1.\n") ==
        "O1\nG73 X1. Z-2. R1. P7 Q8 F1.\nN10 X1.\nN20 Z1.\n");
  // P of M99 is a block of the caller.
  CHECK(renumbered("O1\nM98 P2\nN3 X1.\nN4 M30\nO2\nN4 X2.\nM99 P4\n") ==
        "O1\nM98 P2\nN10 X1.\nN20 M30\nO2\nN10 X2.\nM99 P20\n");
}

TEST_CASE("renumber refuses what it cannot follow") {
  CHECK(refused("O1\nN7 X1.\nGOTO[#1+6]\n"));
  CHECK(refused("O1\nN7 X1.\nGOTO#100\n"));
  CHECK(refused("O1\nN7 X1.\nGOTO 8\n"));
  CHECK(refused("O1\nN7 X1.\n#3=7\nX#3\nGOTO#3\n"));
  CHECK(refused("O1\nN7 X1.\nGOTO#3\n")); // an argument
  CHECK(refused("O1\nN7 X1.\n#500=#4114\n"));
  CHECK(refused("O1\nN7 X1.\nM98 P3 Q7\n"));
  const std::string huge(55, '3');
  CHECK(refused("O1\nG71 P" + huge + " Q7 U1.\nN7 X1.\n"));
  CHECK(refused("O1\nN7 X1.\nM99 P" + huge + "\n"));
  CHECK(refused("O1\nN7 X1.\nM98 P" + huge + " Q7\n"));
  CHECK(refused("O1\nN7 X1.\n#" + huge + "=#4114\n"));
  CHECK(refused("O1\nN7 X1.\nN7 X2.\nGOTO 7\n"));
  CHECK(refused("O1\nM30\nO2\nN4 X2.\nM99 P4\n")); // of a caller in another file
  CHECK(renumbered("O1\nN7 X[\n").empty());
}

TEST_CASE("renumber puts numbers where there are none, and leaves a part alone") {
  RenumberOptions all;
  all.all = true;
  all.start = all.step = 5;
  CHECK(renumbered("%\nO1(A)\n(B)\n/G0 X1.\n/2 X2.\n#1=2\nN3 M30\n%\n", all) ==
        "%\nO1(A)\n(B)\n/N5 G0 X1.\n/2 N10 X2.\nN15 #1=2\nN20 M30\n%\n");
  RenumberOptions part;
  part.range = std::pair(20, 30);
  part.start = 500;
  CHECK(renumbered("O1\nN10 GOTO 30\nN20 X1.\nN30 X2.\nN40 M30\n", part) ==
        "O1\nN10 GOTO 510\nN500 X1.\nN510 X2.\nN40 M30\n");
  part.start = 30; // N40 outside would be there twice
  CHECK(renumbered("O1\nN20 X1.\nN30 X2.\nN40 M30\n", part).empty());
  RenumberOptions steep;
  steep.last = 15;
  CHECK(renumbered("O1\nN1 X1.\nN2 X1.\n", steep).empty());
}

TEST_CASE("a renumbered program jumps as before: random programs") {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    const int blocks = 2 + static_cast<int>(random() % 12);
    std::vector<int> numbers;
    for (int i = 0; i < blocks; ++i)
      numbers.push_back(i * 7 + 1 + static_cast<int>(random() % 7));
    std::shuffle(numbers.begin(), numbers.end(), random);
    std::vector<int> targets;
    std::string text = "O1\n";
    for (int i = 0; i < blocks; ++i) {
      targets.push_back(static_cast<int>(random() % static_cast<unsigned>(blocks)));
      text += "N" + std::to_string(numbers[static_cast<std::size_t>(i)]) + " X1.\nIF[#1 GT 2]GOTO " +
              std::to_string(numbers[static_cast<std::size_t>(targets.back())]) + "\n";
    }
    std::string expected = "O1\n";
    for (int i = 0; i < blocks; ++i)
      expected += "N" + std::to_string(10 + 10 * i) + " X1.\nIF[#1 GT 2]GOTO " +
                  std::to_string(10 + 10 * targets[static_cast<std::size_t>(i)]) + "\n";
    CHECK(renumbered(text) == expected);
  }
}
