// Blocks to statements: functions by the control's table, calls by their signatures.
#include "tests/unit/NcHelper.h"

#include <doctest/doctest.h>

using namespace dotek;
using dotek::tests::lifted;
using dotek::tests::Nc;

namespace {

// The message of the only finding.
std::string message(const std::string& text, const std::string& set = "easyprobe") {
  Nc nc("fanuc-0i-md", set);
  nc.lift(text);
  return nc.diagnostics.all().size() == 1 ? nc.message() : nc.codes();
}

std::string pointed(const std::string& text, const std::string& set = "easyprobe") {
  Nc nc("fanuc-0i-md", set);
  nc.lift(text);
  return nc.pointedAt();
}

} // namespace

TEST_CASE("EasyProbe: coordinates are absolute, travels count from where the probe is") {
  CHECK(lifted("G65 P9770 Z{Zb}") == "protected Z=work:Zb\n");
  CHECK(lifted("G65 P9770 X{IB} Y{JB} F1000") == "protected X=work:IB Y=work:JB F=1000\n");
  CHECK(lifted("G65 P9023 S{G} X{a} I{X}") == "surface X=here:a sets G X=X\n");
  CHECK(lifted("G65 P9023 S56. Y-10. J2.5") == "surface Y=here:-10 sets 56 Y=2.5\n");
  CHECK(lifted("G65 P9023 K{K} Z{Z} S{G}") == "surface Z=here:Z sets G Z=K\n");
  CHECK(lifted("G65 P9023 D{D} S{G} I{X} J{Y}") == "bore D=D sets G X=X Y=Y\n");
}

TEST_CASE("Inspection Plus: the target is absolute, S counts from 1 and corrects by measured minus target") {
  CHECK(lifted("G65 P9810 Z5. F3000", "inspection-plus") == "protected Z=work:5 F=3000\n");
  CHECK(lifted("G65 P9811 X{x} S3", "inspection-plus") == "surface X=work:x sets 56 X=x\n");
  CHECK(lifted("G65 P9811 X{x} S{s}", "inspection-plus") == "surface X=work:x sets (s+53) X=x\n");
  CHECK(lifted("G65 P9811 Z-1.", "inspection-plus") == "surface Z=work:-1\n");
  CHECK(lifted("G65 P9814 D{d}", "inspection-plus") == "bore D=d\n");
  CHECK(lifted("G65 P9832\nG65 P9833", "inspection-plus") == "probe on\nprobe off\n");
  // The nominal centre is where the probe is: no block says it.
  CHECK(lifted("G65 P9814 D{d} S1", "inspection-plus") == "cycle bore diameter=d sets 54 XY\n");
  CHECK(lifted("G65 P9811 X1. S7", "inspection-plus") == "refused: [no-work-system]");
  CHECK(lifted("G65 P9023 S60. X10. I0.") == "refused: [no-work-system]");
  CHECK(lifted("G65 P9023 S3. X10. I0.") == "refused: [no-work-system]");
}

TEST_CASE("calls that have no single meaning are refused") {
  CHECK(lifted("G65 P9999 X1.") == "refused: [unknown-macro]");
  CHECK(message("G65 P9999 X1.").find("easyprobe") != std::string::npos);
  CHECK(pointed("G65 P9999 X1.") == "P9999");
  CHECK(lifted("G65 P9770 Z1.", "") == "refused: [unknown-macro]");
  CHECK(lifted("G65 P9770 Z1. Q5.") == "refused: [unknown-macro-letter]");
  CHECK(pointed("G65 P9770 Z1. Q5.") == "Q5.");
  CHECK(lifted("G65 P9770 Z1. L2") == "refused: [unknown-macro-letter]");
  CHECK(lifted("G65 P9023 S56. X10.") == "refused: [missing-macro-letter]");
  CHECK(message("G65 P9023 S56. X10.").find("lacks I") != std::string::npos);
  CHECK(lifted("G65 P9770 F500") == "refused: [missing-macro-letter]");
  CHECK(lifted("G65 P9023 S56. X1. Y1. I0. J0.") == "refused: [ambiguous-macro]");
  CHECK(lifted("G65 Z5.") == "refused: [call-without-program]");
  CHECK(lifted("G65 P{p} Z5.") == "refused: [call-without-program]");
  CHECK(lifted("G65 P9770.5 Z5.") == "refused: [call-without-program]");
  CHECK(lifted("G90 G65 P9770 Z5.") == "refused: [call-form]");
  CHECK(lifted("Z5. G65 P9770") == "refused: [call-form]");
  CHECK(lifted("G65 P9770 Z5. G90") == "refused: [call-form]");
  CHECK(lifted("G91\nG65 P9770 Z5.") == "refused: [call-under-incremental]");
  CHECK(lifted("G91\nG90\nG65 P9770 Z5.") == "mode G91\nmode G90\nprotected Z=work:5\n");
  CHECK(lifted("G65 P9770 Z F5") == "refused: [bare-word]");
}

