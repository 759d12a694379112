#include "ComPostHelper.h"
#include "frontend/compost/Check.h"
#include "frontend/compost/Slips.h"
#include "frontend/compost/Summary.h"
#include "stdlib/DataFiles.h"
#include "tests/GoldenRunner.h"

#include <doctest/doctest.h>

#include <string>

using namespace dotek;
using namespace dotek::tests;
using namespace dotek::frontend::compost;

namespace {

stdlib::ComPostKeywords keywords() {
  return stdlib::ComPostKeywords::load(stdlib::DataFiles());
}

struct Checked : Prog {
  explicit Checked(std::string text) : Prog(std::move(text)) {
    check(program, keywords(), sources, diagnostics);
  }
};

// The statements are in an entry point, so that nothing is said of calls.
std::string findings(const std::string& statements) {
  Checked prog("progStart:\n" + statements + "\nRETURN\n");
  return prog.only();
}

} // namespace

TEST_CASE("known words and own routines pass") {
  CHECK(findings("SeqC 'x' SpinOff ToolOffset# EOL SetFlag('f') IF Flag? ('f') AND Drilling? END") == "");
  Checked prog("progStart: one RETURN\none: two RETURN\ntwo: RETURN");
  CHECK(prog.only() == "");
}

TEST_CASE("unknown words are one note a name, nearly known ones a warning with the name") {
  CHECK(findings("Blub Blub Blub# IF Blub? END") ==
        "2:1 unknown-keyword, 2:11 unknown-keyword, 2:20 unknown-keyword");
  Checked prog("progStart: SpinOf makeHole RETURN\nmakeHoles: RETURN");
  CHECK(prog.only() == "1:12 keyword-misspelt, 1:19 keyword-misspelt, 2:1 routine-never-called");
  CHECK(prog.at(0).message.find("`SpinOff`") != std::string::npos);
  CHECK(prog.at(1).message.find("`makeHoles`") != std::string::npos);
  CHECK(prog.at(0).severity == Severity::Warning);
}

TEST_CASE("doubled routines, braces in comments") {
  CHECK(Checked("progStart: RETURN\nshipped: RETURN\nprogStart: shipped RETURN").only() ==
        "3:1 duplicate-routine");
  CHECK(Checked("progStart: { x { y } RETURN").only() == "1:16 comment-brace");
  CHECK(Checked("progStart: { x } RETURN\n{ y").only() == "2:1 unterminated-comment");
}

TEST_CASE("case, suffix and argument of known words") {
  CHECK(findings("spinoff eol if") == "2:1 keyword-case, 2:9 keyword-case, 2:13 keyword-case");
  CHECK(findings("Toolofst") == "2:1 keyword-case");
  CHECK(findings("SpinOff#") == "2:1 keyword-kind");
  CHECK(findings("OpFieldData('q') IF Drilling? END") == "2:1 keyword-kind");
  CHECK(findings("OpFieldData#") == "2:1 keyword-argument");
  CHECK(findings("SpinOff('q')") == "2:1 keyword-argument");
  Checked prog("progStart: Doit RETURN doIt: RETURN");
  CHECK(prog.only() == "1:12 keyword-case, 1:24 routine-never-called");
}

TEST_CASE("unverified constructs are one note a file") {
  CHECK(findings("IF NOT Drilling? OR (RigidTap?) END IF NOT RigidTap? END") == "2:4 unverified-in-prog");
  CHECK(findings("#1 = '##' FORMAT(ToolOffset#,1)") == "2:1 unverified-in-prog");
  CHECK(findings("IF Drilling? AND RigidTap? END Drilling?") == "2:32 unverified-in-prog");
  Checked letter("progStart: m\xC4\x9B\xC5\x99 RETURN m\xC4\x9B\xC5\x99: RETURN");
  CHECK(letter.only() == "1:23 unverified-in-prog");
}

TEST_CASE("pictures and their use") {
  const auto only = [](const std::string& text) { return Checked(text).only(); };
  CHECK(only("FORMAT(OpFieldData#,1)\n#1='###.##;0'") == "");
  CHECK(only("FORMAT(OpFieldData#,1)") == "1:21 format-without-picture");
  CHECK(only("#1='##.#'") == "1:1 picture-unused");
  CHECK(only("#1='##.#'\n#1='##'\nFORMAT(ToolOffset#,1)") == "2:1 duplicate-picture");
  CHECK(only("#1='##.#'\nFORMAT(ToolOffset#,1)\nFORMAT(ToolOffset#,1)") == "3:8 duplicate-format");
  CHECK(only("#1='##.#'\nFORMAT(ToolOffset,1)") == "2:8 keyword-kind");
  CHECK(only("#1='##.#'\nFORMAT(Mine#,1)") == "2:8 unknown-keyword");
  Checked bad("FORMAT(ToolOffset#,1)\n#1='##.;'");
  CHECK(bad.findings().size() == 1);
  CHECK(bad.at(0).code == "bad-picture");
  CHECK(bad.sources.line(bad.at(0).range) == 2);
  CHECK(bad.at(0).range.begin > 25);
  CHECK(only("FORMAT(ToolOffset#,1)\n#1='###^##'") == "2:4 unverified-in-prog");
}

