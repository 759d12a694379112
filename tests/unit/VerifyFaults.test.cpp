// Faults that are planted into converted programs and into our own macros: `verify` rejects those that change
// what the machine does.
#include "driver/Driver.h"
#include "support/Decimal.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/policy/Tree.h"
#include "tests/unit/DataFolder.h"
#include "tests/unit/FaultJudge.h"
#include "tests/unit/FaultOperators.h"
#include "tests/unit/MeasuredRunner.h"
#include "verify/Compare.h"

#include <algorithm>
#include <cstdlib>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <set>

using namespace dotek;
using namespace dotek::tests;
namespace fs = std::filesystem;

namespace {

constexpr const char* kOwn = "dotek.nc";
constexpr std::size_t kNamed = 7; // operators that the acceptance names are first

struct Size {
  std::size_t faults = draws<std::size_t>(60, 5);
  std::uint64_t cases = draws<std::uint64_t>(40);
  std::uint64_t seed = 1;
};

Size sizeWanted() {
  Size out;
  if (const char* text = std::getenv("DOTEK_FAULTS")) {
    out.faults = static_cast<std::size_t>(parseNumber(text).value_or(200));
    out.cases = 300;
  }
  if (const char* text = std::getenv("DOTEK_FAULTS_SEED"))
    out.seed = static_cast<std::uint64_t>(parseNumber(text).value_or(1));
  return out;
}

// A cycle and where its post is.
struct Cycle {
  std::string name;
  driver::VerifyOptions options;
};

Cycle cycleOf(const std::string& folder, const std::string& prog, const driver::NamedTexts& hosts = {}) {
  Cycle out;
  out.name = fs::path(folder).filename().string() + " of " + fs::path(prog).filename().string();
  out.options.inputs = {folder};
  out.options.source.prog = prog;
  out.options.common.host = hosts;
  out.options.common.limits.simSteps = 20000; // a fault may make a loop endless
  out.options.to = "fanuc";
  out.options.control = "fanuc-0i-md";
  return out;
}

driver::NamedTexts start(const char* x, const char* y) {
  return {{"start_x", x}, {"start_y", y}};
}

std::vector<Cycle> allCycles() {
  const auto example = [](const char* name) { return (root() / "examples" / name).generic_string(); };
  const std::string mill = example("mill-post.txt"), plain = example("post.txt");
  std::vector<Cycle> out = {
      cycleOf(example("surface-x"), plain, start("3", "-4")),
      cycleOf(example("surface-x"), mill, start("-15", "10")),
      cycleOf(example("surface-y"), mill, start("10", "15")),
      cycleOf(example("surface-z"), mill, start("20", "20")),
      cycleOf(example("bore"), mill, start("50", "40")),
      cycleOf(example("corner-xyz"), mill, start("-15", "10")),
  };
  fs::path corpusFolder;
  if (!haveCorpus(corpusFolder)) return out;
  const std::string prog = (corpusFolder / "compost" / "probe-routines.txt").generic_string();
  const auto add = [&](const char* name, driver::NamedTexts mapped, bool probeOn) {
    Cycle one = cycleOf((corpusFolder / "gibbs" / name).generic_string(), prog, start("3", "4"));
    one.options.common.recover = true;
    one.options.common.field = std::move(mapped);
    if (probeOn) one.options.common.assume.insert("probe-on");
    out.push_back(std::move(one));
  };
  add("MERENI.OSA.X", {{"X", "a"}}, false);
  add("MERENI.OSA.Y", {{"Y", "b"}}, false);
  add("MERENI.OSA.Z", {{"Z", "d"}}, true);
  add("MERENI.STRED.OTVOR", {}, false);
  add("MERENI.OSA.XYZ", {}, true);
  return out;
}

// A cycle with macros, as it is without a fault.
struct Subject {
  std::string name;
  driver::VerifyOptions options;
  std::string program; // converted
  bool own = false;    // runs our macros by their text
  Told told;
};

// A text that faults are planted into.
struct Target {
  std::string name;
  std::string text;
  FaultWords words;
  std::vector<const Subject*> judges;
  std::vector<std::vector<Fault>> faults; // by kind
};

// What a program with a fault came to.
struct Findings {
  bool read = false;     // it could be
  bool rejected = false; // a difference, or too few cases that agree
  bool changed = false;  // the trace of a case that agrees without the fault
};

// Our own macros beside their meaning, on placed features: of most of them no cycle can be converted yet.
class OwnFeatures {
public:
  OwnFeatures(std::uint64_t placements, std::uint64_t seed) {
    verify::Random random(seed);
    MeasuredRunner meaning(kControl, "dotek"), text(kControl, "dotek", ownMacroText());
    for (std::uint64_t n = 0; n < placements; ++n) {
      for (const std::string_view name : kMeasuredFeatures) {
        const double turn = name.starts_with("angle") ? random.between(-4, 4) : 0;
        add(measuredFeature(name, random, {turn, 0, {}}), meaning, text);
        // Where a search ends shows where it finds something only just, or only just not.
        add(measuredFeature(name, random, {0, 0, n % 2 == 0 ? 0.2 : -0.2}), meaning, text);
      }
      for (const char* name : {"protected move", "obstructed move", "flagged move"})
        add(protectedMove(name, random), meaning, text);
    }
  }

