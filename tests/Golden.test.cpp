#include "tests/GoldenRunner.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

std::vector<fs::path> cases() {
  std::vector<fs::path> out;
  for (const auto& entry : fs::recursive_directory_iterator(root() / "tests" / "golden")) {
    if (entry.path().filename() == "cmd") out.push_back(entry.path().parent_path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

// Files that --update leaves alone: their text comes from the corpus or the reference.
bool isReference(const fs::path& file) {
  std::istringstream lines(readAll(root() / "tests" / "golden" / "REFERENCE"));
  const std::string name = fs::relative(file, root() / "tests" / "golden").generic_string();
  for (std::string line; std::getline(lines, line);) {
    if (line == name) return true;
  }
  return false;
}

void compare(const fs::path& file, const std::string& actual, const std::string& absent) {
  const std::string expected = fs::exists(file) ? readAll(file) : absent;
  if (actual == expected) return;
  if (settings().update && !isReference(file)) {
    ++settings().rewritten;
    if (actual == absent)
      fs::remove(file);
    else
      std::ofstream(file, std::ios::binary) << actual;
    return;
  }
  CHECK_MESSAGE(actual == expected, file.string());
}

} // namespace

TEST_CASE("golden cases") {
  const auto folders = cases();
  REQUIRE(!folders.empty());
  for (const fs::path& folder : folders) {
    INFO(folder.string());
    ++settings().run;
    std::istringstream commands(readAll(folder / "cmd"));
    std::string out;
    std::string err;
    std::string status;
    for (std::string line; std::getline(commands, line);) {
      if (line.empty() || line.starts_with("#")) continue;
      const CommandResult result = runDotek(splitArguments(line), folder);
      out += result.out;
      err += result.err;
      status += std::to_string(result.status) + "\n";
    }
    REQUIRE(!status.empty());
    compare(folder / "stdout", out, "");
    compare(folder / "stderr", err, "");
    compare(folder / "status", status, "0\n");
  }
}
