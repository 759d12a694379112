// Damaged input: a diagnostic, no crash, an end.
#include "ComPostHelper.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"

#include <doctest/doctest.h>

#include <random>
#include <string>

using namespace dotek;
using namespace dotek::tests;

namespace {

std::string repeated(const std::string& text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i)
    result += text;
  return result;
}

const std::string kProg =
    "FORMAT(OpFieldData#,10)\n#10 = '###.##;0'\n{ c }\ngo: {x}\nIF CycleType?('A.B') AND NOT (Q? OR R?)\n"
    " SeqC ' Z'OpFieldData#('Zb')'' EOL\nELSE\n SetFlag ('f') SpinOff EOL\nEND\nRETURN\nb: IF A? RETURN\n";

} // namespace

TEST_CASE("deep nesting is one error, and the next routine is read") {
  const auto check = [](const std::string& deep) {
    Prog prog("a: 'x' EOL\n" + deep + "\nRETURN\nb: 'y' EOL RETURN\n");
    CHECK(prog.only().find("nesting-too-deep") != std::string::npos);
    CHECK(prog.findings().size() == 1);
    CHECK(prog.program.hasErrorNodes);
    CHECK(prog.shape().find("routine b") != std::string::npos);
  };
  check(repeated("IF A?\n", 100000));
  check(repeated("W(\n", 100000));
  check("IF " + repeated("(\n", 100000));
}

TEST_CASE("long lines are one error each") {
  Prog blanked("a: 'x' EOL\n" + repeated("IF A? ", 180000) + "\n'y' EOL RETURN\nb: RETURN\n");
  CHECK(blanked.only() == "2:1 line-too-long");
  CHECK(blanked.program.hasErrorNodes);
  CHECK(blanked.shape().find("routine b") != std::string::npos);
  Prog dense("a: 'x' EOL\n" + repeated("EOL ", 3000) + "\nRETURN\nb: RETURN\n");
  CHECK(dense.findings().size() == 1);
  CHECK(dense.only().find("too-many-tokens") != std::string::npos);
  Prog routines(repeated("r: EOL RETURN ", 1000));
  CHECK(routines.only().find("too-many-tokens") != std::string::npos);
}

TEST_CASE("many errors are reported in a time that grows with their number") {
  Prog strays("a:\n" + repeated(")\n", 40000) + "RETURN");
  CHECK(strays.findings().size() == Diagnostics::kMostAlike + 1);
  Prog texts("a:\n" + repeated("'END\n", 40000) + "RETURN");
  CHECK(texts.findings().size() == Diagnostics::kMostAlike + 1);
}

TEST_CASE("empty files and files of blanks and comments are empty Progs") {
  for (const char* text : {"", " \t\r\n", "{ only a comment }", "\xEF\xBB\xBF"}) {
    Prog prog(text);
    CHECK(prog.diagnostics.empty());
    CHECK(prog.program.items.empty());
  }
}

TEST_CASE("a Prog cut anywhere ends, and what follows the cut is not made up") {
  for (std::size_t length = 0; length <= kProg.size(); ++length) {
    Prog prog(kProg.substr(0, length));
    CHECK(prog.findings().size() <= 3);
    CHECK(!prog.dump().empty());
  }
}

TEST_CASE("random bytes and mutated Progs are read to the end") {
  std::mt19937 random(7);
  const std::string pieces[] = {"IF ",    "ELSE ", "END ",         "RETURN\n", "x:",   "(",    ")", "'",
                                "{",      "}",     "AND ",         "NOT ",     "#1",   "=",    ",", "EOL ",
                                "FORMAT", "Q?",    "N#",           "W ",       "\n",   "\x91", ":", "OR ",
                                "9",      "'a'",   "\xE2\x80\x98", "\xC4\x8D", "\x80", "\r"};
  const std::string fallback = "has no meaning here; the rest of the routine";
  const auto read = [&](std::string text) {
    Prog prog(std::move(text), Encoding::Cp1250);
    prog.dump();
    // Every input is covered by the grammar: the shell's own recovery is never needed.
    for (const Diagnostic& one : prog.diagnostics.all())
      CHECK(one.message.find(fallback) == std::string::npos);
  };
  for (int round = 0; round < draws(3000); ++round) {
    std::string soup;
    for (std::size_t i = random() % 60; i > 0; --i)
      soup += pieces[random() % std::size(pieces)];
    read(soup);
    std::string bytes;
    for (std::size_t i = random() % 60; i > 0; --i)
      bytes += static_cast<char>(random());
    read(bytes);
    std::string mutated = kProg;
    for (std::size_t i = 1 + random() % 4; i > 0; --i) {
      const std::size_t at = random() % mutated.size();
      if (random() % 2 == 0)
        mutated.erase(at, 1 + random() % 6);
      else
        mutated.insert(at, pieces[random() % std::size(pieces)]);
      if (mutated.empty()) break;
    }
    read(mutated);
  }
}