TEST_CASE("every call that a set knows is a cycle by its parameters, whatever measures it") {
  const char* const plus = "inspection-plus";
  CHECK(lifted("G65 P9811 Y-1. Q5.", plus) == "cycle surface Y target y=work:-1 overtravel=5\n");
  CHECK(lifted("G65 P9811 Z{z} T{t} F.5 W1.", plus) ==
        "cycle surface Z target z=work:z tool=t feedback=0.5 print=1\n");
  CHECK(lifted("G65 P9812 X30.", plus) == "cycle pocket X width x=30\n");
  CHECK(lifted("G65 P9812 Y{w} Z-5. R-3. S{s}", plus) ==
        "cycle web Y width y=w depth=-5 clearance=-3 sets (s+53) Y\n");
  CHECK(lifted("G65 P9814 D30. H.1", plus) == "cycle bore diameter=30 size-tolerance=0.1\n");
  CHECK(lifted("G65 P9814 D30. Z-5.", plus) == "cycle boss diameter=30 depth=-5\n");
  CHECK(lifted("G65 P9815 X{x} Y{y} S2", plus) ==
        "cycle inner-corner target x=work:x target y=work:y sets 55 XY\n");
  CHECK(lifted("G65 P9823 A0. B120. C240. D25.", plus) ==
        "cycle three-point-bore first-angle=0 second-angle=120 third-angle=240 diameter=25\n");
  CHECK(lifted("G65 P9843 X{x} D10. A90.", plus) ==
        "cycle angle X target x=work:x spacing y=10 face-angle=90\n");
  CHECK(lifted("G65 P9834", plus) == "cycle feature-to-feature, no move\n");
  CHECK(lifted("G65 P9834 Z5.", plus) == "cycle feature-to-feature letter z=5, no move\n");
  CHECK(lifted("G65 P9801 K2.", plus) == "cycle calibration task=2, stays there\n");
  CHECK(lifted("G65 P9810 Z5. M1.", plus) ==
        "cycle protected-move target z=work:5 flag-only=1, stays there\n");
  CHECK(lifted("G65 P9832 W1.", plus) == "cycle probe-on print=1, no move\n");
  CHECK(lifted("G65 P8812 X{w} Q3.", "dotek") == "cycle pocket X width x=w overtravel=3\n");
  CHECK(lifted("G65 P9817 D30. E20.", plus) == "refused: [unknown-macro]");
  CHECK(lifted("G65 P9814 D30. S1 T5", plus) == "refused: [macro-letters-refused]");
  CHECK(message("G65 P9811 X1. T5 M.1", plus).find("T and M together") != std::string::npos);
  CHECK(message("G65 P9811 X1. T5 M.1", plus).find("TM INPUT MIXED") != std::string::npos);
  CHECK(lifted("G65 P9811 X1. Y1.", plus) == "refused: [macro-letters-refused]");
}

TEST_CASE("what a call leaves is a result by its name, whichever of them it is") {
  const char* const plus = "inspection-plus";
  CHECK(lifted("G65 P9812 X30.\n#601=#143", plus) ==
        "cycle pocket X width x=30\nstore 601=result" +
            std::to_string(static_cast<int>(ir::ResultName::SizeError)) + "\n");
  CHECK(lifted("G65 P9811 Z0.\n#601=#142", plus) ==
        "surface Z=work:0\nstore 601=result" + std::to_string(static_cast<int>(ir::ResultName::ErrorZ)) +
            "\n");
}

