// The scanner of plain NC text: words, places of defects, numbers against strtod, the first pass for macros.
#include "frontend/nc/Scan.h"

#include "support/Diagnostics.h"

#include <cstdlib>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <random>
#include <string>
#include <vector>

using namespace dotek;
using namespace dotek::frontend::nc;
using ir::NcWords;

namespace {

struct Read {
  std::vector<NcWords> blocks;
  ScanError error;  // fault None: read to the end
  std::string line; // of the error
};

Read scan(std::string_view text, std::size_t buffer = LineChunks::kBuffer,
          Scanner::Way way = Scanner::Way::Fastest) {
  LineChunks chunks(text, buffer);
  Scanner scanner(chunks, way);
  Read out;
  NcWords words;
  Scanner::Result result;
  while ((result = scanner.next(words)) == Scanner::Result::Block)
    out.blocks.push_back(words);
  if (result == Scanner::Result::Error) {
    out.error = scanner.error();
    out.line = scanner.lineText();
  }
  return out;
}

NcWords one(std::string_view text) {
  const Read read = scan(text);
  CAPTURE(text);
  REQUIRE(read.error.fault == ScanFault::None);
  REQUIRE(read.blocks.size() == 1);
  return read.blocks.front();
}

ScanError error(std::string_view text) {
  return scan(text).error;
}

bool macros(std::string_view text, std::size_t buffer = LineChunks::kBuffer) {
  LineChunks chunks(text, buffer);
  return mayHoldMacros(chunks);
}

// What the two ways of reading a line must agree on.
std::string shown(const NcWords& w) {
  std::string out = fmt::format("marks {} delete {} places {} repeated {:x} pointed {:x}", w.marks,
                                w.deleteLevel, w.mostPlaces, w.repeated, w.pointed);
  for (char letter = 'A'; letter <= 'Z'; ++letter)
    if (w.has(letter)) out += fmt::format(" {}{:a}", letter, w.of(letter));
  for (std::uint32_t i = 0; i < w.gCount; ++i)
    out += fmt::format(" g{}", w.g[i]);
  for (std::uint32_t i = 0; i < w.mCount; ++i)
    out += fmt::format(" m{}", w.m[i]);
  return out;
}

} // namespace

TEST_CASE("nc scan: words of a block") {
  const NcWords w = one("N120 G1 G54.1 X-12.5 Y.25 Z3. M8 M03 F500 P7\n");
  CHECK(w.of('N') == 120);
  CHECK(w.gCount == 2);
  CHECK(w.g[0] == 10);
  CHECK(w.g[1] == 541);
  CHECK(w.mCount == 2);
  CHECK(w.m[0] == 8);
  CHECK(w.m[1] == 3);
  CHECK(w.of('X') == -12.5);
  CHECK(w.of('Y') == 0.25);
  CHECK(w.of('Z') == 3);
  CHECK(w.of('F') == 500);
  CHECK(w.present == ir::addressBits("NGMXYZFP"));
  CHECK((w.pointed & ir::addressBits("XYZFPN")) == ir::addressBits("XYZ"));
  CHECK(w.mostPlaces == 2);
  CHECK(w.repeated == 0);
  CHECK(w.line == 1);
}

TEST_CASE("nc scan: what does not matter (reference 1.1)") {
  const std::string plain = shown(one("G1X10.Y-2F100"));
  for (const char* text : {"G1 X10. Y-2 F100\n", "g1 x10. y-2 f100\r\n", "  G1  X10.\tY-2 F100  \r\n",
                           "G01X+10.Y-02F0100\n", "G1 (to the hole) X10. Y-2 (#1 [ GOTO) F100\n",
                           "G 1 X 10. Y - 2 F 100", "\n\n( a )\nG1X10.Y-2F100\n\n",
                           "\xEF\xBB\xBFG1X10.Y-2F100\n", "G1X10.Y-2F100;\n", "G1X10.Y-2F100\r"}) {
    CAPTURE(text);
    CHECK(shown(one(text)) == plain);
  }
}

TEST_CASE("nc scan: marks") {
  CHECK(one("%\n").marks == NcWords::ProgramMark);
  CHECK(one("O1234 (TITLE)").marks == NcWords::ProgramName);
  CHECK(one("O1234").of('O') == 1234);
  CHECK(one(":500").of('O') == 500);
  CHECK(one("<MAIN_1+2.3>").marks == NcWords::ProgramName);
  CHECK(one("/G1X1").marks == NcWords::BlockDelete);
  CHECK(one("/G1X1").deleteLevel == 1);
  CHECK(one("/3 N10 G1X1").deleteLevel == 3);
  CHECK(one("N10 /2 G1X1").deleteLevel == 2);
  CHECK(one("X1X2Y3").repeated == ir::addressBit('X'));
  CHECK(one("X1X2Y3").of('X') == 2);
}

