// A control that states only what differs, and codes of the probe that the user gives.
#include "stdlib/ControlFacts.h"
#include "stdlib/ProbeCodes.h"
#include "tests/GoldenRunner.h"
#include "tests/unit/ControlText.h"

#include <algorithm>

using namespace dotek;
using namespace dotek::stdlib;
using tests::controlError;
using tests::DataFolder;

namespace {

constexpr const char* kCodes = "[[codes]]\ngrade = \"documented\"\nsource = \"x\"\nlist = [";

Control load(const DataFolder& folder, std::string_view name) {
  DataFiles files;
  Diagnostics diagnostics;
  REQUIRE(files.addFolder(folder.path(), Limits{}, diagnostics));
  auto control = Control::load(files, name);
  REQUIRE(control);
  return std::move(*control);
}

} // namespace

TEST_CASE("a control takes from the one that it extends what it does not state") {
  const DataFolder folder;
  folder.write("controls/ours.toml",
               std::string("schema = 1\ntitle = \"Ours\"\nextends = \"fanuc-31i-b\"\n") + kCodes +
                   "\"M71 probe-on: probe on\", \"M19 stop: stop\"]\n");
  folder.write("controls/later.toml",
               std::string("schema = 1\nextends = \"ours\"\n") + kCodes +
                   "\"M72 probe-off: probe off\"]\n"
                   "[alarm]\nfirst = 0\nlast = 99\nlength = 12\ngrade = \"observed\"\nsource = \"x\"\n");
  const Control base = *Control::load(DataFiles(), "fanuc-31i-b");
  const Control ours = load(folder, "ours");
  CHECK(ours.name == "ours");
  CHECK(ours.title == "Ours");
  CHECK(ours.codes.size() == base.codes.size() + 1);
  CHECK(ours.find(Function::ProbeOn)->tenths == 710);
  CHECK(ours.find('M', 190)->function == Function::Stop);
  CHECK(ours.find('G', 310)->function == Function::Skip);
  CHECK(ours.variables.skip == base.variables.skip);
  CHECK(ours.alarmLength == base.alarmLength);
  const Control later = load(folder, "later");
  CHECK(later.title == "Ours");
  CHECK(later.find(Function::ProbeOn)->tenths == 710);
  CHECK(later.find(Function::ProbeOff)->tenths == 720);
  CHECK(later.alarmLast == 99);
}

TEST_CASE("tables of a control merge by key, and ranges replace those that they overlap") {
  const DataFolder folder;
  folder.write("controls/ours.toml", "schema = 1\nextends = \"fanuc-31i-b\"\n"
                                     "remove = { codes = [\"G33\", \"G22-G23\"], variables = "
                                     "[\"2500-2899\", \"3100\", \"7001-7999\", \"5081-5083\"] }\n"
                                     "[words]\ninteger_digits = 6\ngrade = \"observed\"\nsource = \"x\"\n"
                                     "[variables]\ntool_count = 99\ngrade = \"observed\"\nsource = \"x\"\n"
                                     "[[common]]\nfirst = 500\nlast = 599\nkept = true\ngrade = "
                                     "\"observed\"\nsource = \"x\"\n"
                                     "[[state]]\ntitle = \"lamps\"\nfirst = 1110\naccess = "
                                     "\"store\"\ngrade = \"observed\"\nsource = \"x\"\n"
                                     "[[alarms]]\ngrade = \"observed\"\nsource = \"x\"\nlist = "
                                     "[\"no-feed 12: NO FEED\"]\n");
  const Control base = *Control::load(DataFiles(), "fanuc-31i-b");
  const Control ours = load(folder, "ours");
  CHECK(ours.integerDigits == 6);
  CHECK(ours.decimals == base.decimals);
  CHECK(ours.variables.toolCount == 99);
  CHECK(ours.variables.skip == base.variables.skip);
  CHECK_FALSE(ours.variables.extendedX);
  CHECK_FALSE(ours.variables.toolLength);
  CHECK(ours.isCommon(150));
  CHECK(ours.isCommon(599));
  CHECK_FALSE(ours.isCommon(600)); // #500 to #999 is replaced as a whole
  CHECK(ours.isToolOffset(2499));
  CHECK_FALSE(ours.isToolOffset(2500));
  CHECK_FALSE(ours.isToolOffset(2899));
  CHECK(ours.isToolOffset(2900));
  CHECK(ours.find('G', 330) == nullptr);
  CHECK(ours.find('G', 220) == nullptr);
  CHECK(ours.find('G', 230) == nullptr);
  CHECK(ours.find('G', 10) != nullptr);
  CHECK(ours.find(Alarm::NoFeed)->number == 12);
  CHECK(ours.find(Alarm::DivideByZero)->number == 112);
  const auto holds = [&](std::uint32_t number) {
    return std::any_of(ours.state.begin(), ours.state.end(), [&](const StateRange& range) {
      return range.first <= number && number <= range.last;
    });
  };
  CHECK(holds(1110));
  CHECK_FALSE(holds(1111)); // of the outputs that the base states as one range
  CHECK_FALSE(holds(3100));
  CHECK(holds(3101));
}

