// Macros of the vendors by their meaning, on parts of exact geometry.
#include "VendorHelper.h"

using namespace dotek;
using namespace dotek::tests;

TEST_CASE("a protected move goes to its target, and stops with an alarm where it touches") {
  VendorCase free;
  free.stand(0, 0, 50);
  CHECK(free.call("9810 X10. Y-5. F2000."));
  CHECK(free.at() == "10 -5 50");
  CHECK(free.variable(148) == 0);
  CHECK(free.variable(117) == 2000);
  CHECK(free.call("9810 Z20.")); // with the feed of the move before
  CHECK(free.at() == "10 -5 20");

  VendorCase blocked;
  blocked.world.halfSpace({0, 0, 0}, {0, 0, 1});
  blocked.stand(0, 0, 50);
  CHECK_FALSE(blocked.call("9810 Z-5. F2000."));
  CHECK(blocked.machine->end().ending == sim::Ending::Alarm);
  CHECK(blocked.machine->end().number == 3086);
  CHECK(blocked.machine->end().text == "PATH OBSTRUCTED");

  VendorCase told;
  told.world.halfSpace({0, 0, 0}, {0, 0, 1});
  told.stand(0, 0, 50);
  CHECK(told.call("9810 Z-5. F2000. M1"));
  CHECK(told.variable(148) == 7);
  CHECK(told.at() == "0 0 0"); // the ball's lowest point

  VendorCase feedless;
  CHECK_FALSE(feedless.call("9810 Z20."));
  CHECK(feedless.machine->end().number == 3088);
  CHECK(feedless.machine->end().text == "NO FEED RATE");
}

TEST_CASE("a protected move of EasyProbe: which alarm, and which feed, is in no source") {
  VendorCase probe("easyprobe");
  probe.world.halfSpace({0, 0, 0}, {0, 0, 1});
  probe.stand(0, 0, 50);
  CHECK(probe.call("9770 Z20."));
  CHECK_FALSE(probe.run("G1 X5.")); // the feed that it left is not known
  CHECK(probe.machine->end().text.find("which feed") != std::string::npos);

  VendorCase blocked("easyprobe");
  blocked.world.halfSpace({0, 0, 0}, {0, 0, 1});
  blocked.stand(0, 0, 50);
  CHECK_FALSE(blocked.call("9770 Z-5. F200"));
  CHECK(blocked.machine->end().ending == sim::Ending::Alarm);
  CHECK(blocked.machine->end().number == 0);
}

TEST_CASE("a single surface: two touches, back to the start, position and error") {
  struct Row {
    Vector point, normal;
    const char* call;
    std::uint32_t position, error;
    double measured, off;
  };
  // G54 lies at X100 Y-200 Z-300 of the machine.
  const Row kRows[] = {
      {{120.3, 0, 0}, {-1, 0, 0}, "9811 X20.", 135, 140, 20.3, 0.3},
      {{79.6, 0, 0}, {1, 0, 0}, "9811 X-20.", 135, 140, -20.4, -0.4},
      {{0, -181.25, 0}, {0, -1, 0}, "9811 Y18.", 136, 141, 18.75, 0.75},
      {{0, -225.5, 0}, {0, 1, 0}, "9811 Y-20. Q7.", 136, 141, -25.5, -5.5},
      {{0, 0, -319.2}, {0, 0, 1}, "9811 Z-20.", 137, 142, -19.2, 0.8},
  };
  for (const Row& row : kRows) {
    CAPTURE(row.call);
    VendorCase probe;
    probe.world.halfSpace(row.point, row.normal);
    REQUIRE(probe.run("N1 G54"));
    REQUIRE((probe.machine->write(5221, 100) && probe.machine->write(5222, -200) &&
             probe.machine->write(5223, -300)));
    probe.stand(0, 0, 0);
    REQUIRE(probe.call(row.call));
    CHECK(near(probe.variable(row.position), row.measured));
    CHECK(near(probe.variable(row.error), row.off));
    CHECK(probe.at() == "0 0 0");
    CHECK(probe.variable(148) == 0);
    CHECK(probe.variable(149) == 0);
    // two touches
    const std::string text = probe.text();
    const std::size_t first = text.find(" contact ");
    REQUIRE(first != std::string::npos);
    CHECK(text.find(" contact ", first + 1) != std::string::npos);
    CHECK(text.find("assumed #149 probe-error") != std::string::npos);
    CHECK(text.find("probe not-switched") != std::string::npos);
  }
}

