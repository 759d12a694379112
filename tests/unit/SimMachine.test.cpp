// The machine on plain blocks: each case names what the reference or the data file says.
#include "SimHarness.h"

#include <cmath>

using namespace dotek;
using tests::Simulation;

namespace {

std::string after(std::string_view text, std::string_view control = "fanuc-0i-md") {
  Simulation s(control);
  s.run(text);
  return s.state() == "running" ? s.at() : s.state();
}

std::string machineAfter(std::string_view text) {
  Simulation s;
  s.run(text);
  return s.state() == "running" ? s.machineAt() : s.state();
}

class Plane : public sim::SkipSignal {
public:
  explicit Plane(double z) : z_(z) {}
  std::optional<double> contact(const sim::SkipMove& move) override {
    const double share = (move.machineFrom[2] - z_) / (move.machineFrom[2] - move.machineTo[2]);
    if (!(share >= 0 && share <= 1)) return std::nullopt;
    return share;
  }

private:
  double z_;
};

} // namespace

TEST_CASE("sim: straight moves, absolute and incremental (groups 1 and 3)") {
  CHECK(after("G90 G0 X1. Y2. Z3.") == "1 2 3");
  CHECK(after("G90 G0 X1. Y2. Z3.\nG91 X1.\nY-2. Z0.5") == "2 0 3.5");
  CHECK(after("G1 X1. F100\nX2.\nG91 X0.1\nX0.2") == "2.3 0 0");
  CHECK(after("G90 G91 X1.\nX1.") == "2 0 0"); // the last code of a group holds
  CHECK(after("X5.") == "5 0 0");              // rapid is in force at power on
  CHECK(after("G1 F100") == "0 0 0");
  Simulation s;
  s.run("G0 A10. C-5. W1.5\nG91 A10.");
  CHECK(s.machine->position()[3] == 20);
  CHECK(s.machine->position()[5] == -5);
  CHECK(s.machine->position()[8] == 1.5);
  CHECK(s.machine->movedAxes() == (7u | 1u << 3 | 1u << 5 | 1u << 8));
}

TEST_CASE("sim: increments add up as on a control that counts them") {
  Simulation s;
  s.run("G91");
  for (int i = 0; i < 1000; ++i)
    s.run("G0 X0.1");
  CHECK(s.machine->position()[0] == 100);
  s.run("X0.2 X0");
  CHECK(s.state() == "inconclusive X");
}

TEST_CASE("sim: a word is rounded to the least input increment (reference 1.6)") {
  Simulation s;
  s.run("G0 X12.3456 Y-0.0005 Z0.00049");
  CHECK(s.machine->position()[0] == 12.346);
  CHECK(s.machine->position()[1] == -0.001);
  CHECK(s.machine->position()[2] == 0);
  s.run("G20 X0.00006");
  CHECK(s.machine->position()[0] == 0.00254);
}

TEST_CASE("sim: numbers without a point (DecimalMode)") {
  CHECK(after("G0 X10 Y5.", "fanuc-0i-md") == "10 5 0"); // calculator
  CHECK(after("G0 X10 Y5.", "fanuc-6m") == "0.01 5 0");  // increment: X10 is 0.010 mm
  CHECK(after("G91 G0 X10\nX10", "fanuc-6m") == "0.02 0 0");
  Simulation s("fanuc-6m");
  s.run("G1 X1. F100");
  CHECK(s.machine->feed() == 100); // a feed counts whole units
  s.run("G4 X500");
  CHECK(s.machine->seconds() == 0.5);
}

TEST_CASE("sim: inch and metric (group 6)") {
  CHECK(after("G20 G0 X1. Y-0.5") == "25.4 -12.7 0");
  CHECK(after("G20 G0 X1.\nG21 X3.") == "3 0 0");
  CHECK(after("G20 G91 G0 X0.1\nX0.1") == "5.08 0 0");
  Simulation s;
  s.run("G20 G1 X1. F10.");
  CHECK(s.machine->feed() == 254);
  // Positions, offsets and the feed are read and written in the unit of the input.
  CHECK(s.machine->read(5041) == doctest::Approx(1));
  CHECK(s.machine->read(5021) == doctest::Approx(1));
  CHECK(s.machine->read(4109) == doctest::Approx(10));
  CHECK(s.machine->write(5221, 2));
  CHECK(s.machine->zeroOf(0)[0] == doctest::Approx(50.8));
  CHECK(s.machine->read(5041) == doctest::Approx(-1));
  CHECK(s.machine->write(2005, 0.1));
  s.run("G21");
  CHECK(s.machine->read(5221) == doctest::Approx(50.8));
  CHECK(s.machine->read(2005) == doctest::Approx(2.54));
  CHECK(s.machine->read(4006) == 21);
}

