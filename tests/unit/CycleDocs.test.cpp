// Each whole cycle in docs/cycles.md: nothing is wrong with it, it is laid out, and it runs.
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <string>
#include <vector>

namespace dotek::tests {
namespace {

// Blocks that are indented by four, without the indentation.
std::vector<std::string> blocksOf(const std::string& page) {
  std::vector<std::string> out;
  std::string block, blank;
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t end = std::min(page.find('\n', at), page.size());
    const std::string line = page.substr(at, end - at);
    at = end + 1;
    if (line.starts_with("    ")) {
      block += blank + line.substr(4) + "\n";
      blank.clear();
    } else if (line.empty() && !block.empty()) {
      blank += "\n";
    } else if (!block.empty()) {
      out.push_back(std::move(block));
      block.clear();
      blank.clear();
    }
  }
  if (!block.empty()) out.push_back(std::move(block));
  return out;
}

} // namespace

TEST_CASE("cycles: the cycles in the documentation are right, laid out, and run") {
  int seen = 0;
  for (const std::string& block : blocksOf(readAll(root() / "docs" / "cycles.md"))) {
    const std::size_t header = ("\n" + block).find("\ncycle "), first = header + 6;
    if (header == std::string::npos) continue;
    std::string name = block.substr(first, block.find(' ', first) - first);
    for (char& c : name)
      if (c == '_') c = '-';
    CAPTURE(name);
    ++seen;
    const TestFolder folder("dotek-cycle-docs");
    folder.write(name + ".cycle", block);
    const CommandResult checked = runDotek({"check", name + ".cycle"}, folder.path());
    CHECK_MESSAGE(checked.status == 0, (checked.out + checked.err));
    const CommandResult laidOut = runDotek({"fmt", name + ".cycle"}, folder.path());
    CHECK(laidOut.out == block);
    std::vector<std::string> arguments = {"sim", name + ".cycle"};
    if (name == "edge") arguments.insert(arguments.end(), {"--set", "distance=10"});
    if (name == "plate-side")
      arguments.insert(arguments.end(), {"--set", "side=right", "--set", "face=fine"});
    const CommandResult ran = runDotek(arguments, folder.path());
    CHECK_MESSAGE(ran.status == 0, (ran.out + ran.err));
  }
  CHECK(seen == 3);
}

} // namespace dotek::tests
