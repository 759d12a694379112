// One block of NC: words, numbers, formulas, comments, holes, and what is no block.
#include "tests/Draws.h"
#include "tests/unit/NcHelper.h"

#include <doctest/doctest.h>
#include <random>

using namespace dotek;
using namespace dotek::frontend;
using dotek::tests::Nc;

namespace {

std::string text(const nc::Expression& e) {
  if (const auto* n = std::get_if<nc::Number>(&e.node)) return n->digits;
  if (const auto* h = std::get_if<nc::Hole>(&e.node)) return "<" + h->name + ">";
  if (const auto* v = std::get_if<nc::VariableRef>(&e.node)) return "#{" + text(*v->number) + "}";
  if (const auto* n = std::get_if<nc::Negated>(&e.node)) return "-" + text(*n->operand);
  if (const auto* o = std::get_if<nc::Operation>(&e.node))
    return "(" + text(*o->left) + " " + o->op + " " + text(*o->right) + ")";
  const auto& call = std::get<nc::FunctionCall>(e.node);
  std::string out = call.name;
  for (const auto& argument : call.arguments)
    out += " " + text(*argument);
  return out + ";";
}

std::string text(const nc::Block& block) {
  std::string out;
  const auto item = [&](const std::string& one) { out += (out.empty() ? "" : " ") + one; };
  if (block.blockDelete) item("/");
  if (block.sequenceNumber) item("N" + std::to_string(*block.sequenceNumber));
  if (block.programMark) item("%");
  for (const nc::Word& word : block.words)
    item(word.address + (word.value ? text(*word.value) : "?"));
  for (const nc::Assignment& one : block.assignments)
    item("#{" + text(*one.variable) + "}=" + text(*one.value));
  for (const nc::Comment& comment : block.comments)
    item("(" + comment.text + ")");
  return out;
}

std::string parsed(const std::string& block) {
  Nc nc;
  const auto result = nc.parse(block);
  if (!nc.diagnostics.empty()) return (result ? "with " : "refused: ") + nc.codes();
  return result ? text(*result) : "refused without a word";
}

// Where the one finding points.
std::string pointed(const std::string& block) {
  Nc nc;
  CHECK_FALSE(nc.parse(block));
  return nc.pointedAt();
}

} // namespace

TEST_CASE("words of a block: blanks are free, numbers keep their digits") {
  CHECK(parsed("G65 P9770 Z5. F1000") == "G65 P9770 Z5. F1000");
  CHECK(parsed(" G 65P9811Y-1Q5 ") == "G65 P9811 Y-1 Q5");
  CHECK(parsed("G0X.5Y-5.Z+12.25") == "G0 X.5 Y-5. Z12.25");
  CHECK(parsed("G54.1 P48") == "G54.1 P48");
  CHECK(parsed("") == "");
  CHECK(parsed("  \t ") == "");
  CHECK(parsed("N120 M5") == "N120 M5");
  CHECK(parsed("N10( TOOL LIST)") == "N10 ( TOOL LIST)");
  CHECK(parsed("/2 N5 G0") == "/ N5 G0");
  CHECK(parsed("G0 (A) X1. (B (C)") == "G0 X1. (A) (B (C)");
  CHECK(parsed("%") == "%");
  CHECK(parsed("O8000(TITLE)") == "O8000 (TITLE)");
  CHECK(parsed("G91 G28 M5 M9") == "G91 G28 M5 M9");
  CHECK(parsed("G0 X") == "G0 X?");
}

TEST_CASE("holes are where a number is") {
  CHECK(parsed("X{a} Y {b}F200") == "X<the field `a`> Y<the field `b`> F200");
  CHECK(parsed("#550={a}+1") == "#{550}=(<the field `a`> + 1)");
  CHECK(parsed("X[{a}*2.]") == "X(<the field `a`> * 2.)");
  CHECK(parsed("X1{a}") == "refused: [digits-beside-value]");
  CHECK(parsed("X{a}5.") == "refused: [digits-beside-value]");
  CHECK(parsed("X{a}.") == "refused: [digits-beside-value]");
  CHECK(parsed("X{a}{b}") == "refused: [syntax-error]");
  CHECK(parsed("X1. {a}") == "refused: [syntax-error]");
  CHECK(parsed("{a} X1.") == "refused: [syntax-error]");
  CHECK(parsed("N{a} X1.") == "refused: [syntax-error]");
  CHECK(parsed("(DEPTH {a})") == "with [value-named]");
  CHECK(parsed("#3006=1(DEPTH {a})") == "refused: [value-in-comment]");
  CHECK(parsed("IF[#1GT1.]THEN#3000=1(DEPTH {a})") == "refused: [value-in-comment]");
  CHECK(pointed("G0 X{a}25 Y1.") == "25");
}

