// A converted program, run as text on random arguments, against `post` on the same values: the same blocks in
// the same order, and an alarm exactly where the dialog rejects the values.
#include "driver/Driver.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/policy/Tree.h"
#include "tests/unit/MacroBRunner.h"

#include <doctest/doctest.h>
#include <random>

using namespace dotek;
using namespace dotek::tests;
namespace fs = std::filesystem;

namespace {

// What a caller in order shows: metric, G54, tool length active, nothing shifted.
void presetMachine(MacroBRunner& machine) {
  machine.variables = {{4001, 1.0},    {4002, 18.0},   {4003, 91.0},  {4005, 95.0}, {4006, 21.0},
                       {4007, 40.0},   {4008, 43.0},   {4009, 80.0},  {4011, 50.0}, {4014, 54.0},
                       {4016, 69.0},   {4109, 0.25},   {5001, -7.0},  {5002, 8.0},  {5003, 100.0},
                       {5021, -304.0}, {5022, -189.0}, {5023, -50.0}, {5041, -7.0}, {5042, 8.0},
                       {5043, 100.0},  {5201, 3.0},    {5202, 3.0},   {5203, 0.0},  {5221, -300.0},
                       {5222, -200.0}, {5223, -400.0}, {138, 12.345}};
}

// Words and values of a posted block: "N90 G65 P9770 Z5." gives "G65P9770Z5".
std::string words(const std::string& block) {
  MacroBRunner reader;
  reader.run(block, {});
  return reader.blocks.empty() ? "" : reader.blocks.front();
}

std::vector<std::string> postedWords(const std::string& text) {
  std::vector<std::string> out;
  for (const std::string& line : linesOf(text)) {
    if (line.find('#') != std::string::npos) continue; // a macro statement
    const std::string block = words(line);
    if (!block.empty()) out.push_back(block);
  }
  return out;
}

struct Case {
  std::string folder;
  std::string prog;
  std::string control;
  std::vector<std::pair<std::string, char>> letters; // every field of the cycle
  driver::NamedTexts mapped = {};
  bool recover = false;
  std::vector<std::string> hosts = {"clearance", "tool_radius"}; // those that become arguments
};

void runs(const Case& one) {
  CAPTURE(one.folder);
  CAPTURE(one.control);
  driver::ConvertOptions convert;
  convert.inputs = {one.folder};
  convert.source.prog = one.prog;
  convert.common.recover = one.recover;
  convert.common.field = one.mapped;
  convert.to = "fanuc";
  convert.control = one.control;
  for (const auto& [name, letter] : one.letters)
    convert.letters.emplace_back(name, std::string(1, letter));
  driver::NamedTexts hosts;
  for (const auto& host : one.hosts)
    hosts.emplace_back(host, host == "clearance" ? "Q" : "T");
  convert.letters.insert(convert.letters.end(), hosts.begin(), hosts.end());
  const driver::Outcome converted = driver::convert(convert);
  REQUIRE_MESSAGE(converted.status == 0, renderText(converted.diagnostics, converted.sources, 10));

  std::mt19937 random(4);
  std::uniform_int_distribution<int> place(-9999, 9999);
  std::uniform_int_distribution<int> system(53, 60);
  int passed = 0;
  int turnedAway = 0;
  const int sets = draws(400, 40);
  for (int set = 0; set < sets; ++set) {
    driver::PostOptions post;
    post.folders = convert.inputs;
    post.source = convert.source;
    post.common.recover = one.recover;
    post.common.field = one.mapped;
    post.common.host = {{"clearance", "15"}, {"tool_radius", "3"}};
    std::map<char, double> arguments;
    for (const auto& [host, letter] : hosts)
      arguments.emplace(letter[0], letter == "Q" ? 15.0 : 3.0);
    for (const auto& [name, letter] : one.letters) {
      const double value = name == "G" ? system(random) : place(random) / 100.0;
      post.common.set.emplace_back(name, numberText(value));
      arguments.emplace(letter, value);
    }
    const driver::Outcome posted = driver::post(post);
    MacroBRunner machine;
    presetMachine(machine);
    machine.run(converted.output, arguments);
    std::erase(machine.blocks, "G53"); // waits for the motion before a position is read
    if (posted.status != 0) {
      CHECK(machine.alarm >= 100);
      CHECK(machine.blocks.empty());
      ++turnedAway;
      continue;
    }
    ++passed;
    REQUIRE_MESSAGE(machine.alarm == 0, machine.alarmText);
    REQUIRE(machine.returned);
    const std::vector<std::string> expected = postedWords(posted.output);
    std::vector<std::string> ran = machine.blocks;
    REQUIRE(ran.size() >= expected.size() + 3);
    CHECK(ran.front() == "G90G94G17G40G80");
    ran.erase(ran.begin());
    CHECK(std::vector<std::string>(ran.begin(), ran.begin() + static_cast<std::ptrdiff_t>(expected.size())) ==
          expected);
    // What the program changed is put back: motion, plane, distance and feed mode, feed.
    std::string end;
    for (std::size_t i = expected.size(); i < ran.size(); ++i)
      end += ran[i];
    for (const char* word : {"G1", "G18", "G91", "G95", "F0.25"})
      CHECK_MESSAGE(end.find(word) != std::string::npos, end);
    CHECK(end.ends_with("M99"));
    CHECK(machine.variables[550] == (posted.output.find("#550") == std::string::npos
                                         ? MacroBRunner::Value()
                                         : MacroBRunner::Value(12.345)));
  }
  CHECK(passed > sets / 20);
  CHECK(turnedAway > sets / 20);
}

std::string example(const std::string& name) {
  return (root() / "examples" / name).generic_string();
}

} // namespace

TEST_CASE("a converted example does what its post prints") {
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b", "fanuc-6m"}) {
    // The controls but the first do not know the code that switches the probe.
    if (std::string(control) != "fanuc-0i-md") continue;
    runs({example("surface-x"),
          example("post.txt"),
          control,
          {{"G", 'S'}, {"X", 'X'}, {"I", 'I'}, {"Z", 'Z'}, {"R", 'R'}}});
    runs({example("bore"),
          example("mill-post.txt"),
          control,
          {{"G", 'S'}, {"D", 'D'}, {"I", 'I'}, {"J", 'J'}, {"Z", 'Z'}, {"R", 'R'}}});
  }
}

TEST_CASE("a converted corpus cycle does what its post prints") {
  fs::path corpusFolder;
  if (!haveCorpus(corpusFolder)) return;
  const std::string prog = (corpusFolder / "compost" / "probe-routines.txt").generic_string();
  const auto folder = [&](const char* name) { return (corpusFolder / "gibbs" / name).generic_string(); };
  runs({folder("MERENI.OSA.X"),
        prog,
        "fanuc-0i-md",
        {{"a", 'A'}, {"I", 'I'}, {"G", 'S'}, {"Zb", 'Z'}, {"Z", 'C'}},
        {{"X", "a"}},
        true});
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b", "fanuc-6m"})
    runs({folder("MERENI.OSA.Z"),
          prog,
          control,
          {{"d", 'D'}, {"C", 'C'}, {"Zb", 'Z'}, {"K", 'K'}, {"G", 'S'}},
          {{"Z", "d"}},
          true,
          {"tool_radius"}});
  runs({folder("MERENI.STRED.OTVOR"),
        prog,
        "fanuc-0i-md",
        {{"D", 'D'}, {"X", 'I'}, {"Y", 'J'}, {"G", 'S'}, {"Z", 'Z'}, {"Zb", 'B'}},
        {},
        true});
}