TEST_CASE("no surface within the overtravel is PROBE FAIL, contact at the start PROBE OPEN") {
  VendorCase far;
  far.world.wall(31, 0, 180);
  CHECK_FALSE(far.call("9811 X20."));
  CHECK(far.machine->end().number == 3093);
  CHECK(far.machine->end().text == "PROBE FAIL");
  VendorCase reached;
  reached.world.wall(29.9, 0, 180);
  CHECK(reached.call("9811 X20.")); // 10 mm
  VendorCase shorter;
  shorter.world.wall(29.9, 0, 180);
  CHECK_FALSE(shorter.call("9811 X20. Q9."));
  VendorCase open;
  open.world.wall(2.5, 0, 180); // the ball has a radius of 3
  CHECK_FALSE(open.call("9811 X20."));
  CHECK(open.machine->end().number == 3092);
  CHECK(open.machine->end().text == "PROBE OPEN");
}

// No set but our own has the letter.
TEST_CASE("a touch that may find nothing: back, the flag, no offset") {
  for (const bool there : {true, false}) {
    VendorCase probe("dotek");
    probe.world.wall(there ? 20.3 : 60, 0, 180);
    REQUIRE((probe.machine->write(520, 3) && probe.machine->write(5281, 7)));
    probe.stand(0, 2, 1);
    REQUIRE(probe.call("8811 X20. S4 M1"));
    CHECK(near(probe.variable(149), there ? 0 : 2));
    CHECK(near(probe.variable(5281), there ? 0.3 : 7));
    CHECK(near(probe.machine->position()[0], 0));
    REQUIRE(probe.call("8821 A0 D20. S4 M1"));
    CHECK(near(probe.variable(149), there ? 0 : 2));
  }
  VendorCase alarm("dotek");
  REQUIRE(alarm.machine->write(520, 3));
  CHECK_FALSE(alarm.call("8811 X20. M0"));
}

TEST_CASE("S: the system gets the offset in force plus the error") {
  VendorCase probe;
  probe.world.wall(120.3, 0, 180);
  REQUIRE((probe.machine->write(5221, 100) && probe.machine->write(5261, 77)));
  probe.stand(0, 0, 0);
  REQUIRE(probe.call("9811 X20. S3"));
  CHECK(near(probe.variable(5261), 100.3)); // 77 does not count
  CHECK(near(probe.variable(5221), 100));
  CHECK(probe.text().find("offset 56 X100.300000") != std::string::npos);
  // of the active one: the surface gets its nominal
  REQUIRE(probe.call("9811 X20. S1"));
  CHECK(near(probe.variable(5221), 100.3));
  REQUIRE(probe.call("9811 X20."));
  CHECK(near(probe.variable(135), 20));
  // G54.1 P2
  REQUIRE(probe.call("9811 X20.1 S102"));
  CHECK(near(probe.variable(7021), 100.2));
  CHECK_FALSE(probe.call("9811 X20. S149")); // P49: this control has 48
  CHECK(probe.state() == "inconclusive S");
}

TEST_CASE("EasyProbe: signed travel, the feature gets the nominal coordinate") {
  VendorCase probe("easyprobe");
  probe.world.wall(112.5, 0, 180);
  probe.world.wall(80, 0, 0);
  REQUIRE((probe.machine->write(5221, 100) && probe.machine->write(5281, 5)));
  probe.stand(5, 0, 0);
  REQUIRE(probe.call("9023 S57. X10. I0"));
  CHECK(near(probe.variable(5281), 112.5)); // the surface at 112.5 of the machine is 0 of G57
  CHECK(near(probe.variable(138), 12.5));
  CHECK(probe.at() == "5 0 0");
  CHECK(probe.text().find("assumed #138 position-x") != std::string::npos);
  REQUIRE(probe.call("9023 S58. X-25. I-3."));
  CHECK(near(probe.variable(5301), 83));
  // The travel counts: 4 mm do not reach.
  CHECK_FALSE(probe.call("9023 S58. X4. I0"));
  CHECK(probe.machine->end().ending == sim::Ending::Alarm);

  VendorCase bore("easyprobe");
  bore.world.bore(50.2, -9.7, 30.08);
  bore.stand(50, -10, -5);
  REQUIRE(bore.call("9023 D30. S56. I30. J30."));
  CHECK(near(bore.variable(5261), 20.2));
  CHECK(near(bore.variable(5262), -39.7));
  CHECK(near(bore.variable(138), 30.08));
}

