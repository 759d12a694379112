// Our own macros on G31: their text, run on parts of exact geometry.
#include "tests/unit/OwnMacros.h"
#include "driver/Driver.h"
#include "driver/ProgramTools.h"
#include "tests/GoldenRunner.h"

#include <cstdio>

using namespace dotek;
using namespace dotek::tests;

namespace {

// Of G54 on the machine.
constexpr double kX = 100, kY = -200, kZ = -300;
constexpr double kLength = 50, kBall = 3;

struct Own {
  explicit Own(double ball = kBall) : world(ball), signal(world, kLength) {}

  // Is at X Y Z of G54, under G91 and G1 with F1234, and runs `blocks`. #500 to #505: codes and place
  // after them, #506 to #511: offsets of G54 and G57, #512 to #514 of G54.1 P1 (X) and P48 (X, Y).
  const MacroRun& run(const std::string& start, const std::string& blocks,
                      const std::string& control = "fanuc-0i-md") {
    std::string text = fmt::format("O1\nG21G17G40G49G80G90G94G54\nG10L10P1R{}.\n"
                                   "#5221={}.\n#5222={}.\n#5223={}.\n#5281=7.\n#5282=8.\n#5283=9.\n",
                                   kLength, kX, kY, kZ);
    text += "#520=3.\n#521=500.\n#522=50.\n#523=0.5\n" + settings + "G0" + start.substr(0, start.find('Z')) +
            "\nG43H1" + start.substr(start.find('Z')) + "\nG91G1F1234.\n" + modes + blocks + "\n";
    text += "#500=#4001\n#501=#4003\n#502=#4109\nG53\n#503=#5041\n#504=#5042\n#505=#5043-#5083\n"
            "#506=#5221\n#507=#5222\n#508=#5223\n#509=#5281\n#510=#5282\n#511=#5283\n#512=#7001\n#513=#"
            "7941\n#514=#7942\nM30\n";
    last = std::make_unique<MacroRun>(text + ownMacros(), controlOf(control), &signal);
    CHECK(last->run->earlyReads().empty());
    return *last;
  }
  double at(std::uint32_t number) const {
    const std::string text = last->at(number);
    CAPTURE(number);
    REQUIRE_FALSE((text.empty() || text == "null"));
    return *parseNumber(text);
  }
  // #number within a micrometre, or a thousandth of a degree.
  void is(std::uint32_t number, double expected) const {
    CAPTURE(number);
    const double value = at(number);
    CAPTURE(value);
    CAPTURE(expected);
    CHECK(std::abs(value - expected) < 1e-3);
  }

  std::string settings, modes;
  ContactWorld world;
  LongTool signal;
  std::unique_ptr<MacroRun> last;
};

struct Row {
  const char* start;
  const char* call;
  void (*build)(ContactWorld&);
  std::vector<std::pair<std::uint32_t, double>> results;
};

void check(const Row& row, const std::string& control) {
  CAPTURE(row.call);
  CAPTURE(control);
  Own own;
  row.build(own.world);
  const MacroRun& run = own.run(row.start, row.call, control);
  REQUIRE(run.end() == "end");
  for (const auto& [number, value] : row.results)
    own.is(number, value);
  // Back at the start, with the modes and the feed of the caller.
  own.is(500, 1);
  own.is(501, 91);
  own.is(502, 1234);
  double x = 0, y = 0, z = 0;
  REQUIRE(std::sscanf(row.start, "X%lfY%lfZ%lf", &x, &y, &z) == 3);
  own.is(503, x + kX - own.at(506));
  own.is(504, y + kY - own.at(507));
  own.is(505, z + kZ - own.at(508));
}

// Walls and floor in G54.
void wall(ContactWorld& world, double x, double y, double degrees) {
  world.wall(kX + x, kY + y, degrees);
}
void floor(ContactWorld& world, double z) {
  world.halfSpace({0, 0, kZ + z}, {0, 0, 1});
}

} // namespace

