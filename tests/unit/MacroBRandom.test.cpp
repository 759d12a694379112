// Made-up programs by two ways: the slow evaluator of the tree, and the compiled machine after parser and
// lowering. DOTEK_RANDOM_PROGRAMS in the environment sets how many; the same numbers give the same programs.
#include "tests/Draws.h"
#include "tests/unit/MachineAdapter.h"
#include "tests/unit/MacroBHelper.h"
#include "tests/unit/RandomMacroB.h"

#include <algorithm>
#include <cstdlib>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <functional>
#include <map>

using namespace dotek;
using namespace dotek::tests;

namespace {

// Machine and text of one seed.
struct Trial {
  MacroSetup setup;
  std::string text;

  explicit Trial(std::uint32_t seed) {
    if (seed % 3 == 0) {
      setup.control = "fanuc-0i-md";
      setup.decimal8 = true;
    }
    if (seed % 2 == 0) setup.switches = {1};
    if (seed % 5 == 0) setup.switches.insert(2);
    text = randomMacroB(seed, !setup.decimal8);
  }
};

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> out;
  std::string line;
  for (const char c : text) {
    line += c;
    if (c == '\n') out.push_back(std::exchange(line, ""));
  }
  if (!line.empty()) out.push_back(line);
  return out;
}

// Drops lines, many at a time and then fewer, at last any two (DO and END), as long as `differs`
// holds of the rest.
std::string shrunk(const std::string& text, const std::function<bool(const std::string&)>& differs) {
  std::vector<std::string> lines = linesOf(text);
  // Without `size` lines from `at` on, and without the line `other`.
  const auto without = [&](std::size_t at, std::size_t size, std::size_t other) {
    std::vector<std::string> rest;
    std::string joined;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if ((i >= at && i < at + size) || i == other) continue;
      rest.push_back(lines[i]);
      joined += lines[i];
    }
    if (!differs(joined)) return false;
    lines = std::move(rest);
    return true;
  };
  bool again = true;
  while (again) {
    again = false;
    for (std::size_t size = std::max<std::size_t>(lines.size() / 2, 1); size > 0; size /= 2)
      for (std::size_t at = 0; at < lines.size();)
        if (without(at, size, SIZE_MAX))
          again = true;
        else
          at += size;
    for (std::size_t at = 0; at < lines.size() && lines.size() < 60; ++at)
      for (std::size_t other = at + 1; other < lines.size(); ++other)
        if (without(at, 1, other)) again = true;
  }
  std::string out;
  for (const std::string& line : lines)
    out += line;
  return out;
}

// "": the machine agrees, or there is nothing to compare.
std::string disagreement(const std::string& text, const MacroSetup& setup) {
  const MacroOutcome slow = runSlowly(text, setup);
  if (slow.fragile || slow.ending == SlowStop::Kind::Unsupported) return "";
  const MachineRun machine = runOnMachine(text, setup);
  return machine.refusal.empty() ? difference(slow, machine.outcome) : "";
}

std::uint32_t programs() {
  const char* text = std::getenv("DOTEK_RANDOM_PROGRAMS");
  const int number = text == nullptr ? 0 : std::atoi(text);
  return number > 0 ? static_cast<std::uint32_t>(number) : draws(2000U);
}

} // namespace

TEST_CASE("random macro b: the programs are read without an error and end in every path") {
  std::map<std::string, int> endings;
  std::map<std::string, int> reasons;
  int compared = 0;
  constexpr int kPrograms = 1000;
  for (std::uint32_t seed = 1; seed <= kPrograms; ++seed) {
    const Trial trial(seed);
    CAPTURE(seed);
    CHECK(trial.text == Trial(seed).text);
    MacroFile parsed(trial.text);
    CHECK_MESSAGE(parsed.told() == "", trial.text);
    const MacroOutcome outcome = runSlowly(trial.text, trial.setup);
    const auto alarm = outcome.alarm >= 3000 ? 3000 : outcome.alarm;
    ++endings[fmt::format("{} {}", static_cast<int>(outcome.ending), alarm)];
    if (outcome.ending == SlowStop::Kind::Unsupported) ++reasons[outcome.reason];
    if (!outcome.fragile && outcome.ending != SlowStop::Kind::Unsupported) ++compared;
  }
  std::string told;
  for (const auto& [reason, count] : reasons)
    told += fmt::format(" {}: {};", reason, count);
  for (const auto& [end, count] : endings)
    told += fmt::format(" [{}] {}", end, count);
  INFO(told);
  for (const std::string alarm :
       {"110", "111", "112", "115", "116", "119", "122", "76", "77", "78", "128", "3000"})
    CHECK_MESSAGE(endings["2 " + alarm] > 0, alarm);
  CHECK(endings["0 0"] > kPrograms / 3); // M30
  CHECK(endings["1 0"] > 0);             // end of the text
  CHECK(compared > kPrograms * 8 / 10);
  if (std::getenv("DOTEK_RANDOM_PROGRAMS") != nullptr) MESSAGE(told);
}

