#include "frontend/macrob/Check.h"
#include "frontend/macrob/Lower.h"
#include "ir/Print.h"
#include "support/messages/MacroB.h"
#include "tests/unit/MacroBHelper.h"

#include <doctest/doctest.h>

using namespace dotek;
using tests::MacroFile;

namespace {

struct Lowered {
  std::optional<ir::ProgramFile> file;
  std::string told;
  std::string body; // of the first program, blanks and labels as print() writes them
};

Lowered lower(const std::string& text, const std::string& control = "fanuc-31i-b") {
  MacroFile parsed("%\nO1\n" + text + "%\n");
  const auto profile = stdlib::Control::load(stdlib::DataFiles(), control);
  REQUIRE(profile);
  Lowered out;
  out.file = frontend::macrob::lower(parsed.file, *profile, parsed.sources, parsed.diagnostics);
  out.told = parsed.told();
  if (!out.file) return out;
  const std::string all = ir::print(*out.file, nullptr);
  out.body = all.substr(all.find("  body\n") + 7);
  return out;
}

} // namespace

TEST_CASE("macro B lowering: null is kept by a variable that is alone, else it counts as 0") {
  CHECK(lower("#2=#1\n").body == "    store #2 = #1\n");
  CHECK(lower("#2=[#1]\n").body == "    store #2 = or_zero(#1)\n");
  CHECK(lower("#2=-#1\n").body == "    store #2 = -(or_zero(#1))\n");
  CHECK(lower("#2=#1+#3*5\n").body == "    store #2 = or_zero(#1) + or_zero(#3) * 5\n");
  CHECK(lower("#2=SIN[#1]\n").body == "    store #2 = sin(or_zero(#1))\n");
  CHECK(lower("#[#1]=#[#2+1]\n").body == "    store #(or_zero(#1)) = #(or_zero(#2) + 1)\n");
}

TEST_CASE("macro B lowering: words keep null, but a null after a minus has no value") {
  CHECK(lower("G0X#1Y-#2Z[#3+1.]\n").body == "    nc G0 X(#1) Y(-(#2)) Z(or_zero(#3) + 1.)\n");
  CHECK(lower("X-5.Y-#[#1]\n").body == "    nc X-5. Y(-(#(or_zero(#1))))\n");
  CHECK(lower("X[ROUND[#1]]\n").body == "    nc X(round_increment(or_zero(#1)))\n");
  CHECK(lower("#1=ROUND[#1]\n").body == "    store #1 = round(or_zero(#1))\n");
}

TEST_CASE("macro B lowering: EQ and NE know null, the other comparisons count it as 0") {
  CHECK(lower("N1IF[#1EQ#0]GOTO1\n").body == "  label n1\n    if #1 is #0 goto n1\n");
  CHECK(lower("N1IF[#1NE[#2]]GOTO1\n").body == "  label n1\n    if #1 is not or_zero(#2) goto n1\n");
  CHECK(lower("N1IF[#1LT#2]GOTO1\n").body == "  label n1\n    if or_zero(#1) < or_zero(#2) goto n1\n");
  CHECK(lower("N1IF[[#1GT1]XOR[#2LE3]]GOTO1\n").body ==
        "  label n1\n    if or_zero(#1) > 1 and or_zero(#2) > 3 or or_zero(#1) <= 1 and or_zero(#2) <= 3 "
        "goto n1\n");
}

TEST_CASE("macro B lowering: THEN jumps over its statement, a loop is its labels and its ends") {
  CHECK(lower("IF[#1EQ2]THEN#3=#4\n").body ==
        "    if #1 is not 2 goto next1\n    store #3 = #4\n  label next1\n");
  CHECK(lower("IF[#1EQ2]THENGOTO9\nN9\n").body == "    if #1 is 2 goto n9\n  label n9\n");
  CHECK(lower("WHILE[#1LT3]DO2\n#1=#1+1\nEND2\n").body ==
        "  label next1\n    while 2 or_zero(#1) < 3 else next2\n    store #1 = or_zero(#1) + 1\n"
        "    end 2 goto next1\n  label next2\n");
  CHECK(lower("DO1\nEND1\n").body ==
        "  label next1\n    while 1 else next2\n    end 1 goto next1\n  label next2\n");
}