TEST_CASE("a bore and a boss: centre, size, errors from where the probe is") {
  for (const double x : {-0.7, 0.0, 0.45}) {
    for (const double y : {-0.3, 0.0, 0.8}) {
      CAPTURE(x);
      CAPTURE(y);
      VendorCase bore;
      bore.world.bore(10 + x, 20 + y, 40.05);
      bore.stand(10, 20, -5);
      REQUIRE(bore.call("9814 D40. S2"));
      CHECK(near(bore.variable(135), 10 + x));
      CHECK(near(bore.variable(136), 20 + y));
      CHECK(near(bore.variable(138), 40.05));
      CHECK(near(bore.variable(140), x));
      CHECK(near(bore.variable(141), y));
      CHECK(near(bore.variable(143), 0.05));
      CHECK(near(bore.variable(5241), x));
      CHECK(near(bore.variable(5242), y));
      CHECK(bore.at() == "10 20 -5");

      VendorCase boss;
      boss.world.boss(10 + x, 20 + y, 39.9, 0);
      boss.stand(10, 20, 10);
      REQUIRE(boss.call("9814 D40. Z-5. R6."));
      CHECK(near(boss.variable(135), 10 + x));
      CHECK(near(boss.variable(136), 20 + y));
      CHECK(near(boss.variable(138), 39.9));
      CHECK(boss.at() == "10 20 10");
    }
  }
  VendorCase island; // R below 0: down into the hole beside an island
  island.world.bore(0.2, 0, 60);
  island.world.boss(0, 0, 20, 0);
  island.stand(0, 0, 10);
  REQUIRE(island.call("9814 D60. Z-5. R-4."));
  CHECK(near(island.variable(135), 0.2));
  CHECK(near(island.variable(138), 60));
}

TEST_CASE("what is in the way beside a boss is PATH OBSTRUCTED, and R has no default") {
  VendorCase blocked;
  blocked.world.boss(0, 0, 40, 0);
  blocked.world.box(30, 0, 10, 200, 5);
  blocked.stand(0, 0, 10);
  CHECK_FALSE(blocked.call("9814 D40. Z-5. R6."));
  CHECK(blocked.machine->end().number == 3086);
  VendorCase plain;
  plain.world.boss(0, 0, 40, 0);
  plain.stand(0, 0, 10);
  CHECK_FALSE(plain.call("9814 D40. Z-5."));
  CHECK(plain.state() == "inconclusive");
  CHECK(plain.machine->end().text.find("P9814") != std::string::npos);
}

TEST_CASE("pocket and web along X and Y") {
  VendorCase pocket;
  pocket.world.wall(25.1, 0, 180);
  pocket.world.wall(-24.7, 0, 0);
  REQUIRE(pocket.call("9812 X50."));
  CHECK(near(pocket.variable(135), 0.2));
  CHECK(near(pocket.variable(138), 49.8));
  CHECK(near(pocket.variable(140), 0.2));
  CHECK(near(pocket.variable(143), -0.2));
  CHECK(pocket.at() == "0 0 0");
  VendorCase web;
  web.world.box(0, 5.3, 100, 30.04, 0);
  web.stand(0, 5, 10);
  REQUIRE(web.call("9812 Y30. Z-3. R5. S1"));
  CHECK(near(web.variable(136), 5.3));
  CHECK(near(web.variable(138), 30.04));
  CHECK(near(web.variable(5222), 0.3));
}