TEST_CASE("sim: alarms carry number, program and block") {
  Simulation s;
  CHECK_FALSE(s.run("O1234\nN5 G0 X1.\nN10 G1 X2.\n"));
  CHECK(s.state() == "alarm 11");
  const sim::RunEnd& end = s.machine->end();
  CHECK(end.text == "NO FEEDRATE COMMANDED");
  CHECK(end.line == 3);
  REQUIRE(end.stack.size() == 1);
  CHECK(end.stack[0].program == 1234);
  CHECK(end.stack[0].sequence == 10);
  CHECK_FALSE(s.run("G0 X5.")); // nothing runs after an end
  CHECK(s.at() == "1 0 0");
  CHECK(after("G0 X100000.") == "alarm 3");
  CHECK(after("G0 X99999.999") == "100000 0 0");
}

TEST_CASE("sim: arcs end where they are programmed, on their circle") {
  CHECK(after("G0 X10. Y0\nG2 X0 Y-10. I-10. F100") == "0 -10 0");
  CHECK(after("G0 X10. Y0\nG3 I-10. F100") == "10 0 0"); // a full circle
  CHECK(after("G0 X10. Y0\nG3 X0 Y10. R10. F100") == "0 10 0");
  CHECK(after("G0 X10. Y0\nG3 X-10. Y0 Z-1. R10. F100") == "-10 0 -1");
  CHECK(after("G18 G0 X10. Z0\nG2 X0 Z10. I-10. K0. F100") == "0 0 10");
  CHECK(after("G19 G0 Y10. Z0\nG2 Y0 Z10. J-10. K0. F100") == "0 0 10");
  // The radii of the ends may differ by the tolerance of the data file, no more.
  CHECK(after("G0 X10. Y0\nG2 X0 Y-10.02 I-10. F100") == "0 -10.02 0");
  CHECK(after("G0 X10. Y0\nG2 X0 Y-10.04 I-10. F100") == "alarm 20");
  CHECK(after("G0 X10. Y0\nG2 X0 Y0 R4.9 F100") == "alarm 20");
  CHECK(after("G0 X10. Y0\nG2 X0 Y0 R4.99 F100") == "0 0 0");
  CHECK(after("G0 X10.\nG2 X0 Y-10. I-10.") == "alarm 11");
  CHECK(after("G2 X0 Y-10. F100") == "inconclusive G");
  CHECK(after("G2 X1. Y0 R0 F100") == "inconclusive R");
  CHECK(after("G2 I-10. K1. F100") == "inconclusive K"); // no address of XY
  CHECK(after("G1 X1. I5. F100") == "inconclusive I");
}

TEST_CASE("sim: work systems are shifts of the machine (#5221 G54, +20)") {
  Simulation s;
  s.machine->write(5221, 100);
  s.machine->write(5242, -50);
  s.machine->write(5203, 7);
  CHECK(s.at() == "-100 0 -7");
  s.run("G0 X1. Y2. Z3.");
  CHECK(s.machineAt() == "101 2 10");
  s.run("G55");
  CHECK(s.at() == "101 52 3");
  s.run("X1. Y2. Z3.");
  CHECK(s.machineAt() == "1 -48 10");
  CHECK(s.machine->modalCode(14) == 550);
  s.run("G54.1 P3 X1.");
  CHECK(s.machineAt() == "1 -48 10");
  CHECK(s.machine->read(4014) == 54.1);
  s.machine->write(7041, 30); // X of P3
  s.run("X1.");
  CHECK(s.machineAt() == "31 -48 10");
  s.run("G54.1 P49 X0");
  CHECK(s.state() == "inconclusive P");
}

TEST_CASE("sim: local shift, G92, G10") {
  CHECK(machineAfter("G52 X10. Y20.\nG0 X1. Y1.") == "11 21 0");
  CHECK(machineAfter("G52 X10.\nG55 G0 X1.") == "11 0 0"); // in every work system
  CHECK(machineAfter("G52 X10.\nG52 X0\nG0 X1.") == "1 0 0");
  CHECK(after("G91 G52 X10.") == "inconclusive G");
  CHECK(after("G0 X5. Y5.\nG92 X0 Y1.") == "0 1 0");
  CHECK(machineAfter("G0 X5. Y5.\nG92 X0 Y1.\nX2.\nG55 X2.") == "7 5 0");
  CHECK(machineAfter("G52 X3.\nG0 X2.\nG92 X0\nX1.") == "6 0 0");
  CHECK(machineAfter("G10 L2 P1 X10. Y-1.\nG0 X1. Y0") == "11 -1 0");
  CHECK(machineAfter("G10 L2 P0 Z5.\nG0 Z0") == "0 0 5");
  CHECK(machineAfter("G10 L2 P2 X10.\nG91 G10 L2 P2 X1.\nG90 G55 G0 X0") == "11 0 0");
  CHECK(machineAfter("G10 L20 P48 X8.\nG54.1 P48 G0 X0") == "8 0 0");
  CHECK(after("G10 L2 P7 X1.") == "inconclusive P");
  CHECK(after("G10 L50") == "inconclusive L");
  CHECK(after("G10 L12 P1 R2.") == "0 0 0"); // a radius of memory C
}

