// Checks of programs: each finding, and what looks like it and is right.
#include "tests/unit/MacroBHelper.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

// Findings of a body inside a whole program, line 1 being its first line.
std::string body(const std::string& text, const std::string& control = "") {
  return told(text + "\nM99\n", control);
}
std::string program(const std::string& text, const std::string& control = "") {
  return told("O1\n" + text + "\nM99\n", control);
}

constexpr const char* k31 = "fanuc-31i-b";
constexpr const char* k0i = "fanuc-0i-md";
constexpr const char* k6m = "fanuc-6m";

} // namespace

TEST_CASE("macrob check: loops (1.7, 1.11)") {
  CHECK(program("WHILE[#1LE5]DO1\nDO2\n#1=#1+1\nEND2\nEND1\nDO1\nEND1") == "");
  MacroFile bare("O1\nWHILE[#1LE#2]DO\n#1=#1+1\nEND3\nM99\n");
  bare.check();
  CHECK(bare.told() == "E 2:14 do-without-number");
  CHECK(bare.fixed("do-without-number") == "O1\nWHILE[#1LE#2]DO3\n#1=#1+1\nEND3\nM99\n");
  CHECK(program("DO1\nEND") == "E 3:1 end-without-number");
  CHECK(program("DO4\nEND4") == "E 2:3 loop-number-range; E 3:4 loop-number-range");
  CHECK(program("DO1\nDO1\nEND1\nEND1") == "E 3:3 loop-number-in-use");
  CHECK(program("DO1\nDO1\nDO1\nEND1\nEND1\nEND1") == "E 3:3 loop-number-in-use; E 4:3 loop-number-in-use");
  CHECK(program("DO1\nEND1\nDO1\nEND1") == "");
  CHECK(program("DO1\nDO2\nEND1\nEND2") == "E 4:1 loops-cross");
  CHECK(program("DO1\nDO2\nDO3\nEND2\nEND3\nEND1\nDO2\nEND2") == "E 5:1 loops-cross");
  CHECK(program("END2") == "E 2:1 end-without-do");
  CHECK(program("DO2\n#1=2") == "E 2:1 do-without-end");
}

TEST_CASE("macrob check: jumps (1.7, 1.11)") {
  CHECK(program("IF[#1EQ1]GOTO5\nG0\nN005 G1") == "");
  CHECK(program("GOTO5\nN6") == "E 2:5 goto-target-missing");
  CHECK(program("GOTO#1\nGOTO[#2+1]") == "W 3:1 block-never-runs");
  // Excerpts hold a part only.
  CHECK(body("IF[#1EQ1]GOTO5") == "");
  CHECK(told("O1\nIF[#1EQ1]GOTO5\nG0\n") == "");
  CHECK(program("IF[#1EQ1]GOTO5\nN5 G0\nN5 G1") == "W 4:1 duplicate-target");
  CHECK(program("N5 G0\nN5 G1") == ""); // nobody jumps there
  CHECK(program("IF[#1EQ1]GOTO5\nDO1\nN5 #1=#1+1\nEND1") == "E 2:14 jump-into-loop");
  CHECK(program("IF[#1EQ1]GOTO5\nDO1\n#1=#1+1\nN5 END1") == "E 2:14 jump-into-loop");
  CHECK(program("IF[#1EQ1]GOTO5\nN5 DO1\n#1=#1+1\nEND1") == ""); // to the DO
  CHECK(program("DO1\nIF[#1EQ1]GOTO5\n#1=#1+1\nN5 END1") == ""); // inside
  CHECK(program("DO1\nIF[#1EQ1]GOTO5\nEND1\nN5 G0") == "");      // out of it
  // Of loops within one another the jump may enter the inner one alone.
  CHECK(program("DO1\nIF[#1EQ1]GOTO5\nDO2\nN5 #1=#1+1\nEND2\nEND1") == "E 3:14 jump-into-loop");
  CHECK(program("DO1\nDO2\nIF[#1EQ1]GOTO5\nEND2\nN5 #1=#1+1\nEND1") == "");
  CHECK(program("DO1\nDO2\nN5 #1=#1+1\nEND2\nEND1\nIF[#1EQ1]GOTO5") == "E 7:14 jump-into-loop");
  CHECK(program("DO1\nEND1\nN5 G0\nDO1\nIF[#1EQ1]GOTO5\nEND1") == "");
}