TEST_CASE("a range of codes that a control calls auxiliary fills what nothing lists") {
  const DataFolder folder;
  folder.write(
      "controls/ours.toml",
      std::string("schema = 1\nextends = \"fanuc-31i-b\"\n") + kCodes +
          "\"M1-M50 auxiliary: of the builder\", \"M31 probe-on: on\", \"G103 auxiliary: read ahead\"]\n");
  const Control ours = load(folder, "ours");
  CHECK(ours.find('M', 30)->function == Function::SpindleClockwise);
  CHECK(ours.find('M', 310)->function == Function::ProbeOn);
  CHECK(ours.find('M', 410)->function == Function::Auxiliary);
  CHECK(ours.find('M', 510) == nullptr);
  CHECK(ours.find('G', 1030)->function == Function::Auxiliary);
}

TEST_CASE("facts of a control name the files that state them") {
  const DataFolder folder;
  const std::string path = folder.write(
      "controls/ours.toml", std::string("schema = 1\nextends = \"fanuc-31i-b\"\n"
                                        "remove = { codes = [\"G33\"], variables = [\"100-120\"] }\n"
                                        "[words]\ninteger_digits = 6\ngrade = \"observed\"\nsource = "
                                        "\"tried\"\n") +
                                kCodes + "\"M8 stop: odd\"]\n");
  DataFiles files;
  Diagnostics diagnostics;
  REQUIRE(files.addFolder(folder.path(), Limits{}, diagnostics));
  const std::vector<ControlFact> facts = controlFacts(files, "ours");
  const auto file = [&](std::string_view section, std::string_view key) -> std::string {
    std::string out;
    for (const ControlFact& fact : facts)
      if (fact.section == section && fact.key == key) out += (out.empty() ? "" : "+") + fact.file;
    return out;
  };
  CHECK(file("words", "integer_digits") == path);
  CHECK(file("words", "decimals") == "built in: fanuc-31i-b");
  CHECK(file("codes", "M8") == path);
  CHECK(file("codes", "M9") == "built in: fanuc-31i-b");
  CHECK(file("codes", "G33").empty());
  CHECK(file("common", "#100-#199").empty());
  CHECK(file("common", "#121-#199") == "built in: fanuc-31i-b");
  CHECK(file("alarms", "no-feed") == "built in: fanuc-31i-b");
}

TEST_CASE("chains of controls have four members at most, and none extends itself") {
  const DataFolder folder;
  const auto link = [&](const char* name, const char* base) {
    folder.write(std::string("controls/") + name + ".toml",
                 std::string("schema = 1\nextends = \"") + base + "\"\n");
  };
  link("a", "fanuc-31i-b");
  link("b", "a");
  link("c", "b");
  link("d", "c");
  link("x", "y");
  link("y", "x");
  CHECK(load(folder, "c").alarmLength == 31);
  DataFiles files;
  Diagnostics diagnostics;
  REQUIRE(files.addFolder(folder.path(), Limits{}, diagnostics));
  CHECK_THROWS_WITH_AS(Control::load(files, "d"), doctest::Contains("more than 4 controls"), DataError);
  CHECK_THROWS_WITH_AS(Control::load(files, "x"), doctest::Contains("extend one another"), DataError);
}

