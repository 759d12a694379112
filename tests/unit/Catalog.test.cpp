// What people look up: explanations of every code, the list of rules, the version.
#include "lint/Catalog.h"
#include "support/Version.h"
#include "tests/GoldenRunner.h"
#include "tests/Goldens.h"
#include "tests/unit/DataFolder.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

using namespace dotek;
using namespace dotek::tests;

namespace {

std::size_t words(const std::string& text) {
  std::istringstream in(text);
  std::size_t count = 0;
  for (std::string word; in >> word;)
    ++count;
  return count;
}

} // namespace

TEST_CASE("policy: every code says why it matters, shows an example, and names the repair") {
  for (const lint::CodeInfo& info : lint::codeTable()) {
    const lint::Explained parts = lint::explained(info);
    CHECK_MESSAGE(words(parts.why) >= (info.rule != nullptr ? 15U : 9U), info.code << ": " << parts.why);
    CHECK_MESSAGE(!parts.example.empty(), info.code << " has no example");
    CHECK_MESSAGE(words(parts.repair) >= 2, info.code << " has no `Repair:`");
    CHECK_MESSAGE(parts.repair.ends_with('.'), info.code << ": " << parts.repair);
    CHECK_MESSAGE(lint::helpOf(info).find("\nRepair: ") != std::string::npos,
                  info.code << " does not print its repair");
  }
}

TEST_CASE("policy: pages of messages have a section for each message and no other") {
  std::set<std::string_view> codes;
  for (const MessageInfo& info : messageTable())
    codes.insert(info.code);
  std::set<std::string> sections;
  for (const lint::MessagePage& page : lint::messagePages()) {
    std::istringstream in{std::string(page.text)};
    for (std::string line; std::getline(in, line);) {
      if (!line.starts_with("## ")) continue;
      CHECK_MESSAGE(sections.insert(line.substr(3)).second, line << " is there twice");
      CHECK_MESSAGE(codes.contains(line.substr(3)), page.name << ": " << line << " is no message");
    }
  }
  CHECK(sections.size() == codes.size());
}

TEST_CASE("policy: docs/rules/README.md is what the rules say") {
  const std::filesystem::path folder = root() / "docs" / "rules";
  int rewritten = 0;
  const std::string fault =
      settle({folder, folder / "README.md", ""}, lint::rulesReadme(), settings().update, rewritten);
  CHECK_MESSAGE(fault.empty(), fault);
}

TEST_CASE("list rules: each rule once, below the heading of what it judges, and no message") {
  const CommandResult result = runDotek({"list", "rules"}, root());
  std::istringstream in(result.out);
  std::set<std::string> seen;
  std::size_t headings = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) continue;
    if (!line.starts_with("  ")) {
      ++headings;
      continue;
    }
    const std::string code = line.substr(2, line.find(' ', 2) - 2);
    CHECK_MESSAGE(seen.insert(code).second, code);
    CHECK_MESSAGE(lint::findRule(code) != nullptr, code << " is no rule");
  }
  CHECK(seen.size() == lint::rules().size());
  CHECK(headings == lint::areas().size());
  CHECK(lint::areaOf({"suf-arc-radius", nullptr}) == "Programs of Mikroprog");
  CHECK(lint::areaOf({"jump-to-itself", nullptr}) != "Programs of Mikroprog");
  CHECK(lint::areaOf({"word-repeated", nullptr}) == "NC programs (macro B)");
  CHECK(lint::areaOf({"inputs-overlap", nullptr}) == "Macros and dialogs (GibbsCAM)");
  CHECK(lint::areaOf({"empty-literal", nullptr}) == "Posts (ComPost)");
  CHECK(lint::areaOf({"field-not-defined", nullptr}) == "Cycles with their post");
  const CommandResult messages = runDotek({"list", "messages"}, root());
  CHECK(static_cast<std::size_t>(std::count(messages.out.begin(), messages.out.end(), '\n')) ==
        messageTable().size());
}

TEST_CASE("explain: a message has its three parts") {
  const CommandResult result = runDotek({"explain", "decimal-comma"}, root());
  CHECK(result.status == 0);
  CHECK(result.out.find("\nExample:\n\n    G0 Z64,5\n") != std::string::npos);
  CHECK(result.out.find("\nRepair: write a point: `G0 Z64.5`.\n") != std::string::npos);
}

TEST_CASE("the version is the one of the build") {
  CHECK(readAll(root() / "CMakeLists.txt").find("project(dotek VERSION ${version} ") != std::string::npos);
  const std::string out = runDotek({"--version"}, root()).out;
  CHECK(out.starts_with("dotek " + std::string(kVersion) + " (commit "));
  CHECK(out.find(", data ") != std::string::npos);
  CHECK(out.ends_with(")\n"));
}

TEST_CASE("lint --format sarif: version, help and fingerprints that survive inserted lines") {
  const DataFolder folder;
  const auto run = [&](const std::string& text) {
    folder.write("a.nc", text);
    return nlohmann::json::parse(
        runDotek({"lint", "a.nc", "--format", "sarif"}, folder.path()).out)["runs"][0];
  };
  const std::string body = "G90 G0 X1. X2.\nG90 G0 Y1. Y2.\nG90 G0 X1. X2.\nM30\n";
  const auto before = run("O0001\n" + body);
  const auto after = run("O0001\n(NEW)\nG0 Z50.\n" + body);
  const auto& driver = before["tool"]["driver"];
  CHECK(driver["version"] == kVersion);
  for (const auto& rule : driver["rules"]) {
    CHECK(rule["help"]["text"].get<std::string>().find("Repair: ") != std::string::npos);
    CHECK(rule["help"]["markdown"].get<std::string>().find("**Repair:** ") != std::string::npos);
  }
  const auto prints = [](const auto& of) {
    std::vector<std::string> out;
    for (const auto& one : of["results"])
      if (one["ruleId"] == "word-repeated") out.push_back(one["partialFingerprints"]["dotekLine/v1"]);
    return out;
  };
  REQUIRE(prints(before).size() == 3);
  CHECK(prints(before) == prints(after));
  const auto list = prints(before);
  CHECK(list[0] != list[1]);
  CHECK(list[0] != list[2]); // equal lines are counted
}
