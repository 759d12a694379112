// Macro programs that run: jumps, loops, calls (reference 1.7, 1.8).
#include "RunHarness.h"

using namespace dotek;
using tests::controlOf;
using tests::MacroRun;
using tests::value;

TEST_CASE("run, reference 1.7: GOTO searches forward, then from the top") {
  CHECK(value("GOTO5\n#2=1\nN5\n") == "");
  CHECK(value("#1=5\nGOTO#1\n#2=1\nN5#2=7\n") == "7");
  CHECK(value("#1=4\nGOTO[#1+0.6]\n#2=1\nN5#2=7\n") == "7"); // rounded
  CHECK(value("N5#2=#2+1\nIF[#2GE3]GOTO6\n#1=5\nGOTO#1\nN6\n") == "3");
  // Of two blocks with the number the one that the search meets first.
  CHECK(value("#3=#3+1\nN5#2=#2+1\nIF[#2GT20]GOTO9\nGOTO6\nN6#1=5\nGOTO#1\nN5#2=#2+10\nN9\n") == "11");
  CHECK(value("#1=7\nGOTO#1\n") == "alarm 128");
  CHECK(value("GOTO7\n") == "alarm 128");
  CHECK(value("#1=0\nGOTO#1\nN0#2=1\n") == "alarm 128");
  CHECK(value("GOTO10000\nN10000\n", "fanuc-0i-md") == "alarm 128"); // beyond what the control searches
  CHECK(value("#1=10000\nGOTO#1\nN10000\n", "fanuc-0i-md") == "alarm 128");
  CHECK(value("GOTO12345\n#2=1\nN12345\n") == "");
  CHECK(value("#1=99999\nGOTO#1\n#2=1\nN99999\n") == "");
  // Of more digits nobody is certain; a block that is not there is none anyway.
  CHECK(value("GOTO100000\nN100000\n").starts_with("inconclusive: whether the control searches"));
  CHECK(value("GOTO100000\n") == "alarm 128");
  CHECK(value("GOTO01\n#2=1\nN1\n") == "");
}

TEST_CASE("run, reference 1.7: IF") {
  CHECK(value("IF[1EQ1]THEN#2=5\n") == "5");
  CHECK(value("#2=1\nIF[1EQ2]THEN#2=5\n") == "1");
  CHECK(value("#10=2\nIF[#10EQ2]THENGOTO100\n#2=1\nN100\n") == "");
}

TEST_CASE("run, reference 1.7: WHILE tests before each pass, DO loops for ever, END goes back") {
  CHECK(value("#1=1\nWHILE[#1LE10]DO1\n#2=#2+#1\n#1=#1+1\nEND1\n") == "55");
  CHECK(value("#1=20\nWHILE[#1LE10]DO1\n#2=#2+#1\nEND1\n") == "");
  CHECK(value("#1=1\nWHILE[#1LE3]DO1\n#3=1\nWHILE[#3LE3]DO2\n#2=#2+1\n#3=#3+1\nEND2\n#1=#1+1\nEND1\n") ==
        "9");
  CHECK(value("DO1\n#2=#2+1\nIF[#2EQ7]GOTO5\nEND1\nN5\n") == "7"); // out of a loop
  CHECK(value("#1=1\nWHILE[[#1LT3]AND[#1NE#0]]DO1\n#2=#2+1\n#1=#1+1\nEND1\n") == "2");
  // The block of WHILE lies outside: the loop begins anew.
  CHECK(value("N5WHILE[#1LT3]DO1\n#1=#1+1\n#2=#2+1\nIF[#1EQ2]GOTO5\nEND1\n") == "3");
}

