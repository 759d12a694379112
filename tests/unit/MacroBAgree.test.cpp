// Both readers give the same tree and findings, and the layout keeps the tree: on the corpus and on made-up
// programs.
#include "frontend/macrob/Scan.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/unit/MacroBHelper.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <random>

namespace fs = std::filesystem;
using namespace dotek;
using namespace dotek::tests;
namespace macrob = dotek::frontend::macrob;

namespace {

// Writes programs that are right, in the spelling of somebody who puts blanks anywhere.
class Writer {
public:
  explicit Writer(unsigned seed) : random_(seed) {}

  std::string file() {
    std::string out;
    if (chance(2)) out += "%\n";
    const int programs = number(1, 3);
    for (int i = 0; i < programs; ++i) {
      if (i > 0 || !chance(4)) out += header(i) + (chance(2) ? "(" + text() + ")" : "") + "\n";
      const int blocks = number(1, 15);
      for (int j = 0; j < blocks; ++j)
        out += block() + (chance(8) ? ";\n" : "\n");
    }
    if (chance(2)) out += "%\n";
    return out;
  }

  std::string block() {
    std::string out;
    if (chance(8)) out += "/" + (chance(2) ? std::to_string(number(1, 9)) : "") + blank();
    if (chance(3)) out += "N" + blank() + std::to_string(number(1, 9999)) + blank();
    if (chance(6)) out += comment();
    out += statement();
    if (chance(3)) out += blank() + comment();
    return out;
  }

private:
  int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool chance(int of) { return number(1, of) == 1; }
  template <class T, std::size_t n> const T& any(const T (&list)[n]) {
    return list[number(0, static_cast<int>(n) - 1)];
  }
  std::string blank() { return chance(3) ? std::string(static_cast<std::size_t>(number(1, 3)), ' ') : ""; }
  std::string text() {
    static const char* const kTexts[] = {"NOTE", "a, b = #5 [x", "50% ; / *", "", "G1 X5.", "IF[#1EQ2]GOTO1"};
    return any(kTexts);
  }
  std::string comment() { return "(" + text() + ")"; }
  std::string header(int index) {
    if (chance(4)) return "<PART-" + std::to_string(index) + ".A>";
    return (chance(3) ? ":" : "O") + std::to_string(number(1, 9999));
  }

  std::string digits() {
    static const char* const kNumbers[] = {"0",   "1",      "5.",  ".5",   "0.25",
                                           "100", "12.345", "007", "2000", "90."};
    return any(kNumbers);
  }
  std::string spelled(const std::string& word) {
    std::string out;
    for (const char c : word) {
      out += c;
      if (chance(12)) out += ' ';
    }
    return out;
  }