TEST_CASE("own macros: features on placed parts, both controls") {
  const std::vector<Row> rows = {
      {"X0Y0Z0", "G65P8811X20.", [](ContactWorld& w) { wall(w, 20.3, 0, 180); }, {{135, 20.3}, {149, 0}}},
      {"X0Y0Z0", "G65P8811X-20.", [](ContactWorld& w) { wall(w, -20.4, 0, 0); }, {{135, -20.4}}},
      {"X2.5Y-1.5Z3.", "G65P8811Y18.", [](ContactWorld& w) { wall(w, 0, 18.75, 270); }, {{136, 18.75}}},
      {"X0Y0Z0", "G65P8811Y-20.Q7.", [](ContactWorld& w) { wall(w, 0, -25.5, 90); }, {{136, -25.5}}},
      {"X0Y0Z10.", "G65P8811Z-20.", [](ContactWorld& w) { floor(w, -19.2); }, {{137, -19.2}}},
      {"X0Y0Z-20.",
       "G65P8811Z12.", // a ceiling: touched with the top of the ball
       [](ContactWorld& w) {
         w.halfSpace({0, 0, kZ + 11.7}, {0, 0, -1});
       },
       {{137, 11.7}}},
      // Offsets: that in force + measured - expected, whatever the system held.
      {"X0Y0Z0",
       "G65P8811X20.S4",
       [](ContactWorld& w) { wall(w, 20.3, 0, 180); },
       {{509, kX + 0.3}, {510, 8}, {511, 9}, {506, kX}}},
      {"X0Y0Z0",
       "G65P8811Z-20.S1.",
       [](ContactWorld& w) { floor(w, -20.25); },
       {{508, kZ - 0.25}, {509, 7}, {506, kX}}},
      // Beyond G59, as Inspection Plus numbers them.
      {"X0Y0Z0",
       "G65P8811X20.S101",
       [](ContactWorld& w) { wall(w, 20.3, 0, 180); },
       {{512, kX + 0.3}, {506, kX}, {509, 7}}},
      {"X10.Y20.Z-5.",
       "G65P8814D40.S148",
       [](ContactWorld& w) { w.bore(kX + 10.7, kY + 19.6, 40.05); },
       {{513, kX + 0.7}, {514, kY - 0.4}, {506, kX}, {507, kY}, {509, 7}}},
      {"X10.Y20.Z-5.",
       "G65P8814D40.S4",
       [](ContactWorld& w) { w.bore(kX + 10.7, kY + 19.6, 40.05); },
       {{135, 10.7}, {136, 19.6}, {138, 40.05}, {509, kX + 0.7}, {510, kY - 0.4}, {511, 9}}},
      {"X10.Y20.Z10.",
       "G65P8814D40.Z-5.R6.S1",
       [](ContactWorld& w) { w.boss(kX + 9.3, kY + 20.8, 39.9, kZ); },
       {{135, 9.3}, {136, 20.8}, {138, 39.9}, {506, kX - 0.7}, {507, kY + 0.8}, {509, 7}}},
      {"X0Y0Z0",
       "G65P8812X50.S4",
       [](ContactWorld& w) {
         wall(w, 25.1, 0, 180);
         wall(w, -24.7, 0, 0);
       },
       {{135, 0.2}, {138, 49.8}, {509, kX + 0.2}, {510, 8}}},
      {"X4.Y0Z0",
       "G65P8812Y50.",
       [](ContactWorld& w) {
         wall(w, 0, 25.1, 270);
         wall(w, 0, -25.3, 90);
       },
       {{136, -0.1}, {138, 50.4}}},
      {"X5.Y5.Z10.",
       "G65P8812Y30.Z-3.R5.S1",
       [](ContactWorld& w) { w.box(kX, kY + 5.3, 100, 30.04, kZ); },
       {{136, 5.3}, {138, 30.04}, {507, kY + 0.3}, {506, kX}}},
      {"X5.Y5.Z10.",
       "G65P8812X30.Z-3.R5.",
       [](ContactWorld& w) { w.box(kX + 4.6, kY, 30.04, 100, kZ); },
       {{135, 4.6}, {138, 30.04}}},
      {"X0Y0Z-5.",
       "G65P8815X-20.Y15.S4",
       [](ContactWorld& w) {
         wall(w, -20.3, 0, 0);
         wall(w, 0, 15.6, 270);
       },
       {{135, -20.3}, {136, 15.6}, {509, kX - 0.3}, {510, kY + 0.6}}},
      {"X-15.Y-12.Z-5.",
       "G65P8816X0Y0I10.J12.S4",
       [](ContactWorld& w) { w.box(kX + 50.2, kY + 49.7, 100, 100, kZ); },
       {{135, 0.2}, {136, -0.3}, {509, kX + 0.2}, {510, kY - 0.3}}},
      {"X115.Y112.Z-5.",
       "G65P8816X100.Y100.I10.J12.",
       [](ContactWorld& w) { w.box(kX + 50.2, kY + 49.7, 100, 100, kZ); },
       {{135, 100.2}, {136, 99.7}}},
      {"X0Y0Z0",
       "G65P8843X20.D16.",
       [](ContactWorld& w) { wall(w, 20.3, 0, 181.5); },
       {{139, 91.5}, {144, 1.5}}},
      {"X0Y0Z0",
       "G65P8843X20.D16.A87.",
       [](ContactWorld& w) { wall(w, 20, 0, 177.25); },
       {{139, 87.25}, {144, 0.25}}},
      {"X0Y0Z0", "G65P8843X20.D16.", [](ContactWorld& w) { wall(w, 20.3, 0, 180); }, {{139, 90}, {144, 0}}},
      {"X0Y0Z0", "G65P8843Y20.D16.", [](ContactWorld& w) { wall(w, 0, 20, 272); }, {{139, 2}, {144, 2}}},
      {"X0Y0Z0",
       "G65P8843Y-20.D16.A-1.",
       [](ContactWorld& w) { wall(w, 0, -20, 88); },
       {{139, -2}, {144, -1}}},
      // A face has two directions: the one nearer to the expected, half a turn away or more.
      {"X0Y0Z0",
       "G65P8843Y20.D16.A181.",
       [](ContactWorld& w) { wall(w, 0, 20, 272); },
       {{139, 182}, {144, 1}}},
      {"X0Y0Z0",
       "G65P8843X20.D16.A-92.",
       [](ContactWorld& w) { wall(w, 20.3, 0, 181.5); },
       {{139, -88.5}, {144, 3.5}}},
      {"X0Y0Z0",
       "G65P8843Y20.D16.A-358.",
       [](ContactWorld& w) { wall(w, 0, 20, 272); },
       {{139, -358}, {144, 0}}},
      {"X2.Y1.Z0",
       "G65P8821A30.D20.S4",
       [](ContactWorld& w) { wall(w, 2 + 20.4 * 0.8660254038, 1 + 20.4 * 0.5, 210); },
       {{135, 19.6669}, {136, 11.2}, {509, kX + 0.3464}, {510, kY + 0.2}, {511, 9}, {149, 0}}},
      {"X0Y0Z0",
       "G65P8821A-90.D20.",
       [](ContactWorld& w) { wall(w, 0, -19.5, 90); },
       {{135, 0}, {136, -19.5}, {509, 7}}},
      {"X0Y0Z0",
       "G65P8822A45.D50.",
       [](ContactWorld& w) {
         wall(w, 25.2 * 0.7071067812, 25.2 * 0.7071067812, 225);
         wall(w, -24.8 * 0.7071067812, -24.8 * 0.7071067812, 45);
       },
       {{135, 0.1414}, {136, 0.1414}, {138, 50}}},
      {"X10.Y20.Z-5.",
       "G65P8823A10.B130.C-110.D40.S4",
       [](ContactWorld& w) { w.bore(kX + 10.7, kY + 19.6, 40.05); },
       {{135, 10.7}, {136, 19.6}, {138, 40.05}, {509, kX + 0.7}, {510, kY - 0.4}, {511, 9}}},
      {"X10.Y20.Z10.",
       "G65P8823A0B100.C230.D40.Z-5.R6.S1",
       [](ContactWorld& w) { w.boss(kX + 9.3, kY + 20.8, 39.9, kZ); },
       {{135, 9.3}, {136, 20.8}, {138, 39.9}, {506, kX - 0.7}, {507, kY + 0.8}, {509, 7}}},
  };
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b"})
    for (const Row& row : rows)
      check(row, control);
}

