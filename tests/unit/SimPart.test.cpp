// `dotek sim` with a part, a machine and pictures: what is bounded, what is written, plain programs beside
// macro ones.
#include "DataFolder.h"
#include "tests/GoldenRunner.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

namespace fs = std::filesystem;
using namespace dotek::tests;
using Json = nlohmann::json;

namespace {

constexpr const char* kMachine = "schema = 1\n[start]\nz = 50.0\n[probe]\nball_diameter = 6.0\nlength = 0.0\n"
                                 "length_to = \"tip\"\novertravel = 5.0\non = true\n";
constexpr const char* kPart = "schema = 1\n[[shape]]\nkind = \"box\"\nmin = [0.0, 0.0, -20.0]\n"
                              "max = [100.0, 100.0, 0.0]\n";

struct Folder : DataFolder {
  Folder() {
    write("machine.toml", kMachine);
    write("part.toml", kPart);
  }
  CommandResult sim(const std::string& program, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"sim", program, "--machine", "machine.toml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runDotek(arguments, path());
  }
  std::string read(const std::string& name) const { return readAll(fs::path(path()) / name); }
  bool has(const std::string& name) const { return fs::exists(fs::path(path()) / name); }
};

std::size_t countOf(const std::string& text, const std::string& what) {
  std::size_t out = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size())
    ++out;
  return out;
}

} // namespace