TEST_CASE("a sign before a hole negates, with a warning") {
  Nc nc;
  const auto block = nc.parse("X-{a} Y+{b} Z[1.-{c}] #1");
  CHECK_FALSE(block); // the #1
  Nc signs;
  const auto words = signs.parse("X-{a} Y+{b} Z[1.-{c}]");
  REQUIRE(words);
  CHECK(text(*words) == "X-<the field `a`> Y<the field `b`> Z(1. - <the field `c`>)");
  CHECK(signs.codes() == "[sign-before-value], [sign-before-value]"); // a difference is no sign
  CHECK(signs.sources.text(signs.diagnostics.all()[0].range) == "-");
}

TEST_CASE("formulas: functions bind before * / AND MOD, these before + - OR XOR, left to right") {
  CHECK(parsed("#1=#2+#3*#4-5") == "#{1}=((#{2} + (#{3} * #{4})) - 5)");
  CHECK(parsed("#1=2+12AND10") == "#{1}=(2 + (12 AND 10))");
  CHECK(parsed("#1=8/4*2 MOD 3") == "#{1}=(((8 / 4) * 2) MOD 3)");
  CHECK(parsed("#1=1OR2XOR3") == "#{1}=((1 OR 2) XOR 3)");
  CHECK(parsed("#1=SIN[[[#2+#3]*#4+#5]*#6]") == "#{1}=SIN ((((#{2} + #{3}) * #{4}) + #{5}) * #{6});");
  CHECK(parsed("#[#1+500]=-[#2]") == "#{(#{1} + 500)}=-#{2}");
  CHECK(parsed("#1=ATAN[#2]/[#3]*2") == "#{1}=(ATAN #{2} #{3}; * 2)");
  CHECK(parsed("#1=ATAN[#2,#3]") == "#{1}=ATAN #{2} #{3};");
  CHECK(parsed("#1=[ATAN[#2]]/[2]") == "#{1}=(ATAN #{2}; / 2)");
  CHECK(parsed("#1=POW[2,3]") == "#{1}=POW 2 3;");
  CHECK(parsed("#1=--5") == "#{1}=--5");
  CHECK(parsed("X-#5 Y[#1+2.] Z-[#2] P#3") == "X-#{5} Y(#{1} + 2.) Z-#{2} P#{3}");
  CHECK(parsed("N10 #550=#138 (COPY)") == "N10 #{550}=#{138} (COPY)");
}

TEST_CASE("what is no block is refused at its place") {
  CHECK(parsed("#1=") == "refused: [syntax-error]");
  CHECK(parsed("#1=#") == "refused: [syntax-error]");
  CHECK(parsed("##1=5") == "refused: [syntax-error]");
  CHECK(parsed("#1 5") == "refused: [syntax-error]");
  CHECK(parsed("#1=SIN 5") == "refused: [syntax-error]");
  CHECK(parsed("#1=SIN[5") == "refused: [syntax-error]");
  CHECK(parsed("#1=SIN[5,6]") == "refused: [syntax-error]");
  CHECK(parsed("#1=[5") == "refused: [syntax-error]");
  CHECK(parsed("#1=5]") == "refused: [unexpected-character]");
  CHECK(parsed("#1=FOO[5]") == "refused: [unexpected-character]");
  CHECK(parsed("#1=5 #2=6") == "refused: [syntax-error]");
  CHECK(parsed("#1=ATAN[5]/2") == "refused: [syntax-error]");
  CHECK(parsed("X.") == "refused: [syntax-error]");
  CHECK(parsed("X-") == "refused: [syntax-error]");
  CHECK(parsed("X+#1") == "refused: [syntax-error]");
  CHECK(parsed("X1..5") == "refused: [unexpected-character]");
  CHECK(parsed("X1 0") == "refused: [unexpected-character]");
  CHECK(parsed("X12345678") == "X12345678");
  CHECK(parsed("X123456789") == "refused: [syntax-error]");
  CHECK(parsed("X0.00000001") == "refused: [syntax-error]");
  CHECK(parsed("X.00000001") == "X.00000001");
  CHECK(parsed("X1,5") == "refused: [unexpected-character]");
  CHECK(parsed("G0 (OPEN") == "refused: [syntax-error]");
  CHECK(parsed("G0 N5") == "refused: [syntax-error]");
  CHECK(parsed("N123456789 G0") == "refused: [syntax-error]");
  CHECK(parsed("G0 %") == "refused: [unexpected-character]");
  CHECK(parsed("% G0") == "refused: [unexpected-character]");
  CHECK(parsed("G0 \xE1") == "refused: [unexpected-character]");
  CHECK(parsed(std::string("G0 \x01 X1.", 8)) == "refused: [unexpected-character]");
  CHECK(pointed("G0 X1. = Y2.") == "=");
  CHECK(pointed("G0 x1.") == "x");
  CHECK(parsed("G0 x1.") == "refused: [lower-case-address]");
}

