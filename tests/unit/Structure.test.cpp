#include "ir/Structure.h"
#include "frontend/macrob/Lower.h"
#include "ir/Flow.h"
#include "tests/unit/MacroBHelper.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <random>

using namespace dotek;
using tests::MacroFile;

namespace {

ir::Program lowered(const std::string& text) {
  MacroFile parsed("O1\n" + text);
  const auto control = stdlib::Control::load(stdlib::DataFiles(), "fanuc-31i-b");
  REQUIRE(control);
  const auto file = frontend::macrob::lower(parsed.file, *control, parsed.sources, parsed.diagnostics);
  INFO(text << parsed.told());
  REQUIRE(file);
  return file->programs.front();
}

// `if 0-3 loop 4-9`, with `/5` where the other arm begins; or `refused: reason @line`.
std::string told(const std::string& text) {
  const ir::Structure structure = ir::structureOf(lowered(text));
  if (structure.refused) {
    CHECK(structure.regions.empty());
    const std::string before = ("O1\n" + text).substr(0, structure.refused->range.begin);
    return fmt::format("refused: {} @{}", structure.refused->reason,
                       std::count(before.begin(), before.end(), '\n'));
  }
  std::string out;
  for (const ir::Region& region : structure.regions) {
    out += out.empty() ? "" : " ";
    out += fmt::format("{} {}-{}", region.kind == ir::Region::Kind::Loop ? "loop" : "if", region.begin,
                       region.end);
    if (region.otherwise != region.end) out += fmt::format("/{}", region.otherwise);
  }
  return out;
}

} // namespace

TEST_CASE("structure: branches with one arm and with two") {
  CHECK(told("G0X1.\nM99\n") == "");
  CHECK(told("IF[#1EQ2]THEN#3=4\n") == "if 0-2");
  CHECK(told("IF[#1EQ2]GOTO5\n#3=4\nN5M99\n") == "if 0-2");
  CHECK(told("IF[#1EQ2]GOTO5\n#3=4\nGOTO6\nN5#3=5\nN6M99\n") == "if 0-5/3");
  CHECK(told("IF[#1EQ2]GOTO5\nIF[#2EQ2]GOTO5\n#3=4\nN5M99\n") == "if 0-3 if 1-3");
}

TEST_CASE("structure: WHILE is a loop, and so is a jump backward") {
  CHECK(told("WHILE[#1LT3]DO1\n#1=#1+1\nEND1\n") == "loop 1-4");
  CHECK(told("N1#1=#1+1\nIF[#1LT3]GOTO1\nM99\n") == "loop 0-3");
  CHECK(told("N1#1=#1+1\nN2#2=#2+1\nIF[#2LT3]GOTO2\nIF[#1LT3]GOTO1\nM99\n") == "loop 0-6 loop 2-5");
  // Out of a loop, and back from within one.
  CHECK(told("WHILE[#1LT3]DO1\nIF[#2EQ1]GOTO9\n#1=#1+1\nEND1\nN9M99\n") == "loop 1-5");
  CHECK(told("DO1\nIF[#2EQ1]THEN#3=1\nM99\nEND1\n") == "loop 1-7 if 2-4");
}

TEST_CASE("structure: a branch that another jump leads into has none") {
  // The second branch ends after the end of the first, which leads into it.
  CHECK(told("IF[#1EQ1]GOTO10\n#2=1\nIF[#3EQ1]GOTO20\n#4=1\nN10#5=1\nN20M99\n") == "if 0-4");
}

TEST_CASE("structure: what has none says why, and where") {
  CHECK(told("#1=1\nGOTO#1\nN1M99\n") == "refused: the number of this GOTO is computed @2");
  CHECK(told("GOTO7\n") == "refused: no block has the number of this GOTO @1");
  CHECK(told("N5#1=1\nGOTO5\nN5M99\n") == "refused: several blocks are N5, where this jump goes @2");
  CHECK(told("N5#1=1\nN5#1=2\nM99\n") == "");
  CHECK(told("IF[#1EQ1]GOTO5\nWHILE[#1LT3]DO1\nN5#1=#1+1\nEND1\n") ==
        "refused: this jump goes into a loop @1");
  // Two entries: through N1 and through N2.
  CHECK(told("IF[#1EQ1]GOTO2\nN1#2=1\nN2#3=1\nIF[#2EQ1]GOTO1\nM99\n") ==
        "refused: the loop that this jump closes has a second entry @4");
  CHECK(told("GOTO5\nN2#1=#1+1\nGOTO5\nN5IF[#1LT3]GOTO2\nM99\n") ==
        "refused: the loop that this jump closes begins after a part of it @3");
}

TEST_CASE("structure: regions nest, and nothing outside leads into one") {
  std::mt19937 random(20);
  int structured = 0;
  for (int run = 0; run < 400; ++run) {
    const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    std::string text;
    const int blocks = 3 + pick(8);
    for (int i = 1; i <= blocks; ++i) {
      text += fmt::format("N{}", i);
      const int to = 1 + pick(blocks);
      switch (pick(4)) {
      case 0: text += fmt::format("IF[#1EQ{}]GOTO{}\n", i, to); break;
      case 1: text += fmt::format("GOTO{}\n", to); break;
      default: text += fmt::format("#{}=1\n", i); break;
      }
    }
    text += "M99\n";
    const ir::Program program = lowered(text);
    const ir::Structure structure = ir::structureOf(program);
    INFO(text);
    if (structure.refused) continue;
    ++structured;
    const auto next = ir::flowOf(program.body).next;
    for (const ir::Region& region : structure.regions) {
      REQUIRE(region.begin < region.end);
      REQUIRE(region.end <= program.body.size());
      CHECK((region.otherwise > region.begin && region.otherwise <= region.end));
      for (std::size_t from = 0; from < next.size(); ++from) {
        if (from >= region.begin && from < region.end) continue;
        for (const std::size_t to : next[from])
          CHECK_FALSE((to > region.begin && to < region.end));
      }
      for (const ir::Region& other : structure.regions) {
        const bool apart = other.end <= region.begin || region.end <= other.begin;
        const bool holds = (other.begin <= region.begin && region.end <= other.end) ||
                           (region.begin <= other.begin && other.end <= region.end);
        CHECK((apart || holds));
      }
    }
  }
  CHECK(structured > 50);
}
