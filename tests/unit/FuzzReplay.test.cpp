// Every committed seed of a fuzz target, as each kind of file: a finding or not, never a defect of Dotek.
#include "tests/GoldenRunner.h"

#include <doctest/doctest.h>
#include <filesystem>

namespace fs = std::filesystem;
using namespace dotek::tests;

TEST_CASE("seeds of the fuzz targets do no harm") {
  int seeds = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root() / "tests" / "fuzz" / "seeds")) {
    if (!entry.is_regular_file()) continue;
    ++seeds;
    const std::string path = entry.path().string();
    for (const std::string kind : {"prog", "mac", "dlg", "define", "nc", "suf"}) {
      INFO(path << " as " << kind);
      for (const std::string stage : {"tokens", "ast"})
        CHECK(runDotek({"dump", path, "--stage", stage, "--from", kind}, root()).status <= 2);
      const CommandResult lint = runDotek({"lint", path, "--from", kind, "--format", "json"}, root());
      CHECK(lint.status <= 2);
    }
  }
  CHECK(seeds > 0);
}