TEST_CASE("nc scan: a program may begin in the line of its mark") {
  for (const char* text : {"%O100\nX1", "% O100\nX1", "%:100\r\nX1", " %O100(NAME)\nX1"}) {
    CAPTURE(text);
    const Read read = scan(text);
    REQUIRE(read.blocks.size() == 3);
    CHECK(read.blocks[0].marks == NcWords::ProgramMark);
    CHECK(read.blocks[0].present == 0);
    CHECK(read.blocks[0].line == 1);
    CHECK(read.blocks[1].of('O') == 100);
    CHECK(read.blocks[1].line == 1);
    CHECK(read.blocks[2].line == 2);
  }
  CHECK(scan("%<PART>\nX1").blocks.size() == 3);
}

TEST_CASE("nc scan: what precedes the first mark is skipped on request") {
  const auto first = [](std::string_view text) {
    LineChunks chunks(text);
    Scanner scanner(chunks);
    scanner.skipsLeader();
    NcWords words;
    const bool read = scanner.next(words) == Scanner::Result::Block;
    return fmt::format("{} {} {}:{}", read ? std::to_string(words.line) : "none", words.marks,
                       scanner.leaderLine(), scanner.leader());
  };
  CHECK(first("TAPE OF MAY 5\n\n%\nO1\nX1\n%\n") == "3 2 1:TAPE OF MAY 5");
  CHECK(first("\r\n PART 7\r\n%\r\nX1") == "3 2 2:PART 7");
  CHECK(first("%\nX1\n%\n") == "1 2 0:");
  CHECK(first("X1\nM30\n%\n \n") == "1 0 0:");     // the mark ends the text
  CHECK(first("O1\nX1\n%\nO2\nX2\n") == "1 4 0:"); // a program begins before it
  CHECK(first("X1\nM30\n") == "1 0 0:");
}

TEST_CASE("nc scan: codes that are none keep their place") {
  CHECK(one("G1.23").g[0] == NcWords::kNoCode);
  CHECK(one("G-1").g[0] == NcWords::kNoCode);
  CHECK(one("G5101").g[0] == 51010);
  CHECK(one("M3.0").m[0] ==
        NcWords::kNoCode); // reference 1.6: the literal M3.0 is illegal, G is the exception
  CHECK(one("G1.0").g[0] == 10);
  std::string many;
  for (int i = 0; i < 17; ++i)
    many += "G1";
  CHECK((one(many).marks & NcWords::TooManyCodes) != 0);
  CHECK(one(many).gCount == NcWords::kMostCodes);
  CHECK((one(many.substr(2)).marks & NcWords::TooManyCodes) == 0);
}

TEST_CASE("nc scan: defects are at their place") {
  struct Row {
    const char* text;
    ScanFault fault;
    std::uint64_t line;
    std::uint32_t begin, end;
  };
  const Row rows[] = {
      {"G1\nG1 X1 Y\n", ScanFault::NoNumber, 2, 6, 7},
      {"G1 X\nY1", ScanFault::NoNumber, 1, 3, 4},
      {"G1 X1.2.3 Y1", ScanFault::BadNumber, 1, 3, 9},
      {"G1 X. Y1", ScanFault::NoNumber, 1, 3, 4},
      {"G1 X- Y1", ScanFault::NoNumber, 1, 3, 4},
      {"G1 X1 (open\nG1", ScanFault::OpenComment, 1, 6, 11},
      {"G1 X1 (open", ScanFault::OpenComment, 1, 6, 11},
      {"G1 /X1", ScanFault::LateDelete, 1, 3, 4},
      {"G1 % X1", ScanFault::LateMark, 1, 3, 4},
      {"% X1", ScanFault::LateMark, 1, 2, 4},
      {"G1 X1,5", ScanFault::BadCharacter, 1, 5, 6},
      {"G1 X1)", ScanFault::BadCharacter, 1, 5, 6},
      {"G1 \xC5\x99", ScanFault::BadCharacter, 1, 3, 5},
      {"G1;X1", ScanFault::BadCharacter, 1, 2, 3},
      {"X#1", ScanFault::MacroText, 1, 0, 2},
      {"X1 #1=2", ScanFault::MacroText, 1, 3, 4},
      {"X[1+2]", ScanFault::MacroText, 1, 0, 2},
      {"N1 GOTO 10", ScanFault::MacroText, 1, 3, 7},
  };
  for (const Row& row : rows) {
    CAPTURE(row.text);
    const ScanError found = error(row.text);
    CHECK(found.fault == row.fault);
    CHECK(found.line == row.line);
    CHECK(found.begin == row.begin);
    CHECK(found.end == row.end);
  }
  CHECK(error(std::string_view("G1 \0X1", 6)).fault == ScanFault::BadCharacter);
  CHECK(error("X" + std::string(41, '1')).fault == ScanFault::BadNumber);
}

