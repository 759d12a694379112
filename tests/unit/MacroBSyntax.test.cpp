// What the readers make of blocks: reference on Macro B, sections 1.1 to 1.9.
#include "tests/unit/MacroBHelper.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;
namespace macrob = dotek::frontend::macrob;

namespace {

// The tree of one block, one line, without places: what the layout prints is checked elsewhere.
std::string tree(const std::string& block) {
  MacroFile file(block + "\n");
  CHECK_MESSAGE(file.told() == "", block);
  std::string out;
  std::string text = file.dump();
  std::size_t skip = 0; // file, program, block
  for (int i = 0; i < 3; ++i)
    skip = text.find('\n', skip) + 1;
  text = text.substr(skip);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    std::string line = text.substr(at, end - at);
    line.erase(0, line.find_first_not_of(' '));
    out += (out.empty() ? "" : "|") + line;
    at = end + 1;
  }
  return out;
}

// The whole block brought into the style, which shows how it was read.
std::string read(const std::string& block) {
  MacroFile file(block + "\n");
  CHECK_MESSAGE(file.told() == "", block);
  std::string text = file.format().value_or("?");
  if (!text.empty()) text.pop_back();
  return text;
}

} // namespace

TEST_CASE("macrob: blanks have no meaning (1.1)") {
  CHECK(read("WHILE[#6LE#4]DO1") == "WHILE[#6 LE #4]DO1");
  CHECK(read("W H I L E [ # 6 L E # 4 ] D O 1") == "WHILE[#6 LE #4]DO1");
  CHECK(read("IF[#10EQ2]THENGOTO100") == "IF[#10 EQ 2]THEN GOTO 100");
  CHECK(read("GO TO 10") == "GOTO 10");
  CHECK(read("G65P9811Y-1Q5") == "G65 P9811 Y-1 Q5");
  CHECK(read("G 65 P 9811 Y - 1 Q5") == "G65 P9811 Y-1 Q5");
  CHECK(read("N 10 # 1 = # [ 2000 + # 7 ]") == "N10 #1=#[2000+#7]");
}

TEST_CASE("macrob: keywords go before single letters, the longest first (1.1)") {
  CHECK(tree("#1=ATAN[1]") == "assignment|number 1|function ATAN|number 1");
  CHECK(read("X[ATAN[#1]]") == "X[ATAN[#1]]");
  CHECK(read("#1=#2XOR#3") == "#1=#2 XOR #3");
  CHECK(read("#1=#2ORROUND[#3]") == "#1=#2 OR ROUND[#3]");
  CHECK(read("#1=ASIN[#2]ANDSIN[#3]") == "#1=ASIN[#2] AND SIN[#3]");
  CHECK(read("IF[#1GTTAN[#2]]GOTO1") == "IF[#1 GT TAN[#2]]GOTO 1");
  CHECK(tree("END1") == "end 1");
  CHECK(tree("DO2") == "do 2");
}

TEST_CASE("macrob: precedence (1.4)") {
  // AND binds like a product, OR and XOR like a sum.
  CHECK(tree("#1=2+12AND10") == "assignment|number 1|operation +|number 2|operation AND|number 12|number 10");
  CHECK(tree("#1=2OR3*4") == "assignment|number 1|operation OR|number 2|operation *|number 3|number 4");
  CHECK(tree("#1=2-3-4") == "assignment|number 1|operation -|operation -|number 2|number 3|number 4");
  CHECK(tree("#1=8/4/2") == "assignment|number 1|operation /|operation /|number 8|number 4|number 2");
  CHECK(tree("#1=-2*3") == "assignment|number 1|operation *|negated|number 2|number 3");
  CHECK(tree("#1=2*[3+4]") == "assignment|number 1|operation *|number 2|operation + []1|number 3|number 4");
  CHECK(tree("#1=7MOD3+1") == "assignment|number 1|operation +|operation MOD|number 7|number 3|number 1");
}