TEST_CASE("statements of a macro program are refused by name") {
  for (const std::string one : {"THEN#1=2", "SETVN500[A]"}) {
    INFO(one);
    CHECK(parsed("N10 " + one) == "refused: [macro-statement]");
  }
  CHECK(pointed("N5 SETVN500[A]") == "SETVN");
}

TEST_CASE("statements of the port are read with what they print") {
  const auto errors = [](const std::string& text) {
    CAPTURE(text);
    return parsed(text);
  };
  CHECK(errors("POPEN").find("refused") == std::string::npos);
  CHECK(errors("N10 DPRNT[ANA*D#544[43]*X#545[53]]").find("refused") == std::string::npos);
  CHECK(errors("BPRNT[#100[4]]").find("refused") == std::string::npos);
  CHECK(errors("DPRNT X#100[53]") == "refused: [syntax-error]");
  CHECK(errors("DPRNT[X#100[53]") == "refused: [syntax-error]");
  CHECK(errors("DPRNT[X#100]") == "refused: [syntax-error]");
  CHECK(errors("DPRNT[X#100[5]]") == "refused: [syntax-error]");
  CHECK(errors("DPRNT[X#[53]]") == "refused: [syntax-error]");
  CHECK(errors("G0 X1. DPRNT[X#100[53]]") == "refused: [mixed-block]");
  CHECK(errors("POPEN G0 X1.") == "refused: [mixed-block]");
}

TEST_CASE("statements that steer a branch: their condition and where they lead") {
  for (const std::string one :
       {"IF[#100EQ0]GOTO10", "IF [ABS[#100-[5.+.1]] LT .01] THEN #101=2.", "GOTO100", "WHILE[#100LE5]DO1",
        "GOTO[70+2]", "IF[#100EQ1]GOTO[2*[30+6]]", "DO2", "END2", "IF[[#100GT1]AND[#101LT[#102+2]]]GOTO8",
        "IF[[#100GT1]XOR[#101LT2]]GOTO8", "IF[[#100GT1]XOR[#101LT2]OR[#100EQ#0]]THEN#102=1.",
        "IF[#100NE#0]THEN GOTO10"}) {
    INFO(one);
    CHECK(parsed("N10 " + one).find("refused") == std::string::npos);
  }
  CHECK(parsed("IF[#100]GOTO10") == "refused: [syntax-error]");
  CHECK(parsed("IF[#100EQ1]") == "refused: [syntax-error]");
  CHECK(parsed("IF#100EQ1 GOTO10") == "refused: [syntax-error]");
  CHECK(parsed("IF[#100EQ1]THEN M5") == "refused: [syntax-error]");
  CHECK(parsed("WHILE[#100EQ1]GOTO5") == "refused: [syntax-error]");
  CHECK(parsed("GOTO#100") == "refused: [jump-computed]");
  CHECK(parsed("GOTO[100+#1]") == "refused: [jump-computed]");
  CHECK(parsed("GOTO[7.5]") == "refused: [jump-computed]");
  CHECK(parsed("GOTO[5-5]") == "refused: [jump-computed]");
  CHECK(parsed("G0 GOTO10") == "refused: [mixed-block]");
  CHECK(parsed("GOTO10 G0") == "refused: [mixed-block]");
}