TEST_CASE("nc scan: reading goes on after a defect") {
  LineChunks chunks("G1 X\r\nG2 Y1\nZ,1\nZ2");
  Scanner scanner(chunks);
  NcWords words;
  CHECK(scanner.next(words) == Scanner::Result::Error);
  CHECK(scanner.lineText() == "G1 X");
  CHECK(scanner.next(words) == Scanner::Result::Block);
  CHECK(words.line == 2);
  CHECK(scanner.next(words) == Scanner::Result::Error);
  CHECK(scanner.error().line == 3);
  CHECK(scanner.next(words) == Scanner::Result::Block);
  CHECK(words.of('Z') == 2);
  CHECK(scanner.lineText() == "Z2");
  CHECK(scanner.next(words) == Scanner::Result::End);
  CHECK(scanner.next(words) == Scanner::Result::End);
}

TEST_CASE("nc scan: a line longer than the buffer ends the reading") {
  const Read read = scan("G1 X1\n(" + std::string(200, 'x') + ")\nG1\n", 64);
  CHECK(read.blocks.size() == 1);
  CHECK(read.error.fault == ScanFault::LineTooLong);
  CHECK(read.error.line == 2);
  CHECK(scan("(" + std::string(200, 'x') + ")\nG1\n", 256).blocks.size() == 1);
}

TEST_CASE("nc scan: feed holes around a program are read alike wherever a buffer ends") {
  const std::string holes(30, '\0');
  const std::string text = holes + "\n" + holes + "O1\nG1 X1\nM30\n" + holes + "\n\x1A" + holes;
  const std::string damaged = "O1\nG1 X1\n" + holes + "\n" + holes + "Y1\nM30\n";
  for (std::size_t buffer = 64; buffer < 160; ++buffer) {
    CAPTURE(buffer);
    const Read read = scan(text, buffer);
    if (read.error.fault == ScanFault::LineTooLong) {
      CHECK(buffer < 96); // the trailer with its line ends
      continue;
    }
    CHECK(read.error.fault == ScanFault::None);
    CHECK(read.blocks.size() == 3);
    CHECK(scan(damaged, buffer).error.fault == ScanFault::BadCharacter);
  }
  CHECK(scan("\x1AG1 X1\n").error.fault == ScanFault::BadCharacter);
}

TEST_CASE("nc scan: a number equals strtod of its text") {
  std::mt19937 random(20261121);
  const auto below = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
  const auto check = [&](const std::string& number) {
    // With a word after it, at the end of a line, and after a comment, which is read by other code.
    for (const std::string& text : {"Q" + number + " X1", "Q" + number, "()Q" + number + "X1"}) {
      for (const Scanner::Way way : {Scanner::Way::Fastest, Scanner::Way::Portable}) {
        CAPTURE(text);
        const Read read = scan(text, LineChunks::kBuffer, way);
        REQUIRE(read.blocks.size() == 1);
        const NcWords& w = read.blocks.front();
        const double expected = std::strtod(number.c_str(), nullptr);
        REQUIRE(w.of('Q') == expected);
        REQUIRE(((w.pointed >> ('Q' - 'A')) & 1) == (number.find('.') != std::string::npos ? 1 : 0));
      }
    }
  };
  for (int i = 0; i < 20000; ++i) {
    std::string number = below(3) == 0 ? "-" : "";
    const unsigned digits = 1 + below(15);
    const unsigned point = below(digits + 4); // after the digits: none
    for (unsigned k = 0; k < digits; ++k) {
      if (k == point) number += '.';
      number += static_cast<char>('0' + below(10));
    }
    if (point == digits) number += '.';
    check(number);
  }
  for (const char* number :
       {"0", "-0", "0.0", "00000000", "12345678", "1234567.8", ".12345678", "12345678.", "999999999999999",
        "0.00000000000000000001", "12345678901234567890", "0.1234567890123456789", "1234567890.1234567890"})
    check(number);
}

