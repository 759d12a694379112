// Macro programs that run: values, functions, numbers (reference 1.3 to 1.6).
#include "RunHarness.h"
#include "sim/machine/Decimal8.h"

using namespace dotek;
using tests::MacroRun;
using tests::value;

namespace {

// 1 where the condition holds with #1 as set by `before`.
std::string holds(const std::string& before, const std::string& condition) {
  return value(before + "#2=0\nIF[" + condition + "]GOTO1\nGOTO2\nN1#2=1\nN2\n");
}

} // namespace

TEST_CASE("run, reference 1.3: null in each row of the table") {
  SUBCASE("X#1 in an NC block: word and address ignored") {
    CHECK(MacroRun("G90G0X5.Y5.\nX#1Y1.\n").trace.find("rapid X5.000000 Y1.000000") != std::string::npos);
    CHECK(MacroRun("G90G0X5.Y5.\n#1=0\nX#1Y1.\n").trace.find("rapid X0.000000 Y1.000000") !=
          std::string::npos);
  }
  SUBCASE("#2=#1: null is copied") {
    CHECK(value("#2=5\n#2=#1\n") == "null");
    CHECK(value("#1=0\n#2=#1\n") == "0");
    CHECK(value("#100=#1\n#2=#100\n") == "null");
    CHECK(value("#2=#0\n") == "null");
    CHECK(value("#2=5\n#2=#3100\n") == "null");
  }
  SUBCASE("#2=#1*5, #1+#1, #1+1, 1+#1") {
    CHECK(value("#2=#1*5\n") == "0");
    CHECK(value("#2=#1+#1\n") == "0");
    CHECK(value("#2=#1+1\n") == "1");
    CHECK(value("#2=1+#1\n") == "1");
  }
  SUBCASE("EQ and NE with #0 and with 0") {
    CHECK(holds("", "#1EQ#0") == "1");
    CHECK(holds("#1=0\n", "#1EQ#0") == "0");
    CHECK(holds("", "#1NE#0") == "0");
    CHECK(holds("#1=0\n", "#1NE#0") == "1");
    CHECK(holds("", "#1EQ0") == "0");
    CHECK(holds("#1=0\n", "#1EQ0") == "1");
    CHECK(holds("", "#1NE0") == "1");
    CHECK(holds("#1=0\n", "#1NE0") == "0");
  }
  SUBCASE("GE, LE, GT, LT: null counts as 0") {
    for (const std::string before : {"", "#1=0\n"}) {
      for (const std::string right : {"#0", "0"}) {
        CHECK(holds(before, "#1GE" + right) == "1");
        CHECK(holds(before, "#1LE" + right) == "1");
        CHECK(holds(before, "#1GT" + right) == "0");
        CHECK(holds(before, "#1LT" + right) == "0");
      }
    }
  }
  SUBCASE("functions, AND, unary minus: 0, and the result is a number") {
    CHECK(value("#2=COS[#1]\n") == "1");
    CHECK(value("#2=ABS[#1]\n") == "0");
    CHECK(value("#2=#1AND7\n") == "0");
    CHECK(value("#2=-#1\n") == "0");
    CHECK(value("#2=[#1]\n") == "0");
  }
  SUBCASE("division by null: alarm 112") {
    CHECK(value("#2=1/#1\n") == "alarm 112");
  }
  SUBCASE("X-#1 with a null #1: no source says") {
    CHECK(MacroRun("G0X-#1\n").end().starts_with("inconclusive"));
    CHECK(MacroRun("#1=2\nG0X-#1\n").trace.starts_with("rapid X-2.000000"));
  }
}

TEST_CASE("run, reference 1.3: subscripts are rounded, null is #0, out of range is alarm 115") {
  CHECK(value("#4=9\n#1=3.6\n#2=#[#1]\n") == "9");
  CHECK(value("#4=9\n#1=3.5\n#2=#[#1]\n") == "9");
  CHECK(value("#2=5\n#2=#[#1]\n") == "null");
  CHECK(value("#1=34\n#2=#[#1]\n") == "alarm 115");
  CHECK(value("#1=-1\n#2=#[#1]\n") == "alarm 115");
  CHECK(value("#1=1000000000000\n#2=#[#1]\n") == "alarm 115");
  CHECK(value("#1=34\n#[#1]=1\n") == "alarm 115");
  CHECK(value("#1=-1\n#[#1]=1\n") == "alarm 115");
  CHECK(value("#1=0\n#[#1]=1\n") == "alarm 116");
  CHECK(value("#[#1]=1\n") == "alarm 116");
  CHECK(value("#0=1\n") == "alarm 116");
  CHECK(value("#5041=1\n") == "alarm 116");
  CHECK(value("#1=100\n#[#1+1]=7\n#2=#101\n") == "7");
  CHECK(value("#3=7\n#1=2\n#[#1]=#[#1+1]\n") == "7");
}

