// Macro programs that run: messages, printing, system variables, the window of the PMC (reference 1.2, 1.9 to
// 1.11).
#include "RunHarness.h"

using namespace dotek;
using tests::controlOf;
using tests::MacroRun;
using tests::value;

TEST_CASE("run, reference 1.10: #3000 and #3006") {
  const MacroRun alarm("#3000=5(TOOL LONG)\n");
  CHECK(alarm.end() == "alarm 3005");
  CHECK(alarm.machine->end().text == "TOOL LONG");
  CHECK(alarm.trace == "alarm 3005 TOOL LONG\n");
  CHECK(MacroRun("#1=199.6\n#3000=#1(A)\n").end() == "alarm 3200");
  CHECK(MacroRun("#3000=201(A)\n").end().starts_with("inconclusive"));
  CHECK(MacroRun("#3000=-1(A)\n").end().starts_with("inconclusive"));
  CHECK(MacroRun("#3006=1(LOOK)\n").trace == "message LOOK\nend\n");
  CHECK(MacroRun("IF[#1EQ#0]THEN#3000=1(NULL)\n").end() == "alarm 3001");
  CHECK(value("#1=3000\n#[#1]=1\n").starts_with("inconclusive"));
}

TEST_CASE("run, reference 1.9: DPRNT") {
  const auto printed = [](const std::string& blocks, const std::string& control = "fanuc-31i-b") {
    const MacroRun run("POPEN\n" + blocks + "PCLOS\n", controlOf(control));
    return run.end() == "end" ? run.run->output() : run.end();
  };
  CHECK(printed("#2=128.47398\nDPRNT[X#2[53]*Y]\n") == "X  128.474 Y\n");
  CHECK(printed("#2=-91.2\nDPRNT[Y#2[53]]\n") == "Y   -91.200\n");
  CHECK(printed("#2=123.456\nDPRNT[T#2[20]]\n") == "T123\n"); // no point, longer than asked
  CHECK(printed("DPRNT[#2[30]]\n") == "  0\n");               // null prints as 0
  CHECK(printed("#2=0.0005\nDPRNT[#2[13]]\n") == "0.001\n");
  CHECK(printed("#2=-0.0001\nDPRNT[#2[13]]\n") == "0.000\n");
  CHECK(printed("#2=5\nDPRNT[A#2[40]]\n", "fanuc-6m").starts_with("inconclusive"));
  stdlib::Control control = controlOf("fanuc-31i-b");
  control.printPadding = false;
  CHECK(MacroRun("POPEN\n#2=5\nDPRNT[A#2[41]]\nPCLOS\n", control).run->output() == "A5.0\n");
  CHECK(MacroRun("DPRNT[A]\n").end().starts_with("inconclusive: printing without POPEN"));
  CHECK(MacroRun("POPEN\nPOPEN\n").end().starts_with("inconclusive"));
  CHECK(MacroRun("POPEN\nDPRNT[A*B]\n").trace == "print A B\nend\n");
  Limits limits;
  limits.outputBytes = 10;
  CHECK(
      MacroRun("POPEN\nDPRNT[ABCDEFGHIJK]\n", control, nullptr, nullptr, limits).end().starts_with("limit"));
}

TEST_CASE("run, reference 1.9: BPRNT, SETVN") {
  const MacroRun run("POPEN\n#100=1.5\n#101=-1\nBPRNT[A#100[3]#101[0]]\nPCLOS\n");
  CHECK(run.run->output() == std::string("A\x00\x00\x05\xdc\xff\xff\xff\xff\n", 10));
  CHECK(run.trace == "print-binary 41000005dcffffffff\nend\n");
  CHECK(MacroRun("SETVN510[LEFT,RIGHT]\n").trace == "names 510 LEFT RIGHT\nend\n");
}

TEST_CASE("run, reference 1.10: variables that the machine keeps") {
  CHECK(value("#1100=1\n#1102=1\n#2=#1132\n") == "5");
  CHECK(value("#1132=6\n#2=#1101+#1102*10\n") == "11");
  CHECK(value("#1100=0.5\n").starts_with("inconclusive"));
  CHECK(value("#1133=70000\n#2=#1133\n") == "70000");
  CHECK(value("#1000=1\n") == "alarm 116");
  CHECK(value("#2=#1000\n").starts_with("inconclusive: what #1000 holds"));
  CHECK(value("#2=#1032\n").starts_with("inconclusive: what #1032 holds"));
  CHECK(value("#3003=1\n#3004=7\n#2=#3003+#3004\n") == "8");
  CHECK(value("#3005=1\n").starts_with("inconclusive"));
  CHECK(value("#2=#3007\n") == "0");
  CHECK(value("#2=#3011\n").starts_with("inconclusive: what #3011 holds (date"));
  CHECK(value("#2=#3901\n").starts_with("inconclusive: what #3901 holds (parts"));
  CHECK(value("#3901=5\n#2=#3901\n") == "5");
  CHECK(value("#2=#3101\n") == "3.141592653589793");
  CHECK(value("#3102=1\n") == "alarm 116");
  CHECK(value("G54.1P7\n#2=#4130\n") == "7");
  CHECK(value("#2=#4130\n").starts_with("inconclusive: #4130"));
  CHECK(value("#3001=0\nG4X1.5\n#2=#3001\n") == "1500");
  CHECK(value("#2=#4203\n").starts_with("inconclusive: what #4203"));
  CHECK(value("#2=#5101\n").starts_with("inconclusive: what #5101"));
  CHECK(value("G90G0X5.\nG53\n#2=#5001\n") == "5");
  CHECK(value("#2501=1\n", "fanuc-6m") == "");
  CHECK(value("O1\n#5221=10\nG90G0X5.\nG53\n#2=#5021\nM30\n") == "15");
}

