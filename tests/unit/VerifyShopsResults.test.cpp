// Cycles whose branch goes on by what was measured: what vendors' calls leave, limits that a part exceeds,
// lists of the dialog.
#include "driver/Driver.h"
#include "support/Worker.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"
#include "tests/policy/Tree.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

struct Shop {
  const char *shop, *cycle, *to, *set, *control;
};

void take(targets::TranslationOptions& options, const Shop& of) {
  const auto shops = root() / "tests" / "shops";
  options.inputs = {(shops / of.shop / of.cycle).generic_string()};
  options.source.prog = (shops / of.shop / "post.txt").generic_string();
  options.common.data = {(shops / "data").generic_string()};
  options.common.scriptProgram = runningProgram();
  options.common.probeCodes = {"M31", "M32"};
  options.to = of.to;
  options.probeMacros = of.set;
  options.control = of.control;
}

// What is written, and what `convert` says of it.
std::pair<std::string, std::string> converted(const Shop& of) {
  driver::ConvertOptions options;
  take(options, of);
  const driver::Outcome outcome = driver::convert(options);
  const std::string said = renderText(outcome.diagnostics, outcome.sources, 0);
  REQUIRE_MESSAGE(outcome.status == 0, said);
  return {outcome.files.front().text, said};
}

// Messages and verdict; `text`: "": what `convert` writes.
std::string verified(const Shop& of, const std::string& text = "") {
  const TestFolder folder("dotek-shop-results");
  driver::VerifyOptions options;
  take(options, of);
  options.cases = 20;
  options.jobs = 1;
  options.allowEdits = true; // the cases alone are to show it
  if (!text.empty()) options.translation = folder.write("edited", text);
  const driver::Outcome outcome = driver::verify(options);
  return renderText(outcome.diagnostics, outcome.sources, 0) + outcome.output;
}

bool agrees(const std::string& said) {
  return ("\n" + said).find("\nAGREES: 20 of 20 drawn cases") != std::string::npos;
}
bool differs(const std::string& said) {
  return ("\n" + said).find("\nDIFFERS: ") != std::string::npos;
}

// Without the first line that holds `part`.
std::string without(const std::string& text, const std::string& part) {
  const std::size_t at = text.find(part);
  REQUIRE_MESSAGE(at != std::string::npos, part << " is not in\n" << text);
  const std::size_t begin = text.rfind('\n', at) + 1;
  return text.substr(0, begin) + text.substr(text.find('\n', at) + 1);
}

} // namespace

TEST_CASE("verify: a branch that compares what a call has measured comes to its end in the rehearsal") {
  const Shop web{"results", "WF-WEB-PAIR", "fanuc", "inspection-plus", "fanuc-31i-b"};
  const std::string said = verified(web);
  CHECK_MESSAGE(agrees(said), said);
  // Its own comparison of the first width, which few drawn parts exceed.
  CHECK(differs(verified(web, without(converted(web).first, "IF[ABS[#143] GT "))));
}

TEST_CASE("verify: what a call leaves that no source describes is the same on both sides") {
  for (const char* const cycle : {"WF-PCD", "WF-STEP", "WF-CORNER-OUT"}) {
    const Shop of{"results", cycle, "fanuc", "inspection-plus", "fanuc-31i-b"};
    const std::string said = verified(of);
    CHECK_MESSAGE(agrees(said), cycle << ": " << said);
  }
  const Shop circle{"results", "WF-PCD", "fanuc", "inspection-plus", "fanuc-31i-b"};
  std::string text = converted(circle).first;
  const std::size_t at = text.find("#613=#138");
  REQUIRE(at != std::string::npos);
  CHECK(differs(verified(circle, text.replace(at, 9, "#613=#139"))));
}

TEST_CASE("verify: a local shift of Z stops a fragment before the measure that it would spoil") {
  const std::string said = verified({"included", "HB_Anschlag", "fusion", "dotek", "fanuc-0i-md"});
  CHECK_MESSAGE(agrees(said), said);
}

