// Two runs side by side: each aspect of a comparison tells a difference, and only that.
#include "sim/machine/Compile.h"
#include "sim/vendor/VendorMacros.h"
#include "tests/MeasuringCycles.h"
#include "tests/unit/RunHarness.h"
#include "verify/Compare.h"
#include "verify/Stand.h"

#include <algorithm>

using namespace dotek;
using namespace dotek::tests;
using verify::Aspect;

namespace {

// Blocks of O1, and what it calls; a wall at X = 30 of G54.
struct OneRun {
  explicit OneRun(const std::string& blocks, const std::string& macros = "inspection-plus",
                  verify::Entry entry = {}, verify::Stand::Way way = verify::Stand::Way::Run,
                  bool passUnstated = false)
      : profile(controlOf("fanuc-31i-b")), set(*stdlib::MacroSet::load(stdlib::DataFiles(), macros)),
        meaning(set, profile, measuringCycles()), parsed("%\nO1\n" + blocks + "M30\n%\n") {
    file = frontend::macrob::lower(parsed.file, profile, parsed.sources, parsed.diagnostics);
    CAPTURE(blocks);
    CAPTURE(parsed.told());
    REQUIRE(file);
    meaning.setStylusRadius(3);
    if (passUnstated) meaning.passUnstated();
    sim::PartBuilder builder;
    const sim::Point3 zero = verify::standZeros()[0];
    builder.box(zero + sim::Point3{30, -20, -20}, zero + sim::Point3{60, 20, 20});
    std::string fault;
    sim::Probe probe;
    probe.length = 150;
    probe.on = false;
    sim::World world(*builder.finish(fault), probe);
    const sim::Bytecode code = sim::compile({&file->programs.front()}, profile, parsed.sources);
    verify::Stand stand(profile, {&set}, limits);
    entry.start.z = 5;
    record = stand.run(code, world, entry, {500, 501}, &meaning, way);
  }
  std::string at(SourceRange range) const { return parsed.sources.textUtf8(range); }

  stdlib::Control profile;
  stdlib::MacroSet set;
  sim::VendorMacros meaning;
  MacroFile parsed;
  Limits limits;
  std::optional<ir::ProgramFile> file;
  verify::Record record;
};

std::vector<Aspect> differing(const std::string& one, const std::string& other, bool restores = false) {
  const OneRun source(one), target(other);
  verify::CompareRules rules;
  rules.mayRestoreModes = restores;
  std::vector<Aspect> out;
  for (const verify::Difference& difference : verify::compare(source.record, target.record, rules)) {
    CHECK_FALSE(difference.text.empty());
    out.push_back(difference.aspect);
  }
  return out;
}

using Aspects = std::vector<Aspect>;
const std::string kOn = "G65P9832\n";
const std::string kTouch = kOn + "G65P9811X30.S2\n";

} // namespace

TEST_CASE("verify: a feed differs by more than a millionth") {
  CHECK(differing("G1X10.F250000.\n", "G1X10.F249999.9\n").empty());
  CHECK(differing("G1X10.F250000.\n", "G1X10.F249999.\n") == Aspects{Aspect::State});
  CHECK(differing("G1X10.F250.\n", "G1X10.F250.01\n") == Aspects{Aspect::State});
}

TEST_CASE("verify: an angle of a face is as exact as its touches are apart") {
  verify::Measure face;
  face.nominal = {{{10, 0, 0}, {1, 0, 0}}, {{10, 5, 0}, {1, 0, 0}}};
  verify::Record source, target;
  source.measures = target.measures = {face};
  source.stores[601] = -0.292997;
  target.stores[601] = -0.29289;
  verify::CompareRules rules;
  rules.results = 5e-5;
  CHECK(verify::compare(source, target, rules).empty());
  target.stores[601] = -0.2915;
  CHECK(verify::compare(source, target, rules).size() == 1);
  source.measures[0].nominal[1].point.y = target.measures[0].nominal[1].point.y = 80;
  target.stores[601] = -0.29289;
  CHECK(verify::compare(source, target, rules).size() == 1);
}