TEST_CASE("nc scan: all paths read the same") {
  std::mt19937 random(7);
  const auto below = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
  int read = 0;
  for (int i = 0; i < 20000; ++i) {
    static constexpr std::string_view kBytes = "GMXYZNFgx0123456789.-+ ()/%";
    std::string line;
    for (unsigned k = below(9); k > 0; --k) {
      line += below(16) == 0 ? kBytes[below(kBytes.size())] : "GMXYZ"[below(5)];
      if (below(16) != 0) line += std::to_string(below(2000) / 10.0).substr(0, 1 + below(5));
      if (below(3) == 0) line += ' ';
    }
    const Read careful = scan(line, LineChunks::kBuffer, Scanner::Way::Careful);
    for (const Scanner::Way way : {Scanner::Way::Fastest, Scanner::Way::Portable}) {
      const Read quick = scan(line, LineChunks::kBuffer, way);
      CAPTURE(line);
      REQUIRE(quick.error.fault == careful.error.fault);
      REQUIRE(quick.blocks.size() == careful.blocks.size());
      if (quick.error.fault != ScanFault::None) {
        CHECK(quick.error.begin == careful.error.begin);
        CHECK(quick.error.end == careful.error.end);
      } else if (!quick.blocks.empty()) {
        ++read;
        REQUIRE(shown(quick.blocks[0]) == shown(careful.blocks[0]));
      }
    }
  }
  CHECK(read > 1000);
}

TEST_CASE("nc scan: the size of the buffer makes no difference") {
  std::string text = "%\r\nO7\n";
  for (int i = 0; i < 300; ++i)
    text +=
        fmt::format("N{} G{} X{}.5 (c{}){}", i, i % 4, i, std::string(static_cast<std::size_t>(i % 20), '.'),
                    i % 3 == 0   ? "\r\n"
                    : i % 3 == 1 ? "\n"
                                 : "\r");
  text += "M30";
  const Read whole = scan(text);
  CHECK(whole.blocks.size() == 303);
  CHECK(whole.blocks.back().line == 303);
  for (const std::size_t buffer : {64, 65, 67, 100, 128, 1000, 4096}) {
    CAPTURE(buffer);
    const Read parts = scan(text, buffer);
    REQUIRE(parts.blocks.size() == whole.blocks.size());
    for (std::size_t i = 0; i < whole.blocks.size(); ++i) {
      CHECK(shown(parts.blocks[i]) == shown(whole.blocks[i]));
      CHECK(parts.blocks[i].line == whole.blocks[i].line);
    }
  }
}

TEST_CASE("nc scan: a word is found again in its line") {
  const std::string_view line = "N10 (X5 G9) G1 x-1. G 17 :7";
  const auto text = [&](char letter, std::uint32_t which) {
    const auto place = findWord(line, letter, which);
    return place ? std::string(line.substr(place->begin, place->end - place->begin)) : std::string("none");
  };
  CHECK(text('X', 0) == "x-1.");
  CHECK(text('G', 0) == "G1");
  CHECK(text('G', 1) == "G 17");
  CHECK(text('G', 2) == "none");
  CHECK(text('O', 0) == ":7");
  CHECK(text('Y', 0) == "none");
}

TEST_CASE("nc scan: the first pass finds macro statements and calls, outside of comments") {
  const char* const plain[] = {"",
                               "G1 X1 Y2\n",
                               "(#1 [2] GOTO 3 M98)\nG0 X1",
                               "G64 G67 G0 G00 G6 M9 M09 M90 M0 M6\n",
                               "O65 P66 N98 X98 M980\n",
                               "G1 X 1 Y 2\n",
                               "%\nO1 (A#)\n(G65)G1(M98)\n",
                               "<MAIN_M98#>\nG1",
                               "G1X1\r\nM30\r\n",
                               "G165 G650 G5 X6",
                               "G1 X Y5",
                               "X\nY1",
                               "GX"};
  for (const char* text : plain) {
    CAPTURE(text);
    CHECK_FALSE(macros(text));
  }
  const char* const held[] = {
      "#1=2",        "G1 X#1",      "G1 X[1]",      "GOTO 10",         "G65 P9000", "G65P1",
      "g 65 p1",     "G065 P1",     "G66.1 P1",     "M98 P1",          "M99",       "M099",
      "(a) M98 (b)", "DO1\nEND1\n", "(x)\n(y)#5=1", "G1 X1 (#) Y#2\n", "POPEN",     "IF[1EQ1]GOTO5"};
  for (const char* text : held) {
    CAPTURE(text);
    CHECK(macros(text));
    // At every offset of the step that looks at several bytes at once, and after many blocks.
    for (std::size_t lead = 0; lead < 40; ++lead)
      CHECK(macros(std::string(lead, ' ') + text));
    CHECK(macros(std::string(1000, '\n') + "G1 X1 Y1 (c)\n" + text + "\nG1 X1\n", 128));
  }
}