TEST_CASE("run, reference 1.7: a jump into a loop is not guessed") {
  const std::string loop = "WHILE[#1LT3]DO1\nN5#1=#1+1\nEND1\n";
  CHECK(value("GOTO5\n" + loop).starts_with("inconclusive: a jump into a loop"));
  CHECK(value("#3=5\nGOTO#3\n" + loop).starts_with("inconclusive: a jump into a loop"));
  CHECK(value("IF[1EQ1]GOTO5\n" + loop).starts_with("inconclusive: a jump into a loop"));
  CHECK(value("#2=4\nIF[1EQ2]GOTO5\n" + loop) == "4");                                  // not taken
  CHECK(value("WHILE[#1LT3]DO1\n#1=#1+1\nIF[#1EQ1]GOTO5\n#2=#2+1\nN5\nEND1\n") == "2"); // within
  CHECK(value("DO1\nDO2\nGOTO5\nEND2\nN5#2=1\nGOTO6\nEND1\nN6\n") == "1"); // out of the inner one
  CHECK(value("DO1\nGOTO5\nDO2\nN5#2=1\nEND2\nEND1\n").starts_with("inconclusive: a jump into a loop"));
}

TEST_CASE("run: a program that never ends meets the limit of steps") {
  Limits limits;
  limits.simSteps = 1000;
  const auto end = [&](const std::string& text) {
    return MacroRun(text, controlOf("fanuc-31i-b"), nullptr, nullptr, limits).end();
  };
  CHECK(end("N1GOTO1\n") ==
        "limit: the program took more than 1000 steps; `--limit sim-steps=N` allows more");
  CHECK(end("DO1\nEND1\n").starts_with("limit"));
  CHECK(end("O1\nG0X1.\nM99\n").starts_with("limit"));
  CHECK(end("#1=5\nN5GOTO#1\n").starts_with("limit"));
  CHECK(end("O1\n#1=#1+1\nIF[#1EQ5]GOTO9\nM99\nN9M30\n") ==
        "end"); // M99 of the main program: its first block
}

TEST_CASE("run, reference 1.8: G65 has locals of its own, M98 those of the caller") {
  const std::string called = "O9001\n#100=#1\n#101=#2\n#1=99\nM99\n";
  const MacroRun macro("O1\n#1=5\nG65P9001A#1B#3\n#2=#1\nM30\n" + called);
  CHECK(macro.end() == "end");
  CHECK(macro.at(100) == "5");
  CHECK(macro.at(101) == "null"); // a null argument leaves the local null
  CHECK(macro.at(1) == "5");
  const MacroRun subprogram("O1\n#1=5\nM98P9001\n#2=#1\nM30\n" + called);
  CHECK(subprogram.at(100) == "5");
  CHECK(subprogram.at(2) == "99");
  CHECK(MacroRun("O1\nG65P9001I1.I2.J3.K4.A9.\nM30\nO9001\n#100=#4\n#101=#7\n#102=#8\n#103=#9\nM99\n")
            .at(103) == "4");
}

TEST_CASE(
    "run, reference 1.8: arguments without a point count increments where the control does not calculate") {
  const std::string good = "O1\nG65P9001X10Y10.D3\nM30\nO9001\n#100=#24\n#101=#25\n#102=#7\nM99\n";
  stdlib::Control increment = controlOf("fanuc-31i-b");
  increment.decimal = stdlib::DecimalMode::Increment;
  const MacroRun run(good, increment);
  CHECK(run.at(100) == "0.01");
  CHECK(run.at(101) == "10");
  CHECK(run.at(102) == "3");
  CHECK(MacroRun(good).at(100) == "10");
}

TEST_CASE("run, reference 1.8: repeats, the old form of M98, P missing, no such program") {
  const std::string called = "O1002\n#100=#100+1\nM99\n";
  const auto count = [&](const std::string& blocks, const std::string& control = "fanuc-31i-b") {
    const MacroRun run("O1\n" + blocks + "M30\n" + called, controlOf(control));
    return run.end() == "end" ? run.at(100) : run.end();
  };
  CHECK(count("M98P1002\n") == "1");
  CHECK(count("M98P1002L3\n") == "3");
  CHECK(count("M98P51002\n") == "5");
  CHECK(count("M98P51002\n", "fanuc-6m").starts_with("inconclusive"));
  CHECK(count("G65P1002L4\n") == "4");
  CHECK(count("G65P1002L0\n").starts_with("inconclusive"));
  CHECK(count("M98P1003\n") == "alarm 78");
  CHECK(count("G65P#9\n") == "alarm 76");
  CHECK(count("M98P#9\n") == "alarm 76");
  // Each pass of a macro begins with the arguments of the call.
  CHECK(MacroRun("O1\nG65P2L2A5.\nM30\nO2\n#100=#100+#1\n#1=1\nM99\n").at(100) == "10");
}