TEST_CASE("the inner corner: both faces, the corner where they are parallel to the axes") {
  VendorCase corner;
  corner.world.wall(-20.3, 0, 0);
  corner.world.wall(0, 15.6, 270);
  REQUIRE(corner.call("9815 X-20. Y15. S4"));
  CHECK(near(corner.variable(135), -20.3));
  CHECK(near(corner.variable(136), 15.6));
  CHECK(near(corner.variable(140), -0.3));
  CHECK(near(corner.variable(141), 0.6));
  CHECK(near(corner.variable(5281), -0.3));
  CHECK(near(corner.variable(5282), 0.6));
  CHECK(corner.at() == "0 0 0");
  CHECK_FALSE(corner.machine->read(139)); // no angle was measured
  CHECK(corner.state() == "inconclusive");
  VendorCase angled;
  CHECK_FALSE(angled.call("9815 X-20. Y15. I8."));
  CHECK(angled.state() == "inconclusive I");
}

TEST_CASE("the angle of a face") {
  for (const double tilt : {-3.0, 0.0, 1.25}) {
    CAPTURE(tilt);
    VendorCase x;
    x.world.wall(20, 0, 180 + tilt); // normal toward -X, the face at 90 + tilt
    REQUIRE(x.call("9843 X20. D24."));
    CHECK(near(x.variable(139), 90 + tilt));
    CHECK(near(x.variable(144), tilt));
    CHECK(x.at() == "0 0 0");
    VendorCase y;
    y.world.wall(0, -20, 90 + tilt);
    REQUIRE(y.call("9843 Y-20. D24. B5."));
    CHECK(near(y.variable(139), tilt));
    CHECK(near(y.variable(144), tilt));
    VendorCase given;
    given.world.wall(0, -20, 90 + tilt);
    REQUIRE(given.call("9843 Y-20. D24. A1."));
    CHECK(near(given.variable(139), tilt));
    CHECK(near(given.variable(144), tilt - 1));
  }
  VendorCase beyond;
  beyond.world.wall(20, 0, 181);
  CHECK_FALSE(beyond.call("9843 X20. D24. B.5"));
  CHECK(beyond.machine->end().ending == sim::Ending::Alarm);
  CHECK(beyond.machine->end().text == "ANGLE OUT OF TOLERANCE");
}

TEST_CASE("oblique: a surface, a pocket, a web, a bore by three points") {
  const double a = 30 * std::numbers::pi / 180;
  VendorCase surface;
  surface.world.wall(20.4 * std::cos(a), 20.4 * std::sin(a), 210);
  REQUIRE(surface.call("9821 A30. D20. S2"));
  CHECK(near(surface.variable(140), 0.4 * std::cos(a)));
  CHECK(near(surface.variable(141), 0.4 * std::sin(a)));
  CHECK(near(surface.variable(5241), 0.4 * std::cos(a)));
  CHECK(surface.at() == "0 0 0");

  VendorCase pocket;
  pocket.world.wall(15.3 * std::cos(a), 15.3 * std::sin(a), 210);
  pocket.world.wall(-14.9 * std::cos(a), -14.9 * std::sin(a), 30);
  REQUIRE(pocket.call("9822 A30. D30."));
  CHECK(near(pocket.variable(138), 30.2));
  CHECK(near(pocket.variable(135), 0.2 * std::cos(a)));
  CHECK(pocket.text().find("assumed #138 size") != std::string::npos);

  VendorCase web;
  web.world.box(0.1 * std::cos(a), 0.1 * std::sin(a), 30, 60, 0, 30);
  web.stand(0, 0, 10);
  REQUIRE(web.call("9822 A30. D30. Z-4. R5."));
  CHECK(near(web.variable(138), 30));
  CHECK(near(web.variable(136), 0.1 * std::sin(a)));

  VendorCase bore;
  bore.world.bore(0.3, -0.4, 50.06);
  REQUIRE(bore.call("9823 A30. B150. C270. D50."));
  CHECK(near(bore.variable(135), 0.3));
  CHECK(near(bore.variable(136), -0.4));
  CHECK(near(bore.variable(138), 50.06));
  VendorCase boss;
  boss.world.boss(0.3, -0.4, 29.95, 0);
  boss.stand(0, 0, 10);
  REQUIRE(boss.call("9823 A0. B120. C240. D30. Z-4. R5."));
  CHECK(near(boss.variable(138), 29.95));
  CHECK(near(boss.variable(135), 0.3));
  VendorCase line;
  line.world.bore(0, 0, 50);
  CHECK_FALSE(line.call("9823 A30. B30. C150. D50."));
  CHECK(line.state() == "inconclusive");
}