  void judge(const std::string& macros, Findings& out) const {
    MeasuredRunner runner(kControl, "dotek", macros);
    if (!runner.readable()) return;
    out.read = true;
    for (const One& one : cases_) {
      std::size_t trace = 0;
      const verify::Record record = traced(runner, one.feature, trace);
      out.rejected = out.rejected || !differences(one.expected, record).empty();
      out.changed = out.changed || (one.agrees && trace != one.trace);
      if (out.rejected && out.changed) return;
    }
  }
  std::size_t size() const { return cases_.size(); }

private:
  static constexpr const char* kControl = "fanuc-0i-md";
  struct One {
    MeasuredFeature feature;
    verify::Record expected;
    std::size_t trace = 0; // of the text without a fault
    bool agrees = false;
  };

  static verify::Record traced(MeasuredRunner& runner, const MeasuredFeature& feature, std::size_t& hash) {
    std::string lines;
    sim::Trace trace([&](std::string_view piece) { lines += piece; });
    verify::Record record = *runner.run(feature, {}, &trace);
    trace.flush();
    for (const auto& [key, zero] : record.zeros)
      lines += fmt::format("zero {} {} {:.6f}\n", key.first, key.second, zero);
    for (const auto& [number, value] : record.stores)
      lines += fmt::format("variable {} {:.6f}\n", number, value);
    hash = deedsOf(lines);
    return record;
  }
  // Where the text is on the increments of the control and the meaning does not, contacts on a round
  // surface lie beside each other by half of one.
  static std::vector<verify::Difference> differences(const verify::Record& expected,
                                                     const verify::Record& record) {
    verify::CompareRules rules;
    rules.results = 1e-3;
    rules.mayRestoreModes = true;
    return verify::compare(expected, record, rules);
  }

  void add(MeasuredFeature feature, MeasuredRunner& meaning, MeasuredRunner& text) {
    One one;
    const verify::Record said = traced(text, feature, one.trace);
    // What these do is said by the text alone.
    const bool alone = feature.name == "outer corner" || feature.name == "flagged move";
    one.expected = alone ? said : *meaning.run(feature);
    CAPTURE(feature.name);
    for (const verify::Difference& difference : differences(one.expected, said))
      FAIL_CHECK(difference.text);
    const bool move = feature.name.ends_with("move");
    SourceRange at;
    one.agrees = move || verify::whyNoEvidence(one.expected, at).empty();
    CHECK((one.agrees || one.expected.alarmKind == "probe-fail"));
    one.feature = std::move(feature);
    cases_.push_back(std::move(one));
  }

  // Away from a face, or into it.
  static MeasuredFeature protectedMove(const std::string& name, verify::Random& random) {
    MeasuredFeature out = measuredFeature("surface x", random);
    out.name = name;
    const double way = out.expected[0] - out.start.x;
    out.calls["dotek"] =
        fmt::format("G65P8810X{:.3f}Y{:.3f}Z{:.3f}{}{}",
                    out.start.x + way * (name == "protected move" ? -1 : 1.2), out.start.y + 3,
                    out.start.z + 2, random.chance(0.5) ? "F700." : "", name == "flagged move" ? "M1" : "");
    out.results.clear();
    if (name == "flagged move") out.results = {{148, 7, 1}};
    return out;
  }

  std::vector<One> cases_;
};

Findings judge(const Target& target, const Fault& fault, const OwnFeatures& features, std::uint64_t& runs) {
  const std::string text = withFault(target.text, fault);
  DataFolder folder;
  Findings out;
  if (target.name == kOwn) features.judge(text, out);
  for (const Subject* subject : target.judges) {
    if (out.rejected && out.changed) break;
    driver::VerifyOptions options = subject->options;
    if (target.name == kOwn) {
      folder.write("macrob/dotek.nc", text);
      options.common.data = {folder.path()};
    } else {
      options.allowEdits = true; // the cases alone are to show it
      options.translation = folder.write("faulty.nc", text);
    }
    const Told told = toldBy(options);
    ++runs;
    CAPTURE(fault.text());
    CAPTURE(told.messages);
    REQUIRE(told.status <= 1);
    if (told.traces.empty()) break;
    out.read = true;
    out.rejected = out.rejected || told.status == 1;
    for (const std::uint64_t number : subject->told.agreeing) {
      const auto trace = told.traces.find(number);
      out.changed =
          out.changed || trace == told.traces.end() || trace->second != subject->told.traces.at(number);
    }
  }
  return out;
}

struct Counts {
  std::size_t placesConverted = 0, placesOwn = 0;
  std::size_t drawn = 0, notRead = 0, unchanged = 0, onlyEdges = 0, rejected = 0, survived = 0;
};

} // namespace