TEST_CASE("verify: the same program does the same") {
  CHECK(differing(kTouch, kTouch).empty());
  CHECK(differing("G0X10.\nG0X20.\n", "G0X20.\n").empty());                   // in one line
  CHECK(differing("G0X10.\nX20.Y5.\n", "G91G0X10.\nX10.Y5.\nG90\n").empty()); // another way to say it
}

TEST_CASE("verify: each aspect has its difference") {
  CHECK(differing("G0X10.\n", "G0X11.\n") == Aspects{Aspect::Path, Aspect::End});
  CHECK(differing("POPEN\nDPRNT[A]\nPCLOS\n", "POPEN\nDPRNT[A]\n") == Aspects{Aspect::Printed});
  CHECK(differing("G0X10.\nX0\n", "G1X10.F500.\nG0X0\n") == Aspects{Aspect::Path});
  CHECK(differing("G0X10.\nX20.\nX10.\n", "G0X10.\n") == Aspects{Aspect::Path});
  CHECK(differing(kOn + "G65P9810X10.F500.\n", kOn + "G1X10.F500.\nG0\n") == Aspects{Aspect::Path});
  CHECK(differing("M3S100\nG0X10.\nM5\n", "G0X10.\nM5\n") == Aspects{Aspect::State});
  CHECK(differing("M8\nG0X10.\n", "M9\nG0X10.\n") == Aspects{Aspect::State});
  CHECK(differing("G65P9832\nG0X1.\n", "G65P9833\nG0X1.\n") == Aspects{Aspect::State});
  CHECK(differing("M3S100\nG0X1.\n", "M3S100\nG0X1.\nM5\n") == Aspects{Aspect::State}); // at the end
  CHECK(differing("G65P9832\nG0X1.\nG65P9833\n", "G65P9832\nG0X1.\n") == Aspects{Aspect::State});
  CHECK(differing("G1X10.F500.\nG0X0\n", "G1X10.F5000.\nG0X0\n") == Aspects{Aspect::State});
  CHECK(differing(kOn + "G65P9810X10.F500.\n", kOn + "G65P9810X10.F900.\n") == Aspects{Aspect::State});
  CHECK(differing(kOn + "G65P9810X10.F500.\n", kOn + "G65P9810X10.\n") == Aspects{Aspect::State});
  CHECK(differing(kOn + "G65P9810X10.F500.\nG65P9810X20.F90.\n", kOn + "G65P9810X20.F500.\n") ==
        Aspects{Aspect::State}); // not in one piece
  CHECK(differing(kOn + "G65P9810X10.F500.\nG65P9810X20.F500.\n",
                  kOn + "G65P9810X10.F500.\nG65P9810X20.F90.\n") == Aspects{Aspect::State});
  CHECK(differing(kTouch, kOn + "G65P9811X30.5S2\n") == Aspects{Aspect::Nominal, Aspect::Offset});
  CHECK(differing(kTouch, kOn + "G65P9811X30.S3\n") == Aspects{Aspect::Offset, Aspect::Offset});
  CHECK(differing(kTouch, kOn + "G0Y1.\n" + "G65P9811X30.S2\nG0Y0\n") ==
        Aspects{Aspect::Path, Aspect::Nominal, Aspect::Contact});
  CHECK(differing(kOn + "G31X40.F100.\n", kOn + "G31X45.F100.\n") ==
        Aspects{Aspect::Nominal}); // the wall comes before
  CHECK(differing("#500=1.\n", "#500=1.1\n") == Aspects{Aspect::Variable});
  CHECK(differing("#500=1.\n", "\n") == Aspects{Aspect::Variable});
  CHECK(differing("#502=1.\n", "#502=2.\n").empty());              // not asked for
  CHECK(differing("#7002=5.\n", "\n") == Aspects{Aspect::Offset}); // of G54.1 P1
  CHECK(differing("\n", "#7002=5.\n") == Aspects{Aspect::Offset});
  CHECK(differing("#7002=5.\n", "#7022=5.\n") == Aspects{Aspect::Offset, Aspect::Offset});
  CHECK(differing("#7002=5.\n", "#7002=5.\n").empty());
  CHECK(differing("G91\n", "G90\n") == Aspects{Aspect::Modal});
  CHECK(differing("G91\n", "G90\n", true).empty()); // as it stood at entry
  CHECK(differing("G90\n", "G91\n", true) == Aspects{Aspect::Modal});
}