TEST_CASE("the stylus: calibrated variables, else what the caller tells, else 0 and a word about it") {
  VendorCase variables("inspection-plus", 3, 99);
  variables.world.wall(20, 0, 180);
  REQUIRE((variables.machine->write(500, 2.9) && variables.machine->write(501, 3.1)));
  REQUIRE(variables.call("9811 X20."));
  CHECK(near(variables.variable(135), 19.9));
  CHECK_FALSE(variables.call("9821 A30. D20.")); // two radii, and an oblique direction
  CHECK(variables.state() == "inconclusive");

  VendorCase none("inspection-plus", 3, std::nullopt);
  none.world.wall(20, 0, 180);
  REQUIRE(none.call("9811 X20."));
  CHECK(near(none.variable(135), 17));
  CHECK(none.text().find("stylus not calibrated: radius 0") != std::string::npos);

  VendorCase offset;
  offset.world.wall(20, 0, 180);
  REQUIRE(
      (offset.machine->write(500, 3) && offset.machine->write(501, 3) && offset.machine->write(502, 0.01)));
  CHECK_FALSE(offset.call("9811 X20."));
  CHECK(offset.state() == "inconclusive");
}

TEST_CASE("tolerances stop the run; the upper limit before anything is set") {
  const auto bored = [](const char* text) {
    VendorCase probe;
    probe.world.bore(0.2, 0, 40.1);
    probe.call(text);
    const sim::RunEnd& end = probe.machine->end();
    return end.ending == sim::Ending::Running ? std::string("runs")
           : end.ending == sim::Ending::Alarm ? end.text
                                              : "inconclusive";
  };
  CHECK(bored("9814 D40. H.15") == "runs");
  CHECK(bored("9814 D40. H.05") == "OUT OF TOLERANCE");
  CHECK(bored("9814 D40. M.5") == "runs");
  CHECK(bored("9814 D40. M.3") == "OUT OF POSITION"); // 0.2 off is beyond a zone of 0.3
  CHECK(bored("9814 D40. U.5") == "runs");
  CHECK(bored("9814 D40. U.15") == "the error is larger than the call allows");
  // No source says whether the macro takes the size of a limit below 0.
  for (const char* const negative :
       {"9814 D40. U-.5", "9814 D40. H-.15", "9814 D40. M-.5", "9811 X20. U-.15"})
    CHECK_MESSAGE(bored(negative) == "inconclusive", negative);
  VendorCase limit;
  limit.world.bore(0.2, 0, 40.1);
  CHECK_FALSE(limit.call("9814 D40. S1 U.15"));
  CHECK(limit.machine->end().ending == sim::Ending::Alarm);
  CHECK(limit.variable(5221) == 0);
}

TEST_CASE("letters that the macro refuses together, and letters that are not known") {
  const auto end = [](const char* text) {
    VendorCase probe;
    probe.world.bore(0, 0, 40);
    CHECK_FALSE(probe.call(text));
    return probe.state() + ": " + probe.machine->end().text;
  };
  CHECK(end("9814 D40. S1 T5") ==
        "alarm 0: program `9814` of `inspection-plus` does not take S and T together");
  CHECK(end("9814 D40. S1 H.1") ==
        "alarm 0: program `9814` of `inspection-plus` does not take S and H together");
  CHECK(end("9814 D40. T5 M.1") == "alarm 0: TM INPUT MIXED");
  CHECK(end("9811 X1. Y1.") == "alarm 0: XY INPUT MIXED");
  CHECK(end("9814 D40. A1.")
            .starts_with("inconclusive A: program `9814` of `inspection-plus` has no argument `A`"));
  CHECK(end("9814 S1").starts_with("inconclusive: the call of program `9814` of `inspection-plus` lacks D"));
  CHECK(end("9816 X1. Y1.").find("the way round the corner") != std::string::npos);
  for (const char* text : {"9819 C100. D10. A0. B4. K5.", "9820 Z0. I1. J1.", "9834", "9834 X1. Y1.",
                           "9835 T1 M2 C3", "9801 K2 D50."})
    CHECK(end(text).starts_with("inconclusive"));
  // A local that no letter sets: argument specification II.
  VendorCase second;
  std::vector<double> locals(34, sim::kNull);
  locals[26] = 0;
  locals[27] = 5;
  CHECK_FALSE(second.meaning.run(*second.machine, 9820, locals));
  CHECK(second.machine->end().text.find("#27") != std::string::npos);
}

