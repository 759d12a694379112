// Programs of a lathe in G code system A on the virtual machine. Positions are counted by hand from the
// drawing.
#include "tests/unit/RunHarness.h"

#include <doctest/doctest.h>
#include <string>

using namespace dotek::tests;

namespace {

MacroRun run(const std::string& text) {
  return MacroRun(text, controlOf("fanuc-0i-tf"));
}

// Of a run that came to M30.
std::string trace(const std::string& text) {
  const MacroRun out = run(text);
  CAPTURE(text);
  CHECK(out.end() == "end");
  return out.trace;
}

std::string endOf(const std::string& text) {
  return run(text).end();
}

bool holds(const std::string& text, std::string_view part) {
  CAPTURE(text);
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("turning: X is a diameter, U and W are increments, I and R are radii") {
  CHECK(trace("G0 X40. Z2.\n"
              "G1 X30. Z-10. F.2\n"
              "U4. W-5.\n"
              "X38. W-2.\n"
              "G2 X48. Z-22. R5.\n"
              "G3 X58. Z-27. I0. K-5.\n"
              "G2 U10. W-5. I5. K0.\n") ==
        "rapid X40.000000 Z2.000000\n"
        "feed X30.000000 Z-10.000000 FR0.200000\n"
        "feed X34.000000 Z-15.000000 FR0.200000\n"
        "feed X38.000000 Z-17.000000 FR0.200000\n"
        "arc-cw zx X48.000000 Z-22.000000 centre -17.000000 48.000000 FR0.200000\n"
        "arc-ccw zx X58.000000 Z-27.000000 centre -27.000000 48.000000 FR0.200000\n"
        "arc-cw zx X68.000000 Z-32.000000 centre -27.000000 68.000000 FR0.200000\n"
        "end\n");
  CHECK(holds(endOf("G0 X40. U2.\n"), "inconclusive: X and U in one block"));
  // The machine itself counts the radius.
  const MacroRun radius = run("G0 X40. Z2.\n");
  CHECK(radius.machine->position()[0] == 20);
  CHECK(radius.machine->position()[2] == 2);
}

TEST_CASE("turning: a number without a point counts thousandths, of the diameter") {
  CHECK(trace("G0 X40000 Z2000\nG1 U-1 F.2\n") == "rapid X40.000000 Z2.000000\n"
                                                  "feed X39.999000 Z2.000000 FR0.200000\n"
                                                  "end\n");
}

TEST_CASE("turning: inches") {
  CHECK(trace("G20\nG0 X2. Z.1\nG1 U-1. F.01\n") == "rapid X50.800000 Z2.540000\n"
                                                    "feed X25.400000 Z2.540000 FR0.254000\n"
                                                    "end\n");
}

TEST_CASE("turning: reference point, coordinates, dwell, feed, speed and tool") {
  CHECK(trace("G50 S2500\n"
              "T0304\n"
              "G96 S180 M3\n"
              "G0 X40. Z2.\n"
              "G98 G1 Z-3. F100.\n"
              "G4 U1.5\n"
              "G4 P500\n"
              "G97 S1000\n"
              "T0300\n"
              "G28 U0 W0\n"
              "G50 X200. Z150.\n"
              "G0 U-10. W-1.\n"
              "T0\n") == "spindle-limit S2500.000000\n"
                         "tool 3 offset 4\n"
                         "surface-speed on\n"
                         "spindle cw V180.000000\n"
                         "rapid X40.000000 Z2.000000\n"
                         "feed X40.000000 Z-3.000000 F100.000000\n"
                         "dwell 1.500000\n"
                         "dwell 0.500000\n"
                         "surface-speed off\n"
                         "spindle cw S1000.000000\n"
                         "tool 3 offset 0\n"
                         "reference XZ via X40.000000 Z-3.000000\n"
                         "set-position X200.000000 Z150.000000\n"
                         "rapid X190.000000 Z149.000000\n"
                         "tool-offset off\n"
                         "end\n");
  CHECK(holds(endOf("T3\n"), "depends on a parameter"));
  CHECK(holds(endOf("G50 U10.\n"), "a shift of the coordinates by increments"));
  CHECK(holds(endOf("G10 P1 X.2\n"), "offsets of turning tools"));
  CHECK(holds(endOf("G91 G0 X5.\n"), "does not list it"));
}

TEST_CASE("turning: a thread by G32") {
  CHECK(trace("G0 X20. Z5.\nG32 Z-20. F2.\nU2. W-1.\nG0 X30.\n") ==
        "rapid X20.000000 Z5.000000\n"
        "thread X20.000000 Z-20.000000 FR2.000000\n"
        "thread X22.000000 Z-21.000000 FR2.000000\n"
        "rapid X30.000000 Z-21.000000\n"
        "end\n");
}

TEST_CASE("turning: G90 goes round four sides, again with what a block says anew") {
  CHECK(trace("G0 X52. Z2.\n"
              "G90 X46. Z-30. F.25\n"
              "X40.\n"
              "U-20. W-12.\n"
              "G0 X60.\n") == "rapid X52.000000 Z2.000000\n"
                              "rapid X46.000000 Z2.000000\n"
                              "feed X46.000000 Z-30.000000 FR0.250000\n"
                              "feed X52.000000 Z-30.000000 FR0.250000\n"
                              "rapid X52.000000 Z2.000000\n"
                              "rapid X40.000000 Z2.000000\n"
                              "feed X40.000000 Z-30.000000 FR0.250000\n"
                              "feed X52.000000 Z-30.000000 FR0.250000\n"
                              "rapid X52.000000 Z2.000000\n"
                              "rapid X32.000000 Z2.000000\n"
                              "feed X32.000000 Z-10.000000 FR0.250000\n"
                              "feed X52.000000 Z-10.000000 FR0.250000\n"
                              "rapid X52.000000 Z2.000000\n"
                              "rapid X60.000000 Z2.000000\n"
                              "end\n");
  // A taper of 2 on the radius over the length of the cut: the small end is where it begins.
  CHECK(trace("G0 X52. Z2.\nG90 X40. Z-30. R-2. F.25\nG0 X60.\n") ==
        "rapid X52.000000 Z2.000000\n"
        "rapid X36.000000 Z2.000000\n"
        "feed X40.000000 Z-30.000000 FR0.250000\n"
        "feed X52.000000 Z-30.000000 FR0.250000\n"
        "rapid X52.000000 Z2.000000\n"
        "rapid X60.000000 Z2.000000\n"
        "end\n");
  // Without axes it turns nothing: the line that many programs begin with.
  CHECK(endOf("G18 G20 G40 G80 G90 G99\nG0 X52. Z2.\n") == "end");
  CHECK(holds(endOf("G0 X52. Z2.\nG90 X40. F.2\n"), "a single cycle without Z"));
  CHECK(holds(endOf("G0 X52. Z2.\nG90 X40. Z-5. F.2\nM8\n"), "write `G0` before this block"));
  CHECK(endOf("G0 X52. Z2.\nG90 X40. Z-5.\n") == "alarm 11");
}

TEST_CASE("turning: G92 threads pass by pass, G94 faces") {
  CHECK(trace("G0 X24. Z4.\n"
              "G92 X19.2 Z-18. F1.5\n"
              "X18.6\n"
              "G0 X52. Z2.\n"
              "G94 X0. Z-1. F.15\n"
              "Z-2. R-1.\n"
              "G0 X60.\n") == "rapid X24.000000 Z4.000000\n"
                              "rapid X19.200000 Z4.000000\n"
                              "thread X19.200000 Z-18.000000 FR1.500000\n"
                              "rapid X24.000000 Z-18.000000\n"
                              "rapid X24.000000 Z4.000000\n"
                              "rapid X18.600000 Z4.000000\n"
                              "thread X18.600000 Z-18.000000 FR1.500000\n"
                              "rapid X24.000000 Z-18.000000\n"
                              "rapid X24.000000 Z4.000000\n"
                              "rapid X52.000000 Z2.000000\n"
                              "rapid X52.000000 Z-1.000000\n"
                              "feed X0.000000 Z-1.000000 FR0.150000\n"
                              "feed X0.000000 Z2.000000 FR0.150000\n"
                              "rapid X52.000000 Z2.000000\n"
                              "rapid X52.000000 Z-3.000000\n"
                              "feed X0.000000 Z-2.000000 FR0.150000\n"
                              "feed X0.000000 Z2.000000 FR0.150000\n"
                              "rapid X52.000000 Z2.000000\n"
                              "rapid X60.000000 Z2.000000\n"
                              "end\n");
}

TEST_CASE("turning: G74 drills by pecks, G75 cuts grooves side by side") {
  CHECK(trace("G0 X0 Z2.\nG74 R1.\nG74 Z-12. Q5000 F.1\n") == "rapid X0.000000 Z2.000000\n"
                                                              "feed X0.000000 Z-3.000000 FR0.100000\n"
                                                              "rapid X0.000000 Z-2.000000\n"
                                                              "feed X0.000000 Z-8.000000 FR0.100000\n"
                                                              "rapid X0.000000 Z-7.000000\n"
                                                              "feed X0.000000 Z-12.000000 FR0.100000\n"
                                                              "rapid X0.000000 Z2.000000\n"
                                                              "end\n");
  // P is on the radius, 2 mm; the third groove is where the block says, less than a step away.
  const std::string groove = trace("G0 X52. Z-10.\nG75 R.5\nG75 X40. Z-14. P2000 Q3000 F.08\n");
  std::string expected = "rapid X52.000000 Z-10.000000\n";
  for (const std::string z : {"-10", "-13", "-14"}) {
    const std::string at = " Z" + z + ".000000";
    if (z != "-10") expected += "rapid X52.000000" + at + "\n";
    for (const std::string side :
         {"feed X48.000000", "rapid X49.000000", "feed X44.000000", "rapid X45.000000", "feed X40.000000"})
      expected += side + at + (side.starts_with("feed") ? " FR0.080000\n" : "\n");
    expected += "rapid X52.000000" + at + "\n";
  }
  CHECK(groove == expected + "rapid X52.000000 Z-10.000000\nend\n");
  CHECK(holds(endOf("G0 X0 Z2.\nG74 Z-12. Q5000 F.1\n"), "without the first of its two blocks"));
  CHECK(holds(endOf("G0 X0 Z2.\nG74 R1.\nG74 Z-12. Q5. F.1\n"), "without a point"));
  CHECK(holds(endOf("G0 X0 Z2.\nG74 R1.\nG74 Z-12. Q5000 R.2 F.1\n"), "a relief at the bottom"));
  CHECK(holds(endOf("G0 X0 Z2.\nG74 R5.\nG74 Z-12. Q5000 F.1\n"), "goes back by a peck or more"));
  CHECK(holds(endOf("G0 X52. Z2.\nG75 R.5\nG75 X40. Z-4. P2000 F.1\n"), "without the step Q"));
  CHECK(holds(endOf("G0 X0 Z2.\nG74 Z-12. K5. F.1\n"), "the form with one block"));
  CHECK(holds(endOf("G74 Q5000\n"), "is the first of two blocks, and takes R"));
  CHECK(holds(endOf("G0 X0 Z2.\nG74 R1.\nG74 Z-12. F.1\n"), "and the peck Q"));
}

TEST_CASE("turning: G70 follows the blocks from P to Q and goes back to where it began") {
  CHECK(trace("O1\n"
              "G0 X50. Z2.\n"
              "G70 P10 Q20 F.12\n"
              "G0 X80. Z50.\n"
              "M30\n"
              "N10 G0 X20.\n"
              "G1 Z-15. F.1\n"
              "X30. Z-25.\n"
              "N20 X50.\n") == "rapid X50.000000 Z2.000000\n"
                               "rapid X20.000000 Z2.000000\n"
                               "feed X20.000000 Z-15.000000 FR0.100000\n"
                               "feed X30.000000 Z-25.000000 FR0.100000\n"
                               "feed X50.000000 Z-25.000000 FR0.100000\n"
                               "rapid X50.000000 Z2.000000\n"
                               "rapid X80.000000 Z50.000000\n"
                               "end\n");
  CHECK(holds(endOf("O1\nG70 P10 Q20\nM30\nN10 G0 X20.\n"), "has no block N20, or several"));
  CHECK(holds(endOf("O1\nG70 P20 Q10\nM30\nN10 G0 X20.\nN20 X30.\n"),
              "is blocks alone, from its first to its last"));
  CHECK(holds(endOf("O1\nG70 P10 Q20\nM30\nN10 G0 X20.\n#1=3\nN20 X30.\n"), "is blocks alone"));
  CHECK(holds(endOf("O1\nG70 P10\nM30\nN10 G0 X20.\n"), "takes P and Q"));
  // Which code of group 1 it leaves is in no source.
  CHECK(endOf("O1\nG0 X50. Z2.\nG70 P10 Q20\nX80.\nM30\nN10 G0 X20.\nN20 G1 X30. F.1\n") != "end");
}

TEST_CASE("turning: a cycle whose path no source states ends the run at its line") {
  const std::string contour = "M30\nN10 G0 X20.\nN20 G1 Z-9.\n";
  for (const std::string code : {"G71", "G72", "G73"}) {
    const std::string first = code == "G72" ? " W1.5 R.5\n" : " U1.5 R.5\n";
    CHECK(holds(endOf("O1\nG0 X50. Z2.\n" + code + first + code + " P10 Q20 U.4 W.1 F.25\n" + contour),
                "the cycle of line 5 (the second of two blocks) moves along a path that no source"));
    CHECK(holds(endOf("O1\nG0 X50. Z2.\n" + code + " P10 Q20 U.4 W.1 D1500 F.25\n" + contour),
                "the cycle of line 4 (the form with one block)"));
    CHECK(endOf("O1\n" + code + first + contour) == "end");
    CHECK(holds(endOf("O1\n" + code + " P10 U.4\n" + contour), "with one of P and Q"));
    CHECK(
        holds(endOf("O1\n" + code + " X5.\n" + contour), "is the first of two blocks, and takes U, W and R"));
  }
  CHECK(holds(endOf("O1\nG76 P020060 Q100 R.05\nG76 X17.4 Z-20. P1300 Q400 F2.\nM30\n"),
              "the cycle of line 4 (the second of two blocks)"));
  CHECK(holds(endOf("O1\nG76 X17.4 Z-20. K1.3 D400 F2. A60\nM30\n"),
              "the cycle of line 3 (the form with one block)"));
  CHECK(holds(endOf("O1\nG76 R.05 K2.\nM30\n"), "is the first of two blocks, and takes P, Q and R"));
  CHECK(holds(endOf("G83 Z-20. Q5000 F.1\n"), "what it does here is not known"));
}

TEST_CASE("turning: variables count the axes of the lathe, and X as a diameter") {
  const MacroRun out =
      run("G0 X40. Z2.\n#2=#5041\n#3=#5042\n#4=#5021\n#5221=10.\n#5=#5041\n#5222=-1.\n#6=#5042\n");
  CHECK(out.end() == "end");
  CHECK(out.at(2) == "40");
  CHECK(out.at(3) == "2");
  CHECK(out.at(4) == "40");
  CHECK(out.at(5) == "30");
  CHECK(out.at(6) == "3");
  CHECK(holds(endOf("#2=#5043\n"), "what #5043 holds is not known"));
  CHECK(holds(endOf("#2=#2001\n"), "depends on the control's memory for offsets"));
  CHECK(trace("G10 L2 P1 X10. Z-1.\nG0 X0 Z0\n") == "offset L2 P1 X10.000000 Z-1.000000\n"
                                                    "rapid X0.000000 Z0.000000\n"
                                                    "end\n");
}
