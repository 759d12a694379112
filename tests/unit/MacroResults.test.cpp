// Results of a vendor's macros that a program reads, and refusals without a message, converted and verified.
#include "tests/GoldenRunner.h"
#include "tests/unit/DataFolder.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <string>

using namespace dotek::tests;

namespace fs = std::filesystem;

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
