// What is nested deeper than the limit is an error in every language, never the end of the program.
#include "driver/Driver.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <set>
#include <string>

using namespace dotek;
using namespace dotek::tests;

namespace {

std::string repeated(const std::string& text, int count) {
  std::string out;
  for (int i = 0; i < count; ++i)
    out += text;
  return out;
}

// Of `dotek lint` of a file with the text.
driver::Outcome linted(const std::string& name, const std::string& text) {
  const TestFolder folder("dotek-deep");
  driver::LintOptions options;
  options.paths = {folder.write(name, text)};
  return driver::lint(options);
}

// At a greater depth another limit may be met first.
void isTooDeep(int depth, const std::string& name, const std::string& text) {
  const driver::Outcome outcome = linted(name, text);
  std::set<std::string> allowed = {"nesting-too-deep"};
  if (depth > 1000) allowed.insert({"too-many-tokens", "line-too-long"});
  bool found = false;
  for (const Diagnostic& one : outcome.diagnostics.all())
    found = found || allowed.contains(std::string(one.code));
  CHECK_MESSAGE(outcome.status == 1, name << ": " << text.substr(0, 60));
  CHECK_MESSAGE(found, name << ": " << text.substr(0, 60));
}

} // namespace

TEST_CASE("signs, brackets and negations of any depth are an error") {
  for (const int depth : {700, 5000}) {
    isTooDeep(depth, "deep.nc", "O1\n#1=" + repeated("-", depth) + "1\nM99\n");
    isTooDeep(depth, "deep.nc", "O1\n#1=" + repeated("[", depth) + "1\nM99\n");
    isTooDeep(depth, "deep.nc", "O1\nIF[" + repeated("[", depth) + "#1EQ1]GOTO1\nN1M99\n");
    isTooDeep(depth, "deep.mac", "x = " + repeated("-", depth) + "1\nPOINT_TO_POINT x, 1, 1\n");
    isTooDeep(depth, "deep.mac", "x = " + repeated("(", depth) + "1\nPOINT_TO_POINT x, 1, 1\n");
    const std::string head = "cycle deep \"Deep\"\nresult size : length \"Size\"\n";
    isTooDeep(depth, "deep.cycle", head + "size = " + repeated("-", depth) + "1 mm\n");
    isTooDeep(depth, "deep.cycle", head + "size = " + repeated("(", depth) + "1 mm\n");
    isTooDeep(depth, "deep.cycle", head + "if " + repeated("not ", depth) + "1 < 2 then\nend\nsize = 1 mm\n");
    isTooDeep(depth, "deep.txt", "probe:\n  IF " + repeated("(", depth) + "1 = 1\n  END\nRETURN\n");
  }
}
