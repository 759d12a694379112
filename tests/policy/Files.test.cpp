// House rules for files: size, marks of unfinished work, paths of a machine, tests that cannot fail, links.
#include "tests/GoldenRunner.h"
#include "tests/policy/Tree.h"

#include <algorithm>
#include <cctype>
#include <doctest/doctest.h>
#include <filesystem>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

bool isMarkdown(const TreeFile& file) {
  return file.path.ends_with(".md");
}

bool isOurText(const TreeFile& file) {
  static constexpr const char* kEnds[] = {".cpp",  ".h",  ".def", ".g4",   ".cmake", "CMakeLists.txt",
                                          ".json", ".md", ".sh",  ".toml", ".cyc",   "/run"};
  return file.path == "dev" || std::any_of(std::begin(kEnds), std::end(kEnds),
                                           [&](const char* end) { return file.path.ends_with(end); });
}

// Goldens and seeds are inputs and outputs, not texts of ours.
bool isCase(const TreeFile& file) {
  return file.below("tests/golden") || file.below("tests/fuzz/seeds");
}

std::size_t lineAt(const std::string& text, std::size_t offset) {
  return 1 + static_cast<std::size_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

} // namespace

TEST_CASE("policy: a source file is one room") {
  for (const TreeFile& file : tree()) {
    if (!file.isSource() && !file.path.ends_with(".g4") && !file.path.ends_with(".sh") && file.path != "dev")
      continue;
    const auto lines = std::count(file.text.begin(), file.text.end(), '\n');
    if (lines > 400) MESSAGE(file.path << " has " << lines << " lines; about 400 are one room");
    CHECK_MESSAGE(lines <= 600, file.path << " has " << lines << " lines");
  }
}

TEST_CASE("policy: headers are included once") {
  for (const TreeFile& file : tree()) {
    if (!file.isHeader()) continue;
    CHECK_MESSAGE(file.text.find("\n#pragma once\n") != std::string::npos, file.path);
    CHECK_MESSAGE(file.text.starts_with("//"), file.path << " does not say in its first line what it is for");
  }
}

TEST_CASE("policy: no unfinished work outside tests") {
  for (const TreeFile& file : tree()) {
    if (!isOurText(file) || file.below("tests") || isMarkdown(file)) continue;
    const std::string text = lowerCase(file.text);
    for (const std::string mark :
         {"todo", "fixme", "xxx", "hack", "not implemented", "unimplemented", "stub"}) {
      const std::size_t at = findWord(text, mark);
      CHECK_MESSAGE(at == std::string::npos,
                    file.path << ":" << lineAt(text, at == std::string::npos ? 0 : at) << ": " << mark);
    }
  }
}

TEST_CASE("policy: no path of a machine") {
  for (const TreeFile& file : tree()) {
    if (!isOurText(file) || isCase(file)) continue;
    for (const std::string folder : {"work", "farm", "root", "home", "tmp", "opt"}) {
      const std::string start = "/" + folder + "/";
      for (std::size_t at = file.text.find(start); at != std::string::npos;
           at = file.text.find(start, at + 1)) {
        const char before = at == 0 ? ' ' : file.text[at - 1];
        const bool relative = std::isalnum(static_cast<unsigned char>(before)) != 0 ||
                              std::string_view("_./-}*").find(before) != std::string_view::npos;
        CHECK_MESSAGE(relative, file.path << ":" << lineAt(file.text, at) << ": " << start);
      }
    }
  }
}

TEST_CASE("policy: every test can fail") {
  for (const TreeFile& file : tree()) {
    if (!file.below("tests") || !(file.isSource() || file.path.ends_with(".sh"))) continue;
    for (const std::string macro : {"CHECK", "REQUIRE", "WARN", "CHECK_MESSAGE", "REQUIRE_MESSAGE"}) {
      for (const std::string argument : {"true", "1", "!false"}) {
        for (const std::string end : {")", ","}) {
          const std::string text = macro + "(" + argument + end;
          CHECK_MESSAGE(file.text.find(text) == std::string::npos, file.path << " has " << text);
        }
      }
    }
    for (const std::string& line : linesOf(file.text))
      CHECK_MESSAGE(!line.ends_with("|| "
                                    "true"),
                    file.path << ": " << line);
  }
}

TEST_CASE("policy: what a newcomer looks for is there") {
  for (const std::string name :
       {"README.md", "CHANGELOG.md", "LICENSE", "dev", ".ci/run", "docs/architecture.md", "docs/cli.md",
        "docs/testing.md", "docs/diagnostics.md", "docs/performance.md", "docs/post-differences.md"})
    CHECK_MESSAGE(fs::exists(root() / name), name);
  const std::string readme = readAll(root() / "README.md");
  CHECK(readme.find("./dev demo") != std::string::npos);
  CHECK(readme.find("./dev test") != std::string::npos);
  CHECK(readAll(root() / ".ci/run").find("./dev test") != std::string::npos);
  for (const std::string name : {"dev", ".ci/run"})
    CHECK_MESSAGE((fs::status(root() / name).permissions() & fs::perms::owner_exec) != fs::perms::none, name);
}

TEST_CASE("policy: links in the documents lead somewhere") {
  for (const TreeFile& file : tree()) {
    if (!isMarkdown(file) || isCase(file)) continue;
    for (std::size_t at = file.text.find("]("); at != std::string::npos; at = file.text.find("](", at + 2)) {
      const std::string target = file.text.substr(at + 2, file.text.find_first_of(") #\n", at + 2) - at - 2);
      if (target.empty() || target.find("://") != std::string::npos) continue;
      CHECK_MESSAGE(fs::exists(root() / file.folder() / target),
                    file.path << ":" << lineAt(file.text, at) << ": " << target);
    }
  }
}