  std::string variable(int depth) {
    if (depth > 0 && chance(5)) return "#[" + expression(depth - 1) + "]";
    return "#" + blank() + std::to_string(number(1, 33));
  }
  std::string factor(int depth) {
    static const char* const kFunctions[] = {"SIN",   "COS", "TAN", "ASIN", "ACOS", "SQRT", "ABS",
                                             "ROUND", "FIX", "FUP", "LN",   "EXP",  "BIN",  "BCD"};
    if (chance(8)) return "-" + factor(depth);
    if (depth > 0) {
      switch (number(1, 8)) {
      case 1: return "[" + expression(depth - 1) + "]";
      case 2: return spelled(any(kFunctions)) + "[" + expression(depth - 1) + "]";
      case 3:
        return "ATAN[" + expression(depth - 1) + "]" + (chance(2) ? "/[" + expression(depth - 1) + "]" : "");
      case 4:
        return chance(2) ? "ATAN[" + expression(depth - 1) + "," + expression(depth - 1) + "]"
                         : "POW[" + expression(depth - 1) + "," + expression(depth - 1) + "]";
      default: break;
      }
    }
    return chance(2) ? digits() : variable(depth);
  }
  std::string expression(int depth) {
    static const char* const kOperators[] = {"+", "-", "*", "/", "AND", "OR", "XOR", "MOD"};
    std::string out = blank() + factor(depth);
    for (int i = number(0, 2); i > 0; --i)
      out += blank() + spelled(any(kOperators)) + blank() + factor(depth);
    return out + blank();
  }
  std::string comparison() {
    static const char* const kRelations[] = {"EQ", "NE", "GT", "GE", "LT", "LE"};
    return expression(2) + spelled(any(kRelations)) + expression(2);
  }
  std::string condition() {
    static const char* const kJoins[] = {"AND", "OR", "XOR"};
    if (!chance(5)) return "[" + comparison() + "]";
    std::string out = "[[" + comparison() + "]";
    for (int i = number(1, 2); i > 0; --i)
      out += spelled(any(kJoins)) + "[" + comparison() + "]";
    return out + "]";
  }
  std::string value() {
    switch (number(1, 6)) {
    case 1: return "#" + std::to_string(number(1, 33));
    case 2: return "-#" + std::to_string(number(1, 33));
    case 3: return "[" + expression(2) + "]";
    case 4: return blank() + "-" + blank() + digits();
    case 5: return "+" + digits();
    default: return blank() + digits();
    }
  }
  std::string words() {
    static const char* const kPlain[] = {"G0X5.Y-3.",    "G1 X10. F100", "M30",     "G65P9810Z5.F1000.",
                                         "G43 H1 Z 50.", "T1M6",         "X+1.Y.5", "G54G90Y2F500",
                                         "G04 P100",     "G28 G91 Z0"};
    if (chance(2)) return any(kPlain);
    std::string out;
    for (int i = number(1, 5); i > 0; --i) {
      out += std::string(1, "GXYZFMSTHDABCIJKPQRUVW"[number(0, 21)]) + value() + blank();
      if (chance(10)) out += comment();
    }
    return out;
  }
  std::string assignment() {
    return (chance(5) ? "#[" + expression(1) + "]" : "#" + std::to_string(number(1, 33))) + blank() + "=" +
           expression(3);
  }
  std::string jump() {
    return spelled("GOTO") +
           (chance(4) ? "[" + expression(1) + "]" : blank() + std::to_string(number(1, 9999)));
  }
  std::string statement() {
    switch (number(1, 12)) {
    case 1: return "";
    case 2: return spelled("IF") + condition() + jump();
    case 3: return "IF" + condition() + spelled("THEN") + (chance(4) ? jump() : assignment());
    case 4: return spelled("WHILE") + condition() + spelled("DO") + std::to_string(number(1, 3));
    case 5: return spelled("END") + blank() + std::to_string(number(1, 3));
    case 6: return jump();
    case 7: return chance(2) ? "POPEN" : "DPRNT[A*#1[53] B#502[40]]";
    case 8: return "SETVN 500[ONE,TWO]";
    case 9:
    case 10: return assignment();
    default: return words();
    }
  }

  std::mt19937 random_;
};

void sameByBothReaders(const std::string& text) {
  for (const macrob::Text kind : {macrob::Text::Program, macrob::Text::Listing}) {
    MacroFile fast(text, kind);
    MacroFile slow(text, kind, macrob::Reader::GrammarOnly);
    CHECK(fast.dump(true) == slow.dump(true));
    CHECK(fast.findings() == slow.findings());
  }
}

bool isMacroFile(const fs::path& path) {
  return path.extension() == ".nc" || path.filename() == "programs-ocr.txt";
}

} // namespace

TEST_CASE("macrob: both readers agree on made-up programs, and the layout keeps the tree") {
  for (unsigned seed = 1; seed <= draws(700U); ++seed) {
    CAPTURE(seed);
    const std::string text = Writer(seed).file();
    CAPTURE(text);
    MacroFile file(text);
    REQUIRE(file.told() == "");
    sameByBothReaders(text);
    const std::optional<std::string> once = file.format();
    REQUIRE(once);
    MacroFile again(*once);
    REQUIRE(again.told() == "");
    CHECK(again.dump() == file.dump());
    REQUIRE(again.format());
    CHECK(*again.format() == *once);
  }
}