TEST_CASE("own macros: M1 of a touch leaves a flag instead of an alarm, and sets nothing") {
  const auto away = [](ContactWorld& w) { wall(w, 60, 0, 180); };
  const auto there = [](ContactWorld& w) { wall(w, 20.3, 0, 180); };
  const std::vector<Row> rows = {
      {"X1.Y2.Z3.", "G65P8811X20.S4M1", away, {{149, 2}, {509, 7}, {510, 8}, {511, 9}}},
      {"X1.Y2.Z3.", "G65P8811Z-20.M1", away, {{149, 2}}},
      {"X1.Y2.Z3.", "G65P8811X20.S4M1", there, {{149, 0}, {135, 20.3}, {509, kX + 0.3}}},
      {"X1.Y2.Z3.", "G65P8821A0D20.S4M1", away, {{149, 2}, {509, 7}, {510, 8}, {511, 9}}},
      {"X1.Y2.Z3.", "G65P8821A0D20.S4M1", there, {{149, 0}, {135, 20.3}, {509, kX - 0.7}}},
      // A touch that found something wipes out the flag of the one before.
      {"X1.Y2.Z3.", "G65P8811X-20.M1\nG65P8811X20.", there, {{149, 0}, {135, 20.3}}},
  };
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b"})
    for (const Row& row : rows)
      check(row, control);
}