TEST_CASE(
    "verify: a tolerance that another set's program compares itself is seen on a part that exceeds it") {
  for (const Shop of : {Shop{"inspection", "JT.Rib.Size", "fanuc", "dotek", "fanuc-31i-b"},
                        Shop{"inspection", "JT.Rib.Size", "fusion", "dotek", "fanuc-31i-b"}}) {
    const std::string said = verified(of);
    CHECK_MESSAGE(agrees(said), said);
    CHECK(differs(verified(of, without(converted(of).first, "OUT OF TOLERANCE)"))));
  }
}

TEST_CASE("convert to gibbs: a field that counts the work offsets from 1 is not asked for 54 to 59") {
  driver::ConvertOptions options;
  take(options, {"inspection", "JT.Vice.Corner", "gibbs", "inspection-plus", ""});
  options.common.host = {{"clearance", "25"}};
  const driver::Outcome outcome = driver::convert(options);
  REQUIRE_MESSAGE(outcome.status == 0, renderText(outcome.diagnostics, outcome.sources, 0));
  bool found = false;
  for (const auto& file : outcome.files)
    if (file.name.ends_with("CycleData.mac")) {
      found = true;
      CHECK_MESSAGE(file.text.find("work offset") == std::string::npos, file.text);
    }
  CHECK(found);
}

TEST_CASE("convert: what the list of a dialog does not offer is an alarm") {
  const Shop side{"included", "HB_Anschlag", "fanuc", "easyprobe", "fanuc-0i-md"};
  const std::string text = converted(side).first;
  CHECK(text.find("(SE IS NOT IN ITS LIST)") != std::string::npos);
  CHECK(agrees(verified(side)));
  CHECK(differs(verified(side, without(text, "=103(SE IS NOT"))));
  const Shop fragment{"included", "HB_Anschlag", "fusion", "easyprobe", "fanuc-0i-md"};
  CHECK(agrees(verified(fragment)));
}

TEST_CASE("convert: a printout that another set does not have is left out, and said") {
  const auto [text, said] = converted({"results", "WF-WEB-PAIR", "fanuc", "dotek", "fanuc-31i-b"});
  CHECK(said.find("[print-left-out]") != std::string::npos);
  CHECK(text.find("(PRINT OF THE SOURCE LEFT OUT)") != std::string::npos);
}

TEST_CASE("convert: G10 L2 writes a work offset on another control as well") {
  const Shop corner{"bounded", "LK-TWO-FACE", "fanuc", "dotek", "fanuc-31i-b"};
  CHECK(converted(corner).first.find("G10 L2 P2 X[") != std::string::npos);
  const std::string said = verified(corner);
  CHECK_MESSAGE(agrees(said), said);
}

TEST_CASE("verify: the travel and the noise of a machine are not looked at") {
  const TestFolder folder("dotek-verify-machine");
  driver::VerifyOptions options;
  take(options, {"results", "WF-TILT", "fanuc", "inspection-plus", "fanuc-31i-b"});
  options.cases = 20;
  options.jobs = 1;
  options.machine =
      folder.write("mill.toml", "schema = 1\n[probe]\nball_diameter = 6.0\nlength = 180.0\nlength_to = "
                                "\"tip\"\non = true\nnoise = 0.01\n"
                                "[travel]\nx = [-600.0, 0.0]\ny = [-400.0, 0.0]\nz = [-500.0, 0.0]\n");
  const driver::Outcome outcome = driver::verify(options);
  const std::string said = renderText(outcome.diagnostics, outcome.sources, 0);
  CHECK_MESSAGE(outcome.status == 0, said);
  CHECK_MESSAGE(said.find("the travel of the machine is not looked at") != std::string::npos, said);
  CHECK_MESSAGE(said.find("the noise of the machine is not looked at") != std::string::npos, said);
  CHECK(said.find("[verify-machine-ignored]") != std::string::npos);
}