namespace {

// Of the first difference of the aspect.
std::string toldOf(Aspect aspect, const std::string& one, const std::string& other) {
  const OneRun source(one, "inspection-plus", {}, verify::Stand::Way::Run, true);
  const OneRun target(other, "inspection-plus", {}, verify::Stand::Way::Run, true);
  verify::CompareRules rules;
  rules.sameAlarmNumbers = true;
  for (const verify::Difference& difference : verify::compare(source.record, target.record, rules))
    if (difference.aspect == aspect) return difference.text;
  return "";
}

} // namespace

namespace {

// The lines of the two sides that each difference names, and what it says.
std::vector<std::string> namedBy(const std::string& one, const std::string& other,
                                 const verify::CompareRules& rules = {}) {
  const OneRun source(one), target(other);
  std::vector<std::string> out;
  for (const verify::Difference& difference : verify::compare(source.record, target.record, rules))
    out.push_back(source.at(difference.source) + " | " + target.at(difference.target) + " | " +
                  difference.text);
  return out;
}

using Told = std::vector<std::string>;

} // namespace

TEST_CASE("verify: each variable and offset that differs is told, where the two first write it differently") {
  CHECK(namedBy("#500=1.\n#501=1.\n", "#500=2.\n#501=3.\n") ==
        Told{"#500=1. | #500=2. | #500 is 1 against 2", "#501=1. | #501=3. | #501 is 1 against 3"});
  CHECK(namedBy("#500=1.\n#500=#500+1.\n", "#500=3.\n#500=#500+1.\n") ==
        Told{"#500=1. | #500=3. | #500 is 2 against 4"});
  CHECK(namedBy("#500=1.\n#500=#500+1.\n", "#500=1.\n#500=#500+2.\n") ==
        Told{"#500=#500+1. | #500=#500+2. | #500 is 2 against 3"});
  CHECK(namedBy("#500=1.\n#500=#500+1.\n", "#500=1.\n") == Told{"#500=#500+1. |  | #500 is 2 against 1"});
  CHECK(namedBy("#500=1.\n", "#501=1.\n").front() ==
        "#500=1. |  | #500: the source leaves it at 1, the translation does not write it");
  CHECK(
      namedBy("#5241=1.\n#5242=2.\n", "#5241=1.5\n#5242=3.\n") ==
      Told{"#5241=1. | #5241=1.5 | the zero of G55 along X lies at 1.000000 of the machine against 1.500000",
           "#5242=2. | #5242=3. | the zero of G55 along Y lies at 2.000000 of the machine against 3.000000"});
  CHECK(namedBy("#5241=1.\n#5241=#5241+1.\n", "#5241=4.\n#5241=#5241+1.\n")
            .front()
            .find("#5241=1. | #5241=4. | ") == 0);
}

TEST_CASE("verify: a register that only one side writes is named with the side that does") {
  const Told wrong = namedBy("#5261=1.\n", "#5281=1.\n");
  REQUIRE(wrong.size() == 2);
  CHECK(wrong[0].find("#5261=1. |  | the source moves the zero of G56 along X") == 0);
  CHECK(wrong[1] == " | #5281=1. | the translation moves the zero of G57 along X to 1.000000 of the machine, "
                    "the source does not");
  // A measure that sets the one and a measure that sets the other are a pair.
  const Told called = namedBy(kTouch, kOn + "G65P9811X30.S3\n");
  REQUIRE(called.size() == 2);
  CHECK(called[0].find("G65P9811X30.S2 | G65P9811X30.S3 | the source moves the zero of G55") == 0);
  CHECK(called[1].find("G65P9811X30.S2 | G65P9811X30.S3 | the translation moves the zero of G56") == 0);
}

TEST_CASE("verify: a zero that was written otherwise before the path goes another way is the cause") {
  const std::string rest = "G65P9810X20.\nG65P9810Z0\nG65P9810X31.\n";
  const Told found = namedBy(kOn + "#5221=#5221-20.\n" + rest, kOn + "#5221=#5221+9.\n" + rest);
  REQUIRE(found.size() == 1);
  CHECK_MESSAGE(found[0].find("#5221=#5221-20. | #5221=#5221+9. | G54 X is set to") == 0, found[0]);
  CHECK_MESSAGE(found[0].find("; then the source ends, the translation stops with") != std::string::npos,
                found[0]);
}

