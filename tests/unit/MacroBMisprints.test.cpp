// Misprints of a typist, and those of listings (--from listing): one finding each, with the repair where
// there is one only.
#include "tests/unit/MacroBHelper.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;
namespace macrob = dotek::frontend::macrob;

namespace {

constexpr auto kListing = macrob::Text::Listing;

// Notes that point to --from listing.
std::size_t hints(const std::string& text) {
  const MacroFile file(text);
  std::size_t out = 0;
  for (const Diagnostic& one : file.diagnostics.all())
    for (const DiagnosticNote& note : one.notes)
      out += note.message.find("--from listing") != std::string::npos;
  return out;
}

struct Case {
  std::string text;
  std::string told;
  std::string code;
  std::string fixed; // "": no fix
};

void holds(const Case& one, macrob::Text kind = macrob::Text::Program) {
  CAPTURE(one.text);
  MacroFile file(one.text + "\n", kind);
  CHECK(file.told() == one.told);
  CHECK(file.fixed(one.code) == (one.fixed.empty() ? "" : one.fixed + "\n"));
  if (one.fixed.empty()) return;
  // What the fix writes is the tree that the reader took.
  MacroFile repaired(one.fixed + "\n", kind);
  CHECK_MESSAGE(repaired.told() == "", one.fixed);
  std::string dump = file.dump();
  for (std::size_t at = dump.find(" repaired"); at != std::string::npos; at = dump.find(" repaired"))
    dump.erase(at, 9);
  CHECK(dump == repaired.dump());
}

} // namespace

TEST_CASE("macrob: the letter O for a zero") {
  holds({"GO X12.", "E 1:2 letter-o-for-zero", "letter-o-for-zero", "G0 X12."});
  holds({"GOG40 X12.", "E 1:2 letter-o-for-zero", "letter-o-for-zero", "G0G40 X12."});
  holds({"G1 BO. F5", "E 1:5 letter-o-for-zero", "letter-o-for-zero", "G1 B0. F5"});
  holds({"G1 Y1O.5", "E 1:6 letter-o-for-zero", "letter-o-for-zero", "G1 Y10.5"});
  holds({"MO8", "E 1:2 letter-o-for-zero", "letter-o-for-zero", "M08"});
  holds({"#1=1O+#2", "E 1:5 letter-o-for-zero", "letter-o-for-zero", "#1=10+#2"});
  holds({"IF[#1EQO]GOTO5", "E 1:8 letter-o-for-zero", "letter-o-for-zero", "IF[#1EQ0]GOTO5"});
  holds({"G1 XOO.", "E 1:5 letter-o-for-zero", "letter-o-for-zero", "G1 X00."});
  holds({"GO R5.", "E 1:2 letter-o-for-zero", "letter-o-for-zero", "G0 R5."});
  // GO5 may be short for GOTO5.
  holds({"GO5", "E 1:2 syntax-error", "letter-o-for-zero", ""});
  holds({"G0TO 5", "E 1:2 zero-for-letter-o", "zero-for-letter-o", "GOTO 5"});
  // Each misprint is reported; one of them is the error of the block.
  CHECK(MacroFile("GO CO. M4\n").told() == "E 1:2 letter-o-for-zero; W 1:5 letter-o-for-zero");
  CHECK(MacroFile("GO XO. Y5,5\n").told() ==
        "E 1:2 letter-o-for-zero; W 1:5 letter-o-for-zero; W 1:10 decimal-comma");
  // Without a repair, that is the error.
  CHECK(MacroFile("GO 543 G55\n").told() == "W 1:2 letter-o-for-zero; E 1:4 number-without-address");
}

TEST_CASE("macrob: a decimal comma") {
  holds({"G1 Y31,25 F#9", "E 1:7 decimal-comma", "decimal-comma", "G1 Y31.25 F#9"});
  holds({"#2601=#2602+17,5", "E 1:15 decimal-comma", "decimal-comma", "#2601=#2602+17.5"});
  holds({"X[#1/COS[12,5]]", "E 1:12 decimal-comma", "decimal-comma", "X[#1/COS[12.5]]"});
  // In ATAN and POW a comma separates two values.
  CHECK(MacroFile("#1=ATAN[12,5]\n").told() == "");
  CHECK(MacroFile("#1=POW[2,5]\n").told() == "");
}

