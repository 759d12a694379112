#include "tests/GoldenRunner.h"
#include "tests/unit/GibbsHarness.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;
using namespace dotek::frontend::gibbs;

namespace {
std::string ast(const std::string& text) {
  GibbsHarness h;
  const Macro macro = h.macro(text);
  CHECK_MESSAGE(h.diagnostics.empty(), h.messages());
  return dumpAst(macro, h.sources);
}
bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
} // namespace

TEST_CASE("gibbs: statements of the core") {
  CHECK(ast("depth = -(w/2-r)*3+1\n") == "assign @1:1\n  to depth @1:1\n  + @1:9\n    * @1:9\n      negative "
                                         "@1:9\n        brackets @1:10\n          - @1:11\n"
                                         "            / @1:11\n              variable w @1:11\n              "
                                         "number 2 @1:13\n            variable r @1:15\n"
                                         "      number 3 @1:18\n    number 1 @1:20\n");
  CHECK(ast("FOR k = 1 TO n STEP 2\nCONTINUE\nNEXT k") ==
        "for k @1:1\n  number 1 @1:9\n  variable n @1:14\n  step @1:21\n    number 2 @1:21\ncontinue "
        "@2:1\nnext k @3:1\n");
  CHECK(ast(":again\r\nagain2:\r\n  goto AGAIN\r\n") ==
        "label again @1:2\nlabel again2 @2:1\ngoto AGAIN @3:3\n");
  CHECK(ast("if abs(q) <= 2.5, then message \"low ! no comment\" ! tail") ==
        "if @1:1\n  compare <= @1:4\n    function abs @1:4\n      variable q @1:8\n    number 2.5 @1:14\n  "
        "then @1:19\n"
        "    command message @1:24\n      text \"low ! no comment\" @1:32\ncomment ! tail @1:51\n");
  CHECK(ast("CALL \"part.mac\", 1, b$\rCALL sub\\part.mac\rCALL part, 2\rCALL name$\r") ==
        "call @1:1\n  text \"part.mac\" @1:6\n  number 1 @1:18\n  variable b$ @1:21\ncall sub\\part.mac "
        "@2:1\ncall part @3:1\n"
        "  number 2 @3:12\ncall @4:1\n  variable name$ @4:6\n");
  CHECK(
      ast("ARGS a, b$\nGLOBAL x\nLOCAL y, z\nPERMANENT q\n#include \"a b.mac\"\n#INCLUDE lib.mac\nON_ERROR "
          "GOTO bad\n") ==
      "args @1:1\n  name a @1:6\n  name b$ @1:9\nglobal @2:1\n  name x @2:8\nlocal @3:1\n  name y @3:7\n  "
      "name z @3:10\n"
      "permanent @4:1\n  name q @4:11\ninclude \"a b.mac\" @5:1\ninclude lib.mac @6:1\non-error bad @7:1\n");
  CHECK(ast("FILE_WRITE_VARS, 2, i, t\nDEGREES\n") ==
        "command FILE_WRITE_VARS @1:1\n  number 2 @1:18\n  variable i @1:21\n  variable t @1:24\ncommand "
        "DEGREES @2:1\n");
}

TEST_CASE("gibbs: no word but IF, THEN and NOT is reserved") {
  const std::string words =
      "to = 1\nstep = to\nnext = step\nfor = next\ngoto = for\ncall = 2\nargs = 3\nlocal = 4\nelse = 5\n"
      "and = 6\nor = and\ncontinue = 7\non_error = 8\nglobal = 9\npermanent = 10\n"
      "for to = to to to step step\nnext to\n:next\ngoto next\nif and = or and or = and then or = 1\n";
  GibbsHarness h;
  const Macro macro = h.macro(words);
  CHECK_MESSAGE(h.diagnostics.empty(), h.messages());
  CHECK(macro.lines.size() == 20);
}

TEST_CASE("gibbs: blocks") {
  CHECK(ast("CONTOUR\n[\nSTART 0, 0\nLINE P16\n\nARC 1,2,3,4, cw\n]\nPOINTS\n[\n]\n") ==
        "geometry CONTOUR @1:1\n  command START @3:1\n    number 0 @3:7\n    number 0 @3:10\n  command LINE "
        "@4:1\n"
        "    variable P16 @4:6\n  command ARC @6:1\n    number 1 @6:5\n    number 2 @6:7\n    number 3 "
        "@6:9\n    number 4 @6:11\n"
        "    variable cw @6:14\ngeometry POINTS @8:1\n");
  CHECK(ast("if a = 1 then\n[\nb = 2\n]\nelse\n[\nb = 3\n]\nc = 4") ==
        "if @1:1\n  compare = @1:4\n    variable a @1:4\n    number 1 @1:8\n  then @1:10\n    assign @3:1\n  "
        "    to b @3:1\n"
        "      number 2 @3:5\n  else @5:1\n    assign @7:1\n      to b @7:1\n      number 3 @7:5\nassign "
        "@9:1\n  to c @9:1\n"
        "  number 4 @9:5\n");
  CHECK(holds(ast("if a = 1 then b = 2 else b = 3"), "  else @1:21\n    assign @1:26"));
  CHECK(holds(ast("if a = 1 then [\nb = 2\n] else [\nb = 3\n]"), "  else @3:3\n    assign @4:1"));
  CHECK(holds(ast("if a = 1 then if b = 2 then c = 3 else c = 4"), "    else @1:35"));
}