TEST_CASE("words and an assignment exclude each other, an address appears once") {
  CHECK(parsed("G0 #1=5") == "refused: [mixed-block]");
  CHECK(parsed("#1=5 G0") == "refused: [mixed-block]");
  CHECK(parsed("G0 X1. Y2. X3.") == "refused: [address-twice]");
  CHECK(parsed("G65 P9820 Z0 I10. J5. I20.") == "refused: [arguments-repeated]");
  CHECK(pointed("G0 X1. Y2. X3.") == "X3.");
  CHECK(parsed("G0 G90 M5 M9") == "G0 G90 M5 M9");
  CHECK(parsed("N10 N20 G0") == "refused: [syntax-error]");
}

TEST_CASE("brackets, chains and length are bounded") {
  const auto nested = [](std::size_t depth) {
    return "#1=" + std::string(depth, '[') + "1" + std::string(depth, ']');
  };
  CHECK(parsed(nested(64)) == "#{1}=1");
  CHECK(parsed(nested(65)) == "refused: [nesting-too-deep]");
  CHECK(parsed("#1=" + std::string(65, '-') + "1") == "refused: [nesting-too-deep]");
  CHECK(parsed("#1=" + std::string(5000, '[')) == "refused: [nesting-too-deep]");
  std::string chain = "#1=1";
  for (int i = 0; i < 1001; ++i)
    chain += "+1";
  CHECK(parsed(chain) == "refused: [too-many-tokens]");
  CHECK(parsed("(" + std::string(20000, 'A') + ")") == "refused: [line-too-long]");
}

TEST_CASE("places are those of the pieces, whatever the text stands for") {
  Nc nc;
  const FileId file = nc.sources.add(SourceFile("p", "'G0 X' F('a') SpinOff", Encoding::Utf8));
  const auto at = [&](std::uint32_t begin, std::uint32_t end) { return SourceRange{file, begin, end}; };
  const auto block = nc::parseBlock({nc::TextPiece{"G0 X", at(1, 5)},
                                     nc::HolePiece{{ir::constant(1), nullptr, "a"}, at(7, 13)},
                                     nc::TextPiece{" M5", at(14, 21)}},
                                    nc.limits, nc.diagnostics);
  REQUIRE(block);
  REQUIRE(block->words.size() == 3);
  CHECK(nc.sources.text(block->range) == "G0 X' F('a') SpinOff");
  CHECK(nc.sources.text(block->words[0].range) == "G0");
  CHECK(nc.sources.text(block->words[1].range) == "X' F('a')");
  CHECK(nc.sources.text(block->words[2].range) == "SpinOff");
}

TEST_CASE("a printed block parses to itself") {
  std::mt19937 random(20240521);
  const auto upTo = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto number = [&] {
    std::string digits = std::to_string(upTo(2000));
    if (upTo(2) == 0) digits += "." + (upTo(2) == 0 ? std::to_string(upTo(100)) : "");
    return digits;
  };
  int withWords = 0;
  const int rounds = tests::draws(2000);
  for (int round = 0; round < rounds; ++round) {
    std::string block = upTo(3) == 0 ? "N" + std::to_string(1 + upTo(9999)) : "";
    std::string expected = block;
    const auto both = [&](const std::string& written, const std::string& read) {
      block += std::string(static_cast<std::size_t>(upTo(2)), ' ') + written;
      expected += (expected.empty() ? "" : " ") + read;
    };
    std::string letters = "ABCDEFGHIJKLMPQRSTUVWXYZ";
    std::shuffle(letters.begin(), letters.end(), random);
    const int words = upTo(8);
    for (int i = 0; i < words; ++i) {
      const std::string letter(1, letters[static_cast<std::size_t>(i)]);
      // Two bare letters in a row could spell a keyword, so each has a value.
      switch (upTo(4)) {
      case 0: both(letter + "-" + std::to_string(upTo(500)) + ".5", ""); break;
      case 1: both(letter + "#" + std::to_string(100 + upTo(50)), ""); break;
      default: both(letter + number(), ""); break;
      }
      std::string read = block.substr(block.rfind(letter));
      const std::size_t mark = read.find('#');
      if (mark != std::string::npos) read = read.substr(0, mark) + "#{" + read.substr(mark + 1) + "}";
      expected += read;
      withWords += 1;
    }
    // both() put a separator before each word already.
    INFO(block);
    const std::string result = parsed(block);
    CHECK(result == expected);
    CHECK(parsed(result.find('#') == std::string::npos ? result : block) == expected);
  }
  CHECK(withWords > rounds);
}