TEST_CASE("verify: a feed that changes in a straight path is named where it does") {
  CHECK(namedBy(kOn + "G65P9810X10.F500.\nG65P9810X20.F500.\n",
                kOn + "G65P9810X10.F500.\nG65P9810X20.F90.\n") ==
        Told{"G65P9810X20.F500. | G65P9810X20.F90. | F500 against F90"});
  // Another place is one, whatever the feed.
  CHECK(differing(kOn + "G65P9810X10.F500.\nG65P9810X10.Y9.F90.\n",
                  kOn + "G65P9810X12.F500.\nG65P9810X10.Y9.F90.\n") == Aspects{Aspect::Path});
}

TEST_CASE("verify: a difference names its sides and shows what differs") {
  // The same place from the other side: the letter that says so.
  const std::string side = kOn + "G65P9812X30.Z-5.R";
  const std::string nominal = toldOf(Aspect::Nominal, side + "6.\n", side + "-6.\n");
  CAPTURE(nominal);
  CHECK(nominal.find("along X") != std::string::npos);
  CHECK(nominal.ends_with("(P9812 with R6 against R-6)"));
  CHECK(toldOf(Aspect::State, kOn + "G65P9810Z-1.F2500.\nG65P9810Z-2.F250.\nX1.\n",
               kOn + "G65P9810Z-1.F250.\nG65P9810Z-2.F250.\nX1.\n")
            .find("F2500 against F250") != std::string::npos);
  CHECK(toldOf(Aspect::Variable, "#500=28.04904099999999\n", "#500=0.0000409999999\n") ==
        "#500 is 28.049041 against 0.000041");
  CHECK(toldOf(Aspect::Variable, "#500=1.\n", "\n") ==
        "#500: the source leaves it at 1, the translation does not write it");
  CHECK(toldOf(Aspect::Ending, "G0X1.\n", "G0X1.\n#3000=9(NO)\n") ==
        "the source ends, the translation stops with alarm 3009 (NO)");
  CHECK(toldOf(Aspect::State, "M19\n", "\n") == "the source has M19, the translation nothing");
  CHECK(toldOf(Aspect::Path, "G0X10.\nY20.\n", "G0X10.\n").ends_with(", the translation does not"));
}

TEST_CASE("verify: what is on counts where the probe is switched, and where the program stops itself") {
  CHECK(differing("M8\nM9\nG65P9832\n", "M8\nG65P9832\nM9\n").empty()); // other macros may be there
  CHECK(toldOf(Aspect::State, "M8\nM9\nG65P9832\n", "M8\nG65P9832\nM9\n") ==
        "coolant off against flood where the probe is switched");
  const std::string stop = "#3000=9(NO)\n";
  CHECK(toldOf(Aspect::State, kOn + "G0X1.\nG65P9833\n" + stop, kOn + "G0X1.\n" + stop) ==
        "probe off against on at its alarm");
  CHECK(toldOf(Aspect::State, kOn + "G0X1.\n" + stop, kOn + "G0X1.\n" + stop).empty());
}