TEST_CASE("a macro leaves its motion and feed after it") {
  CHECK(lifted("G1 X1. F50\nG65 P9770 Z5.\nX2.") == "refused: [mode-not-known]");
  CHECK(lifted("G1 X1. F50\nG65 P9770 Z5.\nG1 X2.") ==
        "feed X=work:1 F=50\nprotected Z=work:5\nfeed X=work:2\n");
}

TEST_CASE("a program number that the command line fixes is read") {
  Nc nc;
  nc.fixed["p"] = 9770;
  CHECK(nc.lift("G65 P{p|####} Z5."));
  CHECK(nc.shown() == "protected Z=work:5\n");
}

TEST_CASE("G0 and G1: modal motion, feed and distance mode") {
  CHECK(lifted("G0 Z{Zb} F5000") == "rapid Z=work:Zb F=5000\n");
  CHECK(lifted("G1 X1. F200.\nY2.\nG0 Z5.") == "feed X=work:1 F=200\nfeed Y=work:2 F=200\nrapid Z=work:5\n");
  CHECK(lifted("G0 X1. F300\nG1 Y2.") == "rapid X=work:1 F=300\nfeed Y=work:2 F=300\n");
  CHECK(lifted("G1 X1.") == "feed X=work:1\n"); // the feed in force
  CHECK(lifted("G91 G1 Z-{a|} F50") == "with [sign-before-value]");
  CHECK(lifted("G91 G1 Z-5. F50\nG90 G0 Z5.") == "mode G91\nfeed Z=here:-5 F=50\nmode G90\nrapid Z=work:5\n");
  CHECK(lifted("G0") == "mode G0\n");
  CHECK(lifted("G1 F100\nX5.") == "with [word-left-out]");
  Nc nc;
  CHECK(nc.lift("G1 F100\nX5."));
  CHECK(nc.shown() == "mode G1\nfeed X=work:5 F=100\n");
  CHECK(lifted("F100") == "with [word-left-out]");
  CHECK(lifted("G54 G17 G90 G0 G94") == "mode G54\nmode G17\nmode G90\nmode G94\nmode G0\n");
  CHECK(lifted("G17 G40 G80") == "mode G17\nmode G40\nmode G80\n");
  CHECK(lifted("X5.") == "refused: [mode-not-known]");
  CHECK(message("X5.").find("G0 or G1") != std::string::npos);
  CHECK(lifted("G0 G1 X5.") == "refused: [two-functions]");
  CHECK(lifted("G90 G91") == "refused: [two-functions]");
  CHECK(lifted("G54 G55") == "refused: [two-functions]");
  CHECK(lifted("G54 G55", "", "fanuc-6m") == "refused: [two-functions]");
  CHECK(lifted("G{g} X1.") == "refused: [computed-function]");
  CHECK(lifted("M{m}") == "refused: [computed-function]");
  CHECK(lifted("G20") == "refused: [inch-in-branch]");
  CHECK(lifted("G21") == "with [word-left-out]");
}

TEST_CASE("a work system that the command line fixes is read") {
  Nc nc;
  nc.fixed["g"] = 56;
  CHECK(nc.lift("G{g}"));
  CHECK(nc.shown() == "mode G56\n");
}

TEST_CASE("spindle, coolant, probe, stops, dwell") {
  CHECK(lifted("M5\nM9\nM31\nM32") == "spindle 0\ncoolant 0\nprobe on\nprobe off\n");
  CHECK(lifted("S1200 M3\nM4\nM8\nM7") == "spindle 1 S=1200\nspindle 2\ncoolant 1\ncoolant 2\n");
  CHECK(lifted("M0\nM1") == "stop\noptional stop\n");
  CHECK(lifted("M31", "", "fanuc-31i-b").find("[opaque-block]") != std::string::npos); // not this machine's
  CHECK(lifted("G4 X2.5\nG4 P500") == "dwell 2.5\ndwell 0.5\n");
  CHECK(lifted("G4 P{p}") == "dwell (p/1000)\n");
  CHECK(lifted("G4") == "refused: [dwell-form]");
  CHECK(lifted("G4 X1. P500") == "refused: [dwell-form]");
  CHECK(lifted("G1 G4 X1.") == "refused: [two-functions]");
  CHECK(lifted("M3 M5") == "refused: [two-functions]");
  CHECK(lifted("M8 M9") == "refused: [two-functions]");
  CHECK(lifted("M31 M32") == "refused: [two-functions]");
  CHECK(lifted("M30") == "refused: [end-in-branch]");
  CHECK(lifted("M99") == "refused: [end-in-branch]");
}

