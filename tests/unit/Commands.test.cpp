// What cannot appear in a golden case: results in files, and inputs too large to keep.
#include "DataFolder.h"
#include "tests/GoldenRunner.h"
#include "tests/Process.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

std::string example(const std::string& name) {
  return (root() / "examples" / name).string();
}

std::size_t filesIn(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

// A copy of an example cycle in which one file is replaced.
std::string damagedCycle(const DataFolder& folder, const std::string& file, const std::string& text) {
  fs::copy(example("surface-x"), folder.path() + "/surface-x");
  return folder.write("surface-x/" + file, text);
}

std::string repeated(const std::string& text, std::size_t count) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i)
    out += text;
  return out;
}

// lint and post both refuse a cycle in which `file` has `text`; one finding `code`, at `place`, and little
// text.
void refusedAt(const std::string& file, const std::string& text, const std::string& place,
               const std::string& code) {
  INFO(file << " " << place << " " << code);
  const DataFolder folder;
  const std::string path = damagedCycle(folder, file, text);
  const std::string cycle = folder.path() + "/surface-x";
  const CommandResult lint = runDotek({"lint", cycle, "--select", code}, folder.path());
  CHECK(lint.status == 1);
  CHECK(lint.out.starts_with(path + ":" + place + ": error: "));
  CHECK(lint.out.find("[" + code + "]") == lint.out.rfind("[" + code + "]"));
  CHECK(lint.out.size() < 2000);
  const CommandResult post =
      runDotek({"post", cycle, "--prog", example("post.txt"), "--clearance", "5"}, folder.path());
  CHECK(post.status == 1);
  CHECK(post.out.empty());
  CHECK(post.err.find("[" + code + "]") != std::string::npos);
}

} // namespace

TEST_CASE("post -o writes what it would print, whole or not at all") {
  const DataFolder folder;
  const std::vector<std::string> base = {
      "post", example("surface-x"), "--prog", example("post.txt"), "--clearance", "5"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), base.begin(), base.end());
    return runDotek(more, folder.path());
  };
  const CommandResult printed = with({"--set", "G=54"});
  REQUIRE(printed.status == 0);
  const std::string out = folder.path() + "/x.nc";

  // A refusal creates nothing.
  CHECK(with({"--set", "G=5", "-o", out}).status == 1);
  CHECK(filesIn(folder.path()) == 0);

  const CommandResult written = with({"--set", "G=54", "-o", out});
  CHECK(written.status == 0);
  CHECK(written.out.empty());
  CHECK(readAll(out) == printed.out);
  CHECK(filesIn(folder.path()) == 1);

  // A refusal leaves the last result as it is.
  CHECK(with({"--set", "G=5", "-o", out}).status == 1);
  CHECK(readAll(out) == printed.out);

  const CommandResult nowhere = with({"--set", "G=54", "-o", folder.path() + "/none/x.nc"});
  CHECK(nowhere.status == 2);
  CHECK(nowhere.out.empty());
  CHECK(nowhere.err.find("[file-not-writable]") != std::string::npos);
  const CommandResult onFolder = with({"--set", "G=54", "-o", folder.path()});
  CHECK(onFolder.status == 2);
  CHECK(filesIn(folder.path()) == 1);
}

TEST_CASE("a line of 1 MB is one finding at that line") {
  const std::string long1 = "x = 1" + std::string(1000000, ' ') + "+ 1\n";
  refusedAt("CycleData.mac", "y = 1\n" + long1 + "z = 1\n", "2:1", "line-too-long");
  refusedAt("ToolPath.mac", "! " + std::string(1000000, 'x'), "1:1", "line-too-long");
  refusedAt("DefineData.txt", "X = 1\n\nY = " + std::string(1000000, '1'), "3:1", "line-too-long");
  refusedAt("CycleData.dlg", "dialog \"" + std::string(1000000, 'x') + "\", 0, 0, 1, 1\nok 1, 1, 1, 1\n",
            "1:1", "line-too-long");
}

TEST_CASE("100,000 nested brackets are one finding") {
  const std::string open(100000, '(');
  const std::string close(100000, ')');
  const std::vector<std::string> lines = {"x = " + open + "1" + close + "\n", "if " + open + "1\n",
                                          "x = " + repeated("abs(", 25000) + "\n"};
  for (const std::string& line : lines) {
    const DataFolder folder;
    damagedCycle(folder, "CycleData.mac", "y = 1\n" + line);
    const CommandResult lint =
        runDotek({"lint", folder.path() + "/surface-x", "--fail-on", "error"}, folder.path());
    CHECK(lint.status == 1);
    CHECK(lint.out.find("CycleData.mac:2:") != std::string::npos);
    CHECK(lint.out.find("error: ") == lint.out.rfind("error: "));
    CHECK(lint.out.size() < 20000);
    // The same within the limits of length: the depth is what is reported.
    const CommandResult deep = runDotek({"lint", folder.path() + "/surface-x", "--fail-on", "error",
                                         "--limit", "line-bytes=1000000", "--limit", "line-tokens=1000000"},
                                        folder.path());
    CHECK(deep.status == 1);
    CHECK(deep.out.find("[nesting-too-deep]") != std::string::npos);
    CHECK(deep.out.find("error: ") == deep.out.rfind("error: "));
  }
}