TEST_CASE("macrob: text that is printed ends with its block") {
  for (const std::string text : {"DPRNT[A;M5\n", "SETVN 500[ONE;M5\n", "DPRNT[X#1[53];G0 X1]\n"}) {
    CAPTURE(text);
    sameByBothReaders(text);
  }
}

TEST_CASE("macrob: both readers agree on damaged programs") {
  static const std::string kBytes = "#[]=.,OD0()%/N\n*- \xB0x";
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  for (unsigned seed = 1; seed <= draws(400U); ++seed) {
    std::string text = Writer(seed).file();
    for (int i = 0; i < 3; ++i) {
      const std::size_t at = below(text.size());
      if (i == 0)
        text.erase(at, 1);
      else
        text[at] = kBytes[below(kBytes.size())];
    }
    CAPTURE(seed);
    CAPTURE(text);
    sameByBothReaders(text);
  }
}

TEST_CASE("macrob: the hand-written reader takes what programs mostly hold and leaves the rest") {
  const auto takes = [](const std::string& text, bool macros = true) {
    const SourceRange range{0, 0, static_cast<std::uint32_t>(text.size())};
    return macrob::scanBlock(text, range, Limits(), macros).has_value();
  };
  for (const char* plain : {"G1 X5. Y-3.F100", "N10G0", "/N10 X+1", "/2G1", "", "N5", "G65P9811Y-1Q5", "X .5",
                            "#1=2", "N5 #550 = #138", "#1=2.5(A)", "/#1=#2"}) {
    CHECK_MESSAGE(takes(plain), plain);
    CHECK_MESSAGE(takes(plain, false), plain);
  }
  for (const char* macro :
       {"#1=-2", "#1=2+1", "#1=[2]", "#[1]=2", "X#1", "X[1]", "X-#1", "GOTO1", "GOTO#1", "DO1", "END 1",
        "IF[#1EQ#0]GOTO5", "IF [#1 GT 2.] THEN #2=ABS#1", "WHILE[[#1LT2]AND[#2LT3]]DO2", "#1=SIN[#2]*3.",
        "IF[#1 EQ 2]THEN GOTO 5", "N5 G1 X[#1 MOD 5] F#9(A)"}) {
    CHECK_MESSAGE(takes(macro), macro);
    CHECK_MESSAGE(!takes(macro, false), macro);
  }
  for (const char* other : {"#1.=2",       "#1=",
                            "#1=2 3",      "#1=#2G1",
                            "##1=2",       "#1",
                            "O10",         "GO",
                            "X1,5",        "X1 0",
                            "x1",          "X",
                            "N1.",         "G1 N5",
                            "/0G1",        "X.",
                            "X1*2",        "1",
                            "IF",          "X1.2.3",
                            "/12 G1",      "N",
                            "POPEN",       "#1=[2",
                            "#1=2]",       "IF[#1]",
                            "GO TO1",      "IF[#1]GOTO1",
                            "DO",          "#1=ATAN[1]",
                            "#1=[1EQ2]",   "#1=a",
                            "DO1.",        "IF[1EQ2]THEN G1",
                            "WHILE[1EQ2]", "#1=2 A ND 3",
                            "#1=SIN",      "#1=POW[1,2]"})
    CHECK_MESSAGE(!takes(other), other);
}

TEST_CASE("macrob: both readers agree on the corpus, and the layout keeps its programs") {
  fs::path corpus;
  if (!haveCorpus(corpus)) return;
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(corpus)) {
    if (!entry.is_regular_file() || !isMacroFile(entry.path())) continue;
    ++files;
    CAPTURE(entry.path().string());
    const std::string text = readAll(entry.path());
    sameByBothReaders(text);
    MacroFile file(text);
    if (const std::optional<std::string> once = file.format()) {
      MacroFile again(*once);
      CHECK(again.dump() == file.dump());
      CHECK(again.format() == once);
    }
  }
  CHECK(files >= 17);
}
