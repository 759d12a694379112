#include "tests/Goldens.h"

#include "tests/GoldenRunner.h"

#include <algorithm>
#include <deque>
#include <doctest/doctest.h>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;

namespace dotek::tests {

namespace {

constexpr std::string_view kPrefix = "golden ";

void compare(const fs::path& file, const std::string& actual, const std::string& absent) {
  const GoldenFile golden{root() / "tests" / "golden", file, absent};
  const std::string fault = settle(golden, actual, settings().update, settings().rewritten);
  CHECK_MESSAGE(fault.empty(), fault);
}

void runGolden(const fs::path& folder) {
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

// doctest's functions take no argument: the name of the case says which golden it is.
void runCurrent() {
  const std::string_view name = doctest::getContextOptions()->currentTest->m_name;
  runGolden(root() / "tests" / "golden" / name.substr(kPrefix.size()));
}

} // namespace

std::vector<std::string> goldenNames(const fs::path& root) {
  std::vector<std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().filename() == "cmd")
      out.push_back(fs::relative(entry.path().parent_path(), root).generic_string());
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<std::string> referenceFiles(const fs::path& root) {
  std::istringstream lines(readAll(root / "REFERENCE"));
  std::vector<std::string> out;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && !line.starts_with('#')) out.push_back(line);
  return out;
}

std::string settle(const GoldenFile& golden, const std::string& actual, bool update, int& rewritten) {
  const std::string expected = fs::exists(golden.file) ? readAll(golden.file) : golden.absent;
  if (actual == expected) return "";
  const std::string name = fs::relative(golden.file, golden.root).generic_string();
  const std::vector<std::string> kept = referenceFiles(golden.root);
  const bool reference = std::find(kept.begin(), kept.end(), name) != kept.end();
  if (update && !reference) {
    ++rewritten;
    if (actual == golden.absent)
      fs::remove(golden.file);
    else
      std::ofstream(golden.file, std::ios::binary) << actual;
    return "";
  }
  return golden.file.string() + " differs" +
         (update ? "; it is listed in REFERENCE, and --update does not rewrite it" : "") +
         "\n--- expected:\n" + expected + "\n--- found:\n" + actual;
}

void registerGoldens() {
  // doctest keeps pointers to the names, and tells cases of one file apart by their line.
  static std::deque<std::string> names;
  unsigned line = 1;
  for (const std::string& name : goldenNames(root() / "tests" / "golden")) {
    names.push_back(std::string(kPrefix) + name);
    doctest::detail::regTest(doctest::detail::TestCase(runCurrent, __FILE__, line++, {}) *
                             names.back().c_str());
  }
}

} // namespace dotek::tests