TEST_CASE("run: M98 Q and M97 P call a block of their program") {
  const std::string rest = "M30\nN100#100=#100+#1\nM99\nO2\n#100=50\nN100#100=#100+7\nM99\n";
  const auto value = [&](const std::string& blocks, const std::string& control = "fanuc-31i-b") {
    const MacroRun run("O1\n#1=2\n#100=0\n" + blocks + rest, controlOf(control));
    return run.end() == "end" ? run.at(100) : run.end();
  };
  CHECK(value("M98Q100\n") == "2"); // the caller's locals
  CHECK(value("M98Q100L3\n") == "6");
  CHECK(value("M98P2Q100\n") == "7");
  CHECK(value("#2=100\nM98Q#2\nM98Q#2\n", "fanuc-0i-md") == "4");
  CHECK(value("M98Q200\n") == "alarm 128");
  CHECK(value("M97P100L2\n", "haas-ngc") == "4");
  CHECK(MacroRun("O1\nM97P5\n#100=#100+10\nM30\nN5#100=#100+1\nM97P6\nM99\nN6#100=#100*3\nM99\n",
                 controlOf("haas-ngc"))
            .at(100) == "13");
  CHECK(
      MacroRun("O1\nM98Q5\nM30\nWHILE[#1LT3]DO1\nN5#1=#1+1\nEND1\nM99\n").end().starts_with("inconclusive"));
}

TEST_CASE("run, reference 1.8: nesting: 122 for macros, 77 in all, a limit of Dotek where it is not known") {
  CHECK(MacroRun("O1\n#100=#100+1\nG65P1\n").end() == "alarm 122");
  CHECK(MacroRun("O1\n#100=#100+1\nG65P1\n").at(100) == "6"); // five levels below the main program
  CHECK(MacroRun("O1\n#100=#100+1\nG65P1\n", controlOf("fanuc-6m")).at(100) == "5");
  const MacroRun deep("O1\n#100=#100+1\nM98P1\n");
  CHECK(deep.end() == "alarm 77");
  CHECK(deep.at(100) == "16");
  CHECK(MacroRun("O1\nM98P1\n", controlOf("fanuc-6m")).end().starts_with("limit: calls nest deeper than 32"));
}

TEST_CASE("run, reference 1.8: M99 with P goes on at that block of the caller") {
  CHECK(MacroRun("O1\nM98P2\n#100=1\nM30\nN7#100=2\nM30\nO2\nM99P7\n").at(100) == "2");
  CHECK(MacroRun("O1\n#1=7\nM98P2\n#100=1\nM30\nN7#100=2\nM30\nO2\nM99P#1\n").at(100) == "2");
  CHECK(MacroRun("O1\nM98P2\nM30\nO2\nM99P7\n").end() == "alarm 128");
  CHECK(MacroRun("O1\nM98P2\n#100=3\nM30\nO2\nM99P#20\n").at(100) == "3"); // null: left out
  CHECK(MacroRun("O1\nM98P2L2\nN7M30\nO2\nM99P7\n").end().starts_with("inconclusive"));
  CHECK(MacroRun("O1\nM98P2\nDO1\nN7\nEND1\nM30\nO2\nM99P7\n")
            .end()
            .starts_with("inconclusive: a jump into a loop"));
  CHECK(MacroRun("O1\n#1=#1+1\nIF[#1GT1]GOTO9\nM99P5\n#100=1\nN5#100=2\nN9M30\n").at(100) ==
        "2"); // of the main one
  CHECK(
      MacroRun("O1\nM98P2\nM30\nO2\n#1=1\n").end().starts_with("inconclusive: the program ends without M99"));
  CHECK(MacroRun("O1\n#1=1\n").end() == "text end");
  CHECK(MacroRun("O1\nDO1\nM98P2\nGOTO9\nEND1\nN9M30\nO2\nDO1\nM99\nEND1\n").end() == "end"); // out of a loop
}

