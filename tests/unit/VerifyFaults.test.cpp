// Faults that are planted into converted programs and into our own macros: `verify` rejects those that change
// what the machine does.
#include "driver/Driver.h"
#include "stdlib/DataFiles.h"
#include "stdlib/MacroSet.h"
#include "support/Decimal.h"
#include "tests/GoldenRunner.h"
#include "tests/policy/Tree.h"
#include "tests/unit/FaultCycles.h"
#include "tests/unit/FaultOperators.h"
#include "verify/Random.h"

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

constexpr const char* kSets[] = {"easyprobe", "inspection-plus", "dotek"};
constexpr const char* kOwn = "dotek.nc";
constexpr std::size_t kNamed = 7; // operators that the acceptance names stand first

struct Size {
  std::size_t faults = 60;
  std::uint64_t cases = 40;
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

// A cycle and where its post stands.
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

std::vector<Cycle> cyclesOf(const FaultCycles& more) {
  const auto example = [](const char* name) { return (root() / "examples" / name).generic_string(); };
  const std::string mill = example("mill-post.txt"), plain = example("post.txt");
  std::vector<Cycle> out = {
      cycleOf(example("surface-x"), plain, start("3", "-4")),
      cycleOf(example("surface-x"), mill, start("-15", "10")),
      cycleOf(example("surface-y"), mill, start("10", "15")),
      cycleOf(example("surface-z"), mill, start("20", "20")),
      cycleOf(example("bore"), mill, start("50", "40")),
      cycleOf(example("corner-xyz"), mill, start("-15", "10")),
      cycleOf(more.folder("fault-pocket"), more.post()),
      cycleOf(more.folder("fault-web"), more.post()),
      cycleOf(more.folder("fault-boss"), more.post()),
      cycleOf(more.folder("fault-corner"), more.post(), start("10", "20")),
      cycleOf(more.folder("fault-angle"), more.post(), start("10", "20")),
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

// Of one run of verify: what the translation did in each case.
struct Told {
  int status = 0;
  std::map<std::uint64_t, std::size_t> traces; // hashes
  std::set<std::uint64_t> proved;
  std::string messages;
};

Told verified(driver::VerifyOptions options) {
  Told out;
  options.traces = [&](std::uint64_t number, bool proved, const std::string& trace) {
    out.traces.emplace(number, std::hash<std::string>()(trace));
    if (proved) out.proved.insert(number);
  };
  const driver::Outcome outcome = driver::verify(options);
  out.status = outcome.status;
  out.messages = renderText(outcome.diagnostics, outcome.sources, 3);
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

FaultWords wordsOf(const std::string& program) {
  FaultWords out;
  out.radius = {"#520"};
  out.probeOn = {"M31"};
  for (const char* name : kSets) {
    const stdlib::MacroSet set = *stdlib::MacroSet::load(stdlib::DataFiles(), name);
    for (const stdlib::MacroSignature& one : set.signatures) {
      if (one.intent == stdlib::Intent::ProbeOn)
        out.probeOn.insert(fmt::format("G65P{}", one.program));
      else if (one.intent == stdlib::Intent::ProtectedMove)
        out.travels.insert(one.program);
      else if (one.intent != stdlib::Intent::ProbeOff)
        out.measures.insert(one.program);
    }
  }
  out.measures.insert(8801); // one touch, of the others
  // "(A #1 TOOL_RADIUS ...": the header's list of arguments.
  for (const std::string& line : linesOf(program)) {
    const std::size_t sign = line.find('#');
    if (line.starts_with("(") && sign == 3 && line.find(" TOOL_RADIUS ") != std::string::npos)
      out.radius.insert(line.substr(sign, line.find(' ', sign) - sign));
  }
  return out;
}

enum class Judgement { Rejected, Unchanged, RejectedUnchanged, NotRead, Survived };

Judgement judge(const Target& target, const Fault& fault, std::uint64_t& runs) {
  const std::string text = withFault(target.text, fault);
  DataFolder folder;
  bool rejected = false, changed = false, read = false;
  for (const Subject* subject : target.judges) {
    driver::VerifyOptions options = subject->options;
    if (target.name == kOwn) {
      folder.write("macrob/dotek.nc", text);
      options.common.data = {folder.path()};
    } else {
      options.translation = folder.write("faulty.nc", text);
    }
    const Told told = verified(options);
    ++runs;
    CAPTURE(fault.text());
    CAPTURE(told.messages);
    REQUIRE(told.status <= 1);
    read = read || !told.traces.empty();
    if (told.traces.empty()) break;
    rejected = rejected || told.status == 1;
    for (const std::uint64_t number : subject->told.proved) {
      const auto trace = told.traces.find(number);
      changed = changed || trace == told.traces.end() || trace->second != subject->told.traces.at(number);
    }
    if (rejected && changed) return Judgement::Rejected;
  }
  if (!read) return Judgement::NotRead;
  if (changed) return Judgement::Survived;
  return rejected ? Judgement::RejectedUnchanged : Judgement::Unchanged;
}

std::string ownText() {
  const stdlib::DataFiles files;
  const stdlib::DataFile* const file = files.find("macrob", "dotek");
  REQUIRE(file != nullptr);
  return std::string(file->text);
}

struct Counts {
  std::size_t placesConverted = 0, placesOwn = 0;
  std::size_t drawn = 0, notRead = 0, unchanged = 0, onlyEdges = 0, rejected = 0, survived = 0;
};

} // namespace

TEST_CASE("verify rejects planted faults") {
  const Size size = sizeWanted();
  const FaultCycles more;
  std::vector<Subject> subjects;
  for (const Cycle& cycle : cyclesOf(more)) {
    for (const char* set : kSets) {
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
      if (outcome.status != 0) { if (std::getenv("DOTEK_FAULTS_ALL")) fmt::print("{}: {}\n", one.name, renderText(outcome.diagnostics, outcome.sources, 3)); continue; } // the set does not have it
      one.program = outcome.output;
      one.told = verified(one.options);
      CAPTURE(one.name);
      CAPTURE(one.told.messages);
      CHECK(one.told.status == 0);
      CHECK(one.told.proved.size() >= size.cases * 95 / 100);
      subjects.push_back(std::move(one));
    }
  }

  std::vector<Target> targets(1);
  targets.front().name = kOwn;
  targets.front().text = ownText();
  for (const Subject& subject : subjects) {
    if (subject.own) targets.front().judges.push_back(&subject);
    targets.push_back({subject.name, subject.program, {}, {&subject}, {}});
  }
  std::map<std::string_view, Counts> counts;
  for (Target& target : targets) {
    target.words = wordsOf(target.text);
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
    const Judgement result = judge(target, fault, runs);
    if (std::getenv("DOTEK_FAULTS_ALL"))
      fmt::print("{} {}: {}\n", static_cast<int>(result), target.name, fault.text());
    switch (result) {
    case Judgement::Rejected: ++count.rejected; break;
    case Judgement::Unchanged: ++count.unchanged; break;
    case Judgement::RejectedUnchanged: ++count.onlyEdges; break;
    case Judgement::NotRead: ++count.notRead; break;
    case Judgement::Survived:
      ++count.survived;
      survivors += fmt::format("  {}: {}\n", target.name, fault.text());
      break;
    }
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
  const std::size_t changed = all.rejected + all.survived;
  MESSAGE(
      fmt::format("{} faults by seed {}, {} cases each, {} programs, {} runs; rejected {} of {} that change "
                  "the trace of a proved case\n{}{}{}",
                  size.faults, size.seed, size.cases, targets.size(), runs, all.rejected, changed, table,
                  survivors.empty() ? "no survivors" : "survivors:\n", survivors));
  CHECK(changed >= size.faults / 3);
  CHECK(all.rejected * 100 >= changed * 98);
}
