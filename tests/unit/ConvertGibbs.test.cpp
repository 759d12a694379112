// Cycles as folders for GibbsCAM: what is written reads back, is posted and does what the cycle means.
#include "driver/Driver.h"
#include "support/messages/Verify.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

using namespace dotek;
using namespace dotek::tests;

namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

std::string libraryPath(const std::string& name) {
  return (root() / "stdlib/cycles" / (name + ".cycle")).string();
}

std::string said(const driver::Outcome& outcome) {
  return outcome.output + renderText(outcome.diagnostics, outcome.sources, 0);
}

bool says(const driver::Outcome& outcome, std::string_view code) {
  const auto& all = outcome.diagnostics.all();
  return std::any_of(all.begin(), all.end(), [&](const Diagnostic& one) { return one.code == code; });
}

void expectSaid(const driver::Outcome& outcome, std::string_view code) {
  CHECK_MESSAGE(says(outcome, code), code << " of:\n" << said(outcome));
}

// Alarms of a post that was read get numbers in the order of the blocks, and a variable that may be empty is
// taken from 0.
std::string withoutNumbers(const std::string& text) {
  static const std::regex kAlarm("#3000=[0-9]+");
  static const std::regex kFromZero("\\[0\\.-#");
  return std::regex_replace(std::regex_replace(text, kAlarm, "#3000="), kFromZero, "[-#");
}

driver::ConvertOptions optionsOf(const std::string& path, const std::string& set, const Values& defaults) {
  driver::ConvertOptions out;
  out.inputs = {path};
  out.to = "gibbs";
  out.probeMacros = set;
  out.defaults = defaults;
  out.common.host = {{"approach_feed", "1000"}, {"overtravel", "5"}};
  return out;
}

// The folder on disk; its path.
std::string written(const driver::Outcome& outcome, const TestFolder& folder) {
  std::string path;
  for (const OutputFile& file : outcome.files)
    path = folder.write(file.name, file.text);
  return path.substr(0, path.rfind('/'));
}

driver::Outcome posted(const std::string& path) {
  driver::PostOptions options;
  options.folders = {path};
  options.source.prog = path + "/branch.txt";
  options.source.form = "thesis-a";
  options.common.host = {{"tool_radius", "3"}};
  return driver::post(options);
}

// Blocks of a post as a program that is called, with the modes that a caller gets back.
std::string program(const std::string& blocks) {
  return "%\nO8000(POSTED)\n#33=#4001\n#32=#4002\n#31=#4003\n#30=#4005\n#29=#4109\n" + blocks +
         "G#33 G#32 G#31 G#30 F#29\nM99\n%\n";
}

struct Case {
  const char* cycle;
  Values values; // of all parameters
};

// The limits that most cycles share, given so that nothing is left out.
Values with(Values values, const char* tolerance = "0.1") {
  values.insert(values.end(), {{"tolerance", tolerance}, {"violation", "1"}, {"protocol", "0"}});
  return values;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> out = {
      {"surface-x", with({{"distance", "12"}, {"system", "55"}, {"at_x", "0"}})},
      {"surface-x", with({{"distance", "-9.125"}, {"system", "59"}, {"at_x", "-3.5"}})},
      {"surface-y", with({{"distance", "-11"}, {"system", "56"}, {"at_y", "3"}})},
      {"surface-z", with({{"distance", "-7"}, {"system", "55"}, {"at_z", "1"}})},
      {"bore", with({{"diameter", "30"}, {"depth", "2"}, {"system", "55"}, {"at_x", "0"}, {"at_y", "1"}})},
      {"boss", with({{"diameter", "24"},
                     {"depth", "12"},
                     {"clearance", "7"},
                     {"system", "55"},
                     {"at_x", "0"},
                     {"at_y", "1"}})},
      {"web-x",
       with({{"width", "20"}, {"depth", "12"}, {"clearance", "7"}, {"system", "55"}, {"at_x", "2"}})},
      {"channel-y", with({{"width", "28"}, {"depth", "3"}, {"system", "55"}, {"at_y", "2"}})},
      {"corner-inner",
       {{"distance_x", "15"}, {"distance_y", "-12"}, {"system", "55"}, {"at_x", "2"}, {"at_y", "3"}}},
      {"corner-outer",
       {{"reach_x", "20"},
        {"reach_y", "20"},
        {"depth", "12"},
        {"clearance", "7"},
        {"system", "55"},
        {"at_x", "2"},
        {"at_y", "3"}}},
      {"rectangle-inside", with({{"size_x", "40"},
                                 {"size_y", "30"},
                                 {"depth", "2"},
                                 {"system", "55"},
                                 {"at_x", "2"},
                                 {"at_y", "3"}})},
      {"step-height",
       with({{"distance", "10"}, {"step_up", "4"}, {"distance_x", "40"}, {"distance_y", "0"}})},
  };
  return out;
}

} // namespace