TEST_CASE("sim: G92 S limits the spindle's speed and shifts nothing") {
  Simulation s;
  s.run("G54 G0 X10. Y5.\nS800 M3\nG92 S2000\nG0 X0");
  CHECK(s.at() == "0 5 0");
  CHECK(s.machine->spindleSpeed() == 800);
  CHECK(s.machine->positionShift() == sim::Position{});
  CHECK(after("G92 S2000 X5.") == "inconclusive S");
  CHECK(after("G68 X0 Y0 R30.\nG92 S2000\nG69") == "0 0 0");
}

TEST_CASE("sim: tool length (groups 8; #2001 and #2201)") {
  Simulation s;
  s.run("G10 L10 P5 R100.\nG10 L11 P5 R0.5");
  CHECK(s.machine->read(2205) == 100);
  CHECK(s.machine->read(2005) == 0.5);
  // The same offsets have numbers above 10000, too.
  CHECK(s.machine->read(11005) == 100);
  CHECK(s.machine->read(10005) == 0.5);
  s.machine->write(11006, 80);
  s.machine->write(10006, 0.2);
  CHECK(s.machine->read(2206) == 80);
  CHECK(s.machine->read(2006) == 0.2);
  s.run("G0 Z50. G43 H5");
  CHECK(s.at() == "0 0 50");
  CHECK(s.machineAt() == "0 0 150.5");
  CHECK(s.machine->read(5003) == 50);    // no tool offset in it
  CHECK(s.machine->read(5043) == 150.5); // the tool's length stays in it
  CHECK(s.machine->read(5083) == 100.5);
  CHECK(s.machine->read(4111) == 5);
  s.run("G49 Z10.");
  CHECK(s.machineAt() == "0 0 10");
  s.run("G44 H5 Z0");
  CHECK(s.machineAt() == "0 0 -100.5");
  CHECK(after("G43 H400 Z0") == "inconclusive H");
}

TEST_CASE("sim: an axis whose place is not known") {
  // Which of machine and coordinates moves when G43 is without Z depends on a parameter.
  const std::string length = "G10 L10 P1 R10.\nG90 G0 Z5.\nG43 H1\n";
  CHECK(after(length + "G91 Z1.") == "inconclusive Z");
  CHECK(after(length + "G90 Z20.\nG91 Z1.") == "0 0 21");
  CHECK(after(length + "G81 X1. R2. Z-1. F100") == "inconclusive G");
  Simulation s;
  s.run(length);
  CHECK(s.machine->uncertain() == 4);
  CHECK(std::isnan(s.machine->knownPosition()[2]));
  CHECK(std::isnan(s.machine->knownMachinePosition()[2]));
  CHECK(s.machine->knownPosition()[0] == 0);
  CHECK_FALSE(s.machine->read(5023));
  CHECK(s.state() == "inconclusive");
}

TEST_CASE("sim: the trace says which axes are not known") {
  const auto traced = [](std::string_view text) {
    std::string out;
    Simulation s;
    {
      sim::Trace trace([&](std::string_view lines) { out += lines; });
      s.machine->setTrace(&trace);
      s.run(text);
      s.machine->setTrace(nullptr);
    }
    return out;
  };
  const std::string length = "G10 L10 P1 R10.\nG90 G0 Z5.\nG43 H1\n";
  CHECK(traced(length + "X1.").find("rapid X1.000000 Y0.000000 Z?\n") != std::string::npos);
  CHECK(traced(length + "G53 X1.").find("machine rapid X1.000000 Y0.000000 Z?\n") != std::string::npos);
  CHECK(traced(length + "G53 Z-3.").find("machine rapid X0.000000 Y0.000000 Z-3.000000\n") !=
        std::string::npos);
  CHECK(traced(length + "G55").find("system 55 X0.000000 Y0.000000 Z?\n") != std::string::npos);
  CHECK(traced(length + "G92 X2.").find("set-position X2.000000 Y0.000000 Z?\n") != std::string::npos);
  CHECK(traced(length + "Z7.").find("rapid X0.000000 Y0.000000 Z7.000000\n") != std::string::npos);
}