TEST_CASE("macrob: D and a zero for DO") {
  MacroFile file("O1\nD02\n#1=#1+1\nIF[#1GT5]GOTO9\nEND2\nN9 M99\n");
  file.check();
  CHECK(file.told() == "E 2:1 do-as-offset");
  CHECK(file.fixed("do-as-offset") == "O1\nDO2\n#1=#1+1\nIF[#1GT5]GOTO9\nEND2\nN9 M99\n");
  // A loop that has its DO: the word is an offset.
  CHECK(told("O1\nD01\nDO1\n#1=#1+1\nEND1\nM99\n") == "");
  CHECK(told("O1\nDO1\nD01\nEND1\nM99\n") == "");
  CHECK(told("O1\nG41 D02\nM99\n") == "");
}

TEST_CASE("macrob: texts of drawings in a listing") {
  CHECK(MacroFile("B #2 = angle\n", kListing).told() == "N 1:1 legend-line");
  CHECK(MacroFile("Z #26 = DEPTH Z = 12\n", kListing).told() == "N 1:1 legend-line");
  CHECK(MacroFile("E#8 = width of\nthe groove\n", kListing).told() == "N 1:1 legend-line; N 2:1 legend-line");
  MacroFile column("#2502 = #2501 + 7.5          H#11 = number\n", kListing);
  CHECK(column.told() == "N 1:30 legend-line");
  CHECK(column.dump().find("assignment") != std::string::npos);
  CHECK_FALSE(column.format()); // the text would be lost
  // The letter has another variable, or the rest is a calculation.
  CHECK(MacroFile("B #3 = angle\n", kListing).told() == "E 1:1 assignment-target");
  CHECK(MacroFile("B#2=SIN[#3]\n", kListing).told() == "E 1:1 assignment-target");
  CHECK(MacroFile("the groove\n", kListing).told() == "E 1:1 text-without-brackets");
}

TEST_CASE("macrob: without --from listing its lines are no blocks, and the error says what would read them") {
  // Text of drawings: on a line, on the next one, beside a block.
  CHECK(MacroFile("B #2 = angle\n").told() == "E 1:1 assignment-target");
  CHECK(hints("B #2 = angle\n") == 1);
  CHECK(MacroFile("B #2 = angle\n").file.legends.empty());
  CHECK(MacroFile("B #2 = angle\n").dump().find("unread") != std::string::npos);
  CHECK(hints("E#8 = width of\nthe groove\n") == 2);
  CHECK(hints("#2502 = #2501 + 7.5          H#11 = number\n") == 1);
  // Mixed-up signs.
  CHECK(MacroFile("G1 X5. IF #9\n").told() != MacroFile("G1 X5. IF #9\n", kListing).told());
  for (const char* text : {"G1 X5. IF #9\n", "#120=5.\n#1=[*120+#2]\n", "#120=5.\n#1=#2**120\n",
                           "#120=5.\n#1=#120.-#2\n", "#1=[#72./#2]\n"}) {
    CAPTURE(text);
    MacroFile file(text);
    CHECK(file.diagnostics.hasErrors());
    CHECK(file.dump().find("unread") != std::string::npos);
    CHECK(file.dump().find("repaired") == std::string::npos);
    CHECK(hints(text) == 1);
  }
  // A listing would be no better.
  for (const char* text : {"B #3 = angle\n", "B#2=SIN[#3]\n", "the groove\n", "#1=#2**120\n", "G1 X[[#3\n",
                           "G1 X5. IF #9 [\n", "#1=[5,5+[#2]\n", "GO 543 G55\n"}) {
    CAPTURE(text);
    CHECK(MacroFile(text).diagnostics.hasErrors());
    CHECK(hints(text) == 0);
  }
  // What a typist does needs no listing.
  for (const char* text : {"GO X12.\n", "G1 Y31,25\n", "IF[#5AND2]EQ2]GOTO7\n"})
    CHECK(hints(text) == 0);
}