TEST_CASE("run, reference 1.4: precedence and order") {
  CHECK(value("#2=2+12AND10\n") == "10");
  CHECK(value("#2=1OR2AND4\n") == "1");
  CHECK(value("#2=10-3-2\n") == "5");
  CHECK(value("#2=12/3*2\n") == "8");
  CHECK(value("#2=12/[3*2]\n") == "2");
  CHECK(value("#1=3\n#1=[#1+1]*#1\n#2=#1\n") == "12");
  CHECK(value("#2=7XOR2\n") == "5");
  CHECK(value("#2=5.5AND7\n") == "6"); // rounded first
  CHECK(value("#2=4294967296AND1\n") == "alarm 110");
  CHECK(holds("#1=1\n", "[#1EQ1]AND[#3EQ#0]") == "1");
  CHECK(holds("#1=1\n", "[#1EQ2]OR[#3NE#0]") == "0");
  CHECK(holds("#1=1\n", "[#1EQ1]XOR[#3EQ#0]") == "0");
}

TEST_CASE("run, reference 1.4: both sides of AND and OR are computed") {
  CHECK(holds("#1=1\n", "[#1EQ1]OR[[1/#5]EQ1]") == "alarm 112");
  CHECK(holds("#1=1\n", "[#1EQ2]AND[[1/#5]EQ1]") == "alarm 112");
}

TEST_CASE("run, reference 1.5: functions") {
  CHECK(value("#2=SIN[90]\n") == "1");
  CHECK(value("#2=COS[180]\n") == "-1");
  CHECK(value("#2=TAN[180]\n") == "0");
  CHECK(value("#2=TAN[90]\n") == "alarm 112");
  CHECK(value("#2=ASIN[1]\n") == "90");
  CHECK(value("#2=ASIN[1.1]\n") == "alarm 119");
  CHECK(value("#2=ACOS[-1]\n") == "180");
  CHECK(value("#2=ACOS[-1.1]\n") == "alarm 119");
  CHECK(value("#2=ATAN[1]/[-1]\n") == "135");
  CHECK(value("#2=ATAN[-1]/[-1]\n") == "225"); // 0 to 360
  CHECK(value("#2=ATAN[-1,1]\n") == "315");
  CHECK(value("#2=ATAN[-1]\n") == "-45");
  CHECK(value("#2=SQRT[16]\n") == "4");
  CHECK(value("#2=SQRT[-1]\n") == "alarm 119");
  CHECK(value("#2=ABS[-3]\n") == "3");
  CHECK(value("#2=ROUND[2.5]\n") == "3");
  CHECK(value("#2=ROUND[-2.5]\n") == "-3");
  CHECK(value("#2=FIX[-1.2]\n") == "-1");
  CHECK(value("#2=FUP[-1.2]\n") == "-2");
  CHECK(value("#2=LN[1]\n") == "0");
  CHECK(value("#2=LN[0]\n") == "alarm 119");
  CHECK(value("#2=EXP[0]\n") == "1");
  CHECK(value("#2=EXP[1000]\n") == "alarm 111");
  CHECK(value("#2=BIN[16]\n") == "10");
  CHECK(value("#2=BIN[10]\n") == "alarm 119");
  CHECK(value("#2=BCD[10]\n") == "16");
  CHECK(value("#2=BCD[-1]\n") == "alarm 119");
  CHECK(value("#2=POW[2,10]\n") == "1024");
  CHECK(value("#2=-7MOD3\n") == "-1");
  CHECK(value("#2=7MOD0\n") == "alarm 112");
  CHECK(value("#2=1/0\n") == "alarm 112");
  CHECK(value("#1=5\n#2=ADP[#1]\n").starts_with("inconclusive"));
}

TEST_CASE("run, reference 1.5: ROUND after an address goes to the least increment") {
  const auto at = [](const std::string& blocks) { return MacroRun("G90G0\n" + blocks).trace; };
  CHECK(at("#1=1.23456\nX[ROUND[#1]]\n").starts_with("rapid X1.235000"));
  CHECK(at("#1=1.23456\n#2=ROUND[#1]\nX#2\n").starts_with("rapid X1.000000"));
  CHECK(at("#1=1.2344\nX[ROUND[#1]+ROUND[#1]]\n").starts_with("rapid X2.468000"));
  CHECK(MacroRun("G94F[ROUND[1.5]]\n").end().starts_with("inconclusive"));
}