TEST_CASE("flags, calls, names of keywords") {
  CHECK(findings("IF Flag?('q') AND Flag?('q') END") == "2:10 flag-never-set");
  CHECK(findings("SetFlagF('q') IF Flag?('q') END") == "2:24 flag-never-set");
  CHECK(findings("SetFlag('q') IF Flag?('q') END") == "");
  Checked near("progStart: SetFlag('probeOn') IF Flag?('ProbeOn') END RETURN");
  CHECK(near.at(0).message.find("`probeOn`") != std::string::npos);
  Checked hidden("progStart: SpinOff RETURN SpinOff: RETURN");
  CHECK(hidden.only() == "1:27 routine-hides-keyword");
}

TEST_CASE("branches of a cycle and what they print") {
  const Prog prog(
      "ck: IF CycleType?('a') SetFlag('f') silent END RETURN\n"
      "silent: SetOutputPartSpace '' {x} RETURN\n"
      "direct: IF CycleType?('a') AND Flag?('f') 'x' END IF CycleType?('b') word END RETURN\n"
      "word: loop RETURN\nloop: word Unheard RETURN\n"
      "never: IF NOT CycleType?('a') again ELSE 'y' END RETURN\nagain: again RETURN\n"
      "brackets: IF (CycleType?('c') OR CycleType?('a')) IF Drilling? ELSE ToolOffset# END END RETURN\n");
  const auto table = keywords();
  CHECK(cycleIds(prog.program) == std::vector<std::string>{"a", "b", "c"});
  const auto names = [&](const std::string& id) {
    std::string result;
    for (const Routine* routine : printingRoutines(prog.program, table, id))
      result.append(routine->name).append(" ");
    return result;
  };
  CHECK(names("a") == "direct never brackets ");
  CHECK(names("b") == "direct ");
  CHECK(names("c") == "brackets ");
  CHECK(names("d") == "");
  const auto branches = branchesOf(prog.program, "a");
  REQUIRE(branches.size() == 4);
  CHECK(branches[2].elsePart);
  CHECK(branches[2].routine->name == "never");
  CHECK(!prints(findRoutine(prog.program, "again")->body, prog.program, table));
  CHECK(findRoutine(prog.program, "Word") == nullptr);
}

TEST_CASE("fields of a branch, those of called routines included") {
  const Prog prog(
      "p: IF CycleType?('a') OpFieldData#('q')up OpFieldData#('q') IF CycleType?('b') OpFieldData#('r') END "
      "END\n"
      "IF CycleType?('b') OpFieldData#('s') up END RETURN\n"
      "up: up OpFieldData#('t') IF CycleType?('a') OpFieldData#('u') ELSE OpFieldData#('v') END RETURN\n");
  const auto fields = [&](const std::string& id) {
    std::string result;
    for (const FieldRef& field :
         fieldsPrinted(prog.program, branchesOf(prog.program, id).at(id == "a" ? 0 : 1), id))
      result += field.name;
    return result;
  };
  CHECK(fields("a") == "qtuq");
  CHECK(fields("b") == "stv");
  const FieldRef first = fieldsPrinted(prog.program, branchesOf(prog.program, "a").at(0), "a").at(0);
  CHECK(prog.sources.text(first.range) == "'q'");
}

TEST_CASE("routines that the engine runs for some cycle") {
  const Prog prog("flags: IF CycleType?('a') SetFlag('f') END RETURN\n"
                  "text: IF CycleType?('a') IF Drilling? 'x' END END RETURN\n"
                  "calls: IF NOT CycleType?('b') SetFlag('f') ELSE text END RETURN\n"
                  "plain: 'y' EOL RETURN\n");
  std::string names;
  for (const Routine* routine : cycleRoutines(prog.program, keywords()))
    names += routine->name + " ";
  CHECK(names == "text calls ");
}

TEST_CASE("the corpus gives one error and no finding on its words") {
  std::filesystem::path folder;
  if (!haveCorpus(folder)) return;
  Checked prog(readAll(folder / "compost" / "probe-routines.txt"));
  std::size_t errors = 0;
  for (const Diagnostic& one : prog.diagnostics.all()) {
    errors += one.severity == Severity::Error;
    const bool expected = one.code == "open-if-at-return" || one.code == "flag-never-set" ||
                          one.code == "routine-never-called" || one.code == "unknown-keyword";
    CHECK_MESSAGE(expected, one.code);
  }
  CHECK(errors == 1);
  const auto table = keywords();
  for (const std::string& id : cycleIds(prog.program))
    CHECK(printingRoutines(prog.program, table, id).size() == 1);
}

TEST_CASE("slips of the hand and names of their own") {
  // lost, added, changed, swapped; an abbreviation written out
  CHECK(isSlip("CycleTyp", "CycleType"));
  CHECK(isSlip("CycleTypes", "CycleType"));
  CHECK(isSlip("SegC", "SeqC"));
  CHECK(isSlip("OpFeildData", "OpFieldData"));
  CHECK(isSlip("SpindleOff", "SpinOff"));
  CHECK(isSlip("ToolOfset", "ToolOffset"));
  // another axis, another number, the other switch, another word, too short
  CHECK_FALSE(isSlip("XCP1", "ZCP1"));
  CHECK_FALSE(isSlip("ZCP2", "ZCP1"));
  CHECK_FALSE(isSlip("feedIPT", "feedIPM"));
  CHECK_FALSE(isSlip("doOfstOn", "doOfstOff"));
  CHECK_FALSE(isSlip("CoolOn", "CoolOff"));
  CHECK_FALSE(isSlip("SpinOn", "SpinOff"));
  CHECK_FALSE(isSlip("Drill", "Drilling"));
  CHECK_FALSE(isSlip("EOF", "EOL"));
  CHECK_FALSE(isSlip("SeqC", "SeqC"));
}