TEST_CASE("macrob: brackets") {
  holds({"IF[#5AND2]EQ2]GOTO7", "E 1:1 condition-bracket-missing", "condition-bracket-missing",
         "IF[[#5AND2]EQ2]GOTO7"});
  holds({"WHILE[#5*2]LE#6]DO1", "E 1:1 condition-bracket-missing", "condition-bracket-missing",
         "WHILE[[#5*2]LE#6]DO1"});
  holds(
      {"Y[#3-#4] / [#5] F#9", "E 1:10 word-needs-brackets", "word-needs-brackets", "Y[[#3-#4] / [#5]] F#9"});
  holds(
      {"G1 Y[#3-5.]/COS[8.]]", "E 1:12 word-needs-brackets", "word-needs-brackets", "G1 Y[[#3-5.]/COS[8.]]"});
  holds({"G1 Y#3+2. F5", "E 1:7 word-needs-brackets", "word-needs-brackets", "G1 Y[#3+2.] F5"});
  holds({"[#3=#4]", "E 1:1 bracketed-assignment", "bracketed-assignment", "#3=#4"});
  holds({"N8 [#3=5]", "E 1:4 bracketed-assignment", "bracketed-assignment", "N8 #3=5"});
  // No certain place for the bracket.
  holds({"G1 Y[[#3-#4]/[#5] F#9", "E 1:5 brackets-do-not-match", "brackets-do-not-match", ""});
  holds({"G1 Y[[#3-#4]/#5]]", "E 1:17 brackets-do-not-match", "brackets-do-not-match", ""});
  holds({"#1=SQRT[#2]-[#3*#3]]", "E 1:20 brackets-do-not-match", "brackets-do-not-match", ""});
  CHECK(MacroFile("#1=[5,5+[#2]\n").told() == "E 1:4 brackets-do-not-match; W 1:6 decimal-comma");
}