TEST_CASE(
    "run, reference 1.8: G66 calls after each block that moves an axis, within itself only those below") {
  const std::string two = "O9001\n#100=#100+1\n#110=#1\nG0Z1.\nM99\nO9002\n#101=#101+1\nG0Z2.\nM99\n";
  const auto run = [&](const std::string& blocks) {
    return MacroRun("O1\nG90G0\n" + blocks + "M30\n" + two);
  };
  const MacroRun one = run("G66P9001A3.X1.\nX5.\nM8\nG4X1.\n#1=5\nF100.\nY5.\nG67\nX9.\n");
  CHECK(one.end() == "end");
  CHECK(one.at(100) == "2"); // not for the G66 block, nor for blocks that move nothing
  CHECK(one.at(110) == "3");
  const MacroRun both = run("G66P9001\nX1.\nG66P9002\nX2.\nG67\nX3.\n");
  CHECK(both.at(101) == "1");
  CHECK(both.at(100) == "3"); // X1, the Z2 of O9002, X3
  CHECK(run("G66P9001L3\nX1.\n").at(100) == "3");
  CHECK(MacroRun("O1\nG66P2\nG0X1.\nM30\nO2\nG67\nM99\n").end().starts_with("inconclusive"));
  CHECK(run("G66P9001\nX1.\n#5=#4012\nG67\n#6=#4012\n").at(5) == "66");
  CHECK(run("G66P9001\nX1.\n#5=#4012\nG67\n#6=#4012\n").at(6) == "67");
}

TEST_CASE("run, reference 1.8: G66.1 takes each block as arguments") {
  const std::string called = "O9001\n#100=#100+1\n#101=#24\nM99\n";
  const auto run = [&](const std::string& blocks) {
    return MacroRun("O1\nG90G0\n" + blocks + "M30\n" + called);
  };
  const MacroRun each = run("G66.1P9001\nX5.\nX7.\nG67\nX1.\n");
  CHECK(each.end() == "end");
  CHECK(each.at(100) == "2");
  CHECK(each.at(101) == "7");
  CHECK(each.trace == "rapid X1.000000 Y0.000000 Z0.000000\nend\n");
  CHECK(run("G66.1P9001\nG1X5.\n").end().starts_with("inconclusive"));
}

TEST_CASE("run, reference 1.8: codes that call programs") {
  const std::string called = "O9101\n#100=#100+1\n#101=#1\n#102=#24\nG5101A9.\nM99\n";
  // Within the program the same code is an ordinary one, which the control does not have.
  const MacroRun ordinary("O1\n#6=4\nG5101A[#6]X1\nM30\n" + called);
  CHECK(ordinary.end().starts_with("inconclusive"));
  CHECK(ordinary.at(100) == "1");
  CHECK(ordinary.at(101) == "4");
  CHECK(ordinary.at(102) == "1");
  const std::string plain = "O9101\n#100=#100+#1\nM99\n";
  CHECK(MacroRun("O1\n#6=5101\nG#6A2.\nM30\n" + plain).at(100) == "2"); // computed
  CHECK(MacroRun("O1\nG5101A2.L3\nM30\n" + plain).at(100) == "6");
  CHECK(MacroRun("O1\nX1.G5101\nM30\n" + plain).end().starts_with("inconclusive"));
  CHECK(MacroRun("O1\nG5101\nM30\n").end() == "alarm 78");

  stdlib::Control control = controlOf("fanuc-31i-b");
  control.callCodes.push_back({'M', 50, 3, 9001, false, std::nullopt, "", ""});
  control.callCodes.push_back({'M', 60, 1, 9020, true, std::nullopt, "", ""});
  control.callCodes.push_back({'T', 0, 1, 9000, false, 149, "", ""});
  const std::string programs = "O9000\n#101=#149\nM99\nO9002\n#102=#1\nM99\nO9020\n#103=#24\nM99\n";
  const MacroRun all("O1\nG90\n#1=8\nG0X1.M51\nM60X2.5\nT7\n#5=6.6\nT#5\nM30\n" + programs, control);
  CHECK(all.end() == "end");
  CHECK(all.at(102) == "8"); // a subprogram: the caller's locals
  CHECK(all.at(103) == "2.5");
  CHECK(all.at(101) == "7");
  CHECK(all.trace == "rapid X1.000000 Y0.000000 Z0.000000\nend\n"); // the T itself is not carried out
  CHECK(MacroRun("O1\nT7M6\nM30\n" + programs, control).end().starts_with("inconclusive"));
  CHECK(MacroRun("O1\nT7M51\nM30\n" + programs, control).end() ==
        "inconclusive: two codes of one block call programs");
}