TEST_CASE("macrob check: blocks that never run") {
  CHECK(program("GOTO9\n#1=2\nG0 X1.\nN9 G0") == "W 3:1 block-never-runs");
  // Reached only from blocks that never run.
  CHECK(program("GOTO9\nIF[#1EQ1]GOTO5\nG0\nN5 G1\nN9 G0") == "W 3:1 block-never-runs");
  CHECK(program("IF[#2EQ1]GOTO5\nGOTO9\nN5 G1\nN9 G0") == "");
  CHECK(program("/GOTO9\n#1=2\nN9 G0") == "");  // the operator decides
  CHECK(program("GOTO#5\nN5 G1\nN9 G0") == ""); // may go to any number
  CHECK(program("GOTO#5\nG0\nN9 G0") == "W 3:1 block-never-runs");
  CHECK(program("GOTO9\n(NOTE)\nN9 G0") == "");
  CHECK(program("DO1\nIF[#1EQ1]GOTO9\nGOTO8\nN8\nEND1\nN9 G0") == "");
  CHECK(program("DO1\n#1=#1+1\nIF[#1EQ1]GOTO8\nGOTO9\nEND1\nN8\nN9") == "");
}

TEST_CASE("macrob check: blocks after the end of the program") {
  CHECK(program("G0 X1.\nM30") == "W 4:1 block-never-runs"); // the M99
  CHECK(told("O1\nM30\nG1 X5.\nN9 G0\n") == "W 3:1 block-never-runs");
  CHECK(told("O1\nM2\n(NOTE)\n") == "");
  CHECK(told("O1\n/M30\nG0 X5.\nM99\n") == ""); // the operator decides
  CHECK(told("O1\nIF[#1EQ1]GOTO9\nM30\nN9 #3000=1(STOP)\n") == "");
  CHECK(told("O1\nIF[#1EQ1]GOTO9\nM99\nG0\nN9 #3000=1(STOP)\n") == "W 4:1 block-never-runs");
  // A word may name the block: a part of the program that is called, a contour.
  CHECK(told("O1\nM98 P1000 Q100\nM30\nN100 G0 X5.\nM99\n") == "");
  CHECK(told("O1\nM97 P100\nM30\nG0\nN100 G0 X5.\nM99\n") == "W 4:1 block-never-runs");
  CHECK(told("O1\nM30\n%\n") == "");
  // A loop whose END no pass comes to.
  CHECK(told("O1\nWHILE[#1LT5]DO1\n#1=#1+1\nM99\nEND1\n") == "W 5:1 block-never-runs");
  CHECK(told("O1\nWHILE[#1LT5]DO1\nIF[#1LT3]GOTO7\nM99\nN7 #1=#1+1\nEND1\nM99\n") == "");
  CHECK(told("O1\nWHILE[#1LT5]DO1\n#1=#1+1\nM99\nO2\nEND1\nM99\n") ==
        "E 2:1 do-without-end; E 6:1 end-without-do");
}

TEST_CASE("macrob check: numbers of variables (1.3, 1.11)") {
  CHECK(program("#33=#100+#199+#500+#999+#5041") == "");
  CHECK(program("#34=1\n#1=#34") == "E 2:1 variable-out-of-range");
  CHECK(program("#1=#200") == "W 2:4 variable-out-of-range");
  CHECK(program("#1=#150", k31) == "");
  CHECK(program("#1=#400", k31) == "W 2:4 variable-out-of-range"); // its profile infers the ranges
  CHECK(program("#1=#60", k31) == "E 2:4 variable-out-of-range");
  CHECK(program("#1=#400", k6m) == "E 2:4 variable-out-of-range"); // documented
  CHECK(program("#1=#150", k6m) == "E 2:4 variable-out-of-range");
  CHECK(program("X#560", k6m) == "E 2:2 variable-out-of-range");
  CHECK(program("#1=#559", k6m) == "");
  CHECK(program("#0=1") == "E 2:1 null-written");
  CHECK(program("IF[#1EQ#0]THEN#2=#0") == "");
  CHECK(program("#4001=1", k31) == "E 2:1 read-only-written");
  CHECK(program("#5041=1.", k0i) == "E 2:1 read-only-written");
  CHECK(program("IF[#1EQ1]THEN#5061=1.", k31) == "E 2:14 read-only-written");
  CHECK(program("#1000=1", k0i) == "E 2:1 read-only-written");
  CHECK(program("#1032=#1132", k0i) == "E 2:1 read-only-written"); // all inputs as one word
  CHECK(program("#1132=#1032", k0i) == "");
  CHECK(program("#5041=1.") == ""); // which control is not known
  CHECK(program("#5221=1.\n#3000=5(STOP)\n#1=#4001", k31) == "");
}

