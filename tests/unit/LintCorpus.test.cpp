// docs/lint-corpus.md against what lint reports the corpus.
#include "tests/GoldenRunner.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

std::vector<std::string> cells(const std::string& row) {
  std::vector<std::string> out;
  std::istringstream in(row.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' ');
    out.push_back(first == std::string::npos ? ""
                                             : cell.substr(first, cell.find_last_not_of(' ') + 1 - first));
  }
  return out;
}

std::set<std::string> told(const fs::path& folder, std::vector<std::string> flags) {
  flags.insert(flags.begin(), {"lint", "gibbs", "compost"});
  flags.insert(flags.end(), {"--format", "json"});
  std::set<std::string> out;
  for (const auto& one : nlohmann::json::parse(runDotek(flags, folder).out))
    out.insert(one["file"].get<std::string>() + ":" + std::to_string(one["line"].get<int>()) + " " +
               one["code"].get<std::string>());
  return out;
}

} // namespace

TEST_CASE("corpus: lint --select all tells each known defect, and taste is silent by default") {
  fs::path folder;
  if (!haveCorpus(folder)) return;
  const std::set<std::string> all = told(folder, {"--select", "all"});
  const std::set<std::string> byDefault = told(folder, {});
  std::istringstream in(readAll(root() / "docs" / "lint-corpus.md"));
  std::size_t rows = 0;
  std::set<std::string> lists;
  for (std::string line; std::getline(in, line);) {
    const bool row = line.starts_with("| compost ") || line.starts_with("| gibbs ");
    if (!row) continue;
    const std::vector<std::string> cell = cells(line);
    REQUIRE(cell.size() >= 4);
    const std::string finding = cell[1] + ":" + cell[2] + " " + cell[3];
    CHECK_MESSAGE(all.contains(finding), cell[0] << ": " << finding);
    for (const char* taste : {"compost 15", "compost 16", "compost 17", "compost 18"})
      if (cell[0] == taste) CHECK_MESSAGE(!byDefault.contains(finding), cell[0] << ": " << finding);
    std::istringstream names(cell[0]);
    for (std::string name; std::getline(names, name, ',');)
      lists.insert(name.substr(name.find_first_not_of(' ')));
    ++rows;
  }
  CHECK(rows > 80);
  for (int number = 1; number <= 26; ++number) {
    const bool elsewhere = number == 3 || number == 19 || number == 20 || number == 26;
    CHECK_MESSAGE(lists.contains("compost " + std::to_string(number)) != elsewhere, number);
  }
  for (int number = 1; number <= 10; ++number)
    CHECK_MESSAGE(lists.contains("gibbs " + std::to_string(number)), number);
}
