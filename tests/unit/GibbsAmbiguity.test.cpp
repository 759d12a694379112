// The grammar has one reading for every line: each decision takes one token.
#include "tests/GoldenRunner.h"
#include "tests/unit/GibbsHarness.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

TEST_CASE("gibbs: the grammar decides everything by one token, so it cannot be ambiguous") {
  const std::string parser =
      readAll(std::filesystem::path(DOTEK_GENERATED) / "grammar/GibbsMacro/GibbsMacroParser.cpp");
  REQUIRE(parser.find("GibbsMacroParser::lineContent()") != std::string::npos);
  CHECK(parser.find("adaptivePredict") == std::string::npos);
}

namespace {

// The tree of one line, without its places.
std::string tree(const std::string& line) {
  GibbsHarness harness;
  const frontend::gibbs::Macro macro = harness.macro(line + "\n");
  std::string out;
  for (const std::string& word : {harness.codes(), frontend::gibbs::dumpAst(macro, harness.sources)})
    out += word;
  return out;
}

} // namespace

TEST_CASE("gibbs: a statement word is a name where a name is") {
  // The same line with an ordinary name has the same tree, but for the name.
  const auto same = [](const std::string& line, const std::string& word) {
    std::string expected = line;
    std::string plain = word;
    for (char& c : plain)
      c = 'q';
    for (std::size_t at = expected.find('@'); at != std::string::npos; at = expected.find('@'))
      expected.replace(at, 1, plain);
    std::string given = line;
    for (std::size_t at = given.find('@'); at != std::string::npos; at = given.find('@'))
      given.replace(at, 1, word);
    std::string got = tree(given);
    std::string want = tree(expected);
    for (std::size_t at = want.find(plain); at != std::string::npos; at = want.find(plain, at + word.size()))
      want.replace(at, word.size(), word);
    CAPTURE(given);
    CHECK(want.find(word) != std::string::npos);
    CHECK(got == want);
  };
  for (const char* word : {"else", "for", "to", "step", "next", "continue", "goto", "call", "args", "global",
                           "local", "permanent", "on_error", "and", "or"}) {
    for (const char* line : {"@ = 1",
                             "@(2) = 3",
                             "@[2] = 3",
                             "a = @ + @",
                             "a = -(@)",
                             "a = b(@)",
                             "for @ = @ to @ step @",
                             "next @",
                             "goto @",
                             ":@",
                             "@:",
                             "if @ = @ then @ = @",
                             "if a = @ and @ < 1 or (@ = 1) then goto @",
                             "if not @ = 1 then a = @ else @ = 2",
                             "message @, @",
                             "args @, @",
                             "global @",
                             "call @, @",
                             "on_error goto @",
                             "if a = 1 then goto @ else next @"})
      same(line, word);
  }
}

TEST_CASE("gibbs: places that need a look ahead") {
  const auto codes = [](const std::string& line) {
    GibbsHarness harness;
    harness.macro(line + "\n");
    return harness.codes();
  };
  for (const char* line : {"a = -(b-1)*2/c(3)+d[4]",
                           "if (a) < (b) and not (c = 1) or ((d) > 2), then if e = 1 then f (1), 2 else g",
                           "if ((a = 1)) then b = 1",
                           "if not ((a) < (b)) then b = 1",
                           "if f((a)) = (1) then b = 1",
                           "call a.b\\c, 1",
                           "call d$",
                           "call lib",
                           "call \"x\", else",
                           "#include x.mac",
                           "#include y",
                           "#include \"y\"",
                           "for:",
                           "next",
                           "next to",
                           "foo (1)",
                           "foo(1) = 2",
                           "foo (1), 2",
                           "foo else",
                           "foo else, to",
                           "foo, 1",
                           "call (1) = 2",
                           "if a = 1 then next else foo",
                           "if a = 1 then foo else",
                           "if a = 1 then foo else next",
                           "if a = 1 then call b else call c.mac",
                           "if a = 1 then call b.mac else call c.mac",
                           "add_path 1"}) {
    CAPTURE(line);
    CHECK(codes(line) == "");
  }
  CHECK(codes("add_ path feed_ x, a_") == "blank-in-name@1:1 blank-in-name@1:11");
  CHECK(codes("goto a$") == "syntax-error@1:6");
  CHECK(codes("for a$ = 1 to 2") == "syntax-error@1:5");
  CHECK(codes("foo a = 1") == "syntax-error@1:7");
  CHECK(codes("if (a then b = 1") == "syntax-error@1:7");
  CHECK(codes("if (a = 1) = 2 then b = 1") == "syntax-error@1:12");
  CHECK(codes("to 5") == "syntax-error@1:4");
  CHECK(codes("foo_ 5") == "syntax-error@1:6");
}
