// Slips of hand-written Macro B: one finding each, at the place, with what to write.
#include "tests/unit/MacroBHelper.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

struct Slip {
  std::string text, told, code;
  std::string fixed; // "": no fix
};

void holds(const Slip& one) {
  CAPTURE(one.text);
  MacroFile file(one.text + "\n");
  CHECK(file.check().told() == one.told);
  CHECK(file.fixed(one.code) == (one.fixed.empty() ? "" : one.fixed + "\n"));
}

} // namespace

TEST_CASE("macrob slips: signs of other languages") {
  holds({"IF[#4=2.]GOTO8\nN8", "E 1:6 sign-unknown", "sign-unknown", "IF[#4EQ2.]GOTO8\nN8"});
  // An assignment, not a comparison.
  holds({"#4==#5003\n#6=#4", "E 1:3 sign-unknown", "sign-unknown", "#4=#5003\n#6=#4"});
  holds({"IF[#3EQ2]THEN#4==#5", "E 1:16 sign-unknown", "sign-unknown", "IF[#3EQ2]THEN#4=#5"});
  holds({"WHILE[#4==2.]DO2\nEND2", "E 1:9 sign-unknown", "sign-unknown", "WHILE[#4EQ2.]DO2\nEND2"});
  holds({"IF[#18<#19]GOTO8\nN8", "E 1:7 sign-unknown", "sign-unknown", "IF[#18LT#19]GOTO8\nN8"});
  holds({"IF[#18 <> 4]GOTO8\nN8", "E 1:8 sign-unknown", "sign-unknown", "IF[#18 NE 4]GOTO8\nN8"});
  holds({"IF[#18>=4]THEN#1=2", "E 1:7 sign-unknown", "sign-unknown", "IF[#18GE4]THEN#1=2"});
  holds({"IF[[#1EQ2]&&[#3EQ4]]GOTO8\nN8", "E 1:11 sign-unknown", "sign-unknown",
         "IF[[#1EQ2]AND[#3EQ4]]GOTO8\nN8"});
}

TEST_CASE("macrob slips: words of other languages") {
  holds({"IF[#4EQ2]THEN#5=1\nELSE\n#5=2", "E 2:1 flow-word-unknown", "flow-word-unknown", ""});
  holds({"IF[#4EQ2]THEN#5=1 ELSE #5=2", "E 1:19 flow-word-unknown", "flow-word-unknown", ""});
  holds({"ENDIF", "E 1:1 flow-word-unknown", "flow-word-unknown", ""});
  holds({"FOR #1=1 TO 5", "E 1:1 flow-word-unknown", "flow-word-unknown", ""});
  holds({"WHIEL[#4LT2]DO1\nEND1", "E 1:1 word-unknown", "word-unknown", "WHILE[#4LT2]DO1\nEND1"});
  holds({"#4=SQR[#7]", "E 1:4 word-unknown", "word-unknown", "#4=SQRT[#7]"});
  holds({"IF[#4LTE#7]GOTO8\nN8", "E 1:6 word-unknown", "word-unknown", "IF[#4LE#7]GOTO8\nN8"});
  holds({"IF[#4 EQ NULL]GOTO8\nN8", "E 1:10 word-unknown", "word-unknown", "IF[#4 EQ #0]GOTO8\nN8"});
}

TEST_CASE("macrob slips: brackets of conditions and functions") {
  holds({"#7=COS(45.)", "E 1:7 round-brackets", "round-brackets", "#7=COS[45.]"});
  holds({"X(#1+[2.])", "E 1:2 round-brackets", "round-brackets", "X[#1+[2.]]"});
  holds({"IF[#4EQ2 OR #7EQ3]GOTO8\nN8", "E 1:10 joined-comparisons", "joined-comparisons",
         "IF[[#4EQ2] OR[ #7EQ3]]GOTO8\nN8"});
  holds({"IF[#4EQ2]AND[#7EQ3]GOTO8\nN8", "E 1:10 joined-comparisons", "joined-comparisons",
         "IF[[#4EQ2]AND[#7EQ3]]GOTO8\nN8"});
}