TEST_CASE("run, reference 1.6: range of doubles") {
  CHECK(value("#1=1\nWHILE[#3LT20]DO1\n#1=[#1+1]*10000000\n#3=#3+1\nEND1\n#2=#1*#1*#1\n") == "alarm 111");
  CHECK(value("#2=0*-5\n") == "0"); // no -0
}

TEST_CASE("run, reference 1.6: eight decimal digits where the control computes so") {
  const auto early = [](const std::string& blocks) { return value(blocks, "fanuc-0i-md"); };
  CHECK(early("#2=1/3\n") == "0.33333333");
  CHECK(early("#2=2/3\n") == "0.66666667");
  CHECK(early("#1=1/3\n#2=#1*3\n") == "0.99999999");
  CHECK(early("#2=12345678+0.5\n") == "12345679"); // half away from zero
  CHECK(early("#2=-12345678-0.5\n") == "-12345679");
  CHECK(early("#2=99999999+0.6\n") == "100000000");
  CHECK(early("#1=0.0001\n#1=#1*#1*#1*#1\n#2=#1*#1*#1\n") == "alarm 111"); // 1e-48
  CHECK(early("#1=10000000\n#1=#1*#1*#1\n#2=#1*#1*#1\n") == "alarm 111");  // 1e63
  CHECK(value("#1=10000000\n#1=#1*#1*#1\n#2=#1*#1*#1/#1/#1/#1\n") == "1");
  CHECK(early("#2=SIN[45]\n") == "0.70710678");
}

TEST_CASE("decimal8: the nearest number of eight digits, half away from zero") {
  CHECK(sim::toDecimal8(0) == 0);
  CHECK(sim::toDecimal8(123.456785) == 123.45679); // the text says 5, whatever the double is
  CHECK(sim::toDecimal8(-123.4567849) == -123.45678);
  CHECK(sim::toDecimal8(99999999.5) == 1e8);
  CHECK(sim::toDecimal8(0.99999999499) == 0.99999999);
  CHECK(sim::toDecimal8(0.999999995) == 1);
  CHECK(sim::toDecimal8(1.23456785e-20) == 1.2345679e-20);
  CHECK(sim::toDecimal8(1.23456784e30) == 1.2345678e30);
  CHECK(sim::toDecimal8(9.99999999e-14) == 1e-13);
  CHECK(sim::fitsDecimal8(1e-29));
  CHECK_FALSE(sim::fitsDecimal8(9e-30));
  CHECK(sim::fitsDecimal8(1e47));
  CHECK_FALSE(sim::fitsDecimal8(1.1e47));
}

TEST_CASE("decimal8: the result of a function that does not fit is alarm 111, no stale value") {
  for (const std::string function : {"SIN[#1]", "SQRT[#3]", "COS[#1]*#1*#1"})
    CHECK(MacroRun("#1=.0000001*.0000001*.0000001*.0000001\n#3=#1\n#2=5\n#2=" + function + "\n",
                   dotek::tests::controlOf("fanuc-0i-md"))
              .end() == (function.starts_with("SQRT") ? "end" : "alarm 111"));
}

TEST_CASE("run, reference 1.6: words of computed values") {
  const auto at = [](const std::string& blocks) { return MacroRun("G90G0\n" + blocks).trace; };
  CHECK(at("#1=12.3456\nX#1\n").starts_with("rapid X12.346000"));
  CHECK(at("#1=-0.0005\nX#1\n").starts_with("rapid X-0.001000"));
  CHECK(at("#1=3.5\nM#1\n").starts_with("spindle ccw"));
  CHECK(at("M[3.5]\n").starts_with("spindle ccw"));
  CHECK(at("#1=4.6\nT#1\n").starts_with("tool 5"));
  CHECK(at("#1=55\nG#1\n").starts_with("system 55"));
  CHECK(at("#1=54.1\nG#1P2\n").starts_with("system 54.1 P2"));
  stdlib::Control increment = tests::controlOf("fanuc-31i-b");
  increment.decimal = stdlib::DecimalMode::Increment;
  CHECK(MacroRun("G90G0X[10]Y10\n", increment).trace.starts_with("rapid X10.000000 Y0.010000"));
  CHECK(MacroRun("#1=54.6\nG#1\n").end().starts_with("inconclusive"));
  CHECK(MacroRun("#1=54.05\nG#1\n").end().starts_with("inconclusive"));
  CHECK(MacroRun("#1=77\nM#1\n").end().starts_with("inconclusive"));
  CHECK(MacroRun("#1=65\nG#1\n").end() == "inconclusive: a call or a return by a computed code");
  CHECK(MacroRun("G21G91\n#1=10\nG20G0X#1\n").trace == "rapid X254.000000 Y0.000000 Z0.000000\nend\n");
}