TEST_CASE("macrob check: a number of a variable taken for its value") {
  MacroFile file("O1\n#[#20+#21]=5.\nIF[ABS[#20+#21]GT[#3]]GOTO5\n#4=SQRT[#20+#22]\nN5 M99\n");
  file.check();
  CHECK(file.told() == "W 3:8 subscript-as-value");
  CHECK(file.fixed("subscript-as-value").find("IF[ABS[#[#20+#21]]GT[#3]]") != std::string::npos);
  CHECK(program("#4=ABS[#20+#21]") == ""); // no such subscript
  CHECK(program("#[#20+#21]=ABS[#[#20+#21]]") == "");
  CHECK(program("#[700+#21]=ABS[700+#21]") == ""); // a number, not two variables
}

TEST_CASE("macrob check: a `#` at the wrong place") {
  MacroFile base("O1\n#1=5.+[#2000+#7]\nM99\n");
  base.check();
  CHECK(base.told() == "W 2:8 table-base-read");
  CHECK(base.fixed("table-base-read") == "O1\n#1=5.+#[2000+#7]\nM99\n");
  CHECK(program("#1=5.+#[2000+#7]") == "");
  CHECK(program("#1=[#2001+#7]") == "");
  CHECK(program("#110=5.\n#1=#110*SIN[#2]\n#3=110*SIN[#2]") == "W 4:4 hash-missing");
  // The number of a variable that is read by it.
  CHECK(program("#14=#5221+#4*20\n#16=5221+#4*20\n#1=#[#16]") == "");
  CHECK(program("#14=#5221+#4*20\n#16=[5221+#4*20]-1\n#[#16+1]=#[#16]") == "");
  CHECK(program("#14=#5221+#4*20\n#16=5221+#4*20\n#[#15]=#16") == "W 3:5 hash-missing");
  CHECK(program("#110=5.\n#1=#110*SIN[#2]\n#16=5221+110*SIN[#2]\n#1=#[#16]") == "W 4:10 hash-missing");
  CHECK(program("#110=5.\n#1=#2*110") == ""); // not repeated with the variable
  CHECK(program("G1 X5. F#9\nG1 X6. F9") == "W 3:8 hash-missing");
  CHECK(program("G1 X5. F#9\nG1 X6. F90") == "");
  CHECK(program("G1 X5. F#9\nG1 X6. F9.") == "");
  CHECK(program("M#13\nM13") == "");
}

TEST_CASE("macrob check: a zero point that is written twice") {
  CHECK(program("#2502=#2501+5.\n#2502=#2601") == "W 3:1 offset-overwritten");
  CHECK(program("#5221=1.\n(NOTE)\n#5222=2.\n#5221=3.") == "W 5:1 offset-overwritten");
  CHECK(program("#2502=#2501+5.\n#2602=#2601") == "");
  CHECK(program("#2502=#2501\n#2502=#2502+5.") == "");
  CHECK(program("#2502=#2501\nG54 X0.\n#2502=#2601") == "");
  CHECK(program("#2502=#2501\nIF[#1EQ1]THEN#2502=#2601") == "");
  CHECK(program("#502=#501\n#502=#601") == "");
}

