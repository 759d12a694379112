// A control that states only what differs, and codes of the probe that the user gives.
#include "stdlib/ProbeCodes.h"
#include "tests/unit/ControlText.h"

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

TEST_CASE("defects of a control that extends another") {
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
