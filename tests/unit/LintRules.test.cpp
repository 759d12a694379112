// docs/rules/<id>.md is the documentation of a rule and its test: carets under a line mark what the rule
// tells, blocks below `## Clean` give no finding at all.
#include "frontend/compost/Check.h"
#include "frontend/gibbs/Check.h"
#include "frontend/macrob/Check.h"
#include "lint/Page.h"
#include "lint/Rule.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/unit/DataFolder.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace fs = std::filesystem;
using namespace dotek;
using namespace dotek::tests;

namespace {

struct Place {
  std::string file;
  std::size_t line = 0, column = 0, endColumn = 0;
  auto operator<=>(const Place&) const = default;
};

struct Example {
  std::string title;
  bool clean = false;
  std::vector<std::string> flags;
  std::vector<std::pair<std::string, std::string>> files; // name, text without carets
  std::multiset<Place> expected;
};

bool isCaretLine(const std::string& line) {
  return line.find('^') != std::string::npos && line.find_first_not_of(" ^") == std::string::npos;
}

class Document {
public:
  explicit Document(const fs::path& path) {
    std::istringstream in(readAll(path));
    for (std::string line; std::getline(in, line);)
      take(line);
  }

  std::vector<Example> examples;

private:
  void take(const std::string& line) {
    if (inside_) {
      if (line == "```") {
        inside_ = false;
        examples.back().files.emplace_back(file_, text_);
      } else if (isCaretLine(line)) {
        for (std::size_t at = line.find('^'); at != std::string::npos; at = line.find('^', at)) {
          const std::size_t end = std::min(line.find_first_not_of('^', at), line.size());
          examples.back().expected.insert({file_, number_, at + 1, end + 1});
          at = end;
        }
      } else {
        text_ += line + "\n";
        ++number_;
      }
      return;
    }
    if (line == "## Reported" || line == "## Clean") {
      clean_ = line == "## Clean";
      section_ = true;
    } else if (line.starts_with("## ")) {
      section_ = false;
    } else if (line.starts_with("### ") && section_) {
      examples.push_back({line.substr(4), clean_, {}, {}, {}});
    } else if (line.starts_with("Flags: `") && section_ && !examples.empty()) {
      examples.back().flags = splitArguments(line.substr(8, line.size() - 9));
    } else if (line.starts_with("```") && section_) {
      REQUIRE_MESSAGE(!examples.empty(), "a block is before the first ### title");
      const std::size_t blank = line.find(' ');
      REQUIRE_MESSAGE(blank != std::string::npos, line << " has no file name");
      file_ = line.substr(blank + 1);
      text_.clear();
      number_ = 0;
      inside_ = true;
    }
  }

  bool inside_ = false;
  bool clean_ = false;
  bool section_ = false;
  std::string file_, text_;
  std::size_t number_ = 0;
};

// What lint reports the example; the text of the findings for messages.
std::multiset<Place> findings(const Example& example, const std::string& select, std::string& text) {
  const DataFolder folder;
  std::set<std::string> roots;
  for (const auto& [name, content] : example.files) {
    const fs::path path = fs::path(folder.path()) / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << content;
    if (!name.starts_with("data/")) roots.insert(name.substr(0, name.find('/')));
  }
  std::vector<std::string> arguments = {"lint"};
  arguments.insert(arguments.end(), roots.begin(), roots.end());
  arguments.insert(arguments.end(), {"--select", select, "--format", "json"});
  arguments.insert(arguments.end(), example.flags.begin(), example.flags.end());
  const CommandResult result = runDotek(arguments, folder.path());
  REQUIRE_MESSAGE(result.status <= 1, result.err << result.out);
  std::multiset<Place> out;
  for (const auto& one : nlohmann::json::parse(result.out)) {
    Place place{one["file"], one["line"], one["column"], one["endColumn"]};
    if (one["endLine"] != one["line"]) {
      // Over several lines: the carets are under the first.
      for (const auto& [name, content] : example.files) {
        if (name != place.file) continue;
        std::istringstream in(content);
        std::string line;
        for (std::size_t i = 0; i < place.line; ++i)
          std::getline(in, line);
        place.endColumn = line.size() + 1;
      }
    }
    out.insert(place);
    text += "\n  " + one["file"].get<std::string>() + ":" + std::to_string(place.line) + ":" +
            std::to_string(place.column) + "-" + std::to_string(place.endColumn) + " " +
            one["message"].get<std::string>() + " [" + one["code"].get<std::string>() + "]";
  }
  return out;
}

std::vector<fs::path> documents() {
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(root() / "docs" / "rules"))
    if (entry.path().extension() == ".md" && entry.path().stem() != "README")
      out.push_back(entry.path()); // the list
  std::sort(out.begin(), out.end());
  return out;
}

} // namespace