TEST_CASE("verify: tools, M codes, stops and dwells count, where and in which order they come") {
  const Aspects state{Aspect::State};
  CHECK(differing("T20M6\nG0X1.\n", "T20M6\nG0X1.\n").empty());
  CHECK(differing("T20\nM6\nG0X1.\n", "T20M6\nG0X1.\n").empty());
  CHECK(differing("T20M6\nG0X1.\n", "T20\nG0X1.\n") == state);
  CHECK(differing("T20M6\nG0X1.\n", "T21M6\nG0X1.\n") == state);
  CHECK(differing("T20M6\nT1\n", "T20M6\n") == state); // the next tool is looked for
  CHECK(differing("T20M6\nG0X1.\n", "G0X1.\nT20M6\n") == state);
  CHECK(differing("M19\n", "\n") == state);
  CHECK(differing("#3006=1(LOOK)\n", "\n") == state);
  CHECK(differing("#3006=1(LOOK)\n", "#3006=1(GO ON)\n") == state);
  CHECK(differing("#3006=1(LOOK)\n", "#3006=2(LOOK)\n") == state);
  CHECK(differing("M0\n", "#3006=1(STOP)\n").empty());                     // M0 has none
  const std::string longStop = "#3006=1(SIDE FAR OFF, G56 NOT CHANGED)\n"; // is cut after 26 at most
  CHECK(differing(longStop, "#3006=1(SIDE FAR OFF, G56 NOT)\n").empty());
  CHECK(differing(longStop, "#3006=1(SIDE FAR OFF, G56)\n") == state);
  CHECK(differing("\n", "M19\n") == state);
  CHECK(differing("M19\nG0X1.\n", "G0X1.\nM19\n") == state);
  CHECK(differing("T20M6\nM19\n", "M19\nT20M6\n") == state);
  CHECK(differing("M3S100\nM19\nM5\n", "M3S100\nM5\nM19\n") == state); // it turns
  CHECK(differing(kTouch + "M19\n", "M19\n" + kTouch) == state);
  CHECK(differing("M0\n", "\n") == state);
  CHECK(differing("M1\n", "M0\n") == state);
  CHECK(differing("G4P500\n", "\n") == state);
  CHECK(differing("G4P500\n", "G4P600\n") == state);
  CHECK(differing("M3S100\nG0X1.\nM5\n", "M3S200\nG0X1.\nM5\n") == state);
  CHECK(differing("S100\nG0X1.\n", "S200\nG0X1.\n").empty()); // nothing turns
}

TEST_CASE("verify: what the translation meets and the source does not") {
  // The same way; the part is where only the second runs.
  const OneRun source(kOn + "G1X20.F500.\nG0X0\n"), target(kOn + "G1X40.F500.\nG0X0\n");
  REQUIRE(source.record.events.empty());
  REQUIRE_FALSE(target.record.events.empty());
  verify::Record met = source.record;
  met.events = target.record.events;
  const auto found = verify::compare(source.record, met, {});
  REQUIRE(found.size() == 1);
  CHECK(found.front().aspect == Aspect::Contact);
  CAPTURE(found.front().text);
  CHECK(found.front().text.starts_with("the translation meets what the source does not: a "));
  CHECK(verify::compare(met, met, {}).empty());
}

TEST_CASE("verify: where a stem stops the source, results count as exactly as that place is known") {
  OneRun source(kOn + "G31X40.F100.\n"), target(kOn + "G31X40.F100.\n");
  const auto moved = [&](double by) {
    verify::Record other = target.record;
    other.zeros.at({55, 0}) += by;
    return !verify::compare(source.record, other, {}).empty();
  };
  CHECK(moved(0.0001));
  sim::ProbeEvent met;
  met.outcome = sim::Outcome::Miss;
  source.record.events = target.record.events = {{met, {}}};
  CHECK(moved(0.0001));
  for (const sim::Outcome outcome : {sim::Outcome::StemCollision, sim::Outcome::BodyCollision}) {
    met.outcome = outcome;
    source.record.events = target.record.events = {{met, {}}};
    CHECK_FALSE(moved(0.0009));
    CHECK(moved(0.0021));
  }
}

TEST_CASE("verify: a move that vanishes where both its ends are rounded") {
  const OneRun run(kOn + "G1Y5.F500.\nG0Z9.\n");
  const auto same = [&](double length, double tolerance, bool turned = false) {
    verify::Record source = run.record;
    verify::Piece& first = source.pieces.front();
    verify::Piece tiny = first;
    tiny.from.x -= length / 2;
    first.from.x += length / 2;
    tiny.to = first.from;
    source.pieces.insert(source.pieces.begin(), tiny);
    verify::CompareRules rules;
    rules.tolerance = tolerance;
    return (turned ? verify::compare(run.record, source, rules) : verify::compare(source, run.record, rules))
        .empty();
  };
  CHECK(same(0.001, 0.0006));
  CHECK(same(0.001, 0.0006, true));
  CHECK_FALSE(same(0.001, 0.0004));
  CHECK_FALSE(same(0.0021, 0.0006));
  CHECK_FALSE(same(0.0021, 0.0006, true));
  // The last move of one side.
  const auto last = [&](double length, bool turned) {
    verify::Record source = run.record;
    verify::Piece tiny = source.pieces.back();
    tiny.from = tiny.to;
    tiny.to.y += length;
    source.pieces.push_back(tiny);
    verify::CompareRules rules;
    rules.tolerance = 0.0006;
    return (turned ? verify::compare(run.record, source, rules) : verify::compare(source, run.record, rules))
        .empty();
  };
  for (const bool turned : {false, true}) {
    CHECK(last(0.001, turned));
    CHECK_FALSE(last(0.0021, turned));
  }
}