TEST_CASE("own macros: a protected move, free and obstructed") {
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b"}) {
    CAPTURE(control);
    Own free;
    REQUIRE(free.run("X0Y0Z50.", "G65P8810X10.Y-5.F2000.", control).end() == "end");
    free.is(503, 10);
    free.is(504, -5);
    free.is(505, 50);
    free.is(148, 0);
    free.is(501, 91);
    free.is(500, 1);
    free.is(502, 2000); // stays, as the feed of the next one
    Own next;
    REQUIRE(next.run("X0Y0Z50.", "G65P8810Z20.", control).end() == "end"); // with the feed in force
    next.is(505, 20);
    next.is(502, 1234);

    Own blocked;
    floor(blocked.world, 0);
    CHECK(blocked.run("X0Y0Z50.", "G65P8810Z-5.F2000.", control).end() == "alarm 3086");
    CHECK(blocked.last->machine->end().text == "PATH OBSTRUCTED");
    Own told;
    floor(told.world, 0);
    REQUIRE(told.run("X0Y0Z50.", "G65P8810Z-5.F2000.M1", control).end() == "end");
    told.is(148, 7);
    told.is(505, 0); // the ball's lowest point
  }
}

TEST_CASE("own macros: the touch is repeated from nearby, at the second feed") {
  Own own;
  wall(own.world, 20.3, 0, 180);
  const MacroRun& run = own.run("X0Y0Z0", "G65P8811X20.");
  CHECK(own.world.moves == 2);
  CHECK(run.trace.find("F500") != std::string::npos);
  CHECK(run.trace.find("F50.") != std::string::npos);
  Own near; // nearer than the path back
  wall(near.world, 3.3, 0, 180);
  REQUIRE(near.run("X0Y0Z0", "G65P8811X4.").end() == "end");
  near.is(135, 3.3);
}