TEST_CASE("gibbs: one broken line is one error, and the next line parses") {
  for (const char* bad : {"a = = 1",
                          "a = b = 1",
                          "a 1 2",
                          "if a = 1",
                          "if a = 1 b = 2",
                          "if (a = 1 then b = 2",
                          "if a then b = 2",
                          "if a == 1 then b = 2",
                          "if a =< 1 then b = 2",
                          "if a != 1 then b = 2",
                          "for i 1 to 3",
                          "for i = 1 3",
                          "a = 1,5",
                          "a = (1",
                          "a = 1)",
                          "foo 1,,2",
                          "foo 1,",
                          "a = 1; b = 2",
                          "while a < 3",
                          "a = \"x",
                          "a = \xE2\x80\x9Ex\xE2\x80\x9C",
                          "goto",
                          "next 5",
                          "= 5",
                          "then b = 1",
                          "foo [1",
                          "]",
                          "#define x",
                          "a = 5 % 2",
                          "a = 2^3",
                          "_a = 1",
                          "a = 2x",
                          "call a b",
                          "args a b",
                          "10:",
                          "a = 1e999",
                          "else b = 1",
                          "endif x y",
                          "a = 'x",
                          "foo a < 1",
                          "\x01"}) {
    GibbsHarness h;
    const Macro macro = h.macro(std::string("x = 1\n") + bad + "\ny = 2\n");
    CHECK_MESSAGE(h.diagnostics.all().size() == 1, bad << "\n" << h.messages());
    CHECK_MESSAGE(h.errors() == 1, bad);
    CHECK(macro.hasErrorNodes);
    REQUIRE(macro.lines.size() == 3);
    CHECK(std::holds_alternative<ErrorStatement>(macro.lines[1].statement->node));
    CHECK(std::holds_alternative<Assignment>(macro.lines[2].statement->node));
    if (!h.diagnostics.empty()) CHECK_MESSAGE(h.sources.line(h.diagnostics.all()[0].range) == 2, bad);
  }
}

TEST_CASE("gibbs: syntax messages speak of what was written") {
  const std::vector<std::pair<const char*, const char*>> cases = {
      {"if a = 1", "THEN is missing"},
      {"if a = 1 b = 2", "THEN is missing"},
      {"if a = 1 message \"x\"", "THEN is missing"},
      {"if (a+1 < 2 then b = 2", "closing bracket"},
      {"if abs(a < 2 then b = 2", "closing bracket"},
      {"a = (1+2", "closing bracket"},
      {"a = 1+2)", "no `(`"},
      {"if a == 1 then b = 2", "one `=`"},
      {"if a != 1 then b = 2", "`<>`"},
      {"if a => 1 then b = 2", "`>=`"},
      {"if a then b = 2", "no comparison"},
      {"a = b = 1", "second `=`"},
      {"a = 1,5", "decimal point"},
      {"for i 1 to 3", "`=` is missing"},
      {"for i = 1 3", "TO is missing"},
      {"while a < 3", "no WHILE"},
      {"elseif a < 3 then b = 1", "no ELSEIF"},
      {"foo 1,,2", "between two commas"},
      {"foo 1,", "after a comma"},
      {"foo a b", "separated by commas"},
      {"foo \"a\" b", "separated by commas"},
      {"a = b c", "operator is missing"},
      {"a = 1; b = 2", "one statement"},
      {"if abs(a) <", "ends after `<`"},
      {"a =", "ends after `=`"},
      {"a = b *", "ends after `*`"},
      {"10:", "label"},
      {"if a > 1 then", "follows THEN"},
      {"then b = 1", "THEN without IF"},
      {"contour 5", "nothing follows"},
      {"contour\na = 1", "`[` is missing"},
      {"\nelse b = 1", "belongs to no IF"},
  };
  for (const auto& [text, part] : cases)
    CHECK_MESSAGE(holds(firstMessage(text), part), text << ": " << firstMessage(text));
}