TEST_CASE("macro B lowering: a jump goes forward first, then to the first block from the top") {
  const Lowered forward = lower("N5#1=1\nGOTO5\nN5#1=2\nN5#1=3\nGOTO5\n");
  REQUIRE(forward.file);
  const ir::Program& program = forward.file->programs.front();
  std::vector<std::size_t> targets;
  for (const ir::ProgramStatement& statement : program.body)
    if (const auto* jump = std::get_if<ir::Jump>(&statement.node)) targets.push_back(jump->target);
  CHECK(targets == std::vector<std::size_t>{1, 0});
  CHECK(lower("GOTO#1\n").body == "    goto-number or_zero(#1)\n");
  CHECK(lower("IF[#1EQ1]GOTO[#2]\n").body ==
        "    if #1 is not 1 goto next1\n    goto-number or_zero(#2)\n  label next1\n");
  // Alarm 128 comes when the jump runs.
  CHECK(lower("GOTO7\n").body == "    goto-number 7\n");
  CHECK(lower("N0100\nGOTO100\n").body == "  label n100\n    goto n100\n");
}

TEST_CASE("macro B lowering: calls, their arguments and the words beside them") {
  CHECK(lower("G65P9010L3A1.I2.J3.I4.\n").body ==
        "    call macro 9010 times 3, A #1 = 1., I #4 = 2., J #5 = 3., I #7 = 4.\n");
  CHECK(lower("G66P9010X#1\nG67\n").body == "    call after-moves 9010, X #24 = #1\n    call off\n");
  CHECK(lower("G0X1.M98P20L2\n").body == "    nc G0 X1.\n    call subprogram 20 times 2\n");
  CHECK(lower("G91M99P#1\n").body == "    nc G91\n    exit to #1\n");
  CHECK(lower("M99\n").body == "    exit\n");
  CHECK(lower("M99L2\n").told == "E 3:4 " + std::string(frontend::macrob::returnRepeatedCheck.code));
}

TEST_CASE("macro B lowering: messages, output, comments, block delete") {
  CHECK(lower("#3000=#1(STOP)(AND MORE)\n").body ==
        "    comment \"AND MORE\"\n    raise or_zero(#1) \"STOP\"\n");
  CHECK(lower("IF[#1EQ#0]THEN#3006=1(WAIT)\n").body ==
        "    if #1 is not #0 goto next1\n    notice 1 \"WAIT\"\n  label next1\n");
  CHECK(lower("POPEN\nDPRNT[X*#100[53]]\nPCLOS\n").body ==
        "    port open\n    print \"X \" #100[53]\n    port close\n");
  CHECK(lower("DPRNT[#100[5]]\n").told == "E 3:6 " + std::string(frontend::macrob::printedFormatCheck.code));
  CHECK(lower("/3#1=1\n/N5X1.\n").body ==
        "    store unless-skipped 3 #1 = 1\n  label n5\n    nc unless-skipped 1 X1.\n");
  CHECK(lower("/WHILE[#1LT3]DO1\nEND1\n").told.find("block-delete-of-loop") != std::string::npos);
}

TEST_CASE("macro B lowering: what the control cannot run is refused") {
  CHECK(lower("#1=ASIN[#2]\n", "fanuc-6m").told == "E 3:4 function-unknown-here");
  CHECK_FALSE(lower("#1=ASIN[#2]\n", "fanuc-6m").file);
  CHECK_FALSE(lower("G0 X\n").file);
  CHECK_FALSE(lower("WHILE[#1LT3]DO1\n").file);
  // 115 and 116 are alarms of the run.
  CHECK(lower("#90=1\n").file);
  CHECK(lower("#0=1\n").file);
  MacroFile drawing(":60\nA #1 = DIA D = 128\n#1=#1/2.\n", frontend::macrob::Text::Listing);
  const auto profile = stdlib::Control::load(stdlib::DataFiles(), "fanuc-6m");
  CHECK_FALSE(frontend::macrob::lower(drawing.file, *profile, drawing.sources, drawing.diagnostics));
  CHECK(drawing.told().find("legend-not-run") != std::string::npos);
}

TEST_CASE("macro B lowering: blocks after the end of the file belong to no program") {
  CHECK(lower("G0X1.\n%\nX2.\n").told ==
        "E 4:1 " + std::string(diag::BlocksBehindEnd::code) + "; W 4:1 text-after-end");
  CHECK_FALSE(lower("G0X1.\n%\nX2.\n").file);
  // Whole programs are read, and not in silence.
  const Lowered two = lower("M30(50%)\n(%)\n%\nO2(%)\nM99\n");
  CHECK(two.file);
  CHECK(two.told == "W 5:1 text-after-end");
  CHECK(lower("#1=1(%)\n(%)\nM30\n%\n%\n").told == "");
}

TEST_CASE(
    "macro B lowering: what the control meets only as it runs refuses nothing, however often it is there") {
  std::string text;
  for (int i = 0; i <= static_cast<int>(Diagnostics::kMostAlike); ++i)
    text += "IF[#1EQ" + std::to_string(i) + ".]GOTO" + std::to_string(5000 + i) + "\n";
  const Lowered lowered = lower(text);
  CHECK(lowered.file.has_value());
  CHECK(lowered.told.empty());
}