TEST_CASE(
    "convert to gibbs: a cycle of the library is posted as what it means, and lint has nothing to say") {
  for (const char* const set : {"inspection-plus", "dotek"})
    for (const Case& one : cases()) {
      CAPTURE(one.cycle);
      CAPTURE(set);
      const driver::Outcome outcome = driver::convert(optionsOf(libraryPath(one.cycle), set, one.values));
      REQUIRE_MESSAGE(outcome.status == 0, said(outcome));
      REQUIRE(outcome.files.size() == 5);
      const TestFolder folder("dotek-to-gibbs");
      const std::string path = written(outcome, folder);

      lint::LintOptions lint;
      lint.paths = {path};
      lint.select = {"all"};
      const driver::Outcome linted = driver::lint(lint);
      CHECK_MESSAGE(linted.diagnostics.all().empty(), said(linted));

      const driver::Outcome blocks = posted(path);
      REQUIRE_MESSAGE(blocks.status == 0, said(blocks));
      driver::VerifyOptions verify;
      verify.inputs = {libraryPath(one.cycle)};
      verify.to = "fanuc";
      verify.probeMacros = set;
      verify.jobs = 1;
      verify.cases = draws(20U, 4U);
      verify.common.host = {{"approach_feed", "1000"}, {"overtravel", "5"}, {"tool_radius", "3"}};
      verify.common.set = one.values;
      verify.translation = folder.write("posted.nc", program(blocks.output));
      const driver::Outcome verified = driver::verify(verify);
      // Blocks of a post ask nothing of a caller, and keep their values in common variables; whatever else
      // differs, no case comes to callers.
      for (const Diagnostic& each : verified.diagnostics.all())
        CHECK_MESSAGE((each.code != diag::VerifyDiffers::code ||
                       each.message.find(": called ") != std::string::npos ||
                       each.message.find("the source does not write it") != std::string::npos),
                      said(verified));
      CHECK_MESSAGE(verified.status < 2, said(verified));
    }
}

// The branch counts from where the probe is (#5003), the path from the retract plane.
TEST_CASE("convert to gibbs: the folder agrees with its own branch, run as any other folder") {
  for (const char* const name : {"surface-z", "bore"}) {
    CAPTURE(name);
    const auto one = std::find_if(cases().begin(), cases().end(),
                                  [&](const Case& each) { return each.cycle == std::string(name); });
    const driver::Outcome outcome =
        driver::convert(optionsOf(libraryPath(name), "inspection-plus", one->values));
    REQUIRE_MESSAGE(outcome.status == 0, said(outcome));
    const TestFolder folder("dotek-gibbs-verified");
    const std::string path = written(outcome, folder);
    driver::VerifyOptions verify;
    verify.inputs = {path};
    verify.to = "fanuc";
    verify.source.prog = path + "/branch.txt";
    verify.source.form = "thesis-a";
    verify.jobs = 1;
    verify.cases = draws(30U, 6U);
    const driver::Outcome verified = driver::verify(verify);
    CHECK_MESSAGE(verified.output.starts_with("AGREES"), said(verified));
  }
}