TEST_CASE("macrob: the slash after ATAN belongs to it where brackets follow (1.5)") {
  CHECK(tree("#1=ATAN[2]/[3]") == "assignment|number 1|function ATAN|number 2|number 3");
  CHECK(tree("#1=[ATAN[2]]/[3]") ==
        "assignment|number 1|operation /|function ATAN []1|number 2|number 3 []1");
  CHECK(tree("#1=ATAN[2]/3") == "assignment|number 1|operation /|function ATAN|number 2|number 3");
  CHECK(tree("#1=-2*ATAN[3]/[4]*5") == "assignment|number 1|operation *|operation *|negated|number "
                                       "2|function ATAN|number 3|number 4|number 5");
  CHECK(tree("#1=-ATAN[2]/[3]") == "assignment|number 1|negated|function ATAN|number 2|number 3");
  CHECK(tree("#1=ATAN[2,3]") == "assignment|number 1|function ATAN comma|number 2|number 3");
  CHECK(tree("#1=SIN[2]/[3]") == "assignment|number 1|operation /|function SIN|number 2|number 3 []1");
}

TEST_CASE("macrob: words and what they take (1.1)") {
  CHECK(tree("X#1") == "word X|variable|number 1");
  CHECK(tree("X-#1") == "word X|negated|variable|number 1");
  CHECK(tree("X[#1+#2]") == "word X|operation + []1|variable|number 1|variable|number 2");
  CHECK(tree("G#1M#2T#3") == "word G|variable|number 1|word M|variable|number 2|word T|variable|number 3");
  CHECK(tree("X#[#1+2]") == "word X|variable|operation + []1|variable|number 1|number 2");
  CHECK(tree("X-.5Y5.Z+3") == "word X|negated|number .5|word Y|number 5.|word Z|number 3");
  CHECK(tree("G10L2P1N5") == "word G|number 10|word L|number 2|word P|number 1|word N|number 5");
}

TEST_CASE("macrob: functions without brackets are in programs that ran (1.5)") {
  CHECK(tree("#1=ABS#[#7+#9]") ==
        "assignment|number 1|function ABS bare|variable|operation + []1|variable|number 7|variable|number 9");
  CHECK(tree("#1=[SIN #2]*3") ==
        "assignment|number 1|operation *|function SIN bare []1|variable|number 2|number 3");
}

TEST_CASE("macrob: statements (1.7, 1.9)") {
  CHECK(tree("GOTO#1") == "goto|variable|number 1");
  CHECK(tree("GOTO[#1+10]") == "goto|operation + []1|variable|number 1|number 10");
  CHECK(tree("IF[#1EQ#0]GOTO10") == "if|compare EQ []1|variable|number 1|variable|number 0|goto|number 10");
  CHECK(tree("IF[#1EQ2]THEN#3=4") ==
        "if then|compare EQ []1|variable|number 1|number 2|assignment|number 3|number 4");
  CHECK(tree("IF[[#1EQ1]AND[#2LT3]]GOTO5") == "if|join AND []1|compare EQ []1|variable|number 1|number "
                                              "1|compare LT []1|variable|number 2|number 3|goto|number 5");
  CHECK(tree("IF[[#1AND1]EQ1]GOTO5") ==
        "if|compare EQ []1|operation AND []1|variable|number 1|number 1|number 1|goto|number 5");
  CHECK(tree("WHILE[#1LE2]DO3") == "while do 3|compare LE []1|variable|number 1|number 2");
  CHECK(tree("POPEN") == "popen");
  CHECK(tree("PCLOS") == "pclos");
  CHECK(tree("DPRNT[X#100[53]* Y#2[ 80 ]]") == "dprnt|\"X\"|#100[53]|\"* Y\"|#2[80]");
  CHECK(tree("BPRNT[C#100[2]]") == "bprnt|\"C\"|#100[2]");
  CHECK(tree("SETVN510[ONE, TWO]") == "setvn 510 \"ONE\" \"TWO\"");
  CHECK(tree("#[#1+5]=#2") == "assignment|operation + []1|variable|number 1|number 5|variable|number 2");
}

