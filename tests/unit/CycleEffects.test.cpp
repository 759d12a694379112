// What is said of a cycle beside its program: which arguments move the probe, its page, its refusals.
#include "tests/GoldenRunner.h"
#include "tests/unit/DataFolder.h"

#include <doctest/doctest.h>
#include <string>

namespace dotek::tests {
namespace {

constexpr const char* kSide = R"(cycle side "Side"
parameter way      : length = 10 mm       "Way"           require way > 0 mm "No way"
parameter system   : work_offset optional "Offset to set"
parameter limit    : length optional      "Limit"         require limit > 0 mm "No limit"
parameter protocol : flag = no            "Prints a line"
result    away     : length               "Deviation"

spindle off
coolant off
probe on
touch x by way -> one
probe off
away = one.error
if protocol then
  report "Side" measured away
end
if given limit then
  if abs(away) > limit then
    alarm "Out of limits"
  end
end
if given system then
  set system: one.at becomes x 0 mm
end
)";

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("header: what only decides on a set, a report or an alarm moves nothing") {
  const DataFolder folder;
  folder.write("side.cycle", kSide);
  const auto convert = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = {"convert",         "--to",        "fanuc",
                                    "--control",       "fanuc-31i-b", "--probe-macros",
                                    "inspection-plus", "--arg",       "system=S"};
    all.insert(all.end(), more.begin(), more.end());
    const CommandResult run = runDotek(all, folder.path());
    CHECK_MESSAGE(run.status == 0, run.err);
    return run.out;
  };
  std::string program = convert({"side.cycle", "--arg", "way=A", "--arg", "limit=H", "--arg", "protocol=W"});
  CHECK_MESSAGE(holds(program, "(MOVE THE PROBE: A)"), program);
  CHECK_MESSAGE(holds(program, "(SET OR COMPARE, MOVE NOTHING: "), program);
  // What is set before a move moves it.
  folder.write("again.cycle", "cycle again \"Again\"\nparameter system : work_offset optional \"Offset\"\n"
                              "spindle off\ncoolant off\nprobe on\ntouch x by 9 mm -> one\n"
                              "if given system then\n  set system: one.at becomes x 0 mm\nend\n"
                              "touch x by 9 mm -> two\nprobe off\n");
  program = convert({"again.cycle"});
  CHECK_MESSAGE(holds(program, "(MOVE THE PROBE: S)"), program);
}

TEST_CASE("doc: a page lists the alarms that can come, and what each name of a line may be") {
  const DataFolder folder;
  folder.write("side.cycle", kSide);
  folder.write("two.cycle", "cycle two \"Two sides\"\n"
                            "parameter wide, high : length \"Ways\" range 5 mm to 90 mm\n"
                            "spindle off\nprobe on\nprotected move by z -1 mm\n"
                            "call side way = wide -> first\nprobe off\nspindle off\nprobe on\n"
                            "touch y by high -> second\nprobe off\n"
                            "call bore diameter = wide -> third\n");
  const std::string page = runDotek({"doc", "two.cycle"}, folder.path()).out;
  for (const char* const part :
       {"- `wide` is within 5 mm to 90 mm\n", "- `high` is within 5 mm to 90 mm\n",
        "- A protected move that meets something\n", "- No way\n", "- No room in the bore\n",
        "- `bore` (no page here)\n", "- `side` (no page here)\n"})
    CHECK_MESSAGE(holds(page, part), part << page);
  for (const char* const part : {"Out of limits", "Out of tolerance", "No limit", "](bore.md)"})
    CHECK_MESSAGE(!holds(page, part), part << page);
  const std::string both = runDotek({"doc", "two.cycle", "side.cycle"}, folder.path()).out;
  CHECK_MESSAGE(holds(both, "- [side](side.md)\n"), both);
  // With a limit the alarm can come.
  folder.write("two.cycle", "cycle two \"Two sides\"\nparameter wide : length \"Way\"\n"
                            "call side way = wide, limit = 1 mm -> first\n");
  CHECK(holds(runDotek({"doc", "two.cycle"}, folder.path()).out, "- Out of limits\n"));
}

TEST_CASE("mikroprog: values with which a cycle ends in its alarm are refused, and no difference") {
  const DataFolder folder;
  folder.write("deep.cycle", "cycle deep \"Deep\"\n"
                             "parameter size : length \"Size\" range 6 mm to 28 mm\n"
                             "spindle off\ncoolant off\nprobe on\nprotected move by z -1 mm\n"
                             "if size < 20 mm then\n  alarm \"No room\"\nend\n"
                             "touch x by size -> one\nprotected move to x one.at / 2\nprobe off\n");
  const auto run = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> all = arguments;
    for (const char* const one : {"--to", "mikroprog", "--control", "mikroprog-mill"})
      all.emplace_back(one);
    return runDotek(all, folder.path());
  };
  const CommandResult checked = run({"verify", "deep.cycle", "--cases", "20"});
  CHECK_MESSAGE(holds(checked.err + checked.out, "conversion-refused"), checked.out << checked.err);
  CHECK(!holds(checked.err + checked.out, "verify-differs"));
  const CommandResult small =
      run({"convert", "deep.cycle",   "--set",  "size=10",      "--host", "approach_feed=800",
           "--host",  "clearance=0",  "--host", "overtravel=3", "--host", "return_feed=240",
           "--host",  "start_x=0",    "--host", "start_y=0",    "--host", "start_z=0",
           "--host",  "tool_radius=3"});
  CHECK(small.status == 1);
  CHECK_MESSAGE(holds(small.err, "the cycle ends in its alarm `No room`"), small.err);
}

TEST_CASE("gibbs: a touch along a direction is refused as that") {
  const DataFolder folder;
  folder.write("tilted.cycle", "cycle tilted \"Tilted\"\nparameter way : length = 9 mm \"Way\"\n"
                               "spindle off\nprobe on\ntouch along x 1, y 1 by way -> one\nprobe off\n");
  const CommandResult run = runDotek({"convert", "tilted.cycle", "--to", "gibbs", "--control", "fanuc-0i-md",
                                      "--probe-macros", "dotek", "--host", "approach_feed=2000", "-o", "out"},
                                     folder.path());
  CHECK_MESSAGE(holds(run.err, "cannot draw a touch along a direction; touch along an axis"), run.err);
}

} // namespace dotek::tests
