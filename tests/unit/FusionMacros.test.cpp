// Fragments that call Dotek's own macros, and the control that a fragment is written for.
#include "DataFolder.h"
#include "FusionHelper.h"

using namespace dotek;
using namespace dotek::tests;
namespace fusion = backends::fusion;

namespace {

constexpr const char* kBlocks = "#1 = '####.##;0'\n"
                                "FORMAT(OpFieldData#,1)\n"
                                "probe:\n"
                                "IF CycleType?('surface-x')\n"
                                " SeqC ' G65 P9770 Z'OpFieldData#('Z')' F500' EOL\n"
                                " SeqC ' G65 P9023 S'OpFieldData#('G')' X'OpFieldData#('X')' "
                                "I'OpFieldData#('I') EOL\n"
                                "END\n"
                                "RETURN\n";

// The source's macros switch the probe.
constexpr const char* kSwitched = "#1 = '####.##;0'\n"
                                  "FORMAT(OpFieldData#,1)\n"
                                  "probe:\n"
                                  "IF CycleType?('surface-x')\n"
                                  " SeqC ' G65 P9832 (PROBE ON)' EOL\n"
                                  " SeqC ' G65 P9810 Z'OpFieldData#('Z')' F500' EOL\n"
                                  " SeqC ' G65 P9811 X'OpFieldData#('X')' S1' EOL\n"
                                  " SeqC ' G65 P9833' EOL\n"
                                  "END\n"
                                  "RETURN\n";

// Our macros, for a machine whose post is the form `machine`.
driver::ConvertOptions ownMacrosFor(const DataFolder& folder, const std::string& control) {
  std::string form = readAll(root() / "stdlib" / "forms" / "thesis-a.toml");
  const std::string line = "control = \"fanuc-0i-md\"";
  REQUIRE(form.find(line) != std::string::npos);
  form.replace(form.find(line), line.size(), "control = \"" + control + "\"");
  folder.write("forms/machine.toml", form);
  driver::ConvertOptions out =
      toFusion((root() / "examples" / "surface-x").generic_string(), folder.write("post.txt", kBlocks));
  out.common.data = {folder.path()};
  out.source.form = "machine";
  out.probeMacros = "dotek";
  return out;
}

std::set<std::string> errorsOf(const driver::Outcome& outcome) {
  std::set<std::string> out;
  for (const Diagnostic& one : outcome.diagnostics.all()) {
    if (one.severity != Severity::Error) continue;
    CHECK(one.range.hasPlace());
    out.emplace(one.code);
  }
  return out;
}

} // namespace

TEST_CASE("a fragment with our own macros says what they need and calls them") {
  const DataFolder folder;
  const driver::ConvertOptions convert = ownMacrosFor(folder, "fanuc-0i-md");
  const std::string fragment = fragmentOf(convert);
  CHECK(fragment.find("// Set before the first call of a macro: #520 radius") != std::string::npos);
  CHECK(fragment.find("dotek new macros dotek") != std::string::npos);
  fusion::RunInput input;
  input.toolDiameter = 6;
  input.cycle = {{"clearance", 15}};
  input.properties = {{"surfaceX_X", 12}, {"surfaceX_I", 12}, {"surfaceX_G", 55}, {"surfaceX_Z", -5}};
  const fusion::RunResult run = runFragment(fragment, "surfaceX", input);
  CHECK_MESSAGE(run.ok(), reportOf(run));
  CHECK(holds(run.text, "G65 P8811 X12. S2."));
}

TEST_CASE("a fragment asks a drilling operation for no overtravel; --host gives the calls one") {
  const DataFolder folder;
  driver::ConvertOptions convert = ownMacrosFor(folder, "fanuc-0i-md");
  CHECK(fragmentOf(convert).find("vertravel") == std::string::npos);
  convert.common.host = {{"overtravel", "8"}};
  const std::string fragment = fragmentOf(convert);
  CHECK(fragment.find("probeOvertravel") == std::string::npos);
  fusion::RunInput input;
  input.properties = {{"surfaceX_X", 12}, {"surfaceX_I", 12}, {"surfaceX_G", 55}, {"surfaceX_Z", -5}};
  const fusion::RunResult run = runFragment(fragment, "surfaceX", input);
  CHECK_MESSAGE(run.ok(), reportOf(run));
  CHECK(holds(run.text, "G65 P8811 X12. Q8. S2."));
}

