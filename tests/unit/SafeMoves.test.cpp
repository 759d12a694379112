#include "sim/machine/SafeMoves.h"
#include "frontend/macrob/Lower.h"
#include "tests/Draws.h"
#include "tests/unit/MacroBHelper.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <map>
#include <random>
#include <set>

using namespace dotek;
using tests::MacroFile;

namespace {

// Lines, from 1, of the skip moves that go to a position; the program has its alarm at N9.
std::string safeIn(const std::string& body) {
  const std::string text = "O1\n" + body + "M99\nN9#3000=5(HALT)\n";
  MacroFile parsed(text);
  const auto control = stdlib::Control::load(stdlib::DataFiles(), "fanuc-31i-b");
  REQUIRE(control);
  const auto file = frontend::macrob::lower(parsed.file, *control, parsed.sources, parsed.diagnostics);
  INFO(text << parsed.told());
  REQUIRE(file);
  std::string out;
  for (const auto& [id, begin] : sim::safeMoves({&file->programs.front()}, *control)) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(begin);
    out += (out.empty() ? "" : " ") + std::to_string(std::count(text.begin(), end, '\n'));
  }
  return out;
}

} // namespace

TEST_CASE("safe moves: the contact is asked for after a macro that leaves the variable alone") {
  const std::string touch = "#10=#5041\nG90G31X[#10+20.]F200.\n#530=#5061\n",
                    none = "IF[#530GE#10+19.99]THEN#3000=5(NONE)\n";
  CHECK(safeIn(touch + none) == "");
  CHECK(safeIn(touch + "G65P9833\n" + none) == "");
  CHECK(safeIn(touch + "M98P9833\n" + none) == "2"); // may write the variable, too
}

TEST_CASE("safe moves: the IF alarms with a contact, that of a touch without one") {
  const std::string from = "#10=#5041\n", there = "G31X[#10+20.]F200.\n", down = "G90G31Z#26F1000\n";
  CHECK(safeIn(from + there + "IF[#5061LT#10+19.99]GOTO9\n") == "2");
  CHECK(safeIn(from + there + "IF[#5061GE#10+19.99]GOTO9\n") == "");
  CHECK(safeIn(from + there + "IF[#5061GE#10+19.99]THEN#3000=5(NONE)\n") == "");
  CHECK(safeIn(from + there + "IF[#5061LT#10+19.99]GOTO5\n#3000=5(NONE)\nN5\n") == "");
  CHECK(safeIn(from + there + "IF[#5061GE#10+19.99]GOTO5\n#3000=5(HIT)\nN5\n") == "2");
  CHECK(safeIn(down + "IF[ABS[#5063-#26]GT0.01]GOTO9\n") == "1");
  CHECK(safeIn(down + "IF[ABS[#5063-#26]LT0.01]GOTO9\n") == "");
  CHECK(safeIn(down + "IF[ABS[#5063-#5083-#26]GT0.01]GOTO9\n") == "1");
  CHECK(safeIn(down + "IF[ABS[#5063-#5083-#26]LE0.01]GOTO9\n") == "");
  CHECK(safeIn(down + "IF[[#5063GT#26+0.01]OR[#1EQ2]]GOTO9\n") == "1"); // not decided: as it looks
  CHECK(safeIn(down + "IF[[#5063LE#26+0.01]OR[#1EQ2]]GOTO9\n") == "");
  CHECK(safeIn(down + "IF[#5043LE#26+0.01]GOTO9\n") == "");
  CHECK(safeIn(down + "IF[#5043GT#26+0.01]GOTO9\n") == "1");
  // By a way of its own to the alarm, down in the text or with a move away.
  CHECK(safeIn(down + "IF[#5063LE#26+0.01]GOTO8\nM99\nN8G0Z50.\nGOTO9\n") == "");
  const std::string left = "G90G0X15.\nG31X-4.F400.\nG53\n", tail = "N8G90G0Z20.\nM61\n#3000=70(NONE)\n";
  CHECK(safeIn(left + "IF[ABS[#5061-[-4.]]LT.005]GOTO8\nGOTO7\n" + tail + "N7\n") == "");
  CHECK(safeIn(left +
               "IF[ABS[#5061-[-4.]]LT.005]GOTO8\nG91G1X-[-1.*1.]F1000.\nG90G31X-4.F30.\n#1=#5061\nGOTO7\n" +
               tail + "N7\n") == "");
  // From a start that a variable holds, by steps.
  CHECK(safeIn("#2=#5042\nG91G31Y-12.F200\nG90\nIF[#5062LE#2-11.99]GOTO9\n") == "");
  CHECK(safeIn("#2=#5042\nG91G31Y-12.F200\nG90\nIF[#5062GT#2-11.99]GOTO9\n") == "2");
  // The end of the move is in a variable that one branch sets; the same one is compared.
  CHECK(safeIn("IF[#18EQ#0]THEN#18=2.\n#3=#24+#18\nG90G31X#3F200\nIF[#5061GE#24+#18-.01]GOTO9\n") == "");
  CHECK(safeIn("IF[#18EQ#0]THEN#18=2.\n#3=#24+#18\nG90G31X#3F200\nIF[#5061LT#24+#18-.01]GOTO9\n") == "3");
}