namespace {

// O9811 moves to X and keeps the argument; anything else it does not know.
class Meaning : public sim::MacroMeaning {
public:
  bool knows(std::uint32_t program) const override { return program == 9811 || program == 9810; }
  bool run(sim::Machine& machine, std::uint32_t program, std::span<const double> locals) override {
    if (program == 9810) return machine.inconclusive("no meaning");
    ++calls;
    level = machine.level();
    return machine.write(130, locals[24]) && machine.write(1, 77);
  }
  int calls = 0;
  std::uint32_t level = 0;
};

} // namespace

TEST_CASE("run: macros without text go by their meaning") {
  Meaning meaning;
  const MacroRun run("O1\n#1=5\nG65P9811X4.L2\nM30\n", controlOf("fanuc-31i-b"), nullptr, &meaning);
  CHECK(run.end() == "end");
  CHECK(meaning.calls == 2);
  CHECK(meaning.level == 1);
  CHECK(run.at(130) == "4");
  CHECK(run.at(1) == "5"); // the caller's
  CHECK(MacroRun("O1\nG65P9810\nM30\n", controlOf("fanuc-31i-b"), nullptr, &meaning).end() ==
        "inconclusive: no meaning");
  CHECK(MacroRun("O1\nG65P9812\nM30\n", controlOf("fanuc-31i-b"), nullptr, &meaning).end() == "alarm 78");
  Meaning other;
  CHECK(MacroRun("O1\nG65P9811\nM30\nO9811\n#100=1\nM99\n", controlOf("fanuc-31i-b"), nullptr, &other)
            .at(100) == "1");
  CHECK(other.calls == 0); // the text comes first
}

TEST_CASE("run: where an alarm comes from") {
  const MacroRun run("O1\nN10G65P2A0\nM30\nO2\nN20M98P3\nM99\nO3\nN30#5=1/#1\nM99\n");
  CHECK(run.end() == "alarm 112");
  CHECK(run.text() == "N30#5=1/#1");
  const auto& stack = run.machine->end().stack;
  REQUIRE(stack.size() == 3);
  CHECK(stack[0].program == 1);
  CHECK(stack[0].sequence == 10);
  CHECK(stack[0].line == 3);
  CHECK(stack[1].sequence == 20);
  CHECK(stack[2].program == 3);
  CHECK(stack[2].sequence == 30);
  CHECK(stack[2].line == 9);
  const auto calls = run.run->openCalls();
  REQUIRE(calls.size() == 2);
  CHECK(run.parsed.sources.textUtf8(calls[0]) == "N10G65P2A0");
  CHECK(MacroRun("G1X1.F100.Y#33Q5.\n").text() == "Q5.");
}

TEST_CASE("run: block delete, N numbers in #4114") {
  CHECK(value("N10\nN20#2=#4114\n") == "20");
  const std::string text = "/#2=1\nN5\n";
  CHECK(value(text) == "1");
}
