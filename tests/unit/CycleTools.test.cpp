// Tool offsets in cycles: what is set, what is read, and what a control cannot say.
#include "driver/Driver.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <string>

using namespace dotek;
using namespace dotek::tests;

namespace {

// Each part is read and set, and read again after it was set.
constexpr const char* kParts = R"(cycle parts "Parts of a tool offset"

parameter offset : tool_offset "Tool offset" letter T
parameter found  : length      "Measured less nominal" range -1 mm to 1 mm
result    before, after, whole : length

before = offset.radius_wear
if abs(found) > 0.1 mm then
  set tool offset radius_wear before + found / 2
end
after = offset.radius
whole = offset.length
set tool offset length_wear offset.length_wear - found
if offset.length > whole then
  whole = offset.length + offset.length_wear
end
)";

constexpr const char* kWhole = R"(cycle whole "A radius as a whole"

parameter offset : tool_offset "Tool offset" letter T
parameter found  : length      "Found" range 1 mm to 9 mm
result    left_over : length

set tool offset radius found
left_over = offset.radius_wear + offset.radius - found
)";

constexpr const char* kLengths = R"(cycle lengths "Lengths alone"

parameter offset : tool_offset "Tool offset" letter T
result    size : length

size = offset.length
)";

driver::VerifyOptions optionsOf(const std::string& path, const std::string& control) {
  driver::VerifyOptions out;
  out.inputs = {path};
  out.to = "fanuc";
  out.control = control;
  out.probeMacros = "inspection-plus";
  out.jobs = 1;
  out.cases = 40;
  out.common.probeCodes.on = "M71";
  out.common.probeCodes.off = "M72";
  return out;
}

std::string said(const driver::Outcome& outcome) {
  return outcome.output + renderText(outcome.diagnostics, outcome.sources, 0);
}

std::string written(const driver::VerifyOptions& options) {
  driver::ConvertOptions convert;
  static_cast<targets::TranslationOptions&>(convert) = options;
  const driver::Outcome outcome = driver::convert(convert);
  return outcome.files.empty() ? said(outcome) : outcome.files.front().text;
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("cycle tools: what is set and read does the same on a control") {
  const TestFolder folder("dotek-tool-parts");
  driver::VerifyOptions options = optionsOf(folder.write("parts.cycle", kParts), "fanuc-31i-b");
  options.results = {{"before", "#600"}, {"after", "#601"}, {"whole", "#602"}};
  const driver::Outcome parts = driver::verify(options);
  CHECK_MESSAGE(parts.output.starts_with("AGREES"), said(parts));
  const std::string text = written(options);
  CAPTURE(text);
  CHECK(holds(text, "=#[12000+#"));
  CHECK(holds(text, "=#[13000+#20]+#[12000+#20]\n"));
  CHECK(holds(text, "=#[2200+#20]+#[2000+#20]\n"));
  CHECK(holds(text, "TOOL OFFSET NOT 1 TO 200"));
  // A planted fault in what is read, and in what is set.
  for (const auto& [was, is] :
       {std::pair("=#[12000+#20]\n", "=#[13000+#20]\n"), std::pair("\n#[12000+#20]=", "\n#[13000+#20]="),
        std::pair("=#[2200+#20]+#[2000+#20]\n", "=#[2200+#20]\n"),
        std::pair("\n#[2000+#20]=", "\n#[2200+#20]=")}) {
    CAPTURE(was);
    std::string changed = text;
    const std::size_t at = changed.rfind(was);
    REQUIRE(at != std::string::npos);
    changed.replace(at, std::string(was).size(), is);
    options.allowEdits = true; // the cases alone are to show it
    options.translation = folder.write("O8000.nc", changed);
    const driver::Outcome planted = driver::verify(options);
    CHECK_MESSAGE(planted.output.starts_with("DIFFERS"), said(planted));
  }
  options.translation.reset();

  driver::VerifyOptions whole = optionsOf(folder.write("whole.cycle", kWhole), "fanuc-31i-b");
  whole.results = {{"left_over", "#600"}};
  const driver::Outcome agrees = driver::verify(whole);
  whole.control = "fanuc-0i-md"; // tool offset memory C has them in the same places
  CHECK(driver::verify(whole).output.starts_with("AGREES"));
  whole.control = "fanuc-31i-b";
  CHECK_MESSAGE(agrees.output.starts_with("AGREES"), said(agrees));
  CHECK(holds(written(whole), "THE TABLE OF TOOL OFFSETS HOLDS RADII, NO DIAMETERS"));

  for (const char* const control : {"fanuc-31i-b", "fanuc-0i-md", "haas-ngc", "fanuc-6m"}) {
    CAPTURE(control);
    driver::VerifyOptions lengths = optionsOf(folder.write("lengths.cycle", kLengths), control);
    lengths.results = {{"size", std::string(control) == "fanuc-6m" ? "#510" : "#600"}};
    const driver::Outcome outcome = driver::verify(lengths);
    CHECK_MESSAGE(outcome.output.starts_with("AGREES"), said(outcome));
  }
}

TEST_CASE("cycle tools: what a control cannot say is refused at its line") {
  const TestFolder folder("dotek-tool-refused");
  const std::string parts = folder.write("parts.cycle", kParts), whole = folder.write("whole.cycle", kWhole);
  for (const char* const control : {"haas-ngc", "fanuc-6m"})
    CHECK(holds(written(optionsOf(whole, control)), "its profile does not say where the table has it"));
  CHECK(holds(
      written(optionsOf(folder.write("wear.cycle", "cycle wear \"Wear\"\nparameter offset : tool_offset\n"
                                                   "set tool offset length_wear 0.1 mm\n"),
                        "fanuc-6m")),
      "its table has one value for each"));
  for (const char* const target : {"mikroprog --control mikroprog-mill",
                                   "gibbs --control fanuc-31i-b --probe-macros inspection-plus -d out"}) {
    CAPTURE(target);
    for (const char* const file : {"parts.cycle", "whole.cycle"}) {
      const CommandResult result = runDotek(
          splitArguments(std::string("convert ") + file +
                         " --set found=1 "
                         "--set offset=3 --host clearance=50 --host overtravel=5 --host return_feed=500 "
                         "--host start_x=0 --host start_y=0 --host start_z=50 --host tool_radius=3 --to " +
                         target),
          folder.path());
      CAPTURE(result.err);
      CHECK(result.status != 0);
      CHECK(holds(result.err, ".cycle:"));
    }
  }
}

TEST_CASE("cycle tools: the run of a cycle shows what is set") {
  const TestFolder folder("dotek-tool-sim");
  folder.write("parts.cycle", kParts);
  const CommandResult ran =
      runDotek(splitArguments("sim parts.cycle --set offset=7 --set found=0.5 --trace -"), folder.path());
  CAPTURE(ran.out);
  CAPTURE(ran.err);
  CHECK(holds(ran.out + ran.err, "tool-offset 7 radius wear 0.250000"));
  CHECK(holds(ran.out + ran.err, "result after 0.250000"));
}