TEST_CASE("sim: machine coordinates and reference points") {
  CHECK(machineAfter("G10 L2 P1 X10. Z20.\nG0 X1. Z1.\nG53 X5. Z-3.") == "5 0 -3");
  CHECK(after("G10 L2 P1 X10.\nG53 G0 X5.\nG91 X1.") == "-4 0 0");
  CHECK(after("G53") == "0 0 0"); // waits only
  CHECK(after("G91 G53 X5.") == "inconclusive G");
  CHECK(after("G0 X5. Y6. Z7.\nG28") == "0 0 0"); // without axes all of them
  CHECK(after("G1 G53 X5.") == "alarm 11");
  CHECK(machineAfter("G10 L2 P1 Z-100.\nG0 X5. Z50.\nG91 G28 Z0") == "5 0 0");
  CHECK(after("G10 L2 P1 Z-100.\nG0 Z50.\nG91 G28 Z0") == "0 0 100");
  CHECK(after("G0 X5.\nG28 X7.") == "0 0 0");
  CHECK(after("G30 P2 X0\nG91 X1.") == "inconclusive X"); // where that point lies is not known
  CHECK(after("G30 P2 X0\nG90 X1.") == "1 0 0");
  CHECK(after("G30 P5 X0") == "inconclusive P");
}

TEST_CASE("sim: dwell") {
  Simulation s;
  s.run("G4 P1500\nG4 X2.\nG04 X5\nG4 U0.5");
  CHECK(s.machine->seconds() == 9); // T31: G4X5 is 5 s
  CHECK(s.at() == "0 0 0");
  CHECK(s.machine->read(3001) == 9000);
  CHECK(after("G4 P1.5") == "inconclusive P");
  CHECK(after("G4 X1. P1") == "inconclusive G");
  CHECK(after("G4 Y1.") == "inconclusive G");
}

TEST_CASE("sim: canned cycles end at the initial level or at level R (groups 9 and 10)") {
  const std::string begin = "G90 G0 X0 Y0 Z50.\n";
  for (const char* code : {"73", "74", "76", "81", "82", "83", "84", "85", "86", "88", "89"}) {
    CAPTURE(code);
    CHECK(after(begin + "G98 G" + code + " X1. Y2. Z-5. R2. F100") == "1 2 50");
    CHECK(after(begin + "G99 G" + code + " X1. Y2. Z-5. R2. F100") == "1 2 2");
  }
  CHECK(after(begin + "G99 G81 X1. Z-5. R2. F100\nX3.\nY4.") == "3 4 2"); // modal
  CHECK(after(begin + "G99 G81 X1. Z-5. R2. F100\nG98 X3.") == "3 0 50");
  CHECK(after(begin + "G99 G81 X1. Z-5. R2. F100\nG80\nX5.") == "5 0 2");
  CHECK(after(begin + "G99 G81 X1. Z-5. R2. F100\nG0 X5. Z9.") == "5 0 9"); // group 1 ends the cycle
  CHECK(after(begin + "G91 G99 G81 X1. Y2. Z-5. R-40. K3 F100") == "3 6 10");
  CHECK(after(begin + "G99 G81 X1. Y2. Z-5. R2. K3 F100") == "1 2 2");
  CHECK(after(begin + "G81 X1. R2. F100") == "inconclusive G");  // no depth
  CHECK(after(begin + "G81 X1. Z-5. F100") == "inconclusive G"); // no level R
  CHECK(after(begin + "G81 X1. Z-5. R2.") == "alarm 11");
  // K0 keeps R, depth and feed, and moves nothing.
  CHECK(after(begin + "G99 G81 X1. Y2. Z-5. R2. K0 F100") == "0 0 50");
  CHECK(after(begin + "G99 G81 X1. Y2. Z-5. R2. K0 F100\nX3.") == "3 0 2");
  CHECK(after(begin + "G91 G99 G81 X1. Z-5. R-40. K0 F100\nX3. K2") == "6 0 10");
  CHECK(after(begin + "G81 X1. Z-5. R2. L0 F100", "fanuc-6m") == "0 0 50");
  CHECK(after(begin + "G81 X1. Z-5. R2. K1.5 F100") == "inconclusive K");
  CHECK(after(begin + "G81 X1. Z-5. R2. L2 F100") == "inconclusive L"); // the data file says K
  CHECK(after(begin + "G81 X1. Z-5. R2. L2 F100", "fanuc-6m") == "1 0 50");
  CHECK(after(begin + "G98 G87 X1. Z-5. R-8. Q1. F100") == "1 0 50");
  CHECK(after(begin + "G99 G87 X1. Z-5. R-8. Q1. F100") == "inconclusive G");
  CHECK(after(begin + "G0 G81 X1. Z-5. R2. F100") == "inconclusive G");
  CHECK(after("G18 G0 Y50.\nG99 G81 X1. Z2. Y-5. R2. F100") == "1 2 2");
  Simulation s;
  s.run(begin + "G81 X1. Z-5. R2. F100");
  CHECK(s.machine->read(4009) == 81);
  s.run("G1 X5.");
  CHECK(s.machine->read(4009) == 80);
}

