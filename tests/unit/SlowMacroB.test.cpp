// The slow evaluator against the rows of the reference's tables, each by hand.
#include "tests/unit/SlowMacroB.h"

#include <cmath>
#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace dotek::tests;

namespace {

// Ending and alarm: "30" is an alarm, "end" M30, "text" the end of the text.
std::string ending(const std::string& text, const MacroSetup& setup = {}) {
  const MacroOutcome outcome = runSlowly(text, setup);
  switch (outcome.ending) {
  case SlowStop::Kind::ProgramEnd: return "end";
  case SlowStop::Kind::TextEnd: return "text";
  case SlowStop::Kind::Alarm: return std::to_string(outcome.alarm);
  case SlowStop::Kind::Budget: return "budget";
  case SlowStop::Kind::Unsupported: return "open: " + outcome.reason;
  }
  return "";
}

// What #100 holds after the blocks: digits, "null", or how the run ended.
std::string result(const std::string& blocks, const MacroSetup& setup = {}) {
  const std::string text = "O1\n" + blocks + "\nM30\n";
  if (const std::string end = ending(text, setup); end != "end") return end;
  const MacroOutcome outcome = runSlowly(text, setup);
  const auto found = outcome.common.find(100);
  return found == outcome.common.end() ? "null"
                                       : fmt::format("{}", std::round(found->second * 1e9) / 1e9 + 0.0);
}

std::string truth(const std::string& condition) {
  return result("#2=0\n#100=0\nIF[" + condition + "]THEN#100=1");
}

std::string path(const MacroOutcome& outcome) {
  std::string out;
  for (const MacroPosition& at : outcome.positions)
    out += fmt::format("{}{:g} {:g} {:g}", out.empty() ? "" : "; ", at[0], at[1], at[2]);
  return out;
}
std::string path(const std::string& text, const MacroSetup& setup = {}) {
  return path(runSlowly("O1\n" + text, setup));
}

MacroSetup digits8() {
  MacroSetup setup;
  setup.control = "fanuc-0i-md";
  setup.decimal8 = true;
  return setup;
}

} // namespace

TEST_CASE("slow macro b: null, table of 1.3") {
  CHECK(path("G0\nG90 X1.\nX#1 Y2.\nX0 Y3.") == "1 0 0; 1 2 0; 0 3 0"); // the word is left out
  CHECK(path("G0X1.Y1.\nX[#1]Y3.\nX2.\nX-[#1]") == "1 1 0; 0 3 0; 2 3 0; 0 3 0");
  CHECK(ending("O1\nG0X-#1\n").starts_with("open"));
  CHECK(result("#100=5\n#100=#1") == "null");
  CHECK(result("#100=#1*5") == "0");
  CHECK(result("#100=#1+#1") == "0");
  CHECK(result("#100=#1+1") == "1");
  CHECK(result("#100=1+#1") == "1");
  const std::pair<const char*, const char*> kRows[] = {
      {"#1EQ#0", "1"}, {"#1NE#0", "0"}, {"#1EQ0", "0"},  {"#1NE0", "1"},  {"#1GE#0", "1"}, {"#1LE#0", "1"},
      {"#1GE0", "1"},  {"#1LE0", "1"},  {"#1GT#0", "0"}, {"#1LT#0", "0"}, {"#1GT0", "0"},  {"#1LT0", "0"},
      {"#2EQ#0", "0"}, {"#2NE#0", "1"}, {"#2EQ0", "1"},  {"#2NE0", "0"},  {"#2GE#0", "1"}, {"#2LT#0", "0"},
  };
  for (const auto& [condition, expected] : kRows)
    CHECK_MESSAGE(truth(condition) == expected, condition);
  CHECK(result("#100=-#1") == "0");
  CHECK(result("#100=[#1]") == "0");
  CHECK(result("#100=SIN[#1]") == "0");
  CHECK(result("#100=ABS[#1]OR4") == "4");
  CHECK(result("#100=5/#1") == "112");
  CHECK(result("#5=7\n#100=3\n#100=#[#1]") == "null"); // #[null] is #0
  CHECK(result("#4=8\n#100=#[3.5]") == "8");           // rounded
  CHECK(result("#100=#[40]") == "115");
  CHECK(result("#100=#[-1]") == "115");
  CHECK(result("#300=1") == "115");
}