TEST_CASE("statements of a block are in the order in which the control acts") {
  // Modes, probe, spindle, coolant, motion, stop.
  CHECK(lifted("M0 G1 X1. F50 M9 M5 G90 (TEXT)") ==
        "(TEXT)\nmode G90\nspindle 0\ncoolant 0\nfeed X=work:1 F=50\nstop\n");
  Nc nc;
  REQUIRE(nc.lift("N20 M5\nM9 G0 X1. M5\n(A)"));
  REQUIRE(nc.body.size() == 5);
  CHECK(nc.body[0].origin.block == 1);
  CHECK(nc.body[0].origin.addresses == "M");
  for (std::size_t i = 1; i < 4; ++i) {
    CHECK(nc.body[i].origin.block == 2);
    CHECK(nc.body[i].origin.addresses == "MGXM");
    CHECK(nc.sources.text(nc.body[i].origin.range()) == "M9 G0 X1. M5");
  }
  CHECK(nc.body[4].origin.block == 3);
}

TEST_CASE("letters that a field fills by itself name arguments") {
  Nc nc;
  REQUIRE(nc.lift("G65 P9023 D{D} S{G} I[{x}+1.] J{Y}\nG0 X{u}"));
  const auto& arguments = nc.body[0].origin.arguments;
  REQUIRE(arguments.size() == 3);
  CHECK(arguments[0].first == 'D');
  CHECK(nc.cycle.variable(arguments[0].second).name == "D");
  CHECK(arguments[1].first == 'S');
  CHECK(nc.cycle.variable(arguments[1].second).name == "G");
  CHECK(arguments[2].first == 'J');
  CHECK(nc.body[0].origin.addresses == "GPDSIJ");
  CHECK(nc.body[1].origin.arguments.empty()); // no macro call
}

TEST_CASE("what Dotek does not translate becomes one opaque block with one note") {
  Nc nc;
  REQUIRE(nc.lift("G43 H1 D1\nG91 G28 Z0.\nM6\nG0 A90.\nS500\nG68 X0. Y0. R{r}\nM98 P1000\nT1"));
  CHECK(nc.shown() == "opaque G43 H1 D1\nopaque G91 G28 Z0\nopaque M6\nopaque G0 A90\nopaque S500\n"
                      "opaque G68 X0 Y0 Rr\nopaque M98 P1000\nopaque T1\n");
  CHECK(nc.diagnostics.all().size() == 8);
  for (const Diagnostic& one : nc.diagnostics.all())
    CHECK(one.code == "opaque-block");
  CHECK(nc.message().find("`G43`") != std::string::npos);
}

TEST_CASE("an opaque block changes the modes that its codes say, a call all of them") {
  const auto after = [](const std::string& blocks, const std::string& last) {
    Nc nc;
    const bool ok = nc.lift(blocks + "\n" + last);
    return ok ? dotek::tests::show(nc.body.back(), nc.cycle) : nc.codes();
  };
  CHECK(after("G0 X1.\nG43 H1", "Z5.") == "rapid Z=work:5");
  CHECK(after("G91 G28 Z0.", "G0 Z5.") == "rapid Z=here:5");
  CHECK(after("G0 X1.\nM98 P1", "Z5.") == "[opaque-block], [mode-not-known]");
  CHECK(after("G0 X1.\nM98 P1", "G0 Z5.") == "[opaque-block], [mode-not-known]"); // G90?
  CHECK(after("G0 X1.\nM98 P1", "G90 G0 Z5.") == "rapid Z=work:5");
  CHECK(after("G1 X1. F50\nM98 P1", "G90 G1 Z5.") == "[opaque-block], [mode-not-known]"); // G94?
  CHECK(after("G1 X1. F50\nM98 P1", "G90 G94 G1 Z5.") == "feed Z=work:5");
  CHECK(after("G0 X1.\nG81 Z-5. R1. F50", "X5.") == "[opaque-block], [mode-not-known]");
  CHECK(after("G0 X1.\nG2 X2. R1. F50", "X5.") == "[opaque-block], [mode-not-known]");
  CHECK(after("G1 X1. F50\nG95 F0.1", "G1 X5.") == "[opaque-block], [mode-not-known]");
  CHECK(after("M77", "G65 P9770 Z5.") == "protected Z=work:5");
  CHECK(after("G5101 A1.", "G65 P9770 Z5.") == "[opaque-block], [call-under-incremental]");
  CHECK(after("M98 P1", "G65 P9770 Z5.") == "[opaque-block], [call-under-incremental]");
}