TEST_CASE("sim: the skip move G31 and #5061") {
  Plane surface(-10);
  Simulation s;
  s.machine->setSkipSignal(&surface);
  s.run("G90 G0 Z5.\nG31 Z-20. F100");
  CHECK(s.at() == "0 0 -10");
  CHECK(s.machine->read(5063) == -10);
  s.run("G0 Z5.\nG31 Z0");
  CHECK(s.at() == "0 0 0");
  CHECK(s.machine->read(5063) == 0); // without a trigger the end of the block
  s.run("G10 L10 P1 R100.\nG43 H1 Z-50.\nG31 Z-120.");
  CHECK(s.at() == "0 0 -110");                       // contact at the machine's -10
  CHECK(s.machine->read(5063) == -10);               // the tool's length is in it
  CHECK(after("G31 Z-1. F100") == "inconclusive G"); // no part
  CHECK(after("G31 Z-1.") == "alarm 11");
}

TEST_CASE("sim: what is not known ends the run at its word") {
  CHECK(after("G12.1") == "inconclusive G"); // not in the 0i-MD's table
  CHECK(after("G7.1 C1.") == "inconclusive G");
  CHECK(after("M77") == "inconclusive M");
  CHECK(after("M3.0") == "inconclusive M");
  CHECK(after("G51 X1. P2") == "inconclusive G");
  CHECK(after("G51.1 X0") == "inconclusive G");
  CHECK(after("G16") == "inconclusive G");
  CHECK(after("G96 S100") == "inconclusive G");
  CHECK(after("G0 X1. E5") == "inconclusive E");
  CHECK(after("G0 X1. R5.") == "inconclusive R");
  CHECK(after("G22 X1. Y1. Z1. I0. J0. K0.") == "inconclusive I");
  CHECK(after("G4 P1 G10 L2") == "inconclusive G");
  CHECK(after("F-5") == "inconclusive F");
  CHECK(after("O99999") == "inconclusive O");
  // What changes no end point goes on.
  CHECK(after("G17 G40 G49 G80 G50 G69 G15 G50.1 G67 G97 G64 G23 G94 G21 G98 X3.") == "3 0 0");
  CHECK(after("G5.1 Q1\nG8 P1\nG61 X1.") == "1 0 0");
  CHECK(after("M31\nM32") == "0 0 0"); // the thesis machine's probe
}

TEST_CASE("sim: ends of a program") {
  CHECK(after("G0 X1.\nM30\nG0 X2.") == "end");
  CHECK(after("M2") == "end");
  CHECK(after("%\nO1\nG0 X1.\n%\nX2.") == "text end");
  CHECK(after("O1\nG0 X1.\nO2\nX2.") == "text end");
  CHECK(after("M99") == "return");
  CHECK(after("M98 P1") == "call");
  CHECK(after("G65 P9000 X1.") == "call");
  CHECK(after("G66 P9000 X1.") == "call");
  Simulation s;
  s.run("G0 X1.\nX7. M30");
  CHECK(s.at() == "7 0 0"); // the stop comes after the motion
}

TEST_CASE("sim: block delete is a switch") {
  Simulation s;
  s.run("/G0 X1.\n/2 Y1.");
  CHECK(s.at() == "1 1 0");
  s.machine->setBlockDelete(1u << 2);
  s.run("/X5.\n/2 Y5.");
  CHECK(s.at() == "5 1 0");
}

TEST_CASE("sim: cutter compensation: the program's position is known, the tool's is not") {
  Simulation s;
  s.run("G41 D3 G1 X10. F100");
  CHECK(s.at() == "10 0 0");
  CHECK(s.machine->read(5001) == 10);
  CHECK(s.machine->read(4007) == 41);
  CHECK(s.machine->read(4107) == 3);
  CHECK_FALSE(s.machine->read(5041));
  CHECK(s.state() == "inconclusive");
  CHECK(after("G42 D1\nG28 X0") == "inconclusive G");
}
