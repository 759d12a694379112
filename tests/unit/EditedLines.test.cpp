// Where an edited translation is not what convert writes, line by line.
#include "targets/EditedLines.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <string>

namespace {

// `3 now < converted`, one a line; `c` marks comments.
std::string edits(const std::string& converted, const std::string& edited) {
  std::string out;
  for (const auto& one : dotek::targets::editedLines(converted, edited))
    out += fmt::format("{}{} {} < {}\n", one.line, one.comment ? "c" : "", one.now, one.converted);
  return out;
}

const std::string kProgram =
    "%\nO8000(WEB)\n(X  NOMINAL, MM)\n(G65 P8000 X1.)\nIF[#24EQ#0]GOTO91\nG65 P9810 X#24 F2000.\n"
    "IF[#5GT3]GOTO92\n#101=#5061\nM99\nN91#3000=91(X IS MISSING)\nN92#3000=92(TOO FAR)\n%\n";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), with);
}

} // namespace

TEST_CASE("edited lines: a changed, an added and a missing block") {
  CHECK(edits(kProgram, kProgram).empty());
  CHECK(edits(kProgram, replaced(kProgram, "GT3", "GE3")) == "7 IF[#5GE3]GOTO92 < IF[#5GT3]GOTO92\n");
  CHECK(edits(kProgram, replaced(kProgram, "M99\n", "G4 X1.\nM99\n")) == "9 G4 X1. < \n");
  CHECK(edits(kProgram, replaced(kProgram, "#101=#5061\n", "")) == "8  < #101=#5061\n");
  CHECK(edits(kProgram, replaced(kProgram, "NOMINAL, MM", "NOMINAL, INCH")) ==
        "3c (X  NOMINAL, INCH) < (X  NOMINAL, MM)\n");
  CHECK(edits(kProgram, replaced(kProgram, "(X  NOMINAL, MM)\n", "")) == "3c  < (X  NOMINAL, MM)\n");
  CHECK(edits(kProgram, replaced(kProgram, "(TOO FAR)\n%\n", "(TOO NEAR)\n")) ==
        "11 N92#3000=92(TOO NEAR) < N92#3000=92(TOO FAR)\n11  < %\n");
}

TEST_CASE("edited lines: what a shop changes without changing the program is no edit") {
  CHECK(edits(kProgram, replaced(kProgram, "%\nO", "%\n(RUN IN ON MACHINE 4)\nO")).empty());
  CHECK(edits(kProgram, replaced(kProgram, "G65 P9810 X#24 F2000.", "  G65P9810X#24F2000.  ")).empty());
  CHECK(edits(kProgram, replaced(replaced(kProgram, "O8000", "O9123"), "P8000", "P9123")).empty());
  CHECK(edits(kProgram, replaced(kProgram, "O8000", "O9123")) == "4c (G65 P8000 X1.) < (G65 P9123 X1.)\n");
  std::string lines = kProgram;
  for (std::size_t at = 0; (at = lines.find('\n', at)) != std::string::npos; at += 2)
    lines.replace(at, 1, "\r\n");
  CHECK(edits(kProgram, lines).empty());
  CHECK(edits(kProgram, replaced(kProgram, "#101=#5061", "#101=#5061 (THE EDGE)")).empty());
  // All comments but those of alarms are taken out.
  CHECK(edits(kProgram, replaced(kProgram, "(WEB)\n(X  NOMINAL, MM)\n(G65 P8000 X1.)\n", "\n")).empty());
  CHECK(edits(kProgram, replaced(kProgram, "(X  NOMINAL, MM)\n(G65 P8000 X1.)\n", "")).empty());
}

TEST_CASE("edited lines: a comment that is changed, and blanks in a text, are edits") {
  CHECK(edits(kProgram, replaced(kProgram, "O8000(WEB)", "O8000")) == "2 O8000 < O8000(WEB)\n");
  CHECK(edits(kProgram, replaced(kProgram, "(WEB)", "(BOSS)")) == "2c O8000(BOSS) < O8000(WEB)\n");
  CHECK(edits(kProgram, replaced(kProgram, "(TOO FAR)", "(TOOFAR)")) ==
        "11 N92#3000=92(TOOFAR) < N92#3000=92(TOO FAR)\n");
}

TEST_CASE("edited lines: a header that is written anew is edited line by line") {
  CHECK(edits(kProgram, replaced(kProgram, "(X  NOMINAL, MM)\n(G65 P8000 X1.)\n",
                                 "(x  nominal, in)\n(g65 p8000 x1.)\n")) ==
        "3c (x  nominal, in) < (X  NOMINAL, MM)\n4c (g65 p8000 x1.) < (G65 P8000 X1.)\n");
}

TEST_CASE("edited lines: a part of a post has other comments") {
  const std::string script =
      "// WEB\nvar list = [\n  {title: \"G58\", id: \"58\"},\n  {title: \"G59\", id: \"59\"}\n];\n"
      "function onCycle() {\n  (a)(b);\n}\n";
  CHECK(edits(script, replaced(script, "// WEB\n", "")).empty());
  CHECK(edits(script, replaced(script, "var list = [", "var list=[ // systems")).empty());
  CHECK(edits(script, replaced(script, "\"59\"", "\"5 9\"")) ==
        "4 {title: \"G59\", id: \"5 9\"} < {title: \"G59\", id: \"59\"}\n");
  CHECK(edits(script, replaced(script, "];\n", "];\n{ list.pop(); }\n")) == "6 { list.pop(); } < \n");
}

TEST_CASE("edited lines: in a cycle and in a branch round brackets are code") {
  CHECK(edits("cycle web\nway = reach\n", "cycle web\nway = reach(2)\n") ==
        "2 way = reach(2) < way = reach\n");
  CHECK(edits("probe:\n SeqC ' M5' EOL\n", "probe:\n{ OFF }\n SeqC ' M5' EOL\n").empty());
}

TEST_CASE("edited lines: an added comment beside a changed block is passed over") {
  CHECK(edits(kProgram, replaced(kProgram, "IF[#5GT3]", "(WAS GT)\nIF[#5GE3]")) ==
        "8 IF[#5GE3]GOTO92 < IF[#5GT3]GOTO92\n");
}

TEST_CASE("edited lines: of another program all lines are") {
  CHECK(edits("G0 X1.\nM99\n", "G0 X2.\nM30\n") == "1 G0 X2. < G0 X1.\n2 M30 < M99\n");
  CHECK(edits("M99\n", "") == "1  < M99\n");
}