TEST_CASE("slow macro b: precedence and numbers, 1.4 and 1.6") {
  CHECK(result("#100=2+12AND10") == "10"); // 2 + (12 AND 10)
  CHECK(result("#100=1OR2*4") == "9");
  CHECK(result("#100=10-4-3") == "3");
  CHECK(result("#100=12/3*2") == "8");
  CHECK(result("#100=7MOD4*2") == "6");
  CHECK(result("#100=2*SIN[30]+1") == "2");
  CHECK(result("#100=3.5AND1.5") == "0"); // 4 AND 2
  CHECK(result("#100=-1AND255") == "255");
  CHECK(result("#100=6XOR3") == "5");
  CHECK(result("#100=5000000000AND1") == "110");
  CHECK(result("#100=[[[[[1]]]]]") == "1");
  CHECK(result("#100=[[[[[[1]]]]]]") == "118");
  CHECK(result("#100=SIN[[[[[[0]]]]]]") == "118");
  CHECK(truth("[1EQ1]AND[2EQ3]") == "0");
  CHECK(truth("[1EQ1]OR[2EQ3]") == "1");
  CHECK(truth("[1EQ1]XOR[2EQ2]") == "0");
  CHECK(truth("[1EQ2]AND[1/0EQ1]") == "112"); // both sides are computed
  // Values of 8 digits and of doubles.
  CHECK(result("#100=1/3", digits8()) == "0.33333333");
  CHECK(result("#100=12345678+.5", digits8()) == "12345679");
  CHECK(result("#100=1/3*3", digits8()) == "0.99999999");
  CHECK(result("#1=10000000\n#2=#1*#1*#1*#1*#1*#1\n#100=#2*#1", digits8()) == "111");
  CHECK(result("#1=.00000001\n#2=#1*#1*#1\n#100=#2*#1", digits8()) == "111");
  CHECK(result("#1=.00000001\n#2=#1*#1*#1\n#100=#2*#1") == "0"); // 1e-32
  CHECK(result("#100=EXP[1000]") == "111");
  CHECK(path("G0\n#1=12.3456\nX#1") == "12.346 0 0"); // least increment
  CHECK(path("G0\nX[1.0005]Y-1.0005") == "1.001 -1.001 0");
  CHECK(ending("O1\nM[29.5]\n") == "end");
}

TEST_CASE("slow macro b: functions, 1.5") {
  const std::pair<const char*, const char*> kRows[] = {
      {"SIN[90.5-.5]", "1"},     {"COS[60]", "0.5"},       {"TAN[45]", "1"},
      {"SIN[180]", "0"},         {"COS[-270]", "0"},       {"TAN[90]", "112"},
      {"ASIN[-1]", "-90"},       {"ASIN[1.1]", "119"},     {"ACOS[-1]", "180"},
      {"ACOS[-1.1]", "119"},     {"ATAN[-1]/[-1]", "225"}, {"[ATAN[1]]/[2]", "22.5"},
      {"ATAN[-1]/[1]", "315"},   {"ATAN[1,-1]", "135"},    {"ATAN[-1]", "-45"},
      {"SQRT[16]", "4"},         {"SQRT[-1]", "119"},      {"ABS[-3]", "3"},
      {"ROUND[2.5]", "3"},       {"ROUND[-2.5]", "-3"},    {"ROUND[2.4]", "2"},
      {"FIX[-1.2]", "-1"},       {"FIX[1.9]", "1"},        {"FUP[-1.2]", "-2"},
      {"FUP[1.2]", "2"},         {"FUP[3]", "3"},          {"LN[1]", "0"},
      {"LN[0]", "119"},          {"EXP[0]", "1"},          {"BIN[18]", "12"},
      {"BIN[10]", "119"},        {"BCD[12]", "18"},        {"BCD[-1]", "119"},
      {"POW[2,10]", "1024"},     {"7MOD3", "1"},           {"0-7MOD3", "-1"},
      {"[0-7]MOD3", "-1"},       {"7MOD[0-3]", "1"},       {"7.5MOD2.6", "2"},
      {"7MOD.4", "112"},         {"1/0", "112"},           {"BCD[99999999]", "2576980377"},
      {"BCD[100000000]", "119"},
  };
  for (const auto& [expression, expected] : kRows)
    CHECK_MESSAGE(result(std::string("#100=") + expression) == expected, expression);
  CHECK(path("G0\nX[ROUND[1.23456]]") == "1.235 0 0"); // in a word: to its increment
}

