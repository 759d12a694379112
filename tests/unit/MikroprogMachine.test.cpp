// What the machine of Mikroprog does at each function that the reference describes, and where it says that no
// source describes it. Expected traces are worked out from the reference, not from a run.
#include "MikroprogHelper.h"
#include "sim/machine/Trace.h"

using namespace dotek;
using namespace dotek::tests;
using sim::Ending;

namespace {

constexpr std::string_view kLathe = "mikroprog-s280", kMill = "mikroprog-mill";

struct Ran {
  std::string trace, why;
  Ending ending = Ending::Running;
  std::uint32_t line = 0;
};

Ran ran(const std::string& text, std::string_view control = kLathe,
        const std::vector<std::pair<std::string, double>>& presets = {}, sim::SkipSignal* part = nullptr) {
  MikroprogRun run(text, loadMikroprog(control));
  run.limits.simSteps = 100'000;
  run.machine.setSkipSignal(part);
  Ran out;
  for (const auto& [name, value] : presets)
    CHECK_MESSAGE(sim::mikroprog::preset(run.machine, run.profile, name, value), name);
  {
    sim::Trace trace([&](std::string_view piece) { out.trace += piece; });
    run.machine.setTrace(&trace);
    run.start();
    run.machine.setTrace(nullptr);
  }
  out.ending = run.ending();
  out.why = run.why();
  out.line = run.line();
  return out;
}

// Without the six decimals: the numbers of these programs are short.
std::string shortTrace(const Ran& run) {
  std::string out = run.trace;
  for (std::size_t at = 0; (at = out.find(".000000", at)) != std::string::npos;)
    out.erase(at, 7);
  return out;
}

std::string traceOf(const std::string& text, std::string_view control = kLathe,
                    const std::vector<std::pair<std::string, double>>& presets = {}) {
  const Ran run = ran(text, control, presets);
  CHECK_MESSAGE(run.ending == Ending::ProgramEnd, run.why);
  return shortTrace(run);
}

std::string refusal(const std::string& text, std::uint32_t line, std::string_view control = kLathe) {
  const Ran run = ran(text, control);
  CHECK(run.ending == Ending::Inconclusive);
  CHECK(run.line == line);
  return run.why;
}

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("mikroprog machine: a lathe shows X as a diameter and no Y") {
  CHECK(traceOf("N10 G0 X30 Z2\nN20 M25 @A.SOU\nN30 G92 X28\nN40 M30\n") ==
        "rapid X30 Z2\nrecord A.SOU X30 Z2\nset-position X28 Z2\nend\n");
  CHECK(traceOf("N10 G0 X30 Z2\nN20 M30\n", kMill) == "rapid X30 Y0 Z2\nend\n");
}

TEST_CASE("mikroprog machine: arcs with R, at most half a turn") {
  // A corner of radius 10 between face and cylinder: the centre lies in the material.
  CHECK(traceOf("N10 M3 S1000\nN20 G0 X20 Z0\nN30 G3 X40 Z-10 R10 F100\nN40 M30\n") ==
        "spindle cw S1000\nrapid X20 Z0\narc-ccw zx X40 Z-10 centre -10 20 F100\nend\n");
  CHECK(traceOf("N10 G17\nN20 G1 X0 Y0 F100\nN30 G2 X10 Y10 R10\nN40 M30\n", kMill) ==
        "feed X0 Y0 Z0 F100\narc-cw xy X10 Y10 Z0 centre 10 0 F100\nend\n");
  CHECK(has(refusal("N10 G0 X20 Z0\nN20 G3 X40 Z-10 I0 K-10 F100\nN30 M30\n", 2), "(Q3)"));
  CHECK(has(refusal("N10 G0 X20 Z0\nN20 G3 X40 Z-10 R-10 F100\nN30 M30\n", 2), "half a turn"));
  CHECK(ran("N10 G0 X20 Z0\nN20 G3 X40 Z-10 R5 F100\nN30 M30\n").ending == Ending::Alarm);
}

TEST_CASE("mikroprog machine: a profile that answers Q3 runs arcs with I and K") {
  auto control = loadMikroprog(kLathe);
  control.questions.push_back({3, "I and K count from the start", true});
  const auto end = [&](const std::string& arc) {
    MikroprogRun run("N10 G0 X20 Z0\nN20 " + arc + "\nN30 M30\n", control);
    run.start();
    return run.ending();
  };
  CHECK(end("G3 X40 Z-10 I0 K-10 F100") == Ending::ProgramEnd);
  CHECK(end("G3 X40 Z-10 I0 K-9.99 F100") == Ending::Alarm); // off by 0.02, and 0.005 is the limit
}

TEST_CASE("mikroprog machine: G24 makes X a radius, until G90") {
  CHECK(traceOf("N10 G24\nN20 G0 X15 Z2\nN30 G90\nN40 G0 X50\nN50 M30\n") ==
        "rapid X30 Z2\nrapid X50 Z2\nend\n");
  CHECK(traceOf("N10 G24 G0 X15\nN20 G91 X1\nN30 Z1\nN40 M30\n") ==
        "rapid X30 Z0\nrapid X32 Z0\nrapid X32 Z1\nend\n");
  CHECK(has(refusal("N10 G24\nN20 G90\nN30 G91 G0 X1\nN40 M30\n", 3), "(Q9)"));
  CHECK(has(refusal("N10 G24\nN20 P90=1\nN30 G23 L40 O11\nN40 M30\n", 3), "(Q13)"));
}

TEST_CASE("mikroprog machine: shifts of the system, and what is not stated of them") {
  CHECK(traceOf("N10 G51 Z-5\nN20 G0 X30 Z0\nN30 G50\nN40 M25 @A.SOU\nN50 M30\n") ==
        "local X0 Z-5\nrapid X30 Z0\nlocal X0 Z0\nrecord A.SOU X30 Z-5\nend\n");
  CHECK(traceOf("N10 G50\nN20 G0 X30\nN30 M30\n") == "rapid X30 Z0\nend\n");
  CHECK(has(refusal("N10 G51 Z-5\nN20 G51 Z-5\nN30 M30\n", 2), "G50"));
  CHECK(has(refusal("N10 G51 Z-5\nN20 G92 Z0\nN30 M30\n", 2), "(Q12)"));
  CHECK(has(refusal("N10 G51 Z-5\nN20 G98\nN30 M30\n", 2), "G50"));
  CHECK(has(refusal("N10 G52\nN20 G0 X1\nN30 M30\n", 1), "--var G52.X=VALUE"));
  CHECK(traceOf("N10 G53\nN20 G0 X30 Z0\nN30 G50\nN40 M25 @A.SOU\nN50 M30\n", kLathe,
                {{"G53.X", 2}, {"G53.Z", -5}}) ==
        "local X2 Z-5\nrapid X30 Z0\nlocal X0 Z0\nrecord A.SOU X32 Z-5\nend\n");
}

TEST_CASE("mikroprog machine: the reference run ends what G92 and G96 have set") {
  CHECK(traceOf("N10 G0 X30 Z5\nN20 G92 Z0\nN30 M3 S500\nN40 G96 A2000\nN50 G98\nN60 G0 X30 Z5\nN70 M30\n") ==
        "rapid X30 Z5\nset-position X30 Z0\nspindle cw S500\nsurface-speed on A2000\nsurface-speed off\n"
        "reference X0 Z0\nrapid X30 Z5\nend\n");
  CHECK(has(refusal("N10 G98 H1\nN20 M30\n", 1), "(Q29)"));
}

TEST_CASE("mikroprog machine: feed and speed of lathes") {
  CHECK(traceOf("N10 M3 S1000\nN20 G95\nN30 G1 Z-10 F0.1\nN40 G94 G1 Z0 F100\nN50 M30\n") ==
        "spindle cw S1000\nfeed X0 Z-10 FR0.100000\nfeed X0 Z0 F100\nend\n");
  // A new S ends the constant cutting speed.
  CHECK(
      traceOf("N10 M3 S600\nN20 G96 A2000\nN30 G1 X10 F100\nN40 S800\nN50 M30\n") ==
      "spindle cw S600\nsurface-speed on A2000\nfeed X10 Z0 F100\nsurface-speed off\nspindle cw S800\nend\n");
}

TEST_CASE("mikroprog machine: threads") {
  CHECK(traceOf("N10 M3 S500\nN20 G0 X29 Z5\nN30 G33 X29 Z-20 K1.5\nN40 G0 X35\nN50 M30\n") ==
        "spindle cw S500\nrapid X29 Z5\nthread X29 Z-20 K1.500000\nrapid X35 Z-20\nend\n");
  CHECK(has(refusal("N10 G33 X29 Z-20 K1.5\nN20 M30\n", 1), "at rest"));
  CHECK(has(refusal("N10 M3 S500\nN20 G33 Z-20 K1.5\nN30 X35\nN40 M30\n", 3), "G33"));
  CHECK(has(refusal("N10 M3 S500\nN20 G91\nN30 G33 Z-20 K1.5\nN40 M30\n", 3), "G91"));
  // Passes are not known (Q26); the cycle comes back to its start.
  CHECK(traceOf("N10 M3 S500\nN20 G0 X30 Z5\nN30 G78 X28.16 Z-20 U0.2 K1.5 H1 F100\nN40 M30\n") ==
        "spindle cw S500\nrapid X30 Z5\ncycle G78 X28.160000 Z-20 F100 ends X30 Z5\nend\n");
}

TEST_CASE("mikroprog machine: drilling along its stated way") {
  CHECK(traceOf("N10 G0 Z5\nN20 G81 Z-20 F100\nN30 M30\n") ==
        "rapid X0 Z5\nfeed X0 Z-20 F100\nrapid X0 Z5\nend\n");
  CHECK(traceOf("N10 G0 Z5\nN20 G85 Z-20 F100\nN30 M30\n") ==
        "rapid X0 Z5\nfeed X0 Z-20 F100\nfeed X0 Z5 F100\nend\n");
  // Out of the hole after each peck, in again to 0.5 mm above its bottom.
  CHECK(traceOf("N10 G0 Z5\nN20 G83 Z-5 W4 F100\nN30 M30\n") ==
        "rapid X0 Z5\nfeed X0 Z1 F100\nrapid X0 Z5\nrapid X0 Z1.500000\nfeed X0 Z-3 F100\nrapid X0 Z5\n"
        "rapid X0 Z-2.500000\nfeed X0 Z-5 F100\nrapid X0 Z5\nend\n");
  CHECK(ran("N10 G81 Z-20\nN20 M30\n").ending == Ending::Alarm); // F0
  CHECK(
      traceOf("N10 G0 X10 Y10 Z2\nN20 G81 Z-10 F200\nN30 G0 X30\nN40 G81 Z-10\nN50 M30\n", kMill) ==
      "rapid X10 Y10 Z2\nfeed X10 Y10 Z-10 F200\nrapid X10 Y10 Z2\nrapid X30 Y10 Z2\nfeed X30 Y10 Z-10 F200\n"
      "rapid X30 Y10 Z2\nend\n");
}

TEST_CASE("mikroprog machine: roughing comes back to its start, and its way is not known") {
  CHECK(traceOf("N10 G0 X40 Z2\nN20 G64 X30 Z-20 U1 F100\nN30 M30\n") ==
        "rapid X40 Z2\ncycle G64 X30 Z-20 F100 ends X40 Z2\nend\n");
  Box part;
  part.high[2] = -50;
  const Ran run = ran("N10 G0 X40 Z2\nN20 G64 X30 Z-20 U1 F100\nN30 M30\n", kLathe, {}, &part);
  CHECK(run.ending == Ending::Inconclusive);
  CHECK(has(run.why, "not stated"));
}

TEST_CASE("mikroprog machine: tools, stops, outputs, texts, ends") {
  CHECK(traceOf("N10 G0 X60 Z60\nN20 M6 T2\nN30 G0 X60 Z60\nN40 M30\n") ==
        "rapid X60 Z60\ntool 2\ntool-change 2\nrapid X60 Z60\nend\n");
  // Where no turret is, the operator changes the tool.
  CHECK(traceOf("N10 M6 T2\nN20 M30\n", kMill) == "stop\ntool 2\ntool-change 2\nend\n");
  CHECK(traceOf("N10 M42 H220 ;M1=STOP\nN20 M42 H20\nN30 M1 O20\nN40 M30\n") == "optional-stop O20\nend\n");
  CHECK(traceOf("N10 M1 O20\nN20 M30\n", kLathe, {{"O20", 1}}) == "stop\nend\n");
  CHECK(traceOf("N10 M1 O20\nN20 M30\n", kLathe, {{"O20", 0}}) == "end\n");
  CHECK(traceOf("N10 M20 Q4\nN20 M21 Q4\nN30 M30\n") == "output Q4 on\noutput Q4 off\nend\n");
  CHECK(has(refusal("N10 M20 Q1\nN20 M30\n", 1), "Q1"));
  CHECK(has(refusal("N10 M20 Q4 Q5\nN20 M30\n", 1), "(Q15)"));
  CHECK(traceOf("N10 M29 @scr.sou;hello\nN20 M40\nN30 M41\nN40 M99\n") == "write scr.sou hello\nend\n");
  CHECK(traceOf("N10 G41\nN20 G1 X10 F100\nN30 G40\nN40 M30\n") ==
        "comp left\nfeed X10 Z0 F100\ncomp off\nend\n");
}

TEST_CASE("mikroprog machine: inputs are those that the user says") {
  const std::string jump = "N10 G23 L40 O1\nN20 M0 ;NO\nN30 M30\nN40 M0 ;YES\nN50 M30\n";
  CHECK(traceOf(jump, kLathe, {{"O1", 1}}) == "stop YES\nend\n");
  CHECK(traceOf(jump, kLathe, {{"O1", 0}}) == "stop NO\nend\n");
  CHECK(has(refusal(jump, 1), "--var O1=1"));
  const std::string wait = "N10 G5 E2 O1 L40\nN20 M0 ;THERE\nN30 M30\nN40 M0 ;LATE\nN50 M30\n";
  CHECK(traceOf(wait, kLathe, {{"O1", 1}}) == "stop THERE\nend\n");
  CHECK(traceOf(wait, kLathe, {{"O1", 0}}) == "dwell 2\nstop LATE\nend\n");
  CHECK(ran("N10 G5 E2 O1\nN20 M30\n", kLathe, {{"O1", 0}}).ending == Ending::Alarm);
  CHECK(traceOf("N10 G0 ZP5\nN20 M30\n", kLathe, {{"P5", 7}}) == "rapid X0 Z7\nend\n");
  MikroprogRun run("N10 M30\n", loadMikroprog(kLathe));
  for (const char* name : {"P1000", "O6", "O11", "O99", "G50.Z", "G52.Y", "G52", "X", "", "1"})
    CHECK_FALSE_MESSAGE(sim::mikroprog::preset(run.machine, run.profile, name, 1), name);
  CHECK_FALSE(sim::mikroprog::preset(run.machine, run.profile, "O1", 2));
}

TEST_CASE("mikroprog machine: a loop that changes nothing ends, and prints little") {
  const Ran run = ran("N10 G0 X30\nN20 G0 X40\nN30 M25 @A.SOU\nN40 G27 L10\nN50 M30\n");
  CHECK(run.ending == Ending::Limit);
  CHECK(has(run.why, "for ever"));
  CHECK(run.line == 4);
  CHECK(run.trace.size() < 400'000);
  // One that comes to its end after many rounds does.
  CHECK(ran("N10 P90=5000\nN20 P90=P90-1\nN30 G23 L50 O10\nN40 G27 L20\nN50 M30\n").ending ==
        Ending::ProgramEnd);
}

TEST_CASE("mikroprog machine: the header and the section of the thesis's post") {
  CHECK(traceOf(";HEADER\nN10 G18 G90\nN20 M42 H220 ;M1=STOP\nN30 M42 H20\nN40 G98\nN50 P6=1 ;Direct Feed\n"
                "N60 M1 O20\nN70 G0 X1 Z1 ;SAFE\nN80 M6 T2\nN90 G0 X1 Z1\nN100 M3 S1200\nN110 G4 E5\n"
                "N120 G96 A2000\nN130 G1 X31.199 FP6\nN140 M30\n") ==
        "reference X0 Z0\noptional-stop O20\nrapid X1 Z1\ntool 2\ntool-change 2\nrapid X1 Z1\n"
        "spindle cw S1200\ndwell 5\nsurface-speed on A2000\nfeed X31.199000 Z1 F1\nend\n");
}
