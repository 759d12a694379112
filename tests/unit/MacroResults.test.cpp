// Results of a vendor's macros that a program reads, and refusals without a message, converted and verified.
#include "tests/GoldenRunner.h"
#include "tests/unit/DataFolder.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <string>

using namespace dotek::tests;

namespace fs = std::filesystem;

namespace {

CommandResult converted(const DataFolder& folder, const std::string& blocks, const std::string& control) {
  folder.write("o7.nc", "%\nO7\nG21 G90 G17 G40 G49 G80 G94\nG54 G43 H3 Z50.\nG65 P9832\n"
                        "G65 P9810 Z-5. F1000.\n" +
                            blocks + "G65 P9833\nM30\n%\n");
  return runDotek({"convert", "o7.nc", "--to", "fanuc", "--from-control", "fanuc-31i-b", "--control", control,
                   "--probe-macros", "inspection-plus", "--verify", "-o", "out.nc"},
                  folder.path());
}

} // namespace

TEST_CASE("convert --verify: a result that is read after a protected move is that of the call before") {
  const DataFolder folder;
  const std::string text = "G65 P9811 X20. S2\nG65 P9810 Z50. F3000.\n#550=#135\n";
  const CommandResult run = converted(folder, text, "fanuc-31i-b");
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(run.err.find("AGREES: 200 of 200 drawn cases") != std::string::npos);
}

TEST_CASE("convert: a result that a call has filled is read on a control that keeps it at power off") {
  const DataFolder folder;
  const std::string call = "G65 P9811 X20. S2\n", read = "#610=#140\n";
  const CommandResult run = converted(folder, call + "G65 P9810 Z50. F3000.\n" + read, "haas-ngc");
  CHECK_MESSAGE(run.status == 0, run.err);
  for (const std::string& text : {read + call,                                      // before the call
                                  "IF[#1EQ1.]GOTO10\n" + call + "N10" + read,       // a way beside it
                                  "/" + call + read,                                // left out by a switch
                                  std::string("G65 P9811 X20. S2\n#610=#120\n")}) { // of no call
    const CommandResult refused = converted(folder, text, "haas-ngc");
    CHECK_MESSAGE(refused.status == 1, text << refused.err);
    const bool ofCall = text.find("#120") == std::string::npos;
    CHECK(refused.err.find(ofCall ? "[variable-elsewhere]" : "[result-not-translated]") != std::string::npos);
  }
}

TEST_CASE("convert --verify: what a dialog refuses without a message has an alarm of the translation's own") {
  const DataFolder folder;
  fs::copy((root() / "examples/surface-x"), folder.path() + "/surface-x");
  fs::copy((root() / "examples/post.txt"), folder.path() + "/post.txt");
  std::string macro = readAll(fs::path(folder.path()) / "surface-x/CycleData.mac");
  const std::string message = "if wrong = 3 then message \"The retract height lies below the touch\"\n";
  const std::size_t at = macro.find(message);
  REQUIRE(at != std::string::npos);
  folder.write("surface-x/CycleData.mac", macro.erase(at, message.size()) + "if Z > 40 then goto ask\n");
  for (const std::string to : {"fanuc", "gibbs"}) {
    const CommandResult run =
        runDotek({"convert", "surface-x", "--prog", "post.txt", "--to", to, "--verify", "-d", "out-" + to},
                 folder.path());
    CHECK_MESSAGE(run.status <= 1, run.err);
    CHECK_MESSAGE(run.err.find("DIFFERS") == std::string::npos, run.err);
  }
}