TEST_CASE("slow macro b: jumps and loops, 1.7") {
  CHECK(result("#100=1\nGOTO 01\n#100=2\nN1") == "1");
  CHECK(result("GOTO[2+3]\n#100=1\nN5") == "null");
  CHECK(result("#1=5\nGOTO#1\n#100=1\nN5") == "null");
  CHECK(result("GOTO 7") == "128");
  CHECK(result("GOTO#1") == "128");
  CHECK(result("GOTO[9000+1000]\nN10000") == "128");
  // The first one met forward from here, then from the top.
  CHECK(result("GOTO2\nN1#100=1\nGOTO3\nN2\nGOTO1\nN1#100=2\nN3") == "2");
  CHECK(result("GOTO2\nN1#100=1\nGOTO3\nN1#100=3\nGOTO3\nN2\nGOTO1\nN3") == "1");
  CHECK(result("IF[1EQ1]GOTO1\n#100=1\nN1") == "null");
  CHECK(result("IF[1EQ2]GOTO1\n#100=1\nN1") == "1");
  CHECK(result("IF[1EQ1]THENGOTO1\n#100=1\nN1") == "null");
  CHECK(result("#100=0\nWHILE[#100LT5]DO2\n#100=#100+1\nEND2") == "5");
  CHECK(result("#100=7\nWHILE[#100LT5]DO1\n#100=#100+1\nEND1") == "7"); // tested before each pass
  CHECK(result("#100=0\nDO3\n#100=#100+1\nIF[#100EQ9]GOTO4\nEND3\nN4") == "9");
  CHECK(result("#100=0\n#1=0\nWHILE[#1LT3]DO1\n#1=#1+1\n#2=0\nWHILE[#2LT4]DO2\n#2=#2+1\n#100=#100+"
               "1\nEND2\nEND1") == "12");
  CHECK(result("DO4\nEND4") == "126");
  CHECK(result("DO1\nDO1\nEND1\nEND1") == "126");
  CHECK(result("END1") == "126");
  CHECK(result("DO1\n#1=2") == "124");
  CHECK(result("GOTO1\nWHILE[1EQ2]DO1\nN1\nEND1").starts_with("open"));
  CHECK(ending("O1\nDO1\nEND1\nM30\n") == "budget");
  MacroSetup setup;
  setup.switches = {2};
  CHECK(result("#100=1\n/2#100=2\n/#100=#100+4", setup) == "5");
  CHECK(result("#100=1\nGOTO5\n#100=9\n/2N5#100=2", setup) == "1"); // still a target
}

TEST_CASE("slow macro b: calls, 1.8") {
  const auto called = [](const std::string& block, const std::string& macro) {
    return result(block + "\nM30\nO9\n" + macro + "\nM99\nO1000");
  };
  CHECK(called("#1=3\nG65P9A2.\n#100=#100+#1", "#100=#1\n#1=50") == "5"); // locals are a set of its own
  CHECK(called("#1=3\nM98P9\n#100=#1", "#1=50") == "50");                 // shared
  CHECK(called("#100=1\nG65P9L3", "#100=#100*2") == "8");
  CHECK(called("#100=1\nM98P9L4", "#100=#100*2") == "16");
  CHECK(called("G65P9A1.0B2.0I-3.0I4.0D5.0", "#100=#1*1000+#2*100+#4*10+#7") ==
        "1175"); // M16i: the later word
  CHECK(called("G65P9I1.J2.K3.I4.J5.K6.", "#100=#4+#5*10+#6*100+#7*1000+#8*10000+#9*100000") == "654321");
  CHECK(called("G65P9X7.Y8.Z9.", "#100=#24*100+#25*10+#26") == "789");
  CHECK(called("G65P9A#5B1.", "#100=5\n#100=#1") == "null");
  CHECK(called("G65P9A[#5]", "#100=#1") == "0");
  CHECK(called("G65P9\nGOTO7\nN6#100=2\nN7", "M99P6") == "2");
  CHECK(called("G65P9", "M99P6") == "128");
  CHECK(called("#1=9\nG65P#1A4.", "#100=#1") == "4");
  CHECK(called("G65P9", "G65P9") == "122");
  CHECK(called("#100=0\nM98P9", "#100=#100+1\nM98P9") == "77");
  CHECK(called("G65A1.", "") == "76");
  CHECK(called("M98", "") == "76");
  CHECK(called("G65P8", "") == "78");
  CHECK(called("G65P9G1.", "") == "129");
  CHECK(called("G65P9", "DO1\nM99\nEND1") == "null");
  MacroSetup increments;
  increments.calculator = false;
  CHECK(path("G0X10Y10.\nZ[10]", increments) == "0.01 10 0; 0.01 10 10");
  CHECK(result("G65P9X10M10Y10.\nM30\nO9\n#100=#24+#13+#25\nM99\nO7", increments) == "20.01");
  // M99 in the main program starts it again.
  CHECK(result("#100=#100+1\nIF[#100EQ4]GOTO1\nM99\nN1") == "4");
  CHECK(result("#100=#100+1\n#1=1\nIF[#100EQ4]GOTO1\nM99\nN1").starts_with("open"));
}