TEST_CASE("macrob check: depth of brackets (1.4)") {
  CHECK(program("#1=SIN[[[#2+#3]*#4+#5]*#6]") == "");
  CHECK(program("#1=[[[[[1]]]]]") == "");
  CHECK(program("#1=[[[[[[1]]]]]]") == "E 2:9 brackets-too-deep");
  CHECK(program("#1=2([[[[[[)") == "");
  CHECK(program("IF[[[[[[#1]]]]]EQ1]GOTO5\nN5") == "");
}

TEST_CASE("macrob check: what a control can calculate (1.12)") {
  CHECK(program("#1=ASIN[#2]\n#3=#4AND7\n#5=ATAN[1]/[2]", k31) == "");
  CHECK(program("#1=ASIN[#2]\n#1=ASIN[#3]", k6m) == "E 2:4 function-unknown-here");
  CHECK(program("#3=#4AND7", k6m) == "E 2:4 function-unknown-here");
  CHECK(program("#1=ATAN[#2/#3]", k6m) == "");
  CHECK(program("#1=ATAN[#2]/[#3]", k6m) == "E 2:4 function-unknown-here");
  CHECK(program("IF[#1EQ2]THEN#3=4", k6m) == "E 2:1 then-unknown-here");
  CHECK(program("IF[#1EQ2]THEN#3=4", k0i) == "");
  CHECK(program("IF[#1EQ2]THENGOTO5\nN5", k31) == ""); // ran there
  CHECK(program("IF[#1EQ2]THENGOTO5\nN5", k0i) == "W 2:10 then-goto");
  CHECK(program("IF[[#1EQ2]AND[#2EQ3]]GOTO5\nN5", k31) == "");
  CHECK(program("IF[[#1EQ2]OR[#2EQ3]]GOTO5\nN5", k6m) == "E 2:3 joined-unknown-here");
  MacroFile bare("O1\n#1=ABS#2\nM99\n");
  bare.check(k0i);
  CHECK(bare.told() == "W 2:4 function-without-brackets");
  CHECK(bare.fixed("function-without-brackets") == "O1\n#1=ABS[#2]\nM99\n");
  CHECK(program("#1=ABS#2") == "W 2:4 function-without-brackets");
  CHECK(program("#1=ABS#[#2+1]", k31) == "");
  CHECK(program("#1=[SIN #2]", k6m) == "");
}

TEST_CASE("macrob check: conditions that do not depend on anything") {
  CHECK(program("IF[[#1AND0]EQ0]GOTO5\nN5") == "W 2:3 constant-condition");
  CHECK(program("IF[[#1AND1]EQ0]GOTO5\nN5") == "");
  CHECK(program("IF[#1EQ#1]GOTO5\nN5") == "W 2:3 constant-condition");
  CHECK(program("WHILE[1EQ1]DO1\nEND1") == "");
  CHECK(program("IF[[#1*0]GT2]GOTO5\nN5") == "W 2:3 constant-condition");
}

TEST_CASE("macrob check: exact comparison of computed values (1.6)") {
  CHECK(program("IF[#1/3EQ#2]GOTO5\nN5") == "W 2:3 equality-of-computed");
  CHECK(program("IF[SIN[#1]NE0.5]GOTO5\nN5") == "W 2:3 equality-of-computed");
  CHECK(program("#1=#1+0.1\nIF[#1EQ1.]GOTO5\nN5") == "W 3:3 equality-of-computed");
  CHECK(program("#1=#1+0.25\nIF[#1EQ1.]GOTO5\nN5") == ""); // exact
  CHECK(program("#1=#1+1\nIF[#1EQ10]GOTO5\nN5") == "");
  CHECK(program("IF[FIX[#1/2]*2EQ#1]GOTO5\nN5") == "");
  CHECK(program("IF[#1/3LT#2]GOTO5\nN5") == "");
  CHECK(program("#1=FIX[#2*0.1]") == "N 2:4 fix-of-computed");
  CHECK(program("#1=FIX[#2/3]") == "N 2:4 fix-of-computed");
  CHECK(program("#1=FIX[#2]") == "");
  // Halves, quarters, and what divides the clock.
  CHECK(program("IF[[#7/2]EQ#8]GOTO5\nN5") == "");
  CHECK(program("#1=FIX[[#7-1]/4]") == "");
  CHECK(program("#1=FIX[#3012/10000]") == "");
  CHECK(program("#1=FIX[#3012/0.3]") == "N 2:4 fix-of-computed");
}

