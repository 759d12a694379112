// Two runs side by side: each aspect of a comparison tells a difference, and only that.
#include "sim/machine/Compile.h"
#include "sim/machine/VendorMacros.h"
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
                  verify::Entry entry = {}, verify::Stand::Way way = verify::Stand::Way::Run)
      : profile(controlOf("fanuc-31i-b")), set(*stdlib::MacroSet::load(stdlib::DataFiles(), macros)),
        meaning(set, profile), parsed("%\nO1\n" + blocks + "M30\n%\n") {
    file = frontend::macrob::lower(parsed.file, profile, parsed.sources, parsed.diagnostics);
    CAPTURE(blocks);
    CAPTURE(parsed.told());
    REQUIRE(file);
    meaning.setStylusRadius(3);
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

TEST_CASE("verify: the same program does the same") {
  CHECK(differing(kTouch, kTouch).empty());
  CHECK(differing("G0X10.\nG0X20.\n", "G0X20.\n").empty());                   // in one line
  CHECK(differing("G0X10.\nX20.Y5.\n", "G91G0X10.\nX10.Y5.\nG90\n").empty()); // another way to say it
}

TEST_CASE("verify: each aspect has its difference") {
  CHECK(differing("G0X10.\n", "G0X11.\n") == Aspects{Aspect::Path, Aspect::End});
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
        Aspects{Aspect::Path}); // not in one piece
  CHECK(differing(kTouch, kOn + "G65P9811X30.5S2\n") == Aspects{Aspect::Nominal, Aspect::Offset});
  CHECK(differing(kTouch, kOn + "G65P9811X30.S3\n") == Aspects{Aspect::Offset});
  CHECK(differing(kTouch, kOn + "G0Y1.\n" + "G65P9811X30.S2\nG0Y0\n") ==
        Aspects{Aspect::Path, Aspect::Nominal, Aspect::Contact});
  CHECK(differing(kOn + "G31X40.F100.\n", kOn + "G31X45.F100.\n") ==
        Aspects{Aspect::Nominal}); // the wall comes before
  CHECK(differing("#500=1.\n", "#500=1.1\n") == Aspects{Aspect::Variable});
  CHECK(differing("#500=1.\n", "\n") == Aspects{Aspect::Variable});
  CHECK(differing("#502=1.\n", "#502=2.\n").empty());              // not asked for
  CHECK(differing("#7002=5.\n", "\n") == Aspects{Aspect::Offset}); // of G54.1 P1
  CHECK(differing("\n", "#7002=5.\n") == Aspects{Aspect::Offset});
  CHECK(differing("#7002=5.\n", "#7022=5.\n") == Aspects{Aspect::Offset});
  CHECK(differing("#7002=5.\n", "#7002=5.\n").empty());
  CHECK(differing("G91\n", "G90\n") == Aspects{Aspect::Modal});
  CHECK(differing("G91\n", "G90\n", true).empty()); // as it stood at entry
  CHECK(differing("G90\n", "G91\n", true) == Aspects{Aspect::Modal});
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
  CHECK(found.front().text.starts_with("nothing against a "));
  CHECK(verify::compare(met, met, {}).empty());
}

TEST_CASE("verify: endings") {
  CHECK(differing("#3000=5(STOP)\n", "G0X1.\n") == Aspects{Aspect::Ending});
  CHECK(differing("#3000=5(STOP)\n", "#3000=5(STOP)\n").empty());
  // Alarms of different programs: their numbers are their own, unless both call the same macros.
  const OneRun one("#3000=5(STOP)\n"), other("#3000=6(HALT)\n");
  verify::CompareRules rules;
  CHECK(verify::compare(one.record, other.record, rules).empty());
  rules.sameAlarmNumbers = true;
  CHECK(verify::compare(one.record, other.record, rules).size() == 1);
  rules.sameAlarmNumbers = false;
  rules.samePlace = [](SourceRange, SourceRange) { return false; };
  CHECK(verify::compare(one.record, other.record, rules).size() == 1);
  // Of macros their kind counts: no contact against a path that is blocked.
  CHECK(differing(kOn + "G65P9811X-30.S2\n", kOn + "G65P9810X40.F500.\n") == Aspects{Aspect::Ending});
  CHECK(differing(kOn + "G65P9811X-30.S2\n", kOn + "G65P9811X-30.S2\n").empty());
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