TEST_CASE("safe moves: what the end of the move does not decide stays one") {
  const std::string down = "G90G31Z#26F1000\n";
  CHECK(safeIn(down + "IF[#5063LE#7]GOTO9\n") == "1");
  CHECK(safeIn(down + "#26=#26-1.\nIF[#5063LE#26+1.005]GOTO9\n") == "");
  CHECK(safeIn(down + "#26=#8\nIF[#5063LE#26+0.01]GOTO9\n") == "1");
  CHECK(safeIn(down + "IF[#5063LE#26+0.01]GOTO8\nM99\nN8#500=1\n") == "1"); // no alarm on either way
  CHECK(safeIn(down + "IF[#5063LE#26+0.01]GOTO8\nGOTO9\nN8GOTO9\n") == "1");
  CHECK(safeIn("GOTO#1\nN1" + down + "IF[#5063LE#26+0.01]GOTO9\n") == "2");
}

TEST_CASE("safe moves: the first of two touches is none, whatever its IF says") {
  const std::string down = "#5=#5043\nG90G31Z[#5-10.]F1000\nIF[#5063LE#7]GOTO9\n", read = "#101=#5063\n";
  CHECK(safeIn(down + "G91G0Z1.\nG31Z-2.F30\nG90\n" + read) == "");
  CHECK(safeIn(down + "G91G31Z-2.F30\nG90\n" + read) == "2");        // not back
  CHECK(safeIn(down + "G91G0Z1.\nG31X-2.F30\nG90\n" + read) == "2"); // another axis
  CHECK(safeIn(down + "G91G0Z1.\nG31Z2.F30\nG90\n" + read) == "2");  // the other way
  CHECK(safeIn(down + "G91G0Z1.\nX5.\nG31Z-2.F30\nG90\n" + read) == "2");
  // A travel in a variable leads where its sign in the block says.
  const std::string fast = "IF[#5063GT#9]GOTO9\nG91G1Z1.F1000\nG31Z-2.F50\n#610=#5063\n";
  CHECK(safeIn("G91G31Z-10.F300\n" + fast) == "");
  CHECK(safeIn("G91G31Z-#2F300\n" + fast) == "");
  CHECK(safeIn("G91G31Z#2F300\n" + fast) == "1");
}

TEST_CASE("asking blocks: as a walk finds that asks each condition again at each jump back") {
  std::mt19937 random(31);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  for (std::size_t round = 0; round < tests::draws(400U, 40U); ++round) {
    // Each line copies a position or another variable, or asks and jumps.
    struct Line {
      bool asks = false, position = false;
      unsigned to = 0, from = 0;
      std::size_t target = 0;
    };
    const std::size_t count = 3 + below(12);
    std::vector<Line> lines(count);
    std::string text = "O1\n";
    for (std::size_t i = 0; i < count; ++i) {
      Line& line = lines[i];
      line.asks = below(2) == 0;
      line.position = below(3) == 0;
      line.to = static_cast<unsigned>(below(4));
      line.from = static_cast<unsigned>(below(4));
      line.target = below(count);
      text += "N" + std::to_string(i + 1);
      text += line.asks
                  ? "IF[#" + std::to_string(101 + line.from) + "EQ1]GOTO" + std::to_string(line.target + 1)
                  : "#" + std::to_string(101 + line.to) + "=" +
                        (line.position ? "#5061" : "#" + std::to_string(101 + line.from));
      text += "\n";
    }
    text += "M99\n";
    std::set<std::size_t> expected;
    std::map<unsigned, std::set<std::size_t>> now;
    for (std::size_t at = 0; at < count; ++at) {
      const Line& line = lines[at];
      if (!line.asks) {
        now[line.to] = line.position ? std::set<std::size_t>{at} : now[line.from];
        continue;
      }
      for (std::size_t i = std::min(line.target, at); i <= at; ++i)
        if (lines[i].asks) expected.insert(now[lines[i].from].begin(), now[lines[i].from].end());
    }
    MacroFile parsed(text);
    const auto control = stdlib::Control::load(stdlib::DataFiles(), "fanuc-31i-b");
    REQUIRE(control);
    const auto file = frontend::macrob::lower(parsed.file, *control, parsed.sources, parsed.diagnostics);
    REQUIRE_MESSAGE(file, text << parsed.told());
    std::set<std::size_t> found;
    for (const auto& [id, begin] : sim::askingBlocks({&file->programs.front()}))
      found.insert(static_cast<std::size_t>(
                       std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin), '\n')) -
                   1);
    CHECK_MESSAGE(found == expected, text);
  }
}
