// A folder of backends/ is a target: nothing else names it.
#include "targets/Target.h"
#include "tests/policy/Tree.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <set>

using namespace dotek;
using namespace dotek::tests;

namespace {

bool exists(const std::string& path) {
  return std::any_of(tree().begin(), tree().end(), [&](const TreeFile& file) { return file.path == path; });
}

std::vector<std::string> targetFolders() {
  std::set<std::string> out;
  for (const TreeFile& file : tree()) {
    if (!file.below("backends")) continue;
    const std::size_t begin = std::string("backends/").size();
    const std::size_t end = file.path.find('/', begin);
    if (end != std::string::npos) out.insert(file.path.substr(begin, end - begin));
  }
  out.erase("common");
  return {out.begin(), out.end()};
}

// Lines that compare something with the name as a text.
std::vector<std::string> comparisons(const std::string& text, const std::string& name) {
  std::vector<std::string> out;
  for (const std::string& line : linesOf(text))
    for (const std::string& pattern : {"= \"" + name + "\"", "\"" + name + "\" =", "\"" + name + "\" !"})
      if (line.find(pattern) != std::string::npos) out.push_back(line);
  return out;
}

} // namespace

TEST_CASE("policy: the table of targets is the folders of backends") {
  std::vector<std::string> names;
  for (const targets::NamedTarget& one : targets::allTargets())
    names.emplace_back(one.name);
  CHECK(names == targetFolders());
  for (const std::string& name : names) {
    INFO(name);
    CHECK(exists("backends/" + name + "/Target.cpp"));
    CHECK(exists("docs/" + name + ".md"));
  }
}

TEST_CASE("policy: a target says what it is and can be asked everything") {
  for (const targets::NamedTarget& one : targets::allTargets()) {
    INFO(one.name);
    CHECK_FALSE(one.target->text.empty());
    CHECK((one.target->convert != nullptr));
    // A CAM runs its folders itself; verify refuses and says how to look at what they post (docs/gibbs.md).
    CHECK((one.target->verify != nullptr || one.name == "gibbs"));
    CHECK(targets::findTarget(one.name) == one.target);
    CHECK(targets::targetNames().find(one.name) != std::string::npos);
  }
  CHECK(targets::findTarget("") == nullptr);
  CHECK(targets::findTarget("common") == nullptr);
}

TEST_CASE("policy: nothing compares the name of a target") {
  CHECK(comparisons("if (options.to == \"fanuc\")", "fanuc").size() == 1);
  CHECK(comparisons("if (\"fanuc\" != to)", "fanuc").size() == 1);
  CHECK(comparisons("list(\"fanuc\")", "fanuc").empty());
  for (const TreeFile& file : tree()) {
    if (!file.isSource() || file.below("tests") || file.below("stdlib")) continue;
    for (const std::string& name : targetFolders()) {
      // A word of languages, too, and what runs on the simulator.
      const bool word =
          name == "cycle" && !file.below("targets") && !file.below("driver") && !file.below("cli");
      if (word) continue;
      for (const std::string& line : comparisons(file.text, name))
        CHECK_MESSAGE(false, file.path << ": " << line);
    }
  }
}