TEST_CASE("verify: endings") {
  CHECK(differing("#3000=5(STOP)\n", "G0X1.\n") == Aspects{Aspect::Ending});
  CHECK(differing("#3000=5(STOP)\n", "#3000=5(STOP)\n").empty());
  // Alarms of different programs: their numbers are their own, unless both call the same macros.
  const OneRun one("#3000=5(STOP)\n"), other("#3000=6(STOP)\n"), another("#3000=5(HALT)\n");
  verify::CompareRules rules;
  CHECK(verify::compare(one.record, other.record, rules).empty());
  CHECK(verify::compare(one.record, another.record, rules).size() == 1);
  rules.sameAlarmNumbers = true;
  CHECK(verify::compare(one.record, another.record, rules).size() == 1);
  rules.sameAlarmNumbers = false;
  rules.samePlace = [](SourceRange, SourceRange) { return false; };
  CHECK(verify::compare(one.record, other.record, rules).size() == 1);
  // Of macros their kind counts: no contact against a path that is blocked. What moved otherwise before it is
  // the difference.
  CHECK(differing(kOn + "G65P9811X-30.S2\n", kOn + "G65P9810X40.F500.\n") == Aspects{Aspect::Path});
  CHECK(differing(kOn + "G65P9811X-30.S2\n", kOn + "G65P9811X-30.S2\n").empty());
}

TEST_CASE("verify: a limit that the translation compares by itself") {
  // The wall is at 30: an error of 2 against a limit of 1. What is told is the limit, and nothing else.
  const std::string limited = kOn + "G65P9811X28.U1.\n", free = kOn + "G65P9811X28.\n";
  CHECK(differing(limited, free + "IF[ABS[#140]GT1.]THEN#3000=103(UPPER LIMIT)\n").empty());
  CHECK(differing(limited, free + "IF[ABS[#140]GT1.]THEN#3000=103(OUT OF POSITION)\n") ==
        Aspects{Aspect::Ending});
  CHECK(differing(limited, free + "IF[ABS[#140]GT3.]THEN#3000=103(UPPER LIMIT)\n") ==
        Aspects{Aspect::Ending});
  // Another place, or more than is measured before: not the same stop.
  CHECK_FALSE(differing(limited, free + "G0Y1.\n#3000=103(UPPER LIMIT)\n").empty());
  CHECK_FALSE(differing(limited, free + "#5221=1.\n#3000=103(UPPER LIMIT)\n").empty());
  CHECK_FALSE(differing(limited, "#3000=103(UPPER LIMIT)\n").empty());
  // Other alarms of a macro are not to be written by hand.
  CHECK(differing(kOn + "G65P9810X40.F500.\n", kOn + "#3000=103(PATH OBSTRUCTED)\n") ==
        Aspects{Aspect::Ending});
  // From the same place of the source.
  const OneRun one(limited), other(free + "IF[ABS[#140]GT1.]THEN#3000=103(UPPER LIMIT)\n");
  verify::CompareRules rules;
  rules.samePlace = [](SourceRange, SourceRange) { return false; };
  CHECK(verify::compare(one.record, other.record, rules).size() == 1);
}

TEST_CASE("verify: a corner that the translation touches face by face") {
  const std::string at = kOn + "G0X20.Y-10.\nZ-5.\n";
  // The part's corner is outside of both faces here: the Y face is that of the same block, from below.
  const std::string corner = at + "G65P9815X30.Y-9.\n";
  CHECK(differing(corner, corner).empty());
  CHECK_FALSE(differing(corner, at + "G65P9811X30.\n").empty());
  CHECK_FALSE(differing(corner, at + "G65P9811X30.\nG0Y-10.5\nG65P9811Y-9.\n").empty());
  CHECK_FALSE(differing(corner, at + "G65P9811X30.\nG65P9811Y-8.\n").empty());
}