TEST_CASE("own macros: alarms") {
  struct Bad {
    const char* call;
    const char* end;
    const char* settings = "";
    const char* modes = "";
    void (*build)(ContactWorld&) = [](ContactWorld&) {};
  };
  const auto near = [](ContactWorld& w) { wall(w, 3, 0, 180); };
  const Bad rows[] = {
      {"G65P8811X20.", "alarm 3093"},
      {"G65P8814D40.", "alarm 3093"},
      {"G65P8811X20.", "alarm 3092", "", "", near},
      {"G65P8811X20.M1", "alarm 3092", "", "", near},
      {"G65P8811X20.M0", "alarm 3093"},
      {"G65P8821A10.D20.M2", "alarm 3093"},
      {"G65P8811X20.", "alarm 3095", "#520=0\n"},
      {"G65P8811X20.", "alarm 3095", "#521=#0\n"},
      {"G65P8811X20.", "alarm 3095", "#522=0\n"},
      {"G65P8811X20.", "alarm 3095", "#523=#0\n"},
      {"G65P8814D40.", "alarm 3095", "#520=0\n"},
      {"G65P8812X40.", "alarm 3095", "#520=#0\n"},
      {"G65P8811", "alarm 3091"},
      {"G65P8811X20.Y3.", "alarm 3091"},
      {"G65P8811X0.", "alarm 3091"},
      {"G65P8811X20.S7", "alarm 3091"},
      {"G65P8811X20.S2.5", "alarm 3091"},
      {"G65P8811X20.Q-1.", "alarm 3091"},
      {"G65P8811X2.Q0.5", "alarm 3091"}, // it would go the other way
      {"G65P8812X5.Q0.4", "alarm 3091"},
      {"G65P8814D5.Q0.4", "alarm 3091"},
      {"G65P8812", "alarm 3091"},
      {"G65P8812X20.Z-3.", "alarm 3091"},
      {"G65P8814", "alarm 3091"},
      {"G65P8814D20.Z-3.", "alarm 3091"},
      {"G65P8815X5.", "alarm 3091"},
      {"G65P8816X5.Y5.I3.", "alarm 3091"},
      {"G65P8843X5.", "alarm 3091"},
      {"G65P8821A10.", "alarm 3091"},
      {"G65P8821D10.", "alarm 3091"},
      {"G65P8821A10.D20.S7", "alarm 3091"},
      {"G65P8821A10.D20.", "alarm 3093"},
      {"G65P8821A10.D20.", "alarm 3092", "", "", near},
      {"G65P8821A10.D20.", "alarm 3095", "#520=0\n"},
      {"G65P8821A10.D20.", "alarm 3095", "#523=0\n"},
      {"G65P8811X20.S7", "alarm 3091"},
      {"G65P8811X20.S100", "alarm 3091"},
      {"G65P8811X20.S149", "alarm 3091"},
      {"G65P8811X20.S101.5", "alarm 3091"},
      {"G65P8821A10.D2.Q0.5", "alarm 3091"},
      {"G65P8822A10.", "alarm 3091"},
      {"G65P8822A10.D5.Q0.4", "alarm 3091"},
      {"G65P8822A10.D20.Z-3.", "alarm 3091"},
      {"G65P8823A10.B130.D20.", "alarm 3091"},
      {"G65P8823A10.B130.C250.", "alarm 3091"},
      {"G65P8823A10.B130.C250.D20.Z-3.", "alarm 3091"},
      {"G65P8823A10.B130.C250.D40.", "alarm 3093"},
      {"G65P8823A10.B130.C250.D40.", "alarm 3095", "#520=0\n"},
      {"G65P8810F100.", "alarm 3091"},
      {"G65P8810X5.F0", "alarm 3088"},
      {"G65P8810X5.", "alarm 3088", "", "F0\n"},
      {"G65P8811X20.", "alarm 3096", "", "G95F1.\n"},
      {"G65P8811X20.", "alarm 3096", "", "G20\n"},
      {"G65P8811X20.", "alarm 3096", "", "G49\n"},
      {"G65P8810X20.", "alarm 3096", "", "G49\n"},
  };
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b"}) {
    for (const Bad& row : rows) {
      CAPTURE(control);
      CAPTURE(row.call);
      CAPTURE(row.settings);
      CAPTURE(row.modes);
      Own own;
      row.build(own.world);
      own.settings = row.settings;
      own.modes = row.modes;
      CHECK(own.run("X0Y0Z0", row.call, control).end() == row.end);
    }
  }
  Own extended;
  extended.modes = "G54.1P1\n";
  wall(extended.world, -80, 0, 180);
  CHECK(extended.run("X0Y0Z0", "G65P8811X20.S2", "fanuc-31i-b").end() == "alarm 3097");
  Own open; // no contact: the probe goes back before the alarm
  CHECK(open.run("X1.5Y0Z0", "G65P8811X20.").end() == "alarm 3093");
  CHECK(open.last->machine->position()[0] == doctest::Approx(1.5));
  CHECK(open.last->at(149) == "2");
}

TEST_CASE("own macros: lint finds nothing, on both controls") {
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b"}) {
    driver::LintOptions lint;
    lint.paths = {(root() / "stdlib/macrob/dotek.nc").generic_string()};
    lint.control = control;
    const driver::Outcome outcome = driver::lint(lint);
    CHECK_MESSAGE(outcome.output.empty(), outcome.output);
    CHECK(outcome.status == 0);
    CHECK(outcome.diagnostics.all().empty());
  }
}

TEST_CASE("own macros: `new macros` prints the text for the control, and has none of a vendor") {
  const driver::Outcome own = driver::newMacros("dotek", {});
  CHECK(own.status == 0);
  CHECK(own.output == readAll(root() / "stdlib/macrob/dotek.nc"));
  const std::string moved = driver::newMacros("dotek@900", {}).output;
  CHECK(moved.size() == own.output.size());
  CHECK(moved.find("#52") == std::string::npos);
  CHECK(moved.find("F#901\n") != std::string::npos);
  for (const char* none : {"inspection-plus@900", "dotek@", "dotek@x", "dotek@90", "dotek@900x"})
    CHECK(driver::newMacros(none, {}).status == 1);
  const driver::Outcome vendor = driver::newMacros("inspection-plus", {});
  CHECK(vendor.status == 1);
  CHECK(vendor.output.empty());
  REQUIRE_FALSE(vendor.diagnostics.all().empty());
  CHECK(vendor.diagnostics.all().front().code == "no-macro-text");
  const CommandResult written = runDotek({"new", "macros", "dotek", "-o", "-"}, root());
  CHECK(written.out == own.output);
}