TEST_CASE("macrob check: codes are whole numbers (1.6)") {
  CHECK(program("M3.0") == "E 2:1 code-with-point");
  CHECK(program("S1000. M3") == "E 2:1 code-with-point");
  CHECK(program("M[3.5]\nG54.1 P2\nG65 P9810 M1. S1. T4.") == "");
}

TEST_CASE("macrob check: decimal points, where the control counts increments (1.8)") {
  CHECK(program("G1 X10 F100") == "");
  CHECK(program("G1 X10 F100", k31) == "");
  CHECK(program("G1 X10 F100", k6m) == "W 2:4 word-without-point");
  CHECK(program("G1 X0 Y5. Z#1 A-#2 B[5]", k6m) == "");
  // Q of a canned cycle and K of an arc are lengths; K of the one repeats it, Q elsewhere chooses.
  CHECK(program("G83 Z-9. R2. Q4 F100", k6m) == "W 2:14 word-without-point");
  CHECK(program("G3 Y5. J0 K5 F100", k6m) == "W 2:11 word-without-point");
  CHECK(program("G81 Z-9. R2. K3 F100\nG8 Q1", k6m) == "");
  CHECK(program("G65P9811Y-1Q5", k31) == "");
  CHECK(program("G0 X25400 A360000\nG4 X9999", k6m) == ""); // meant, as with a point nothing reaches it
  CHECK(program("G65P9811Y-1Q5.", k6m) == "E 2:9 argument-without-point");
  CHECK(program("G65 P10 D5 F20 T4 S1 H3 M1 E1 X0", k6m) == ""); // whole units
}

TEST_CASE("macrob check: calls (1.8)") {
  CHECK(program("G65 A1. B2. P1000") == ""); // P and arguments in any order
  CHECK(program("G65 X1.") == "E 2:1 call-without-program");
  CHECK(program("M98 L2") == "E 2:1 call-without-program");
  CHECK(program("M98 Q100\nGOTO 9\nN100 G0 X1.\nM99\nN9", k31) == ""); // and N100 runs
  CHECK(program("M98 Q100\nGOTO 9\nN100 G0 X1.\nM99\nN9", k6m) == "E 2:1 call-without-program");
  CHECK(program("M98 Q100\nGOTO 9\nN10 G0 X1.\nM99\nN9", k31) == "E 2:5 goto-target-missing");
  CHECK(program("P9810 D5. S55.") == "W 2:1 call-words-alone");
  CHECK(program("G82 X5. P9500\nX6. P500") == "");
  CHECK(program("G65 P100 G90") == "E 2:10 no-argument");
  CHECK(program("G65 P100 N5") == "E 2:10 no-argument");
  CHECK(program("G66.1 P100 G1 X5.") == "");
  CHECK(program("X1. G65 P100") == "W 2:1 argument-before-call");
  CHECK(program("G90 G65 P100") == "");
  CHECK(program("G65 P100 I1. J2. K3. I4. J5.") == "");
  CHECK(program("G65 P100 J1. I2.") == "W 2:14 argument-order");
  // The manual's own example: #7 is 5.
  CHECK(program("G65 A1.0 B2.0 I-3.0 I4.0 D5.0 P1000") == "W 2:26 argument-overwritten");
  CHECK(program("G65 P100 A1. A2.") == "W 2:14 argument-overwritten");
}