TEST_CASE("a fragment switches the probe as the control and its own macros do, not as the source's") {
  const DataFolder folder;
  driver::ConvertOptions convert = ownMacrosFor(folder, "fanuc-0i-md");
  convert.source.prog = folder.write("post.txt", kSwitched);
  for (const char* macros : {"dotek", "easyprobe"}) {
    convert.probeMacros = macros;
    const std::string fragment = fragmentOf(convert);
    CHECK(fragment.find("writeBlock(\"M31 (PROBE ON)\")") != std::string::npos);
    CHECK(fragment.find("writeBlock(\"M32\")") != std::string::npos);
    CHECK(fragment.find("P983") == std::string::npos);
  }
  // The source's own set is printed as the Prog prints it.
  convert.probeMacros = "inspection-plus";
  CHECK(fragmentOf(convert).find("G65 P9832") != std::string::npos);
  // A control that has no code for it, and no macro.
  driver::ConvertOptions silent = ownMacrosFor(folder, "fanuc-31i-b");
  silent.source.prog = folder.write("post.txt", kSwitched);
  CHECK(errorsOf(driver::convert(silent)).contains("no-probe-code"));
}

TEST_CASE("a fragment prints nothing where the ball has no radius") {
  const DataFolder folder;
  const std::string fragment = fragmentOf(ownMacrosFor(folder, "fanuc-0i-md"));
  fusion::RunInput input;
  input.toolDiameter = 6;
  input.cycle = {{"clearance", 15}};
  input.properties = {{"surfaceX_X", 12}, {"surfaceX_I", 12}, {"surfaceX_G", 55}, {"surfaceX_Z", -5}};
  const auto errorOf = [&] {
    const fusion::RunResult run = runFragment(fragment, "surfaceX", input);
    CHECK(run.text.empty());
    return run.errors.empty() ? std::string() : run.errors.front();
  };
  CHECK(runFragment(fragment, "surfaceX", input).ok());
  input.toolDiameter = 0;
  CHECK(errorOf() == "surface-x: tool.diameter / 2 is not above 0");
}

TEST_CASE("a fragment with our own macros is refused for a machine that cannot tell the skip position") {
  const DataFolder folder;
  driver::ConvertOptions convert = ownMacrosFor(folder, "fanuc-6m");
  const driver::Outcome refused = driver::convert(convert);
  CHECK(refused.status == 1);
  CHECK(errorsOf(refused) == std::set<std::string>{"no-skip-position"});
  // Macros of a vendor need it not.
  convert.probeMacros.reset();
  CHECK(driver::convert(convert).status == 0);
}

TEST_CASE("a fragment with another macro set leaves G91 in force where the source does") {
  const DataFolder folder;
  driver::ConvertOptions convert = ownMacrosFor(folder, "fanuc-0i-md");
  fusion::RunInput input;
  input.toolDiameter = 6;
  input.cycle = {{"clearance", 15}};
  input.properties = {{"surfaceX_X", 12}, {"surfaceX_I", 12}, {"surfaceX_G", 54}, {"surfaceX_Z", -5}};
  for (const char* end : {"", " SeqC ' G90' EOL\n"}) {
    std::string blocks = kBlocks;
    blocks.insert(blocks.find("END"), " SeqC ' G90 G0 Z30.' EOL\n SeqC ' G91 Z5.' EOL\n" + std::string(end));
    folder.write("post.txt", blocks);
    const fusion::RunResult run = runFragment(fragmentOf(convert), "surfaceX", input);
    CHECK_MESSAGE(run.ok(), reportOf(run));
    CHECK(holds(run.text, "G90 G0 Z35."));
    CHECK(withoutNumbers(run.text).back() == (*end == 0 ? "G91" : "G90"));
  }
}

TEST_CASE("a fragment is for the control of the form, not for another one") {
  const DataFolder folder;
  driver::ConvertOptions convert = ownMacrosFor(folder, "fanuc-0i-md");
  convert.control = "fanuc-0i-md";
  CHECK(driver::convert(convert).status == 0);
  convert.control = "fanuc-31i-b";
  const driver::Outcome refused = driver::convert(convert);
  CHECK(refused.status == 1);
  CHECK(errorsOf(refused) == std::set<std::string>{"control-of-form"});
}