TEST_CASE("verify: a call whose work no source states is compared by all that it is given") {
  const auto told = [](const std::string& one, const std::string& other) {
    const OneRun source(one, "inspection-plus", {}, verify::Stand::Way::Run, true);
    const OneRun target(other, "inspection-plus", {}, verify::Stand::Way::Run, true);
    verify::CompareRules rules;
    rules.sameAlarmNumbers = true;
    std::vector<Aspect> out;
    for (const verify::Difference& difference : verify::compare(source.record, target.record, rules))
      out.push_back(difference.aspect);
    return out;
  };
  const std::string corner = kOn + "G65P9816X40.Y20.S2\n";
  const OneRun passed(corner, "inspection-plus", {}, verify::Stand::Way::Run, true);
  REQUIRE(passed.record.ending == verify::Ending::Finished);
  REQUIRE(passed.record.measures.size() == 1);
  CHECK(passed.record.measures[0].unstated.find("the way round the corner") != std::string::npos);
  SourceRange at;
  CHECK(verify::whyNoEvidence(passed.record, at) == "");
  CHECK(OneRun(corner).record.ending == verify::Ending::Inconclusive); // unless it is asked for
  CHECK(told(corner, corner).empty());
  CHECK(told(corner, kOn + "G65P9816X41.Y20.S2\n") == Aspects{Aspect::Nominal});
  CHECK(told(corner, kOn + "G65P9816X40.Y20.S3\n") == Aspects{Aspect::Nominal});
  CHECK(told(corner, kOn + "G65P9816X40.Y20.S2W1.\n") == Aspects{Aspect::Nominal});
  CHECK_FALSE(told(corner, kOn + "G0X1.\n" + corner + "G0X0\n").empty());
  CHECK_FALSE(told(corner, kOn).empty());
  // What it leaves is not known, on both sides.
  CHECK(told(corner + "#500=#135\n", corner + "#500=#135\n").empty());
}

TEST_CASE("verify: what is evidence") {
  const auto why = [](const std::string& blocks) {
    const OneRun run(blocks);
    SourceRange at;
    std::string out = verify::whyNoEvidence(run.record, at);
    return out.empty() ? out : out + " | " + run.at(at);
  };
  CHECK(why(kTouch) == "");
  CHECK(why("G0X1.\n").starts_with("nothing is measured"));
  CHECK(why("G65P9811X30.S2\n").find("probe is off at a measuring move | G65P9811X30.S2") == 4);
  CHECK(why(kOn + "G65P9811X-30.S2\n").starts_with("alarm: "));
  CHECK(why(kOn + "G0X40.\nX0\nG65P9811X30.S2\n").find("G0X40.") != std::string::npos); // into the part
}

TEST_CASE("verify: a rehearsal shows all that is measured, whatever the part") {
  const OneRun run(kOn + "G65P9811X-30.S2\nG65P9811Y12.S2\nG65P9810X40.F500.\nG65P9811X50.S2\n",
                   "inspection-plus", {}, verify::Stand::Way::Rehearse);
  CHECK(run.record.ending == verify::Ending::Finished);
  REQUIRE(run.record.measures.size() == 3);
  const sim::Point3 zero = verify::standZeros()[0];
  for (const verify::Measure& measure : run.record.measures)
    REQUIRE(measure.nominal.size() == 1);
  CHECK(run.record.measures[0].nominal[0].point.x == doctest::Approx(zero.x - 30));
  CHECK(run.record.measures[0].nominal[0].direction == sim::Point3{-1, 0, 0});
  CHECK(run.record.measures[1].nominal[0].point.y == doctest::Approx(zero.y + 12));
  CHECK(run.record.measures[2].nominal[0].point.x == doctest::Approx(zero.x + 50));
  CHECK(run.record.measures[2].nominal[0].point.z == doctest::Approx(zero.z + 5 + 3));
  CHECK(run.record.events.empty());
}
