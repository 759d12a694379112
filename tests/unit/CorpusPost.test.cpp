// The corpus cycles as posted, against the recorded programs. The differences are those that
// docs/post-differences.md lists: one more or one fewer fails.
#include "tests/GoldenRunner.h"
#include "tests/policy/Tree.h"

#include <algorithm>
#include <cctype>
#include <doctest/doctest.h>
#include <fmt/format.h>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

struct Block {
  std::size_t line; // in its file, from 1
  std::string text;
};

// Without N number and blanks around it.
std::string bare(std::string_view block) {
  const auto blanks = [&] {
    while (!block.empty() && block.front() == ' ')
      block.remove_prefix(1);
  };
  blanks();
  if (block.size() > 1 && block[0] == 'N' && std::isdigit(static_cast<unsigned char>(block[1])) != 0) {
    block.remove_prefix(1);
    while (!block.empty() && std::isdigit(static_cast<unsigned char>(block.front())) != 0)
      block.remove_prefix(1);
  }
  blanks();
  while (!block.empty() && block.back() == ' ')
    block.remove_suffix(1);
  return std::string(block);
}

std::vector<Block> blocksOf(std::string_view program, std::size_t first = 1, std::size_t last = SIZE_MAX) {
  std::vector<Block> out;
  const auto lines = linesOf(program);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string text = bare(lines[i]);
    if (i + 1 < first || i + 1 > last || text.empty() || text.starts_with("(MERENI ")) continue;
    out.push_back({i + 1, text});
  }
  return out;
}

// `-LINE block` for a recorded block that was not posted, `+block` for one that was posted only; sorted.
std::vector<std::string> differences(const std::vector<Block>& recorded, const std::vector<Block>& posted) {
  const std::size_t rows = recorded.size();
  const std::size_t columns = posted.size();
  // Length of the longest common part of what follows.
  std::vector<std::vector<int>> common(rows + 1, std::vector<int>(columns + 1, 0));
  for (std::size_t r = rows; r-- > 0;) {
    for (std::size_t c = columns; c-- > 0;) {
      common[r][c] = recorded[r].text == posted[c].text ? common[r + 1][c + 1] + 1
                                                        : std::max(common[r + 1][c], common[r][c + 1]);
    }
  }
  std::vector<std::string> out;
  std::size_t r = 0;
  std::size_t c = 0;
  while (r < rows || c < columns) {
    if (r < rows && c < columns && recorded[r].text == posted[c].text) {
      ++r;
      ++c;
    } else if (c == columns || (r < rows && common[r + 1][c] >= common[r][c + 1])) {
      out.push_back(fmt::format("-{} {}", recorded[r].line, recorded[r].text));
      ++r;
    } else {
      out.push_back("+" + posted[c].text);
      ++c;
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::string cell(std::string text) {
  const std::size_t begin = text.find_first_not_of(" `");
  const std::size_t end = text.find_last_not_of(" `");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

std::vector<std::string> listed(const std::string& cycle) {
  std::vector<std::string> out;
  for (const std::string& line : linesOf(readAll(root() / "docs" / "post-differences.md"))) {
    std::vector<std::string> cells;
    for (std::size_t at = line.find('|'); at != std::string::npos;) {
      const std::size_t next = line.find('|', at + 1);
      if (next == std::string::npos) break;
      cells.push_back(cell(line.substr(at + 1, next - at - 1)));
      at = next;
    }
    if (cells.size() != 6 || cells[0] != cycle) continue;
    if (cells[3] != "none") out.push_back(fmt::format("-{} {}", cells[2], cells[3]));
    if (cells[4] != "none") out.push_back("+" + cells[4]);
  }
  std::sort(out.begin(), out.end());
  return out;
}

struct CorpusCycle {
  std::string name;
  std::string recorded;
  std::size_t first;
  std::size_t last;
  std::vector<std::string> values;
};

const std::vector<CorpusCycle>& corpusCycles() {
  static const std::vector<CorpusCycle> kCycles = {
      {"MERENI.OSA.X", "required-x.nc", 15, 23, {"X=10"}},
      {"MERENI.OSA.Y", "required-y.nc", 1, SIZE_MAX, {"Y=10"}},
      {"MERENI.OSA.Z", "required-z.nc", 1, SIZE_MAX, {"Z=-10"}},
      {"MERENI.OSA.XYZ", "required-xyz.nc", 1, SIZE_MAX, {"IB=10", "JB=-10", "IC=10", "JC=10"}},
      {"MERENI.STRED.OTVOR", "required-circle.nc", 1, SIZE_MAX, {"D=30", "X=30", "Y=30", "Zb=50"}},
  };
  return kCycles;
}

CommandResult post(const fs::path& corpus, const CorpusCycle& cycle, std::vector<std::string> more) {
  std::vector<std::string> arguments = {"post",        (corpus / "gibbs" / cycle.name).string(),
                                        "--prog",      (corpus / "compost" / "probe-routines.txt").string(),
                                        "--routine",   "defProbeCycle",
                                        "--seq",       "90:10",
                                        "--clearance", "5"};
  for (const std::string& value : cycle.values) {
    arguments.push_back("--set");
    arguments.push_back(value);
  }
  arguments.insert(arguments.end(), more.begin(), more.end());
  return runDotek(arguments, root());
}

} // namespace

TEST_CASE("differences are found and named by the recorded line") {
  const auto recorded = blocksOf("(MERENI A)\nN10 M5\nM31\nN30 G0 Z5\n");
  CHECK(recorded.size() == 3);
  CHECK(differences(recorded, recorded).empty());
  CHECK(differences(recorded, blocksOf(" N1 M5\n N2 G0 Z5.\n")) ==
        std::vector<std::string>{"+G0 Z5.", "-3 M31", "-4 G0 Z5"});
  CHECK(differences(blocksOf("M5\n"), blocksOf("M5\nM9\n")) == std::vector<std::string>{"+M9"});
}

TEST_CASE("the corpus cycles are posted as recorded, but for the list") {
  fs::path corpus;
  if (!haveCorpus(corpus)) return;
  for (const CorpusCycle& cycle : corpusCycles()) {
    INFO(cycle.name);
    const CommandResult result = post(corpus, cycle, {"--recover"});
    CHECK_MESSAGE(result.status == 0, result.err);
    const auto recorded = blocksOf(readAll(corpus / "fanuc" / cycle.recorded), cycle.first, cycle.last);
    CHECK(recorded.size() >= 8);
    CHECK(differences(recorded, blocksOf(result.out)) == listed(cycle.name));
  }
}

TEST_CASE("the corpus post is refused without --recover") {
  fs::path corpus;
  if (!haveCorpus(corpus)) return;
  for (const CorpusCycle& cycle : corpusCycles()) {
    INFO(cycle.name);
    const CommandResult result = post(corpus, cycle, {});
    CHECK(result.status == 1);
    CHECK(result.out.empty());
    const std::size_t at = result.err.find("probe-routines.txt:53:1: error: ");
    CHECK(at != std::string::npos);
    CHECK(result.err.find("[open-if-at-return]") != std::string::npos);
    CHECK_MESSAGE(result.err.find(": error: ", at + 40) == std::string::npos, result.err);
  }
}