TEST_CASE("a coordinate of a copied block needs its modes as any other") {
  CHECK(lifted("G43 H1 Z5.") == "refused: [mode-not-known]");
  CHECK(message("G43 H1 Z5.").find("`G0 G43`") != std::string::npos);
  CHECK(lifted("G49 Z{x}") == "refused: [mode-not-known]");
  CHECK(lifted("A90.") == "refused: [mode-not-known]");
  CHECK(lifted("D1 X5.") == "refused: [mode-not-known]");
  CHECK(lifted("M77 Z5.") == "refused: [mode-not-known]");
  CHECK(lifted("G65 P9770 Z5.\nG43 H1 Z5.") == "refused: [mode-not-known]");
  CHECK(lifted("G0 X1.\nM98 P1\nG0 G43 H1 Z5.").find("[mode-not-known]") != std::string::npos); // G90?
  CHECK(lifted("G0 G43 H1 Z5.") == "with [opaque-block]");
  CHECK(lifted("G0 X1.\nG43 H1 Z5.") == "with [opaque-block]");
  CHECK(lifted("G43 H1") == "with [opaque-block]");
  // Coordinates of the code itself.
  for (const char* own : {"G28 Z0.", "G91 G28 Z0.", "G53 Z0.", "G52 X0. Y0.", "G92 X0.", "G68 X0. Y0. R5.",
                          "G81 Z-5. R1. F50", "G2 X2. R1. F50"})
    CHECK_MESSAGE(lifted(own).find("[mode-not-known]") == std::string::npos, own);
}

TEST_CASE("assignments: variables of the machine, results, alarms") {
  CHECK(lifted("#550=5") == "store 550=5\n");
  CHECK(lifted("#550=#551+1") == "store 550=(u14(#551)+1)\n"); // an unset #551 counts as 0
  CHECK(lifted("#550=#551") == "store 550=#551\n");            // an unset #551 is copied
  CHECK(lifted("#550=-#551") == "store 550=u0(u14(#551))\n");
  CHECK(lifted("#550={a}") == "store 550=a\n");
  CHECK(lifted("#550=1 (TEXT)") == "(TEXT)\nstore 550=1\n");
  CHECK(lifted("G65 P9023 S56. X10. I0.\n#550=#138") == "surface X=here:10 sets 56 X=0\nstore 550=result0\n");
  CHECK(lifted("G65 P9811 X1.\n#550=#135\n#551=#138", "inspection-plus") ==
        "surface X=work:1\nstore 550=result1\nstore 551=result4\n");
  CHECK(lifted("#3000=1(TOO DEEP)") == "with [alarm-renumbered]");
  CHECK(lifted("#3006=1(CLEAN IT)") == "stop CLEAN IT\n");
  CHECK(lifted("#3006=5(CLEAN IT)") == "stop 5 CLEAN IT\n");
  CHECK(lifted("#3006=#551(CLEAN IT)") == "with [message-number-computed]");
  CHECK(lifted("#[500+1]=2") == "store (500+1)=2\n");
  CHECK(lifted("#550=#[#551]") == "refused: [computed-variable]");
  CHECK(lifted("#1=5") == "refused: [local-of-caller]");
  CHECK(lifted("#550=#33") == "refused: [local-of-caller]");
  CHECK(lifted("#550=#0") == "refused: [local-of-caller]");
  CHECK(message("#550=#0").find("always empty") != std::string::npos);
  CHECK(pointed("#550=1+#5") == "5");
}

