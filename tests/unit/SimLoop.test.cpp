// A run that meets the limit of steps names the loop in which it goes round.
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <string>
#include <string_view>

using namespace dotek::tests;

namespace {

// "LINE: NOTE" of the finding.
std::string loopOf(const std::string& program) {
  const TestFolder folder("dotek-loop");
  folder.write("a.nc", program);
  const std::string err =
      runDotek({"sim", "a.nc", "--quiet", "--limit", "sim-steps=20000"}, folder.path()).err;
  CAPTURE(err);
  const std::size_t error = err.find("the program took more than 20000 steps");
  REQUIRE(error != std::string::npos);
  const std::string line = err.substr(5, err.find(':', 5) - 5);
  const std::string_view mark = "note: the program goes round in this loop";
  const std::size_t note = err.find(mark);
  if (note == std::string::npos) return line + ": none";
  const std::size_t begin = note + mark.size();
  return line + ":" + err.substr(begin, err.find('\n', begin) - begin);
}

constexpr std::string_view kStays = ":, and nothing on which its end depends changes: ";

} // namespace

TEST_CASE("loop: a WHILE that never ends is named by its own block, with what never changes") {
  CHECK(loopOf("O1\n#1=0\n#2=5\nWHILE[#1 LT 10]DO1\n#2=#2+1\nIF[#2 GT 100]THEN #2=0\nIF[#2 EQ 7]GOTO10\n"
               "#3=#2*2\nN10\nEND1\nM30\n") == "4" + std::string(kStays) + "#1 stays 0");
  CHECK(loopOf("O1\nDO1\n#1=#1+1\nIF[#1 GT 9]THEN #1=0\nEND1\nM30\n") == "2:");
  // One that counts, with a limit that it never meets: it changes.
  CHECK(loopOf("O1\nWHILE[#1 NE 0.5]DO1\n#1=#1+1\nEND1\nM30\n") == "2:");
}

TEST_CASE("loop: a GOTO backwards is named, not where the steps run out") {
  CHECK(loopOf("O1\n#1=0\nN5\n#2=#2+1\nG4 P1\nIF[#1 LT 10]GOTO5\nM30\n") ==
        "6" + std::string(kStays) + "#1 stays 0");
  CHECK(loopOf("O1\n#1=0\nN5\n#1=#1+1\nIF[#1 EQ 3]GOTO7\nGOTO8\nN7\n#1=1\nN8\n#100=#1\nGOTO5\nM30\n") ==
        "11:");
  CHECK(loopOf("O1\nN1 GOTO 2\nN3 GOTO 4\nN2 GOTO 3\nN4 GOTO 1\nM30\n") == "5:");
}

TEST_CASE("loop: of nested loops the one that never ends, and the caller's where a call ends") {
  CHECK(loopOf("O1\n#1=1\nWHILE[#1 EQ 1]DO1\nWHILE[#2 LT 5]DO2\n#2=#2+1\nEND2\n#2=0\nEND1\nM30\n") ==
        "3" + std::string(kStays) + "#1 stays 1");
  CHECK(
      loopOf("O1\n#1=0\nWHILE[#1 LT 3]DO1\nG65 P305 A1.\nEND1\nM30\nO305\n#1=1\nWHILE[#1 LT 3]DO1\n#1=#1+1\n"
             "END1\nM99\n") == "3" + std::string(kStays) + "#1 stays 0");
  // Within a call that never comes back.
  CHECK(loopOf("O1\nG65 P305\nM30\nO305\n#1=1\nWHILE[#1 LT 3]DO1\n#2=#2+1\nEND1\nM99\n") ==
        "6" + std::string(kStays) + "#1 stays 1");
  // A loop that ends comes before it.
  CHECK(loopOf("O1\nWHILE[#1 LT 100]DO1\n#1=#1+1\nEND1\nWHILE[#1 GT 1]DO1\nG4 P1\nEND1\nM30\n") ==
        "5" + std::string(kStays) + "#1 stays 100");
}