TEST_CASE("macrob slips: jumps and loops") {
  holds({"IF[#4EQ2]GOTO N8\nN8", "E 1:15 goto-form", "goto-form", "IF[#4EQ2]GOTO 8\nN8"});
  holds({"IF[#4EQ2]N8\nN8", "E 1:10 goto-form", "goto-form", "IF[#4EQ2]GOTO8\nN8"});
  holds({"WHILE[#4LT2]\n#4=#4+1\nEND1", "E 1:1 while-without-do", "while-without-do",
         "WHILE[#4LT2]DO1\n#4=#4+1\nEND1"});
  holds({"IF[#4EQ2]THEN\n#5=1", "E 1:1 if-over-blocks", "if-over-blocks", ""});
  holds({"IF[#26EQ#0]#26=4.", "W 1:11 then-missing", "then-missing", "IF[#26EQ#0]THEN#26=4."});
  // One loop, one finding.
  holds({"WHILE[#4LT2]DO1\n#4=#4+1\nEND2", "E 3:1 end-without-do", "end-without-do",
         "WHILE[#4LT2]DO1\n#4=#4+1\nEND1"});
}

TEST_CASE("macrob slips: texts, digits, letters of calls") {
  holds({"#3000=7 NO STYLUS", "E 1:9 text-after-statement", "text-after-statement", "#3000=7 (NO STYLUS)"});
  holds({"01234", "E 1:1 header-letter", "header-letter", "O1234"});
  holds({"G1 Xl0.", "E 1:5 letter-for-one", "letter-for-one", "G1 X10."});
  holds({"G0 Y-20. 35.", "E 1:10 two-values", "two-values", ""});
  holds({"G65 P9100 A1. O5.", "E 1:15 letter-o-in-call", "letter-o-in-call", ""});
}

TEST_CASE("macrob: comments as other controls write them are one finding in a file") {
  holds({"G0 X1. ; to the start\nG1 X2. ; slowly\n; the end\nM30", "E 1:8 comment-sign", "comment-sign", ""});
  holds({"// pocket\nG0 X1.\nM30", "E 1:1 comment-sign", "comment-sign", ""});
  // A block after the sign is one.
  holds({"G0 X1.;G1 X2.;\nM30;", "", "comment-sign", ""});
  holds({"O100;#1=5.;IF[#1EQ5.]GOTO10;N10 M30;", "", "comment-sign", ""});
}

TEST_CASE("macrob slips: what is not read is no slip, and nothing is to be corrected") {
  for (const char* text : {"#7=PRM[3201,5]", "#7=PRM[#3]+1", "IF[PRM[20]EQ1]GOTO8\nN8", "M98 P<SUB-1>",
                           "G65P<BORE.2>D30.", "M98 <SUB>", "G66 <SUB> X#1"}) {
    CAPTURE(text);
    MacroFile file(std::string(text) + "\n");
    const std::string told = file.check().told();
    CHECK(told.starts_with("E 1:"));
    CHECK(told.ends_with(" syntax-error"));
    CHECK(told.find(';') == std::string::npos); // one finding
    CHECK(file.diagnostics.all().front().message.find("Dotek") != std::string::npos);
    CHECK_FALSE(file.diagnostics.all().front().fix);
  }
  // A comparison, and commas of numbers, are what they were.
  holds({"IF[#4<2]GOTO8\nN8", "E 1:6 sign-unknown", "sign-unknown", "IF[#4LT2]GOTO8\nN8"});
}

TEST_CASE("macrob: a chamfer, a rounding and an angle are words with addresses of their own") {
  for (const char* text :
       {"G1 X10. F9. ,C2.", "G1 X10. , R#1 F100.", "N5 G1 X#1 ,C[#2] F9.", "G1 X-21.75 ,A30. F9."}) {
    CAPTURE(text);
    MacroFile file("O1\n" + std::string(text) + "\nM30\n");
    CHECK(file.check().told() == "");
  }
  MacroFile both("O1\nG1F9.X1.,C2.C3.\nM30\n"); // C of an axis is another word
  CHECK(both.check().told() == "");
  const auto& words = std::get<frontend::macrob::Words>(both.file.programs.front().blocks.front().body).words;
  REQUIRE(words.size() == 5);
  CHECK(words[3].address == 'c');
  CHECK(words[4].address == 'C');
  holds({"G1 X10. F9. , Y5.", "E 1:13 syntax-error", "syntax-error", ""});
}

TEST_CASE("macrob slips: a function as the value of an address wants brackets, with a sign as well") {
  const auto message = [](const std::string& text) {
    MacroFile file(text + "\n");
    std::string out;
    for (const Diagnostic& one : file.check().diagnostics.all())
      if (one.severity == Severity::Error) out += one.message;
    return out;
  };
  CHECK(message("G0 X ABS[#1]").find("`X[ABS[..]]`") != std::string::npos);
  CHECK(message("G0 XABS[#1]").find("`X[ABS[..]]`") != std::string::npos);
  CHECK(message("G91G31Z-ABS[#26]F500.").find("`Z[-ABS[..]]`") != std::string::npos);
  CHECK(message("G91G31Z[-ABS[#26]]F500.").empty());
}