TEST_CASE("run: variables that --var sets, system variables that no program writes too") {
  const stdlib::Control control = controlOf("fanuc-31i-b");
  sim::Machine machine(control);
  CHECK(machine.preset(1003, 1));
  CHECK(machine.preset(3011, 20261121));
  CHECK(machine.preset(500, 2));
  CHECK(machine.preset(501, 2));
  CHECK(machine.read(3011) == 20261121);
  CHECK(machine.read(1003) == 1);
  CHECK(machine.write(501, 3));
  CHECK(machine.write(502, sim::kNull));
  const auto written = machine.written(); // not what was only given
  REQUIRE(written.size() == 2);
  CHECK(written[0] == std::pair<std::uint32_t, double>(501, 3));
  CHECK(written[1].first == 502);
  CHECK_FALSE(machine.preset(3101, 3));
}

TEST_CASE("run, reference 1.10: the window of the PMC") {
  CHECK(value("#3962=3220\n#3965=-70000\n#2=#3965\n") == "-70000");
  CHECK(value("#3962=3220\n#3963=200\n#2=#3963\n") == "200");
  CHECK(value("#3962=3220\n#3964=-2\n#2=#3963\n") == "254"); // the low byte is first
  CHECK(value("#3962=3220\n#3964=513\n#3962=3221\n#2=#3963\n") == "2");
  CHECK(value("#3962=3220\n#3964=-2\n#2=#3964\n") == "-2");
  CHECK(value("#3962=3220\n#2=#3963\n") == "0");
  CHECK(value("#3962=3220\n#3963=1\nIF[[#3963AND1]EQ1]THEN#2=5\n") == "5");
  CHECK(value("#3963=1\n").starts_with("inconclusive: #3963 is written at no address"));
  CHECK(value("#2=#3963\n").starts_with("inconclusive: #3963 is read at no address"));
  CHECK(value("#2=#3962\n").starts_with("inconclusive"));
  CHECK(value("#3962=7999\n#3965=1\n").starts_with("inconclusive"));
  CHECK(value("#3962=8000\n").starts_with("inconclusive"));
  CHECK(value("#3962=100\n#3963=256\n").starts_with("inconclusive: the value does not fit"));
  CHECK(value("#3962=100\n#3963=1.5\n").starts_with("inconclusive: #3963 takes whole numbers"));
  CHECK(value("#3962=100\n#3965=0.29*100\n#2=#3965\n") == "29");
  CHECK(value("#3962=100\n", "fanuc-0i-md").starts_with("inconclusive: what #3962 sets"));
}

TEST_CASE("run, reference 1.2: positions read while motion may be waiting") {
  const auto early = [](const std::string& blocks) {
    const MacroRun run("G90G0\n" + blocks);
    std::string out;
    for (const sim::EarlyRead& one : run.run->earlyReads())
      out += fmt::format("{}{}", out.empty() ? "" : " ", one.number);
    return out;
  };
  CHECK(early("X1.\n#2=#5041\n") == "5041");
  CHECK(early("X1.\n#3=5041\n#2=#[#3]\n") == "5041");
  CHECK(early("X1.\nG53\n#2=#5041\n") == "");
  CHECK(early("X1.\nM0\n#2=#5041\n") == "");
  CHECK(early("#2=#5041\n") == "");
  CHECK(early("X1.\n#2=#4001\n") == "");
  CHECK(early("X1.\n#3962=100\n#2=#3963\n") == "3963");
  CHECK(early("X1.\nM8\n#2=#5021\n#2=#5001\n") == "5021");
  CHECK(early("WHILE[#1LT3]DO1\nX1.\n#2=#5041\n#1=#1+1\nEND1\n") == "5041"); // once a place
  CHECK(early("X1.\n#1=53\nG#1\n#2=#5041\n") == "");
}

namespace {

class HalfWay : public sim::SkipSignal {
public:
  std::optional<double> contact(const sim::SkipMove&) override { return 0.5; }
};

} // namespace

TEST_CASE("run: a probing move with a signal") {
  HalfWay signal;
  const MacroRun run("G90G31X10.F50.\n#2=#5061\n", controlOf("fanuc-31i-b"), &signal);
  CHECK(run.end() == "end");
  CHECK(run.at(2) == "5");
  CHECK(run.run->earlyReads().empty());
}

TEST_CASE("run: where the signal has stopped no skip move yet is not known") {
  CHECK(value("G1X10.F50.\n#2=#5061\n").starts_with("inconclusive: #5061 is read before any skip move"));
  CHECK(value("#1=5063\nIF[#[#1]GT0]GOTO1\nN1#2=1\n").starts_with("inconclusive: #5063 is read before"));
}