TEST_CASE("slow macro b: G66, 1.8") {
  // Not by its own block, after each later move, until G67.
  CHECK(path("G0\nX9.\nG66P9A5.\nX1.\n#1=2\nM8\nX2.\nG67\nX3.\nM30\nO9\n#100=#100+1\nY[#1*#100]\nM99") ==
        "9 0 0; 1 0 0; 1 5 0; 2 5 0; 2 10 0; 3 10 0");
  // The manual's order: inside the macro of the second G66 only the first acts.
  CHECK(path("G0\nG66P91\nZ1.\nG66P92\nZ2.\nG67\nG67\nZ9.\nM30\nO91\nX[#100+1.]\n#100=#100+1\nM99\n"
             "O92\nZ6.\nZ7.\nM99") == "0 0 1; 1 0 1; 1 0 2; 1 0 6; 2 0 6; 2 0 7; 3 0 7; 3 0 9");
}

TEST_CASE("slow macro b: output, 1.9") {
  const auto printed = [](const std::string& value, const std::string& what) {
    return runSlowly("O1\nPOPEN\n" + value + "\nDPRNT[" + what + "]\nPCLOS\nM30\n").output;
  };
  CHECK(printed("#100=12.5", "G801*X#100[53]") == "G801 X   12.500\n");
  CHECK(printed("#100=-1.25", "#100[31]") == "  -1.3\n");
  CHECK(printed("#100=12345.6", "#100[20]") == "12346\n");
  CHECK(printed("", "A#100[20]") == "A 0\n"); // null is 0
  CHECK(printed("#100=.0004", "#100[13]-#100[14]") == "0.000-0.0004\n");
  CHECK(printed("#100=-.0004", "#100[13]") == "0.000\n");
  CHECK(printed("#100=9.9996", "#100[13]") == "10.000\n");
  CHECK(printed("#100=1000", "#100[11]") == "1000.0\n");
  CHECK(printed("#100=.05", "#100[13]") == "0.050\n");
}

TEST_CASE("slow macro b: system variables and alarms, 1.10 and 1.11") {
  CHECK(result("G0X1.\nG91Y2.Y#0\nZ3.\n#100=#5001*100+#5042*10+#5003") == "123");
  CHECK(result("G1F1.\n#100=#4001*100+#4003") == "190");
  CHECK(result("#3000=12(STOP)") == "3012");
  CHECK(result("IF[1EQ1]THEN#3000=7(STOP)") == "3007");
  CHECK(result("#3006=1(LOOK)\n#100=1") == "1");
  CHECK(result("#0=1") == "116");
  CHECK(result("#[#1]=1") == "116");
  CHECK(result("#4001=1") == "116");
  CHECK(result("#5041=1") == "116");
  CHECK(result("#100=#9999").starts_with("open"));
  const MacroOutcome stopped = runSlowly("O1\n#1=2\n#100=3\nN40 #2=1/0\nM30\n");
  CHECK(stopped.line == 4);
  CHECK(stopped.sequence == 40);
  CHECK(stopped.locals == std::map<int, double>{{1, 2}});
  CHECK(stopped.common == std::map<int, double>{{100, 3}});
  CHECK(ending("O1\n#1=2\n") == "text");
  CHECK(ending("O1\n#1=[2\n").starts_with("open"));
}