TEST_CASE("sim part: of a long plain program no more is reported and kept than is bounded") {
  Folder folder;
  std::string text = "G1 F100\n";
  for (int i = 0; i < 12'000; ++i)
    text += fmt::format("G31 X{}.\n", i % 7 + 1);
  folder.write("long.nc", text + "G0 Z49.\nM30\n");
  const CommandResult result = folder.sim("long.nc", {"--json", "--max-errors", "0"});
  CHECK(result.status == 0);
  const Json summary = Json::parse(result.out);
  CHECK(summary["events"].size() == 10'000);
  CHECK(summary["eventsLeftOut"] == 2'000);
  CHECK(summary["contactsLeftOut"] == 0);
  CHECK(summary["events"][9'999]["line"] == 10'001);
  CHECK(summary["diagnostics"].size() == 1'001);
  CHECK(summary["diagnostics"][1'000]["code"] == "too-many-findings");
  CHECK(summary["diagnostics"][1'000]["line"] == 1'002);
  CHECK(summary["diagnostics"][1'000]["severity"] == "note");
  // Errors that are not listed are an error, too.
  text.clear();
  for (int i = 0; i < 1'500; ++i)
    text += fmt::format("G0 X20. Y20. Z{}\nZ20.\n", -3 - i % 3);
  folder.write("deep.nc", text + "M30\n");
  const CommandResult deep = folder.sim("deep.nc", {"--part", "part.toml", "--quiet", "--max-errors", "0"});
  CHECK(deep.status == 1);
  CHECK(countOf(deep.err, "[rapid-into-part]") == 1'000);
  CHECK(countOf(deep.err, "error: more than 1000 findings `rapid-into-part`") == 1);
}

TEST_CASE("sim part: plain programs and macro programs meet the same part") {
  Folder folder;
  const std::string blocks =
      "G0 X-20. Y50. Z40.\nZ-10.\nG31 X10. F300\nG0 X-20.\nG31 X-8.\nG0 Z40.\nX50.\nG1 Z-1. "
      "F100\nG0 Z40.\nG2 X50. Y50. I-3.\nM30\n";
  folder.write("plain.nc", blocks);
  folder.write("macro.nc", "#1=1\n" + blocks);
  const Json plain = Json::parse(folder.sim("plain.nc", {"--part", "part.toml", "--json"}).out);
  const Json macro = Json::parse(folder.sim("macro.nc", {"--part", "part.toml", "--json"}).out);
  REQUIRE(plain["contacts"].size() == 1);
  REQUIRE(plain["events"].size() == 2);
  CHECK(plain["contacts"][0]["point"]["X"] == 0);
  CHECK(plain["events"][1]["outcome"] == "early-contact");
  CHECK(plain["position"] == macro["position"]);
  for (const char* list : {"contacts", "events"}) {
    REQUIRE(plain[list].size() == macro[list].size());
    for (std::size_t i = 0; i < plain[list].size(); ++i) {
      Json one = plain[list][i], other = macro[list][i];
      CHECK(one["line"].get<int>() + 1 == other["line"].get<int>());
      for (Json* event : {&one, &other})
        for (const char* key : {"line", "file"})
          event->erase(key);
      CHECK(one == other);
    }
  }
}

TEST_CASE("sim part: the calibrated stylus of the machine goes into vendors' macros") {
  Folder folder;
  folder.write("machine.toml", std::string(kMachine) + "effective_radius = 2.9\npre_travel = 0.02\n");
  folder.write("call.nc", "O1\nG0 X-20. Y50.\nG65 P9810 Z-10. F500.\nG65 P9811 X0 S2.\nM30\n");
  const std::vector<std::string> more = {"--part", "part.toml", "--probe-macros", "inspection-plus"};
  const CommandResult result = folder.sim("call.nc", more);
  CHECK(result.status == 0);
  CHECK(result.out.find("offset 55 X0.000000\n") != std::string::npos);
  CHECK(result.out.find("not calibrated") == std::string::npos);
}

TEST_CASE("sim part: pictures are files, whatever the run met, but for wrong arguments") {
  Folder folder;
  folder.write("crash.nc", "G0 X-20. Y50. Z-10.\nX20.\nM30\n");
  folder.write("macro.nc", "#1=1\nG0 X-20. Y50. Z-10.\nX20.\nM30\n");
  folder.write("mill.SUF", "N10 G90 G94\r\nN20 G0 X-20 Y50\r\nN30 G0 Z-10\r\nN40 G0 X20\r\nN50 M30\r\n");
  for (const std::string program : {"crash.nc", "macro.nc", "mill.SUF"}) {
    CAPTURE(program);
    const std::string svg = program + ".svg", html = program + ".html";
    const CommandResult result =
        folder.sim(program, {"--part", "part.toml", "--svg", svg, "--html", html, "--quiet"});
    CHECK(result.status == 1);
    CHECK(countOf(result.err, "[rapid-into-part]") == 1);
    CHECK(!folder.read(svg).empty());
    CHECK(!folder.read(html).empty());
  }
  CHECK(folder.sim("crash.nc", {"--svg", "no/folder/a.svg", "--quiet"}).status == 2);
  CHECK(folder.sim("none.nc", {"--svg", "none.svg", "--quiet"}).status == 2);
  CHECK(!folder.has("none.svg"));
  // Without a machine the path is drawn, and a skip move ends the run as ever.
  CHECK(runDotek({"sim", "crash.nc", "--svg", "bare.svg", "--quiet"}, folder.path()).status == 0);
  CHECK(!folder.read("bare.svg").empty());
}

TEST_CASE("sim part: a picture says where it stops") {
  Folder folder;
  std::string text = "G0 Z60.\n";
  for (int i = 0; i < 200'000; ++i)
    text += i % 2 == 0 ? "X1.\n" : "X2.\n";
  folder.write("long.nc", text + "M30\n");
  const CommandResult result = folder.sim("long.nc", {"--svg", "long.svg", "--quiet"});
  CHECK(result.status == 0);
  CHECK(result.err ==
        "dotek: note: the picture holds the first 200000 motions of the run; what comes later is not "
        "drawn [picture-ends]\n");
  folder.write("fits.nc", "G0 X3.\nM30\n");
  CHECK(folder.sim("fits.nc", {"--svg", "fits.svg", "--quiet"}).err.empty());
}

TEST_CASE("sim part: what a program measured, with the offset that it wrote then, is in its summary and its "
          "pictures") {
  Folder folder;
  folder.write("touch.nc", "O0042\nG90 G21 G54\nG10 L2 P1 X10.\nG0 X-30. Y50. Z-5.\nG31 X5. F200.\n"
                           "#101=#5061+3.\n#[5221]=#[5221]+#101\n#2003=0.25\nG0 X-40.\nM30\n");
  const CommandResult result = folder.sim("touch.nc", {"--part", "part.toml", "--json", "--html", "a.html",
                                                       "--svg", "a.svg", "--date", "21 Nov <2026>"});
  CHECK(result.status == 0);
  const Json measured = Json::parse(result.out)["measured"];
  REQUIRE(measured.size() == 2);
  CHECK(measured[0]["feature"] == "");
  CHECK(measured[0]["offsets"][0] == Json{{"name", "G54 X"}, {"before", 0.0}, {"after", 10.0}});
  CHECK(measured[1]["feature"] == "touch along X+");
  CHECK(measured[1]["place"] == "touch.nc:5");
  CHECK(measured[1]["system"] == "G54");
  CHECK(measured[1]["values"][0] ==
        Json{{"name", "X"}, {"nominal", nullptr}, {"measured", -13.0}, {"deviation", nullptr}});
  CHECK(measured[1]["offsets"][0] == Json{{"name", "G54 X"}, {"before", 10.0}, {"after", 0.0}});
  CHECK(measured[1]["offsets"][1] == Json{{"name", "tool 3 wear"}, {"before", 0.0}, {"after", 0.25}});
  for (const char* name : {"a.html", "a.svg"}) {
    const std::string shown = folder.read(name);
    for (const char* text : {"id=\"measured\"", "touch along X+", "-13.000",
                             "G54 X set from 10.000 to 0.000 (-10.000)", "21 Nov &lt;2026&gt;"})
      CHECK_MESSAGE(shown.find(text) != std::string::npos, name << ": " << text);
  }
}

TEST_CASE("sim part: a vendor's call is one row, with nominal and deviation, not the touches that it makes") {
  Folder folder;
  folder.write("web.nc", "O0043\nG90 G21 G54\nG0 X50. Y50.\nG65 P9811 Z1.5 S2\nM30\n");
  const CommandResult result =
      folder.sim("web.nc", {"--part", "part.toml", "--json", "--probe-macros", "inspection-plus"});
  const Json summary = Json::parse(result.out);
  const Json measured = summary["measured"];
  REQUIRE(measured.size() == 1);
  CHECK(measured[0]["program"] == 9811);
  CHECK(measured[0]["place"] == "web.nc:4");
  CHECK(measured[0]["values"][0] ==
        Json{{"name", "Z"}, {"nominal", 1.5}, {"measured", 0.0}, {"deviation", -1.5}});
  CHECK(measured[0]["offsets"][0] == Json{{"name", "G55 Z"}, {"before", 0.0}, {"after", -1.5}});
  CHECK(summary["contacts"].size() == 2);
}

TEST_CASE("sim part: a run that leaves the travel is told by axis, direction, place and limit") {
  Folder folder;
  folder.write("travel.toml", std::string(kMachine) + "[travel]\nz = [-200.0, 60.0]\n");
  folder.write("up.nc", "O7\nG90 G54\nG0 Z75.5\nM30\n");
  const CommandResult result =
      runDotek({"sim", "up.nc", "--machine", "travel.toml", "--svg", "up.svg", "--quiet"}, folder.path());
  CHECK(result.status == 1);
  CHECK(
      result.err.find(
          "Z+ over-travel: the move takes the spindle to machine Z75.500, and the travel ends at Z60.000") !=
      std::string::npos);
  CHECK(folder.read("up.svg").find(">OVER-TRAVEL<") != std::string::npos);
}