TEST_CASE("convert to gibbs: the folder comes back as a cycle that does the same") {
  for (const Case& one : cases()) {
    if (one.cycle == std::string("surface-z")) continue; // from another height than its path
    CAPTURE(one.cycle);
    const driver::Outcome outcome =
        driver::convert(optionsOf(libraryPath(one.cycle), "inspection-plus", one.values));
    REQUIRE_MESSAGE(outcome.status == 0, said(outcome));
    const TestFolder folder("dotek-gibbs-back");
    const std::string path = written(outcome, folder);
    driver::ConvertOptions back;
    back.inputs = {path};
    back.to = "cycle";
    back.source.prog = path + "/branch.txt";
    back.source.form = "thesis-a";
    const driver::Outcome cycle = driver::convert(back);
    REQUIRE_MESSAGE(cycle.status == 0, said(cycle));
    REQUIRE(cycle.files.size() == 1);
    const std::string& text = cycle.files.front().text;
    // Places, offsets and lists by their words, and no variable of a control.
    CHECK_MESSAGE(text.find("#") == std::string::npos, text);
    CHECK_MESSAGE(
        (text.find("set system:") == std::string::npos) == (one.cycle == std::string("step-height")), text);
    if (text.find("violation") != std::string::npos)
      CHECK_MESSAGE(text.find(": choice of stops, flags = stops") != std::string::npos, text);
    driver::VerifyOptions verify;
    verify.inputs = {path};
    verify.to = "cycle";
    verify.source.prog = path + "/branch.txt";
    verify.source.form = "thesis-a";
    verify.jobs = 1;
    verify.cases = draws(20U, 5U);
    const driver::Outcome verified = driver::verify(verify);
    CHECK_MESSAGE(verified.output.starts_with("AGREES"), said(verified));
  }
}

// The diameter moves the probe by way of a variable of the control: nobody may leave it out.
TEST_CASE("convert to gibbs: what the branch keeps in a variable and moves by is an argument to be given") {
  const auto one = std::find_if(cases().begin(), cases().end(),
                                [](const Case& each) { return each.cycle == std::string("boss"); });
  const driver::Outcome outcome =
      driver::convert(optionsOf(libraryPath("boss"), "inspection-plus", one->values));
  REQUIRE_MESSAGE(outcome.status == 0, said(outcome));
  const TestFolder folder("dotek-gibbs-moves");
  const std::string path = written(outcome, folder);
  driver::ConvertOptions options;
  options.inputs = {path};
  options.to = "fanuc";
  options.source.prog = path + "/branch.txt";
  options.source.form = "thesis-a";
  const driver::Outcome program = driver::convert(options);
  REQUIRE_MESSAGE(program.files.size() == 1, said(program));
  CHECK_MESSAGE(program.files.front().text.find("DIAMETER    MM   GIVE") != std::string::npos,
                program.files.front().text);
}

TEST_CASE("convert to gibbs: a folder that is read and written again stays what it is") {
  for (const Case& one : cases()) {
    CAPTURE(one.cycle);
    const driver::Outcome first = driver::convert(optionsOf(libraryPath(one.cycle), "dotek", one.values));
    REQUIRE_MESSAGE(first.status == 0, said(first));
    const TestFolder before("dotek-gibbs-first"), after("dotek-gibbs-second");
    const std::string path = written(first, before);
    driver::ConvertOptions again = optionsOf(path, "dotek", {});
    again.source.prog = path + "/branch.txt";
    again.source.form = "thesis-a";
    const driver::Outcome second = driver::convert(again);
    REQUIRE_MESSAGE(second.status == 0, said(second));
    const std::string other = written(second, after);
    const driver::Outcome a = posted(path), b = posted(other);
    CHECK_MESSAGE(b.status == 0, said(b));
    CHECK(withoutNumbers(a.output) == withoutNumbers(b.output));
    driver::DumpOptions dump;
    dump.stage = driver::Stage::Path;
    dump.common.host = {{"tool_radius", "3"}, {"retract", "20"}, {"start_x", "5"}, {"start_y", "6"}};
    dump.inputs = {path};
    // A radius that the dialog leaves in a field is 0 before it is shown.
    if (first.files.front().text.find("tool_radius") != std::string::npos) continue;
    const driver::Outcome drawn = driver::dump(dump);
    dump.inputs = {other};
    CHECK(drawn.output == driver::dump(dump).output);
    CHECK_FALSE(drawn.output.empty());
  }
}