TEST_CASE("a Prog with 100,000 nested brackets, IFs or blanks is refused at its line") {
  const DataFolder folder;
  const std::vector<std::pair<std::string, std::string>> progs = {
      {"IF " + std::string(100000, '(') + "Drilling?" + std::string(100000, ')') + " 'x' END\n",
       "prog.txt:2:"},
      {repeated("IF Drilling?\n", 100000) + repeated("END\n", 100000), "prog.txt:"},
      {"'x'" + std::string(1000000, ' ') + "EOL\n", "prog.txt:2:"},
      {"'" + std::string(1000000, 'x') + "' EOL\n", "prog.txt:2:"}};
  for (const auto& [text, place] : progs) {
    const std::string prog = folder.write("prog.txt", "probe:\n" + text + "RETURN\n");
    const CommandResult post =
        runDotek({"post", example("surface-z"), "--prog", prog, "--routine", "probe"}, folder.path());
    CHECK(post.status == 1);
    CHECK(post.out.empty());
    CHECK(post.err.find(place) != std::string::npos);
    CHECK(post.err.find("error: ") == post.err.rfind("error: "));
    CHECK(post.err.size() < 3000);
  }
}

TEST_CASE("commands: a folder that is not there is said to be so, also beside a dotek.toml with a control") {
  const DataFolder folder;
  folder.write("dotek.toml", "schema = 1\ncontrol = \"fanuc-31i-b\"\n");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"verify", "nothing", "--prog", example("post.txt")},
        {"convert", "nothing", "--prog", example("post.txt"), "--to", "fanuc"}}) {
    const CommandResult result = runDotek(command, folder.path());
    CHECK(result.status != 0);
    CHECK(result.err.find("`nothing`") != std::string::npos);
    CHECK(result.err.find("--from-control") == std::string::npos);
  }
}

TEST_CASE("commands: formats for code hosts name files of `.` without the ./") {
  const DataFolder folder;
  folder.write("sub/O0001.nc", "%\nO0001\nGOTO 20\nM30\n%\n");
  for (const char* format : {"sarif", "github", "gitlab"}) {
    const CommandResult result = runDotek({"lint", ".", "--format", format}, folder.path());
    CHECK(result.out.find("sub/O0001.nc") != std::string::npos);
    CHECK(result.out.find("./sub") == std::string::npos);
  }
}

TEST_CASE("a flag that a command does not read is refused") {
  const ProcessFolder folder;
  const std::string root = "'" + dotek::tests::root().string() + "/examples/";
  folder.run("cp -r " + root + "surface-x' sx; ln -s self.nc self.nc");
  folder.write("p.nc", "%\nO1\nG90 G0 X1.\nM30\n%\n");
  for (const char* flag : {"--control self.nc", "--prog self.nc", "--job self.nc", "--set X=p.nc",
                           "--clearance nan", "--form p.nc", "--host a=1", "--assume probe-on", "--cycle x",
                           "--routine x", "--recover", "--field a=b"})
    for (const char* stage : {"", "--stage tokens "}) {
      const ShellResult result = folder.run(fmt::format("dotek dump sx {}{}", stage, flag));
      CHECK_MESSAGE(result.status == 2, flag);
      CHECK_MESSAGE(result.err.find("changes nothing of --stage") != std::string::npos, result.err);
    }
  CHECK(folder.run("dotek dump sx --stage path --prog p.nc").status == 2);
  CHECK(folder.run("dotek dump sx --stage path --set X=2").err.find("changes nothing") == std::string::npos);
  const ShellResult macros = folder.run("dotek sim p.nc --probe-macros p.nc");
  CHECK(macros.status == 2);
  CHECK(macros.err.find("[unknown-macro-set]") != std::string::npos);
}

TEST_CASE("a flag is not taken as the value of another") {
  const DataFolder folder;
  folder.write("run.nc", "G21 G90 G54\nG0 X5.\nM30\n");
  for (const char* flag : {"-q", "--json", "--qiet"}) {
    const CommandResult run = runDotek({"sim", "run.nc", "--html", flag}, folder.path());
    CHECK(run.status == 2);
    CHECK(run.err.find("--html needs a value, and `" + std::string(flag) + "` after it is a flag") !=
          std::string::npos);
    CHECK_FALSE(fs::exists(fs::path(folder.path()) / flag));
  }
}

TEST_CASE("`-` is standard output for a folder of results, too") {
  const ProcessFolder folder;
  folder.write("p.nc", "%\nO1\nG90 G0 X1.\nM30\n%\n");
  folder.write("spare.cycle", "cycle spare \"Spare\"\nspindle off\n");
  const std::string before = folder.names();
  const ShellResult both =
      folder.run("dotek doc spare.cycle > a; dotek doc -o - spare.cycle > b; cmp a b && test -s a "
                 "&& dotek convert p.nc --to fanuc > a; dotek convert p.nc --to fanuc -d - > b; "
                 "cmp a b && test -s a; s=$?; rm a b; exit $s");
  CHECK_MESSAGE(both.status == 0, both.out << both.err);
  CHECK(folder.names() == before);
}
