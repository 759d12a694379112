// Who includes whom: the cost grows with the #INCLUDE lines, a loop ends.
#include "project/IncludeGraph.h"

#include "GibbsRunProject.h"
#include "frontend/gibbs/Program.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

// Files of one project; what each includes is asked of one graph.
struct Included {
  explicit Included(std::map<std::string, std::string> files, std::uint32_t depth = 16) {
    project.files = std::move(files);
    project.limits.includeDepth = depth;
  }

  std::string by(const std::string& name) {
    std::string out;
    for (const gibbs::Macro* macro : graph.includedBy(*project.load(name)))
      out += (out.empty() ? "" : " ") + project.sources.file(macro->file).name();
    return out;
  }

  // CODE@TEXT of each finding.
  std::string findings() {
    std::string out;
    for (const Diagnostic& d : project.diagnostics.all())
      out += fmt::format("{}{}@{} in {}", out.empty() ? "" : "; ", d.code, project.sources.text(d.range),
                         project.sources.file(d.range.file).name());
    return out;
  }

  GibbsProject project;
  std::size_t loads = 0;
  dotek::project::IncludeGraph graph{[this](const std::string& name, SourceRange) {
                                       ++loads;
                                       return project.load(name);
                                     },
                                     project.limits, project.diagnostics};
};

std::string fileName(int i) {
  return "f" + std::to_string(i);
}

} // namespace

TEST_CASE("include graph: files in the order in which they are met, each once") {
  Included all({{"top", "#INCLUDE \"left\"\n#INCLUDE \"right\"\n"},
                {"left", "#INCLUDE \"base\"\n#INCLUDE \"more\"\n"},
                {"right", "#INCLUDE \"more\"\n#INCLUDE \"last\"\n"},
                {"base", "X = 1\n"},
                {"more", "X = 2\n"},
                {"last", "X = 3\n"}});
  CHECK(all.by("top") == "left base more right last");
  CHECK(all.by("right") == "more last");
  CHECK(all.by("last").empty());
  CHECK(all.findings().empty());
  CHECK(all.loads == 6); // one for each line
}

TEST_CASE("include graph: among files that all include one another each line is followed once") {
  constexpr int kFiles = 40;
  std::map<std::string, std::string> files;
  for (int i = 0; i < kFiles; ++i)
    for (int k = 0; k < kFiles; ++k)
      if (k != i) files[fileName(i)] += "#INCLUDE \"" + fileName(k) + "\"\n";
  Included all(std::move(files));
  for (int i = 0; i < kFiles; ++i)
    all.by(fileName(i));
  CHECK(all.loads == kFiles * (kFiles - 1));
  CHECK(all.project.diagnostics.all().size() == kFiles - 1); // where a loop is closed, once a file
  for (const Diagnostic& d : all.project.diagnostics.all())
    CHECK(d.code == "include-loop");
}

TEST_CASE("include graph: a file that includes itself, two loops of one file") {
  Included self(std::map<std::string, std::string>{{"self", "X = 1\n#INCLUDE \"self\"\n"}});
  CHECK(self.by("self").empty());
  CHECK(self.findings() == "include-loop@\"self\" in self");
  Included outer({{"start", "#INCLUDE \"a\"\n#INCLUDE \"c\"\n"},
                  {"a", "#INCLUDE \"b\"\n"},
                  {"b", "#INCLUDE \"a\"\n"},
                  {"c", "#INCLUDE \"d\"\n"},
                  {"d", "#INCLUDE \"c\"\n"}});
  CHECK(outer.by("start") == "a b c d");
  CHECK(outer.findings() == "include-loop@\"a\" in b; include-loop@\"c\" in d");
  CHECK(outer.by("b").empty()); // the line that closes the loop is out
  CHECK(outer.by("a") == "b");
}

TEST_CASE("include graph: the depth is that of the longest chain, however a file is met first") {
  const std::map<std::string, std::string> files = {{"top", "#INCLUDE \"low\"\n#INCLUDE \"one\"\n"},
                                                    {"one", "#INCLUDE \"two\"\n"},
                                                    {"two", "#INCLUDE \"low\"\n"},
                                                    {"low", "#INCLUDE \"end\"\n"},
                                                    {"end", "X = 1\n"}};
  Included enough(files, 4);
  CHECK(enough.by("top") == "low end one two");
  CHECK(enough.findings().empty());
  Included few(files, 3);
  CHECK(few.by("top") == "low end one two");
  CHECK(few.findings() == "include-too-deep@\"end\" in low");
  few.by("top");
  CHECK(few.project.diagnostics.all().size() == 1);
}

TEST_CASE("include graph: a chain as long as there are files") {
  std::map<std::string, std::string> files;
  for (int i = 0; i < 3000; ++i)
    files[fileName(i)] = i == 2999 ? "X = 1\n" : "#INCLUDE \"" + fileName(i + 1) + "\"\n";
  Included all(std::move(files), 100000);
  CHECK(all.graph.includedBy(*all.project.load("f0")).size() == 2999);
  CHECK(all.findings().empty());
}

TEST_CASE("a run ends where files that hold nothing else include one another twice") {
  std::map<std::string, std::string> files;
  for (int i = 0; i < 40; ++i)
    files[fileName(i)] = "#INCLUDE \"" + fileName(i + 1) + "\"\n#INCLUDE \"" + fileName(i + 1) + "\"\n";
  files[fileName(40)] = "! nothing\n";
  GibbsProject project;
  project.files = std::move(files);
  project.limits.includeDepth = 100;
  project.limits.steps = 1000;
  std::size_t loads = 0;
  const gibbs::Program program =
      gibbs::compileProgram(*project.load("f0"), project.limits, [&](const std::string& name, SourceRange) {
        ++loads;
        return project.load(name);
      });
  CHECK(loads < 1000);
  REQUIRE(!program.instructions.empty());
  const auto* refusal = std::get_if<gibbs::RefuseStep>(&program.instructions.front().step);
  REQUIRE(refusal != nullptr);
  CHECK(refusal->why.find("more statements") != std::string::npos);
}

TEST_CASE("a run follows no further path through files that include one another") {
  constexpr int kFiles = 30;
  GibbsProject project;
  for (int i = 0; i < kFiles; ++i)
    for (int k = 0; k < kFiles; ++k)
      project.files[fileName(i)] += "#INCLUDE \"" + fileName(k) + "\"\n";
  project.limits.includeDepth = 100;
  std::size_t loads = 0;
  gibbs::compileProgram(*project.load("f0"), project.limits, [&](const std::string& name, SourceRange) {
    ++loads;
    return project.load(name);
  });
  CHECK(loads <= kFiles);
}