TEST_CASE("convert to gibbs: a field that only decides stays, with what it decides") {
  const TestFolder folder("dotek-gibbs-decides");
  folder.write("side/DefineData.txt", "SIDE = 1\nW = 12\nX = 0\n");
  folder.write("side/CycleData.dlg", "dialog \"Side\", 40, 40, 420, 200\nlabel 20, 20, 60, 24, \"SIDE\"\n"
                                     "dropdown_new 90, 20, 110, 24, SIDE\ndropdown_add 1, \"left\", 1\n"
                                     "dropdown_add 1, \"right\", 2\ndropdown_val 1, SIDE\n"
                                     "label 20, 50, 60, 24, \"W [mm]\"\ninput 90, 50, 70, 24, W, W\n"
                                     "ok 130, 130, 80, 28\ncancel 230, 130, 80, 28\n");
  folder.write("side/ToolPath.mac", "op = callback_op\nget_op_data op, TOOL_NUM, tool\n"
                                    "get_tool_data tool, MTOOL_RADIUS, radius\n"
                                    "if SIDE = 1 then add_custom_drill_cycle_path feed_x, W-radius\n"
                                    "if SIDE = 2 then add_custom_drill_cycle_path feed_x, radius-W\n"
                                    "add_custom_drill_cycle_path feed_x, 0\n");
  const std::string prog = folder.write(
      "post.txt", "#1 = '####.###;0'\nFORMAT(OpFieldData#,1)\nprobe:\nIF CycleType?('side')\n SeqC SpinOff "
                  "EOL\n SeqC ' M31' EOL\n SeqC ' G65 P9023 S55. X'OpFieldData#('X')' I0' EOL\n"
                  " SeqC ' M32' EOL\nEND\nRETURN\n");
  const auto checks = [&](const std::string& lines) {
    folder.write("side/CycleData.mac",
                 ":ask\ndialog \"CycleData.dlg\"\nif W <= 5 then message \"Too short\"\n"
                 "if W <= 5 then goto ask\n" +
                     lines);
    driver::ConvertOptions options = optionsOf((folder / "side").string(), "easyprobe", {});
    options.source.prog = prog;
    options.source.form = "thesis-a";
    options.probeMacros.reset();
    const driver::Outcome outcome = driver::convert(options);
    REQUIRE_MESSAGE(outcome.status == 0, said(outcome));
    CHECK_FALSE(says(outcome, "cam-unused"));
    std::string out;
    for (const OutputFile& file : outcome.files)
      if (file.name == "side/CycleData.mac" || file.name == "side/DefineData.txt") out += file.text;
    return out;
  };
  const auto holds = [](const std::string& text, std::string_view part) {
    CHECK_MESSAGE(text.find(part) != std::string::npos, part << " in\n" << text);
  };
  const std::string sign = checks("v = 1\nif SIDE = 2 then v = -1\nX = v*W\n");
  holds(sign, "SIDE = 1");
  holds(sign, "if SIDE");
  holds(sign, "-1");
  const std::string limit = checks(
      "k = 0\nif SIDE = 2 then k = 8\nif W < k then message \"too near\"\nif W < k then goto ask\nX = W\n");
  holds(limit, "if SIDE");
  const std::string jumped = checks("X = W\nif SIDE = 1 then goto done\nX = 0-W\n:done\n");
  holds(jumped, "if SIDE");
  const std::string checked = checks("if SIDE = 2 then message \"no\"\nif SIDE = 2 then goto ask\nX = W\n");
  holds(checked, "message \"no\"");
}