TEST_CASE("lint rules: the document of each rule holds") {
  const auto all = documents();
  REQUIRE(all.size() == lint::rules().size());
  for (const fs::path& path : all) {
    const std::string id = path.stem().string();
    INFO(id);
    const Document document(path);
    bool clean = false;
    bool failing = false;
    for (const Example& example : document.examples) {
      INFO(example.title);
      (example.clean ? clean : failing) = true;
      std::string text;
      const auto told = findings(example, id, text);
      CHECK_MESSAGE(told == example.expected, "told:" << text);
      if (example.clean) {
        CHECK_MESSAGE(example.expected.empty(), "carets are below ## Clean");
        std::string others;
        if (!fewDraws())
          CHECK_MESSAGE(findings(example, "all", others).empty(), "with --select all:" << others);
      } else {
        CHECK_MESSAGE(!example.expected.empty(), "no caret");
      }
    }
    CHECK_MESSAGE(clean, "no clean example");
    CHECK_MESSAGE(failing, "no example that is reported");
    std::ifstream in(path);
    std::string first;
    std::getline(in, first);
    CHECK_MESSAGE(first == "# " + id, first);
  }
}

TEST_CASE("lint rules: a branch for another axis, whose folder is elsewhere, is no misprint") {
  const auto isFound = [](const std::string& tested, const std::string& folder) {
    Example example;
    example.files = {
        {"SchlitzX/DefineData.txt", "Z = -5\n"},
        {folder + "/DefineData.txt", "Z = -5\n"},
        {"post.txt",
         "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\nprobe:\nIF CycleType?('SchlitzX') SeqC ' G65 P9770 "
         "Z'OpFieldData#('Z')' F500' EOL END\nIF CycleType?('" +
             tested + "') SeqC ' G65 P9770 Z'OpFieldData#('Z')' F600' EOL END\nRETURN\n"}};
    std::string text;
    return !findings(example, "cycle-name-differs", text).empty();
  };
  CHECK(!isFound("YNut", "XNut"));
  CHECK(!isFound("RKante", "LKante"));
  CHECK(!isFound("Nut.Y", "Nut.X"));
  CHECK(isFound("Nut.Tiefa", "Nut.Tiefe"));
  CHECK(isFound("Mut.Tiefe", "Nut.Tiefe"));
}

namespace {

// A number on each block that has none and is no header: from 7001, past numbers that the text has.
std::string numbered(const std::string& text) {
  std::string out;
  int next = 7001;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find_first_not_of(" \t");
    const bool block = at != std::string::npos && line.find_first_of("%:/(<NO", at) != at;
    while (text.find(std::to_string(next)) != std::string::npos)
      ++next;
    if (block) line.insert(0, "N" + std::to_string(next++));
    out += line + "\n";
  }
  return out;
}

} // namespace

TEST_CASE("lint rules: numbers that nothing goes to change no finding") {
  const auto codes = [](Example example, const std::string& select) {
    std::string text;
    std::multiset<std::pair<std::string, std::size_t>> out; // file, line
    for (const Place& place : findings(example, select, text))
      out.insert({place.file, place.line});
    return out;
  };
  std::size_t seen = 0;
  std::size_t page = 0;
  for (const fs::path& path : documents()) {
    if (fewDraws() && page++ % 5 != 0) continue;
    const std::string id = path.stem().string();
    INFO(id);
    for (const Example& example : Document(path).examples) {
      INFO(example.title);
      Example other = example;
      for (auto& [name, text] : other.files)
        if (name.ends_with(".nc")) text = numbered(text);
      if (other.files == example.files) continue;
      ++seen;
      CHECK(codes(example, "all") == codes(other, "all"));
    }
  }
  CHECK(seen > (fewDraws() ? 30 : 200));
}

namespace {

// `SeqC` under another name of the same length, so that every column stays.
std::string renumbered(std::string text) {
  for (std::size_t at = text.find("SeqC"); at != std::string::npos; at = text.find("SeqC", at + 4)) {
    const auto letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
    if ((at > 0 && letter(text[at - 1])) || (at + 4 < text.size() && letter(text[at + 4]))) continue;
    text.replace(at, 4, "Satz");
  }
  return text;
}

} // namespace