TEST_CASE("a variable of the vendor's macros that is no result of the last measurement is a warning") {
  CHECK(lifted("#550=#138") == "with [scratch-read]");
  CHECK(message("#550=#138").find("nothing was measured") != std::string::npos);
  CHECK(lifted("G65 P9811 X1.\n#550=#136", "inspection-plus") == "with [scratch-read]"); // Y was not measured
  CHECK(lifted("#100=1\n#550=#100") == "store 100=1\nstore 550=#100\n");
  CHECK(lifted("#100=1\nG65 P9770 Z1.\n#550=#100") == "with [scratch-read]");
  Nc nc;
  CHECK(nc.lift("#550=#140"));
  CHECK(nc.shown() == "store 550=#140\n");
}

TEST_CASE("formulas: the same arithmetic, or a refusal") {
  CHECK(lifted("#550=SIN[30]*2") == "store 550=(u6(30)*2)\n");
  CHECK(lifted("#550=ATAN[#551]") == "store 550=u11(u14(#551))\n");
  CHECK(lifted("#550=FIX[#551/2]") == "store 550=u2((u14(#551)/2))\n");
  CHECK(lifted("#550=ROUND[1.5]") == "store 550=u4(1.5)\n");
  CHECK(lifted("#550=#551AND3") == "store 550=(u14(#551)and3)\n");
  CHECK(lifted("G0 X[{a}+1]") == "rapid X=work:(a+1)\n"); // no decimal mode in a formula
  CHECK(lifted("G0 X[ROUND[#551]]") == "refused: [function-not-read]");
  CHECK(lifted("#550=ATAN[1]/[2]") == "with [angle-range]"); // 0 to 360, or -180 to 180
  CHECK(lifted("#550=ASIN[1]") == "with [angle-range]");
  CHECK(lifted("#550=BIN[1]") == "refused: [function-not-read]");
  CHECK(lifted("#550=7MOD3") == "refused: [function-not-read]"); // not on the 0i
  CHECK(lifted("#550=ACOS[1]", "", "fanuc-6m") == "refused: [function-not-read]");
  CHECK(lifted("#550=1AND3", "", "fanuc-6m") == "refused: [function-not-read]");
}

TEST_CASE("program marks, program numbers and block delete have no place in a branch") {
  CHECK(lifted("%") == "refused: [program-in-branch]");
  CHECK(lifted("O100") == "refused: [program-in-branch]");
  CHECK(lifted("/G0 X1.") == "refused: [block-delete-in-branch]");
  CHECK(lifted("N90") == "");
  CHECK(lifted("N90 (A) (B)") == "(A)\n(B)\n");
}

TEST_CASE("comments are UTF-8 in the IR") {
  Nc nc;
  frontend::nc::LiftContext context{nc.control, nullptr, nc.cycle, nc.diagnostics};
  context.encoding = Encoding::Cp1250;
  const auto block = nc.parse("(M\xECR)");
  REQUIRE(block);
  CHECK(frontend::nc::lift(*block, context, nc.body));
  CHECK(nc.shown() == "(M\xC4\x9BR)\n");
}

TEST_CASE("programs called, modal codes, equal states") {
  Nc nc;
  CHECK(frontend::nc::programsCalled(*nc.parse("G65 P9770 Z1.")) == std::vector<std::uint32_t>{9770});
  CHECK(frontend::nc::programsCalled(*nc.parse("G65 P{p}")).empty());
  CHECK(frontend::nc::programsCalled(*nc.parse("M98 P9770")).empty());
  std::map<int, std::string> modal;
  frontend::nc::noteModal(*nc.parse("G91 G28 G0 Z0. G55"), nc.control, modal);
  CHECK(modal == std::map<int, std::string>{{1, "G0"}, {3, "G91"}, {14, "G55"}});
  Nc a;
  Nc b;
  a.lift("G1 X1. F50");
  b.lift("G0 X1. F50.");
  CHECK_FALSE(a.state == b.state);
  b.lift("G1 X1. F50");
  CHECK(a.state == b.state);
}