TEST_CASE("macrob: block delete, numbers, comments and their places") {
  CHECK(MacroFile("/N10 G1\n").dump().find("block / N10\n") != std::string::npos);
  CHECK(MacroFile("/2 N10 #1=1\n").dump().find("block /2 N10\n") != std::string::npos);
  CHECK(MacroFile("N010 (A) G1 (B) X1 (C)\n").dump().find(R"(      word G
        number 1
      word X
        number 1
      comment 0 "A"
      comment 1 "B"
      comment 2 "C"
)") != std::string::npos);
  CHECK(MacroFile("(A) #3000=1 (B)\n").dump().find("comment 0 \"A\"\n      comment 1 \"B\"") !=
        std::string::npos);
  // Division inside brackets, block delete at the start.
  CHECK(tree("#1=#2/3") == "assignment|number 1|operation /|variable|number 2|number 3");
}

TEST_CASE("macrob: programs of a file (1.1)") {
  MacroFile file("%\nO0010(FIRST)\nG0\nM99\n:500\nM99\n<MAIN-1>(SECOND)\nM30\n%\n");
  CHECK(file.told() == "");
  REQUIRE(file.file.programs.size() == 3);
  CHECK(file.file.markFirst);
  CHECK(file.file.markLast);
  CHECK(file.file.programs[0].name->number == 10);
  CHECK(file.file.programs[0].comments.at(0).text == "FIRST");
  CHECK(file.file.programs[0].blocks.size() == 2);
  CHECK(file.file.programs[1].name->kind == macrob::ProgramName::Kind::Colon);
  CHECK(file.file.programs[1].name->number == 500);
  CHECK(file.file.programs[2].name->text == "MAIN-1");
  CHECK(file.format() == "%\nO0010(FIRST)\nG0\nM99\n:500\nM99\n<MAIN-1>(SECOND)\nM30\n%\n");

  MacroFile without("G0 X1.\nM30\n%\n");
  CHECK(without.told() == "");
  CHECK_FALSE(without.file.programs.at(0).name);
  CHECK_FALSE(without.file.markFirst);
  CHECK(without.file.markLast);
  // A header may share its line with a block.
  MacroFile shared("O10 G90 (A)\nM30\n");
  CHECK(shared.told() == "");
  REQUIRE(shared.file.programs.size() == 1);
  CHECK(shared.format() == "O10\nG90(A)\nM30\n");
}

TEST_CASE("macrob: what is outside the marks") {
  MacroFile leader("PART 7 REV B\n%\nO1\nM30\n%\n");
  CHECK(leader.told() == "W 1:1 text-before-start");
  CHECK(leader.file.programs.size() == 1);
  CHECK(leader.format() == "PART 7 REV B\n%\nO1\nM30\n%\n");
  CHECK(MacroFile("%\nO1\nM30\n%\nO2\nM30\n%\n").told() == "W 4:1 text-after-end");
  CHECK(MacroFile("O1\nM30\n%\nO2\nM30\n%\n").told() == "W 3:1 text-after-end");
}

TEST_CASE("macrob: ends of blocks") {
  for (const std::string end : {"\n", "\r\n", "\r", ";\n", ";"}) {
    MacroFile file("O1" + end + "G0 X1." + end + "#1=2" + end + "M30" + end);
    CHECK(file.told() == "");
    CHECK(file.format() == "O1\nG0 X1.\n#1=2\nM30\n");
  }
  CHECK(MacroFile("G0 X1.").format() == "G0 X1.\n");
  CHECK(MacroFile("").format() == "");
  CHECK(MacroFile("\n\n \n").format() == "");
}

TEST_CASE("macrob: a comment that was broken over lines is joined") {
  MacroFile file("#1=2 (FIRST\n   SECOND)\nM30\n");
  CHECK(file.told() == "W 1:6 comment-over-lines");
  CHECK(file.format() == "#1=2(FIRST SECOND)\nM30\n");
  CHECK(file.fixed("comment-over-lines") == "#1=2 (FIRST SECOND)\nM30\n");
  // Two comments are not one.
  CHECK(MacroFile("G0 X1. (FIRST\nG0 X2. (SECOND)\n").told() == "E 1:8 open-comment");
  CHECK(MacroFile("G0 (FIRST\n\n\n\nX)\n").told() == "E 1:4 open-comment; E 5:2 syntax-error");
  CHECK(MacroFile("G0 X1. (\n%\n").told() == "E 1:8 open-comment");
  CHECK(MacroFile("G0 (A (B) C)\n").told() == "E 1:12 syntax-error");
}

TEST_CASE("macrob: a bad block is one error, and the next one is read") {
  const auto one = [](const std::string& block) { return MacroFile(block + "\n#1=2\n").told(); };
  CHECK(one("G1 X1. #1=2") == "E 1:8 nc-and-macro-statement");
  CHECK(one("#1=2 G1 X5.") == "E 1:6 nc-and-macro-statement");
  CHECK(one("G1 X1. GOTO 5") == "E 1:8 nc-and-macro-statement");
  CHECK(one("IF[#1EQ2]THEN G0 X1.") == "E 1:15 then-takes-macro-statement");
  CHECK(one("#1=[2") == "E 1:4 brackets-do-not-match");
  CHECK(one("#1=2]*3") == "E 1:5 brackets-do-not-match");
  CHECK(one("#1=#2=#3") == "E 1:6 second-equals");
  CHECK(one("R[#1]=5.") == "E 1:1 assignment-target");
  CHECK(one("##1=5") == "E 1:2 syntax-error");
  CHECK(one("IF[#1=#2]GOTO9") == "E 1:6 sign-unknown");
  CHECK(MacroFile("WHILE[#1=2]DO1\n").diagnostics.all().front().message ==
        "`=` is no sign of Macro B here; the control stops with an alarm; write `EQ`");
  CHECK(one("#1=2 3X") == "E 1:7 syntax-error");
  CHECK(one("#1=5.SIN[#2]") == "E 1:6 missing-operator");
  CHECK(one("#1=5.#2") == "E 1:6 missing-operator");
  CHECK(one("643 G1") == "E 1:1 number-without-address");
  CHECK(one("X SIN[#1]") == "E 1:3 syntax-error");
  CHECK(one("G1 X Y5.") == "E 1:4 syntax-error");
  CHECK(one("#2=[1LT2]") == "E 1:4 comparison-is-no-number");
  CHECK(one("#2=1LT2") == "E 1:4 comparison-is-no-number");
  CHECK(one("IF[#1]GOTO5") == "E 1:3 condition-without-comparison");
  CHECK(one("IF[[#1EQ2]AND#3]GOTO5") == "E 1:4 comparison-is-no-number");
  CHECK(one("#1=SIN[1.,2.]") == "E 1:4 function-operands");
  CHECK(one("#1=POW[2.]") == "E 1:4 function-operands");
  CHECK(one("#1=*5") == "E 1:4 syntax-error");
  CHECK(one("#1=5+") == "E 1:5 syntax-error");
  CHECK(one("#1=SIN[]") == "E 1:7 syntax-error");
  CHECK(one("#1=") == "E 1:3 syntax-error");
  CHECK(one("IF#1EQ2GOTO5") == "E 1:3 syntax-error");
  CHECK(one("WHILE[#1EQ2]GOTO5") == "E 1:13 syntax-error");
  CHECK(one("DPRNT X#100[53]") == "E 1:7 syntax-error");
  CHECK(one("DPRNT[X#100]") == "E 1:8 printed-variable-form");
  CHECK(one("DPRNT[X#100[53]") == "E 1:6 brackets-do-not-match");
  CHECK(one("N1.5 G0") == "E 1:2 sequence-number-form");
  CHECK(one("/12 G0") == "E 1:2 block-delete-number");
  CHECK(one("#1.5=2") == "E 1:2 variable-number-form");
  CHECK(one("this is text") == "E 1:1 text-without-brackets");
  CHECK(one("G0 X{5}") == "E 1:5 unexpected-character");
  CHECK(one("#1=LTE") == "E 1:4 syntax-error");
  // The block is kept as it is, its number too.
  CHECK(MacroFile("N5 #1=[2\n").dump().find("block N5\n      unread \"N5 #1=[2\"") != std::string::npos);
}

TEST_CASE("macrob: blanks inside numbers") {
  MacroFile file("G1 X1 0.5\n");
  CHECK(file.told() == "W 1:5 blank-in-number");
  CHECK(file.dump().find("number 10.5") != std::string::npos);
}

TEST_CASE("macrob: limits") {
  Limits limits;
  limits.lineBytes = 30;
  MacroFile longLine("G0 X1.\n#1=2+2+2+2+2+2+2+2+2+2+2+2+2+2+2\nM30\n", macrob::Reader::Fast, limits);
  CHECK(longLine.told() == "E 2:1 line-too-long");
  CHECK(longLine.dump().find("word M") != std::string::npos);
  limits = {};
  limits.nesting = 4;
  CHECK(MacroFile("#1=[[[[[1]]]]]\n#2=3\n", macrob::Reader::Fast, limits).told() == "E 1:8 nesting-too-deep");
  limits = {};
  limits.lineTokens = 6;
  for (const auto reader : {macrob::Reader::Fast, macrob::Reader::GrammarOnly})
    CHECK(MacroFile("#1=2+3+4+5\n#2=3\n", reader, limits).told() == "E 1:7 too-many-tokens");
  std::string deep = "#1=";
  for (int i = 0; i < 3000; ++i)
    deep += '-';
  CHECK(MacroFile(deep + "1\n").told().starts_with("E 1:"));
}