TEST_CASE("defects of a control that extends another") {
  const auto removal = [](const std::string& what) {
    return controlError("schema = 1\nextends = 'fanuc-31i-b'\nremove = { " + what + " }\n");
  };
  CHECK(removal("codes = ['M77']").find("no code `M77` to remove") != std::string::npos);
  CHECK(removal("codes = ['T1']").find("is no code") != std::string::npos);
  CHECK(removal("variables = ['9-5']").find("no range of variables") != std::string::npos);
  CHECK(removal("variables = ['2001-2050']").find("`tool_wear`") != std::string::npos);
  CHECK(removal("variables = ['1100-1103']").find("cannot be removed") != std::string::npos);
  CHECK(controlError("schema = 1\nextends = 'fanuc-31i-b'\n[programs]\nlast = 99999\ngrade = "
                     "'observed'\nsource = 'x'\n")
            .starts_with("4:"));
  CHECK(controlError("schema = 1\nextends = 'none'\n").find("there is no control `none`") !=
        std::string::npos);
  CHECK(controlError("schema = 1\nextends = 'own'\n").find("extend one another") != std::string::npos);
  CHECK(controlError("schema = 1\nextends = 'fanuc-31i-b'\ncolour = 1\n").find("colour") !=
        std::string::npos);
}

TEST_CASE("codes of the probe: taken before those of the table, refused where they mean something else") {
  Control control = *Control::load(DataFiles(), "fanuc-31i-b");
  CHECK(control.find(Function::ProbeOn) == nullptr);
  CHECK(otherMeaning(control, "M8", true).find("oolant") != std::string::npos);
  CHECK(otherMeaning(control, "M71", true).empty());
  addProbeCodes(control, {"M71", "m8"});
  REQUIRE(control.find(Function::ProbeOn) != nullptr);
  CHECK(control.find(Function::ProbeOn)->tenths == 710);
  CHECK(control.find(Function::ProbeOff) == nullptr); // M8 is the coolant
  CHECK(control.find('M', 80)->function == Function::CoolantFlood);
  CHECK_FALSE(codeOf("31"));
  CHECK_FALSE(codeOf("M3.1"));
  CHECK_FALSE(codeOf("T5"));
  Control other = *Control::load(DataFiles(), "fanuc-0i-md");
  const std::uint32_t before = other.find(Function::ProbeOn)->tenths;
  addProbeCodes(other, {"M71", ""});
  CHECK(other.find(Function::ProbeOn)->tenths == 710);
  CHECK(other.find('M', before)->function == Function::ProbeOn);
}

TEST_CASE("a control by its path: a flag and dotek.toml may name one file by different paths") {
  const DataFolder folder;
  folder.write("6m.toml", "schema = 1\nextends = \"fanuc-6m\"\n");
  folder.write("dotek.toml", "schema = 1\ncontrol = \"./6m.toml\"\n");
  folder.write("a.nc", "O1\nG90 G0 X1.\nM30\n");
  folder.write("sub/b.nc", "O1\nG90 G0 X1.\nM30\n");
  const std::string whole = (std::filesystem::path(folder.path()) / "6m.toml").string();
  const auto clean = [&](std::vector<std::string> arguments, const char* from) {
    const auto result = tests::runDotek(arguments, std::filesystem::path(folder.path()) / from);
    CAPTURE(arguments[1]);
    CHECK_MESSAGE(result.status == 0, result.err);
  };
  clean({"sim", "a.nc"}, "");
  clean({"sim", "a.nc", "--control", "./6m.toml"}, "");
  clean({"sim", "a.nc", "--control", whole}, "");
  clean({"lint", "sub/b.nc", "--control", whole}, "");
  clean({"sim", "b.nc"}, "sub");
  clean({"sim", "b.nc", "--control", whole}, "sub");
  clean({"lint", "b.nc", "--control", whole}, "sub");
  clean({"sim", "b.nc", "--control", "../6m.toml"}, "sub");
}