TEST_CASE("random macro b: the layout of a program does not change what it does") {
  for (std::uint32_t seed = 1; seed <= draws(300U); ++seed) {
    const Trial trial(seed);
    CAPTURE(seed);
    const MacroFile parsed(trial.text);
    const std::optional<std::string> laidOut = parsed.format();
    REQUIRE(laidOut);
    MacroOutcome before = runSlowly(trial.text, trial.setup);
    before.line = 0;
    MacroOutcome after = runSlowly(*laidOut, trial.setup);
    after.line = 0;
    CHECK_MESSAGE(difference(before, after) == "", trial.text);
  }
}

TEST_CASE("random macro b: a machine with one property changed is told apart") {
  const std::pair<const char*, void (*)(MacroSetup&)> kChanges[] = {
      {"digits", [](MacroSetup& setup) { setup.decimal8 = !setup.decimal8; }},
      {"numbers without a point", [](MacroSetup& setup) { setup.calculator = false; }},
      {"a switch of block delete", [](MacroSetup& setup) { setup.switches = {3}; }},
      {"macro levels", [](MacroSetup& setup) { setup.macroLevels = 6; }},
      {"call levels", [](MacroSetup& setup) { setup.callLevels = 10; }},
      {"greatest N", [](MacroSetup& setup) { setup.sequenceLast = 4000; }},
      {"common variables",
       [](MacroSetup& setup) {
         setup.common = {{100, 199}, {500, 502}};
       }},
  };
  for (const auto& [what, change] : kChanges) {
    int different = 0;
    for (std::uint32_t seed = 1; seed <= 400 && different == 0; ++seed) {
      const Trial trial(seed);
      MacroSetup changed = trial.setup;
      change(changed);
      const MacroOutcome outcome = runSlowly(trial.text, trial.setup);
      if (!difference(outcome, runSlowly(trial.text, changed)).empty()) ++different;
    }
    CHECK_MESSAGE(different == 1, what);
  }
}

TEST_CASE("random macro b: shrinking keeps what makes the difference") {
  const auto differs = [](const std::string& text) {
    return text.find("A\n") < text.find("D\n") && text.find("D\n") != std::string::npos;
  };
  CHECK(shrunk("X\nA\nY\nB\nD\nZ\n", differs) == "A\nD\n");
  // Loops go as a whole.
  const auto balanced = [](const std::string& text) {
    return text.find("B\n") != std::string::npos &&
           std::count(text.begin(), text.end(), '(') == std::count(text.begin(), text.end(), ')');
  };
  CHECK(shrunk("A\n(\nB\n(\n)\n)\n", balanced) == "B\n");
}

TEST_CASE("random macro b: the slow evaluator and the machine agree") {
  std::map<std::string, int> refusals;
  std::uint32_t compared = 0;
  int differences = 0;
  for (std::uint32_t seed = 1; seed <= programs() && differences < 5; ++seed) {
    const Trial trial(seed);
    const MacroOutcome slow = runSlowly(trial.text, trial.setup);
    if (slow.fragile || slow.ending == SlowStop::Kind::Unsupported) continue;
    const MachineRun machine = runOnMachine(trial.text, trial.setup);
    if (!machine.refusal.empty()) {
      ++refusals[machine.refusal];
      continue;
    }
    // The two count their steps in different ways.
    if (slow.ending == SlowStop::Kind::Budget || machine.outcome.ending == SlowStop::Kind::Budget) continue;
    ++compared;
    const std::string what = difference(slow, machine.outcome);
    if (what.empty()) continue;
    ++differences;
    const auto kind = [](const std::string& told) { return told.substr(0, told.find_first_of(" :")); };
    const std::string small = shrunk(trial.text, [&](const std::string& text) {
      const std::string now = disagreement(text, trial.setup);
      return !now.empty() && kind(now) == kind(what);
    });
    FAIL_CHECK("seed " << seed << ": " << what << "\n"
                       << small << "now: " << disagreement(small, trial.setup));
  }
  for (const auto& [refusal, count] : refusals)
    FAIL_CHECK(count << " programs: " << refusal);
  CHECK(compared > programs() * 8 / 10);
}