TEST_CASE("convert to gibbs: what a dialog or a Prog cannot say is refused or said") {
  const TestFolder folder("dotek-gibbs-says");
  const auto convert = [&](const std::string& text, const Values& defaults,
                           const Values& hosts = {{"approach_feed", "1000"}}) {
    driver::ConvertOptions options = optionsOf(folder.write("edge.cycle", text), "dotek", defaults);
    options.common.host = hosts;
    return driver::convert(options);
  };
  const std::string head = "// What it is\ncycle edge \"Edge\"\n\n";
  const std::string touch = "spindle off\nprobe on\ntouch x by 10 mm -> right\nprobe off\n";
  CHECK(says(
      convert(head + "parameter d : length\n\nspindle off\nprobe on\ntouch x by d -> right\nprobe off\n", {}),
      "cam-default-missing"));
  const driver::Outcome left = convert(
      head + "parameter datum : work_offset optional\n\n" + touch +
          "if given datum then\n  set datum: right.at becomes x 0 mm\nend\nreport \"Edge\" nominal 1 mm "
          "measured right.at\n",
      {});
  CHECK_MESSAGE(left.status == 0, said(left));
  expectSaid(left, "cam-not-asked");
  expectSaid(driver::convert(optionsOf(libraryPath("surface-x"), "dotek", {{"distance", "12"}})),
             "cam-unused");
  expectSaid(left, "cam-report");
  expectSaid(convert(head + "spindle off\nprobe on\nprotected move by z -5 mm\n" + touch.substr(21), {}, {}),
             "cam-host-unknown");
  expectSaid(convert(head + "parameter way : length = 1 mm require round(way / 1 mm) < 5\n\nspindle "
                            "off\nprobe on\ntouch x by way -> right\nprobe off\n",
                     {}),
             "cam-expression");
  expectSaid(convert(head + "move to machine z 0 mm\n" + touch, {}), "cam-path");
  expectSaid(convert("cycle edge \"Hrana \xc5\xbe\"\n\n" + touch, {}), "cam-text-plain");
  expectSaid(convert(head + "parameter plane : length = 10 mm\n\nspindle off\nprobe on\ntouch x by plane -> "
                            "right\nprobe off\n",
                     {}),
             "cam-name-changed");
  expectSaid(convert(head + "parameter n : count = 2\n\nspindle off\nprobe on\nrepeat n times\n  touch x by "
                            "10 mm -> right\nend\nprobe off\n",
                     {}),
             "branch-goes-back");
  expectSaid(convert(head + "result found : length\n\n" + touch +
                         "found = right.at\nif found > 3 mm then\n  alarm \"Too far\"\nend\n",
                     {}),
             "cam-variables");

  driver::ConvertOptions without = optionsOf((root() / "examples/surface-x").string(), "dotek", {});
  without.common.host.clear();
  expectSaid(driver::convert(without), "cam-no-post");
}

// Controls of a dialog as rectangles: x, y, width, height.
TEST_CASE("convert to gibbs: no control of the dialog covers another or leaves the window") {
  for (const Case& one : cases()) {
    CAPTURE(one.cycle);
    const driver::Outcome outcome = driver::convert(optionsOf(libraryPath(one.cycle), "dotek", one.values));
    const auto file = std::find_if(outcome.files.begin(), outcome.files.end(), [](const OutputFile& each) {
      return each.name.ends_with("/CycleData.dlg");
    });
    REQUIRE(file != outcome.files.end());
    struct Box {
      long x, y, w, h;
    };
    std::vector<Box> boxes;
    Box window{};
    std::istringstream lines(file->text);
    for (std::string line; std::getline(lines, line);) {
      CHECK(std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c < 127; }));
      if (line.starts_with("dropdown_add") || line.starts_with("dropdown_val")) continue;
      std::string numbers = line.substr(line.find(' '));
      const bool isWindow = line.starts_with("dialog");
      if (isWindow) numbers = line.substr(line.rfind('"') + 2);
      std::replace(numbers.begin(), numbers.end(), ',', ' ');
      Box box{};
      std::istringstream(numbers) >> box.x >> box.y >> box.w >> box.h;
      if (isWindow)
        window = box;
      else
        boxes.push_back(box);
    }
    REQUIRE(boxes.size() > 3);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      CHECK(boxes[i].x >= 0);
      CHECK(boxes[i].y >= 0);
      CHECK(boxes[i].x + boxes[i].w <= window.w);
      CHECK(boxes[i].y + boxes[i].h <= window.h);
      for (std::size_t j = 0; j < i; ++j)
        CHECK((boxes[i].x >= boxes[j].x + boxes[j].w || boxes[j].x >= boxes[i].x + boxes[i].w ||
               boxes[i].y >= boxes[j].y + boxes[j].h || boxes[j].y >= boxes[i].y + boxes[i].h));
    }
  }
}