TEST_CASE("verify rejects planted faults") {
  const Size size = sizeWanted();
  const bool everything = std::getenv("DOTEK_FAULTS_ALL") != nullptr;
  const OwnFeatures features(std::max<std::uint64_t>(4, size.cases / 15), size.seed);
  std::vector<Subject> subjects;
  for (const Cycle& cycle : allCycles()) {
    if (fewDraws() && subjects.size() >= 2) break; // to run them without a fault takes longest
    for (const char* set : kFaultSets) {
      Subject one{cycle.name + ", " + set, cycle.options, "", std::string_view(set) == "dotek", {}};
      one.options.probeMacros = set;
      one.options.cases = size.cases;
      one.options.seed = size.seed;
      driver::ConvertOptions convert;
      convert.inputs = one.options.inputs;
      convert.common = one.options.common;
      convert.source = one.options.source;
      convert.to = one.options.to;
      convert.control = one.options.control;
      convert.probeMacros = set;
      const driver::Outcome outcome = driver::convert(convert);
      if (outcome.status != 0) {
        continue; // the set does not have it
      }
      one.program = outcome.output;
      one.told = toldBy(one.options);
      CAPTURE(one.name);
      CAPTURE(one.told.messages);
      CHECK(one.told.status == 0);
      CHECK(one.told.agreeing.size() >= size.cases * 95 / 100);
      subjects.push_back(std::move(one));
    }
  }

  std::vector<Target> targets(1);
  targets.front().name = kOwn;
  targets.front().text = ownMacroText();
  for (const Subject& subject : subjects) {
    if (subject.own) targets.front().judges.push_back(&subject);
    targets.push_back({subject.name, subject.program, {}, {&subject}, {}});
  }
  std::map<std::string_view, Counts> counts;
  for (Target& target : targets) {
    target.words = faultWordsOf(target.text);
    for (const std::string_view kind : faultKinds()) {
      target.faults.push_back(faultsOf(kind, target.text, target.words));
      (target.name == kOwn ? counts[kind].placesOwn : counts[kind].placesConverted) +=
          target.faults.back().size();
    }
  }

  verify::Random random(size.seed);
  std::set<std::pair<std::string, std::string>> drawn;
  std::string survivors;
  std::uint64_t runs = 0;
  while (drawn.size() < size.faults) {
    // Two of five in our own macros; every other one by an operator that the acceptance names.
    const Target& target =
        random.below(5) < 2 ? targets.front() : targets[1 + random.below(targets.size() - 1)];
    const std::size_t kind = random.below(random.below(2) == 0 ? kNamed : faultKinds().size());
    const std::vector<Fault>& faults = target.faults[kind];
    if (faults.empty()) continue;
    const Fault& fault = faults[random.below(faults.size())];
    if (!drawn.emplace(target.name, fault.text()).second) continue;
    Counts& count = counts[faultKinds()[kind]];
    ++count.drawn;
    const Findings found = judge(target, fault, features, runs);
    const bool survived = found.changed && !found.rejected;
    ++(!found.read      ? count.notRead
       : survived       ? count.survived
       : found.changed  ? count.rejected
       : found.rejected ? count.onlyEdges
                        : count.unchanged);
    if (survived) survivors += fmt::format("  {}: {}\n", target.name, fault.text());
    if (everything)
      fmt::print("{}{}{} {}: {}\n", found.read ? "" : "not read ", found.changed ? "changed " : "",
                 found.rejected ? "rejected" : "", target.name, fault.text());
  }

  std::string table =
      fmt::format("{:36}{:>10}{:>6}{:>7}{:>9}{:>11}{:>11}{:>9}{:>9}\n", "operator", "converted", "own",
                  "drawn", "not read", "unchanged", "edges only", "rejected", "survived");
  Counts all;
  for (const std::string_view kind : faultKinds()) {
    const Counts& one = counts[kind];
    table += fmt::format("{:36}{:>10}{:>6}{:>7}{:>9}{:>11}{:>11}{:>9}{:>9}\n", kind, one.placesConverted,
                         one.placesOwn, one.drawn, one.notRead, one.unchanged, one.onlyEdges, one.rejected,
                         one.survived);
    all.rejected += one.rejected;
    all.survived += one.survived;
  }
  for (const std::string_view kind : faultKinds()) {
    if (counts[kind].placesConverted == 0)
      table += fmt::format("fits nowhere in converted programs: {}\n", kind);
    if (counts[kind].placesOwn == 0) table += fmt::format("fits nowhere in our own macros: {}\n", kind);
  }
  const std::size_t changed = all.rejected + all.survived;
  MESSAGE(
      fmt::format("{} faults by seed {}, {} cases each, {} programs, {} runs; rejected {} of {} that change "
                  "the trace of a case that agrees\n{}{}{}",
                  size.faults, size.seed, size.cases, targets.size(), runs, all.rejected, changed, table,
                  survivors.empty() ? "no survivors" : "survivors:\n", survivors));
  CHECK(changed >= size.faults / 3);
  // Of a few dozen one survivor is more than 2 % by itself.
  CHECK(all.survived <= std::max<std::size_t>(1, changed * 2 / 100));
}