TEST_CASE("lint rules: a block number has the name that the form gives it") {
  std::vector<std::pair<std::string, std::string>> forms;
  for (const auto& entry : fs::directory_iterator(root() / "stdlib" / "forms"))
    if (entry.path().extension() == ".toml")
      forms.emplace_back("data/forms/" + entry.path().filename().string(), renumbered(readAll(entry.path())));
  REQUIRE(!forms.empty());
  std::size_t seen = 0;
  for (const fs::path& path : documents()) {
    const std::string id = path.stem().string();
    if (id == "unknown-keyword") continue; // its subject is what the table of the language has
    INFO(id);
    for (const Example& example : Document(path).examples) {
      INFO(example.title);
      Example other = example;
      for (auto& [name, text] : other.files)
        text = renumbered(text);
      if (other.files == example.files) continue;
      ++seen;
      other.files.insert(other.files.end(), forms.begin(), forms.end());
      other.flags.insert(other.flags.end(), {"--data", "data"});
      std::string text;
      CHECK_MESSAGE(findings(other, id, text) == example.expected, "told:" << text);
    }
  }
  CHECK(seen > 120);
}

TEST_CASE("lint rules: ids are unique over messages and rules, and each is explained") {
  std::set<std::string_view> codes;
  for (const MessageInfo& info : messageTable())
    codes.insert(info.code);
  for (const lint::NamedRule& named : lint::rules()) {
    CHECK_MESSAGE(codes.insert(named.id).second, named.id << " is a message, too");
    CHECK(lint::findRule(named.id)->rule == named.rule);
    const std::string_view page = lint::pageOf(named.id);
    CHECK(page == readAll(root() / "docs" / "rules" / (std::string(named.id) + ".md")));
    std::string severity(severityName(named.rule->severity));
    severity[0] = static_cast<char>(severity[0] - 'a' + 'A');
    if (!named.rule->byDefault) severity += ", off by default";
    CHECK_MESSAGE(page.find("\n\n" + severity + ". ") == named.id.size() + 2,
                  named.id << " begins otherwise");
    const CommandResult result = runDotek({"explain", std::string(named.id)}, root());
    CHECK(result.status == 0);
    CHECK(result.out.starts_with(std::string(named.id) + ": "));
    CHECK(result.out.find("\nReported\n") != std::string::npos);
  }
  CHECK(lint::codeTable().size() == messageTable().size() + lint::rules().size());
  CHECK(lint::rulePages().size() == lint::rules().size());
  CHECK(lint::pageOf("no-such-rule").empty());
  for (const lint::CodeInfo& info : lint::codeTable()) {
    const std::string summary = lint::summaryOf(info);
    CHECK_MESSAGE(summary.size() > 12, info.code << ": " << summary);
    CHECK_MESSAGE(summary.back() == '.', info.code << ": " << summary);
  }
}

TEST_CASE("lint rules: shared rules are the checks of the front ends") {
  std::map<std::string_view, Severity> checks;
  const auto take = [&](const auto& list) {
    for (const auto* check : list)
      CHECK_MESSAGE(checks.emplace(check->code, check->severity).second, check->code << " is listed twice");
  };
  take(frontend::compost::progChecks());
  take(frontend::macrob::programChecks());
  take(frontend::gibbs::fileChecks());
  take(frontend::gibbs::cycleChecks());
  std::map<std::string_view, Severity> shared;
  for (const lint::NamedRule& named : lint::rules())
    if (named.rule->shared) shared.emplace(named.id, named.rule->severity);
  CHECK(checks == shared);
}

TEST_CASE("lint rules: a page in a terminal") {
  const std::string page =
      "# a-rule\n\nNote, off by default. One `a. B` sentence\non two lines. Another.\n\nMore.\n\n"
      "## Reported\n\n### A case\n\nFlags: `--control x`\n\n```nc p.nc\nG0\n^^\n```\n\n## Clean\n";
  CHECK(lint::proseOf(page) == "One `a. B` sentence on two lines. Another.\nMore.");
  CHECK(lint::firstSentence(lint::proseOf(page)) == "One `a. B` sentence on two lines.");
  CHECK(lint::shownPage(page) ==
        "One `a. B` sentence on two lines. Another.\n\nMore.\n\nReported\n--------\n\nA case:\n\n"
        "Flags: `--control x`\n\n  p.nc\n    G0\n    ^^\n\nClean\n-----\n");
}

TEST_CASE("lint: the examples give no finding at --select all") {
  const CommandResult result = runDotek({"lint", "examples", "--select", "all"}, root());
  CHECK(result.status == 0);
  CHECK_MESSAGE(result.out.empty(), result.out);
}