TEST_CASE("a tool's length is corrected where all of it is known") {
  VendorCase probe;
  probe.world.halfSpace({0, 0, -19.9}, {0, 0, 1});
  REQUIRE(probe.machine->write(2205, 100));
  CHECK(probe.call("9811 Z-20. T5 F.5")); // 0.1 too high, half of it
  CHECK(near(probe.variable(2205), 99.95));
  CHECK(probe.call("9811 Z-20. T5 F1. V.2")); // within the null band
  CHECK(near(probe.variable(2205), 99.95));
  CHECK_FALSE(probe.call("9811 Z-20. T5")); // which share without F is in no source
  CHECK(probe.state() == "inconclusive T");
  VendorCase diameter;
  diameter.world.bore(0, 0, 40);
  CHECK_FALSE(diameter.call("9814 D40. T5 F1."));
  CHECK(diameter.state() == "inconclusive T");
}

TEST_CASE("the switch of the probe: unknown goes on, off does not") {
  VendorCase probe;
  probe.world.wall(20, 0, 180);
  REQUIRE(probe.call("9832"));
  CHECK(probe.machine->probe() == sim::Machine::Probe::On);
  REQUIRE(probe.call("9811 X20."));
  CHECK(probe.text().find("probe not-switched") == std::string::npos);
  REQUIRE(probe.call("9833"));
  CHECK_FALSE(probe.call("9811 X20."));
  CHECK(probe.state() == "inconclusive");
  CHECK(probe.machine->end().text.find("switched off") != std::string::npos);
  VendorCase code("easyprobe");
  code.world.wall(20, 0, 180);
  REQUIRE(code.run("M31"));
  CHECK(code.machine->probe() == sim::Machine::Probe::On);
  REQUIRE(code.run("M32"));
  CHECK(code.machine->probe() == sim::Machine::Probe::Off);
}

TEST_CASE("what a macro leaves and nobody knows ends the run that uses it") {
  VendorCase probe;
  probe.world.wall(20, 0, 180);
  REQUIRE((probe.machine->write(120, 5) && probe.machine->write(110, 6)));
  REQUIRE(probe.call("9811 X20."));
  CHECK(probe.variable(110) == 6);
  CHECK_FALSE(probe.machine->read(120)); // a work variable of the macros
  CHECK(probe.machine->end().text.find("#120") != std::string::npos);
  VendorCase size;
  size.world.wall(20, 0, 180);
  REQUIRE(size.call("9811 X20."));
  CHECK_FALSE(size.machine->read(138)); // a distance or a size: sources differ
  VendorCase motion;
  motion.world.wall(20, 0, 180);
  REQUIRE(motion.call("9811 X20."));
  CHECK_FALSE(motion.run("X1."));
  CHECK(motion.machine->end().text.find("which motion") != std::string::npos);
  VendorCase told;
  told.world.wall(20, 0, 180);
  REQUIRE(told.call("9811 X20."));
  CHECK(told.run("G0 X1.\nG1 X2. F100.\nX3."));
  CHECK(told.at() == "3 0 0");
}

TEST_CASE("states in which what a macro does is not known") {
  const auto why = [](const char* before) {
    VendorCase probe;
    probe.world.wall(20, 0, 180);
    REQUIRE(probe.run(before));
    CHECK_FALSE(probe.call("9811 X20."));
    CHECK(probe.machine->end().ending == sim::Ending::Inconclusive);
    return probe.machine->end().text;
  };
  CHECK(why("G91").find("G91") != std::string::npos);
  CHECK(why("G20").find("G21") != std::string::npos);
  CHECK(why("G18").find("G17") != std::string::npos);
  CHECK(why("G30 P2 Z0").find("place of the probe") != std::string::npos);
  VendorCase part;
  part.machine->setSkipSignal(nullptr);
  CHECK_FALSE(part.call("9811 X20."));
  CHECK(part.machine->end().text.find("no part") != std::string::npos);
}
