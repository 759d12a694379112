// Lint of what has changed: since a commit, and while somebody writes; and the page of findings.
#include "tests/Process.h"
#include "tests/Skips.h"

#include <doctest/doctest.h>

using namespace dotek::tests;

namespace {

constexpr const char* kNoLength = "%\nO1\nG43 Z50.\nM30\n%\n";
constexpr const char* kGit = "git -c user.email=a@b -c user.name=n -c init.defaultBranch=main ";

bool haveGit(const ProcessFolder& folder) {
  if (folder.run("git --version").status == 0) return true;
  skip("there is no git");
  return false;
}

bool has(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("lint --changed-since reports what git calls changed, and files that it does not know") {
  const ProcessFolder folder;
  if (!haveGit(folder)) return;
  folder.write("a.nc", kNoLength);
  folder.write("b.nc", kNoLength);
  const std::string git = kGit;
  REQUIRE(folder.run(git + "init -q . && git add . && " + git + "commit -qm first").status == 0);

  CHECK(folder.run("dotek lint . --changed-since HEAD").status == 0);
  folder.write("b.nc", "%\nO2\nG43 Z51.\nM30\n%\n");
  REQUIRE(folder.run("mkdir -p \"new folder\"").status == 0);
  folder.write("new folder/c.nc", kNoLength);
  const ShellResult changed = folder.run("dotek lint . --changed-since HEAD");
  CHECK(changed.status == 1);
  CHECK_FALSE(has(changed.out, "a.nc"));
  CHECK(has(changed.out, "b.nc:3:1"));
  CHECK(has(changed.out, "new folder/c.nc:3:1"));
  // From below, by other spellings, and of a commit before.
  const ShellResult below = folder.run("cd 'new folder' && dotek lint ../b.nc . --changed-since HEAD");
  CHECK(has(below.out, "../b.nc:3:1"));
  CHECK(has(below.out, "c.nc:3:1"));
  REQUIRE(folder.run("git add . && " + git + "commit -qm second").status == 0);
  CHECK(folder.run("dotek lint . --changed-since HEAD").status == 0);
  CHECK(has(folder.run("dotek lint . --changed-since HEAD~1").out, "b.nc:3:1"));
  // What a change leaves out of the findings, --fix leaves as it is.
  CHECK(folder.run("dotek lint a.nc --changed-since HEAD --fix").status == 0);
}

TEST_CASE("lint --changed-since reports what a change of another file brings about") {
  const ProcessFolder folder;
  if (!haveGit(folder)) return;
  const std::string git = kGit;
  for (const char* name : {"bore", "surface"}) {
    folder.run(std::string("mkdir -p cycles/") + name);
    folder.write(std::string("cycles/") + name + "/DefineData.txt", "D = 40\n");
  }
  const std::string begin = "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\nprobe:\n";
  const auto branch = [](const std::string& name) {
    return "IF CycleType?('" + name + "')\n SeqC ' G65 P9023 X'OpFieldData#('D') EOL\nEND\n";
  };
  folder.write("post.txt", begin + branch("bore") + branch("surface") + "RETURN\n");
  folder.write("O1.nc", "O1\nG65 P2\nM30\n");
  folder.write("O2.nc", "O2\nM99\n");
  folder.write("O3.nc", kNoLength); // has a finding of its own
  REQUIRE(folder.run(git + "init -q . && git add . && " + git + "commit -qm first").status == 0);
  const auto lint = [&] { return folder.run("dotek lint . --changed-since HEAD").out; };
  CHECK_FALSE(has(lint(), "cycle-without-branch"));

  folder.write("post.txt", begin + branch("surface") + "RETURN\n");
  CHECK(has(folder.run("dotek lint .").out, "cycle-without-branch"));
  CHECK(has(lint(), "cycles/bore/DefineData.txt:1:1: "));
  CHECK(has(lint(), "[cycle-without-branch]"));
  CHECK_FALSE(has(lint(), "O3.nc"));
  REQUIRE(folder.run(git + "commit -qam second").status == 0);
  CHECK_FALSE(has(lint(), "cycle-without-branch")); // known before

  // A program that others call goes, or gets another number.
  folder.run("git rm -q O2.nc");
  CHECK(has(lint(), "O1.nc:2:"));
  CHECK(has(lint(), "[program-not-found]"));
  CHECK_FALSE(has(lint(), "O3.nc"));
  folder.write("X2.nc", "O22\nM99\n");
  CHECK(has(lint(), "[program-not-found]"));
  REQUIRE(folder.run("git add . && " + git + "commit -qm third").status == 0);
  CHECK_FALSE(has(lint(), "program-not-found"));
}

TEST_CASE("lint --changed-since without an answer reports nothing else, and is no success") {
  const ProcessFolder folder;
  if (!haveGit(folder)) return;
  folder.write("a.nc", kNoLength);
  for (const char* reference : {"HEAD", "main", "--output=x", "nosuch"}) {
    const ShellResult result = folder.run(std::string("dotek lint a.nc --changed-since=") + reference);
    CHECK_MESSAGE(result.status == 2, reference << result.out << result.err);
    CHECK(has(result.out, "[changed-since-unknown]"));
    CHECK_FALSE(has(result.out, "length-offset-number"));
  }
  REQUIRE(folder.run(std::string(kGit) + "init -q . && git add . && " + kGit + "commit -qm first").status ==
          0);
  const ShellResult unknown = folder.run("dotek lint a.nc --changed-since nosuch");
  CHECK(unknown.status == 2);
  CHECK(has(unknown.out, "nosuch"));
  CHECK(folder.run("dotek lint a.nc --changed-since=--output=planted").status == 2);
  CHECK_FALSE(has(folder.names(), "planted"));
  const ShellResult without = folder.run("PATH=/nowhere dotek lint a.nc --changed-since HEAD");
  CHECK(without.status == 2);
  CHECK(has(without.out, "git: No such file"));
}

TEST_CASE("lint --watch runs again when a file changes, and not for what it prints") {
  const ProcessFolder folder;
  folder.write("p.nc", kNoLength);
  const ShellResult result = folder.run(R"TXT(
set -m # a group of its own, which ends as a whole
dotek lint . --watch >found 2>said & watcher=$!
until grep -q watched said; do sleep 0.1; done
sleep 1
printf '%%\nO1\nG43 H1 Z50.\nM30\n%%\n' >p.nc
until [ "$(grep -c watched said)" = 2 ]; do sleep 0.1; done
printf '%%\nO1\nG43 Z5.\nM30\n%%\n' >q.nc
until [ "$(grep -c watched said)" = 3 ]; do sleep 0.1; done
kill -- -$watcher; wait $watcher
cat said; cat found)TXT");
  CHECK(has(result.out, "p.nc` has changed"));
  CHECK(has(result.out, "q.nc` has changed"));
  CHECK_FALSE(has(result.out, "found` has changed"));
  CHECK(result.out.find("p.nc:3:1") == result.out.rfind("p.nc:3:1"));
  CHECK(has(result.out, "q.nc:3:1"));
  CHECK(folder.run("dotek lint p.nc --watch --fix").status == 2);
  CHECK(folder.run("echo | dotek lint - --watch").status == 2);
}

TEST_CASE("lint --format html is a page that shows each place, and nothing of a program is markup in it") {
  const ProcessFolder folder;
  folder.write("<b>.nc", "%\nO1(<script>)\nG43 Z50. (<i>&amp;)\nM30\n%\n");
  const ShellResult result = folder.run("dotek lint . --format html");
  CHECK(result.status == 1);
  CHECK(result.out.starts_with("<!DOCTYPE html>"));
  CHECK(has(result.out, "<mark>G43</mark> Z50. (&lt;i&gt;&amp;amp;)"));
  CHECK(has(result.out, "&lt;b&gt;.nc:3:1"));
  CHECK_FALSE(has(result.out, "<script>"));
  CHECK_FALSE(has(result.out, "<b>.nc"));
  const ShellResult clean = folder.run("printf '%%\\nO1\\nM30\\n%%\\n' >c.nc; dotek lint c.nc --format html");
  CHECK(clean.status == 0);
  CHECK(has(clean.out, "0 errors"));
}