TEST_CASE("macrob: letters and signs that recognition of text mixes up") {
  holds({"G1 X5. IF #9", "E 1:8 stray-if", "stray-if", "G1 X5. F #9"}, kListing);
  // A G that became 6: after a complete word, or with H.
  holds({"G00 643 H7", "E 1:5 six-for-letter-g", "six-for-letter-g", "G00 G43 H7"}, kListing);
  holds({"N10 643 H7 Z5.", "E 1:5 six-for-letter-g", "six-for-letter-g", "N10 G43 H7 Z5."}, kListing);
  holds({"G0 654 X5.", "E 1:4 six-for-letter-g", "six-for-letter-g", "G0 G54 X5."}, kListing);
  CHECK(MacroFile("G0 612 X5.\n", kListing).told() != "E 1:4 six-for-letter-g");
  CHECK(MacroFile("X6 43 H7\n", kListing).told().find("six") == std::string::npos);
  CHECK(MacroFile("G00 643 H7\n").told().find("six") == std::string::npos);
  // A `#` before a value that is set.
  MacroFile hash("#101=4.\nN10 101=5.\n", kListing);
  CHECK(hash.told() == "E 2:5 hash-lost");
  CHECK(hash.fixed("hash-lost") == "#101=4.\nN10 #101=5.\n");
  CHECK(MacroFile("#101=4.\n101=5.\n", kListing).told() == "E 2:1 hash-lost");
  CHECK(MacroFile("#101=4.\nN10 102=5.\n", kListing).told().find("hash-lost") == std::string::npos);
  // A bracket, where all readings give one formula.
  for (const auto& [text, wanted] : std::vector<std::pair<std::string, std::string>>{
           {"X[[#102-#103]/[#104] F#9", "X[[#102-#103]/[#104]] F#9"},
           {"X[#1+#2 F100.", "X[#1+#2] F100."},
           {"X[#1+#2]] F100.", "X[#1+#2] F100."},
           {"X5. F100.]", "X5. F100."},
           {"G1 X-[SIN[#2]*2. Y5.", "G1 X-[SIN[#2]*2.] Y5."},
           {"#1=[#2+#3", "#1=[#2+#3]"}}) {
    CAPTURE(text);
    MacroFile one(text + "\n", kListing);
    CHECK(one.fixed("bracket-restored") == wanted + "\n");
    CHECK(MacroFile(text + "\n").told().find("bracket-restored") == std::string::npos);
  }
  for (const char* text : {"X[[#102-#103]/#104+#117]] F#9", "#114=SQRT[#105*#105]-[#113*#113]]",
                           "#1=#5*[#2+#3", "X[#3*[2.+#4-#5] F9.", "X[[#1+#2 F9."}) {
    CAPTURE(text);
    CHECK(MacroFile(std::string(text) + "\n", kListing).told().find("brackets-do-not-match") !=
          std::string::npos);
  }
  // No bracket around the number of a block.
  CHECK(MacroFile("#7=1.\nN70 2000+#7\n", kListing).told().find("word-needs-brackets") == std::string::npos);
  // The variable is known.
  MacroFile star("#120=5.\n#1=[*120+#2]\n#1=#2**120\n", kListing);
  CHECK(star.told() == "E 2:5 star-for-hash; E 3:7 star-for-hash");
  CHECK(star.fixed("star-for-hash") == "#120=5.\n#1=[#120+#2]\n#1=#2**120\n");
  CHECK(MacroFile("#1=#2**120\n", kListing).told() == "E 1:6 sign-unknown");
  MacroFile point("#120=5.\n#1=#120.-#2\n#1=[#72./#2]\n", kListing);
  CHECK(point.told() == "E 2:4 variable-number-form; E 3:5 variable-number-form");
  CHECK(point.fixed("variable-number-form") == "#120=5.\n#1=#120-#2\n#1=[#72./#2]\n");
  holds({"#1=[#72./#2]", "E 1:5 variable-number-form", "variable-number-form", "#1=[72./#2]"}, kListing);
  holds({"#1=SIN[30\xC2\xB0]", "E 1:10 degree-sign", "degree-sign", "#1=SIN[30]"});
  holds({"g1 X5.", "W 1:1 small-letter", "small-letter", "G1 X5."});
  holds({"G1 y5. Z#3", "W 1:4 small-letter", "small-letter", "G1 Y5. Z#3"});
}

TEST_CASE("macrob: a block that was broken over two lines") {
  holds({"G2 Y[SQRT[#3*#3-#4]*\n     *[#5-2.]] F5", "E 1:20 block-over-lines", "block-over-lines",
         "G2 Y[SQRT[#3*#3-#4]* [#5-2.]] F5"});
  holds({"#1=[#2+\n#3]", "E 1:7 block-over-lines", "block-over-lines", "#1=[#2+ #3]"});
  // The next line does not close the bracket.
  CHECK(MacroFile("#1=[#2+\n#3=4\n").told() == "E 1:4 brackets-do-not-match");
}

TEST_CASE("macrob: nothing follows from a misprint") {
  // Jumps to a block that could not be read, and out of one.
  CHECK(told("O1\nIF[#1EQ2]GOTO7\nGOTO8\nN7 X[[#1]\nN8 M99\n") == "E 4:5 brackets-do-not-match");
  CHECK(told("O1\nIF[#1GOTO7\nGOTO8\nN7 G0\nN8 M99\n") == "E 2:3 brackets-do-not-match");
  CHECK(told("O1\nWHILE[#1LT[2]DO1\n#1=#1+1\nEND1\nM99\n") == "E 2:6 brackets-do-not-match");
  // One missing target is one error.
  MacroFile missing("O1\nIF[#1EQ1]GOTO20\nIF[#2EQ1]GOTO20\nN2060 M99\n");
  missing.check();
  CHECK(missing.told() == "E 2:14 goto-target-missing");
  CHECK(missing.diagnostics.all().front().notes.size() == 1);
}