TEST_CASE("macrob check: positions that are read too early (1.2)") {
  CHECK(program("G1 X5. F100\n#1=#5041", k31) == "W 3:4 position-read-early");
  CHECK(program("G1 X5. F100\n#2=1\nIF[#5061GT#3]GOTO5\nN5", k31) == ""); // latched
  CHECK(program("G1 X5. F100\n#1=#5041") == "");
  CHECK(program("G31 X5. F100\n#1=#5061", k31) == "");
  CHECK(program("G31 X5. F100\nG53\n#1=#5041", k31) == "");
  CHECK(program("G1 X5. F100\nG4 P0\n#1=#5041", k31) == "");
  CHECK(program("G1 X5. F100\nM5\n#1=#5041", k31) == "");
  CHECK(program("G65 P9811 X5.\n#1=#5041", k31) == "");
  CHECK(program("G1 X5. F100\n#1=#5001", k31) == ""); // end of the block, known beforehand
  CHECK(program("G1 X5. F100\nG90\nF200.\n#1=#5041", k31) == "W 5:4 position-read-early");
  CHECK(program("G31 X5. F100\nG1 X1.\n#1=#5061\n#2=#5041", k31) == "W 5:4 position-read-early");
  // Nothing says that G31 or a dwell waits on a Haas; G103 P1 ends the reading ahead, G103 begins it again.
  const std::string haas = "haas-ngc";
  CHECK(program("G31 X5. F100.\n#1=#5061", haas) == "W 3:4 position-read-early");
  CHECK(program("G31 X5. F100.\nG4 P0\n#1=#5061", haas) == "W 4:4 position-read-early");
  CHECK(program("G31 X5. F100.\nG53\nG1 X1.\n#1=#5061", haas) == "");
  CHECK(program("G31 X5. F100.\nG103 P1\n#1=#5061", haas) == "");
  CHECK(program("G103 P1\nG31 X5. F100.\n#1=#5061\nG103\nG31 X5.\n#2=#5061", haas) ==
        "W 7:4 position-read-early");
  CHECK(program("G103\nG31 X5. F100.\n#1=#5061", haas) == "W 4:4 position-read-early");
}

TEST_CASE("macrob check: feeds, canned cycles and arcs that no value mends") {
  const auto main = [](const std::string& text, const std::string& control = "") {
    return told("O1\nG17 G90\n" + text + "\nM30\n", control);
  };
  // A feed on one of the paths may be the one that is used.
  CHECK(main("G1 X5.") == "W 3:1 feed-missing");
  CHECK(main("IF[#500EQ1]GOTO5\nF100.\nN5 G1 X5.") == "");
  CHECK(main("G65 P9100\nG1 X5.") == "");
  CHECK(main("M98 P100\nG1 X5.") == "");
  CHECK(main("G66 P9100\nX1.\nG1 X5.\nG67\nG1 X6.") == "");
  CHECK(main("G1 F100.\nX5.") == "");
  CHECK(main("M77\nG1 X5.") == ""); // may be a macro of the builder
  CHECK(main("G0 X5.\nG28 X0") == "");
  CHECK(main("G2 X5. R10.") == "W 3:1 feed-missing");
  CHECK(program("G1 X5.") == "");
  // Modes of a caller are not known, those that the program sets are.
  CHECK(program("G81 X5. F9.") == "");
  CHECK(program("G80\nG81 X5. Z-4. F9.") == "W 3:1 cycle-words");
  CHECK(program("G17 G80\nG81 R1. Z-4. X5. F9.\nX9.\nG80\nX1.\nG81 X5. R1.") == "W 7:1 cycle-words");
  CHECK(main("F9.\nG99 G81 R1. Z-2. K0\nX5.\nG0\nG99 G87 R1. Z-2.") == "W 7:5 cycle-words");
  CHECK(main("F9.\nG99 G81 Z-2. X1.\nX2.\nG80") == "W 4:5 cycle-words"); // the next hole lacks the same
  CHECK(main("F9.\nG73 R1. Z-2. Q1.\nG83 X9.\nG80") == "");
  CHECK(main("F9.\nG18\nG81 R1. Z-2. X3.\nG80") == "W 5:1 cycle-words");
  CHECK(main("F9.\nG18\nG81 R1. Y-2. X3.\nG80") == "");
  CHECK(main("F9.\nG0 G81 R1. Z-2. X3.\nG80") == "W 4:4 codes-exclude");
  CHECK(main("F9.\nG81 R1. Z-2.\nG80 G28 Z5.") == "");
  CHECK(main("F9.\nG81 R1. Z-2.\nG28 Z5.\nG80") == "W 5:1 mode-forbids-code");
  CHECK(main("F9.\nG81 R1. Z-2.\nG17 X5.\nG80") == ""); // the same plane
  CHECK(main("G68 X0 Y0 R9.\nG54\nG69") == "");
  CHECK(main("G68 X0 Y0 R9.\nG57\nG69") == "W 4:1 mode-forbids-code");
  CHECK(main("/G68 X0 Y0 R9.\nG57\nG69") == ""); // the operator decides
  CHECK(main("F9.\nG1 X0. Y0.\nG2 X4. I2.1") == "W 5:1 arc-geometry");
  CHECK(main("F9.\nG1 X0. Y0.\nG55\nG2 X4. I2.1") == "");
  CHECK(main("F9.\nG1 X0. Y0.\nG91 G2 X4. I2.\nG90 G3 X0. R1.5") == "W 6:5 arc-geometry");
  CHECK(main("F9.\nG1 X0. Y0.\nG2 X4 I2.1") == ""); // 4 or 0.004
  CHECK(main("F9.\nG1 X0. Y0.\nG2 X4 I2.1", k31) == "W 5:1 arc-geometry");
  CHECK(main("F9.\nG1 X#1 Y0.\nG2 X4. I2.1") == "");
  CHECK(main("F9.\nG1 X1. Y0.\nG2 X1. Y0 R5.") == "W 5:11 arc-geometry");
  CHECK(main("F9.\nG18 G2 X1. Z5. J2.") == "W 4:16 arc-geometry");
}