TEST_CASE("gibbs: damage of a whole file") {
  CHECK(findings("") == "empty-file@1:1");
  CHECK(findings(" \r\n\r\n") == "empty-file@1:1");
  CHECK(findings("a = 1\nif abs(a) <") == "syntax-error@2:12");
  CHECK(findings("CONTOUR\n[\nSTART 0, 0\n") == "unclosed-block@1:1");
  CHECK(findings("message \xE2\x80\x9Eno"
                 "\xE2\x80\x9D\n") == "typographic-quote@1:9");
  CHECK(findings("a = \"x\ny = 1") == "unterminated-text@1:5");
  CHECK(findings(":a goto b\n:b\n") == "label-not-alone@1:4");
  {
    GibbsHarness h;
    parseMacro(h.add("message \x84hi\x94", "x.mac", Encoding::Cp1250), h.context());
    CHECK(h.codes() == "typographic-quote@1:9");
  }
  {
    GibbsHarness h;
    h.checked("a = " + std::string(100000, '(') + "1\nb = 1\n");
    CHECK(h.codes() == "line-too-long@1:1");
  }
  {
    GibbsHarness h;
    h.limits.lineBytes = 1U << 20;
    const Macro macro = h.checked("a = " + std::string(100000, '(') + "1\nb = 1\n");
    CHECK(h.codes() == "nesting-too-deep@1:69");
    CHECK(macro.lines.size() == 2);
  }
  {
    GibbsHarness h;
    std::string text = "a = 1";
    for (int i = 0; i < 2000; ++i)
      text += "+1";
    h.checked(text + "\nb = 1\n");
    CHECK(h.errors() == 1);
    CHECK(holds(h.codes(), "too-many-tokens"));
  }
  {
    GibbsHarness h;
    h.checked(std::string(1U << 20, 'x'));
    CHECK(h.codes() == "line-too-long@1:1");
  }
  {
    GibbsHarness h;
    std::string text;
    for (int i = 0; i < 3000; ++i)
      text += "a = = " + std::to_string(i) + "\n";
    h.checked(text);
    CHECK(h.errors() <= 502);
    CHECK(holds(h.codes(), "too-many-errors"));
  }
  {
    GibbsHarness h;
    std::string text;
    for (int i = 0; i < 200; ++i)
      text += "if a = 1 then\n[\n";
    h.macro(text);
    CHECK(holds(h.codes(), "nesting-too-deep"));
  }
}

TEST_CASE("gibbs: a blank inside a word") {
  GibbsHarness h;
  const Macro macro =
      h.checked("add_ custom_drill_cycle_path feed_ x, a_b\na_b = 1\nif q_ > 2 then q_ = 3\n");
  CHECK(h.codes() == "blank-in-name@1:1 blank-in-name@1:30");
  CHECK(std::get<Command>(macro.lines[0].statement->node).name.text == "add_custom_drill_cycle_path");
}

TEST_CASE("gibbs: tokens") {
  GibbsHarness h;
  CHECK(dumpTokens(h.add("if a<>1 then ! c\n"), h.context()) ==
        "1:1 KW_IF if\n1:4 ID a\n1:5 NOT_EQUAL <>\n1:7 NUMBER 1\n1:9 KW_THEN then\n1:14 COMMENT ! c\n1:17 "
        "EOL\n");
}

TEST_CASE("gibbs: corpus folders parse without a finding of weight") {
  std::filesystem::path folder;
  if (!haveCorpus(folder)) return;
  int files = 0;
  for (const auto& cycleFolder : std::filesystem::directory_iterator(folder / "gibbs")) {
    GibbsHarness h;
    Cycle cycle;
    for (const auto& entry : std::filesystem::directory_iterator(cycleFolder)) {
      const std::string name = entry.path().filename().string();
      cycle.files.insert(foldCase(name));
      const FileId file = h.add(readAll(entry.path()), name);
      ++files;
      if (name == "DefineData.txt") cycle.defineData = parseDefineData(file, h.context());
      if (name == "CycleData.dlg") cycle.dialog = parseDialog(file, h.context());
      if (name == "CycleData.mac") cycle.cycleData = parseMacro(file, h.context());
      if (name == "ToolPath.mac") cycle.toolPath = parseMacro(file, h.context());
    }
    REQUIRE(cycle.defineData);
    checkDefineData(*cycle.defineData, h.context());
    checkDialog(*cycle.dialog, h.context());
    checkMacro(*cycle.cycleData, {}, h.context());
    checkMacro(*cycle.toolPath, {}, h.context());
    checkCycle(cycle, h.context());
    for (const Diagnostic& d : h.diagnostics.all())
      CHECK_MESSAGE(d.code == "comma-before-then", cycleFolder.path().string() << ": " << d.message);
    for (const InputLabel& label : inputLabels(*cycle.dialog)) {
      CHECK(!label.name.empty());
      CHECK_MESSAGE(label.unit == (label.name == "G" ? "" : "mm"), label.name);
    }
    CHECK(declaredFields(cycle).size() == cycle.defineData->definitions.size());
  }
  CHECK(files == 20);
}