TEST_CASE("macrob check: arcs that another code or an earlier block makes of a move") {
  CHECK(program("G2 G27 X10. Y5. R20. F9.") == "W 2:4 codes-exclude");
  CHECK(program("G17 G3 X10. G28 R20. F9.") == "W 2:13 codes-exclude");
  CHECK(program("G2 G17 X10. Y5. R20. F9.") == "");
  CHECK(program("G0 G28 Z0.\nG27 X0.") == "");
  MacroFile plane("O1\nG2 G27 X10. Y5. R20. F9.\nG17 G2 G28 X1. R2.\nM99\n");
  plane.check();
  REQUIRE(plane.diagnostics.all().size() == 2);
  CHECK(plane.diagnostics.all()[0].message.find("write `G17` if the plane is meant") != std::string::npos);
  CHECK(plane.diagnostics.all()[1].message.find("G18") == std::string::npos);
  // A straight move after an arc, whose G1 was forgotten: once for each arc.
  CHECK(program("G3 G19 Y5. Z5. R5. F9.\nX20.\nX30.") == "W 3:1 arc-without-centre");
  CHECK(program("G3 G19 Y5. Z5. R5. F9.\nX20.\nG3 Y6. Z6. R5.\nX30.") ==
        "W 3:1 arc-without-centre; W 5:1 arc-without-centre");
  CHECK(program("G3 G19 Y5. Z5. R5. F9.\nG1 X20.") == "");
  CHECK(program("G3 G19 Y5. Z5. R5. F9.\nY6. Z6. R5.\nY7. J1. K0.") == "");
  CHECK(program("G3 G19 Y5. Z5. R5. F9.\nF5.\nM9\nG28 X0") == "");
  CHECK(program("G3 G19 Y5. Z5. R5. F9.\nM98 P5\nX20.") == "");    // which mode it leaves is not known
  CHECK(program("IF[#1EQ1]GOTO5\nG3 Y5. R5. F9.\nN5 X20.") == ""); // nor is it here
  CHECK(program("G2 X5. R5. F9.\nG66 P9\nX20.\nG67") == "");       // calls after moves
  // Of a block with an error that has one repair the codes are known.
  CHECK(told("O1\nGO G17 G3 X5. Y5. R5. F9.\nX9.\nM99\n").find("W 3:1 arc-without-centre") !=
        std::string::npos);
}

TEST_CASE("macrob check: G91 between axis words, and a tool length in another plane") {
  CHECK(program("G90 G1 X#24 G91 Z2. F9.") == "W 2:13 codes-exclude");
  CHECK(program("G90 G1\nX#24 G91 Z2. F9.") == "W 3:6 mode-after-axis");
  CHECK(program("X#24 G91 Z2. F9.") == "W 2:6 mode-after-axis");
  CHECK(program("G91\nX#24 G91 Z2. F9.") == "");
  CHECK(program("G90 G1\nG91 X#24 Z2. F9.") == "");
  CHECK(program("G90 G1\nX#24 Z2. G91 F9.") == "");
  CHECK(program("G28 X0 G91 Z0") == "");
  CHECK(program("G19\nG0 G43 Z50. H1") == "W 3:4 mode-forbids-code");
  CHECK(program("G0 G18 G44 Z50. H1") == "W 2:8 mode-forbids-code");
  CHECK(program("G19\nG0 G17 G43 Z50. H1") == "");
  CHECK(program("G19\nG0 G43 X50. H1") == ""); // along the axis of the plane
  CHECK(program("G0 G43 Z50. H1") == "");
}

TEST_CASE("macrob check: data, dwells, signals and sums that no value mends") {
  CHECK(program("G10 L2 P1 X1.\nG10 L20 P#1 X1.\nG10 L11 P3 R#2\nG10 L3") == "");
  CHECK(program("G10 P1 X1.") == "W 2:1 data-input-words");
  CHECK(program("G10 P1 R1.", k6m) == ""); // one memory of tool offsets
  CHECK(program("G10 L#1 X1.") == "");
  CHECK(program("G10 L99 P1 X1.") == "W 2:5 data-input-words");
  CHECK(program("G10 L10 R1.") == "W 2:1 data-input-words");
  CHECK(program("G10 L10 P0 R1.") == "E 2:9 word-out-of-range");
  CHECK(program("G4 X#1\nG4 P100\nG4") == "");
  CHECK(program("G4 X-1.") == "W 2:4 dwell-words");
  CHECK(program("G4 U1. P10") == "W 2:8 dwell-words");
  CHECK(program("#1105=0\n#1105=#1", k0i) == "");
  CHECK(program("#1105=0-1", k0i) == "W 2:1 signal-value");
  CHECK(program("#1=LN[0]") == "W 2:4 calculation-stops");
  CHECK(program("#1=5/[2-2]") == "W 2:4 calculation-stops");
  CHECK(program("#1=5/#2") == "");
  CHECK(program("#1=TAN[270]") == "W 2:4 calculation-stops");
  CHECK(program("GOTO -3\nN3").substr(0, 26) == "E 2:6 goto-target-missing;");
  CHECK(program("IF[#1EQ1]GOTO5\nM98 P1\nN5") == "");
  CHECK(program("/M98 P1") == "");
  CHECK(program("M98 P1") == "W 2:5 calls-itself");
  CHECK(program("IF[#1EQ1]GOTO5\nM98 P1\nN5 M98 P1") == "W 4:8 calls-itself");
}

TEST_CASE("macrob check: a format is proposed with the variable that is printed") {
  MacroFile file("O1\nPOPEN\nDPRNT[X#1[2]]\nBPRNT[X#101[22]]\nPCLOS\nM99\n");
  file.check();
  REQUIRE(file.diagnostics.all().size() == 2);
  CHECK(file.diagnostics.all()[0].message.find("write `#1[53]`") != std::string::npos);
  CHECK(file.diagnostics.all()[1].message.find("write `#101[3]`") != std::string::npos);
}

TEST_CASE("macrob check: offsets while coordinates are turned are those in force, in the plane") {
  const auto turned = [](const std::string& block) {
    return program("G17 G90 G54 G0 X0 Y0\nG68 X0 Y0 R5.\n" + block + "\nG69", k0i);
  };
  CHECK(turned("G10 L2 P0 Y1.") == "W 4:1 mode-forbids-code");
  CHECK(turned("G10 L2 P1 Z1.") == "");
  CHECK(turned("#5222=1.") == "W 4:1 mode-forbids-code");
  CHECK(turned("#5201=1.") == "W 4:1 mode-forbids-code");
  CHECK(turned("#5241=1.") == "");
  CHECK(turned("IF[#1EQ1]GOTO5\nG69\nN5 #5221=1.") == ""); // one path has ended it
}
