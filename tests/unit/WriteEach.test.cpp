// What holds of a file that is written holds of each command that writes one: mode, links, pipes, protection,
// inputs, a full disk.
#include "tests/GoldenRunner.h"
#include "tests/Process.h"

#include <doctest/doctest.h>
#include <string>
#include <vector>

using namespace dotek::tests;

namespace {

struct Writer {
  std::string command; // writes OUT
  std::string input;   // a file that it reads
};

const std::vector<Writer>& writers() {
  static const std::vector<Writer> kWriters = {
      {"run-post post.cps job.toml -o OUT", "post.cps"},
      {"run-post post.cps job.toml -o OUT", "job.toml"},
      {"run-post post.cps job.toml -o o.nc --map OUT", "post.cps"},
      {"run-post post.cps --matrix drilling -o OUT", "post.cps"},
      {"new job --from post.cps -o OUT", "post.cps"},
      {"renumber p.nc -o OUT", "p.nc"},
      {"fmt p.nc -o OUT", "p.nc"},
      {"fmt bore.cycle -o OUT", "bore.cycle"},
      {"lint p.nc --write-baseline OUT", "p.nc"},
      {"preview surface-x -o OUT", "surface-x/ToolPath.mac"},
      {"convert surface-x --prog post.txt --form thesis-a --to cycle -o OUT", "post.txt"},
      {"convert surface-x --prog post.txt --form thesis-a --to fanuc -o OUT", "surface-x/CycleData.mac"},
      {"verify surface-x --prog post.txt --form thesis-a --to fanuc --assume probe-on --cases 10 -o OUT",
       "post.txt"}};
  return kWriters;
}

void fill(const ProcessFolder& folder) {
  const std::string at = root().string();
  const ShellResult made = folder.run("cp -r '" + at + "/examples/surface-x' '" + at +
                                      "/examples/post.txt' '" + at + "/examples/cycles/bore.cycle' .; cp '" +
                                      at + "/tests/golden/run-post/matrix/mill.cps' post.cps; cp '" + at +
                                      "/tests/golden/run-post/job/job.toml' .");
  REQUIRE_MESSAGE(made.status == 0, made.err);
  folder.write("p.nc", "%\nO1\nN1 G0 X1.\nN7 GOTO 1\nM30\n%\n");
}

std::string with(std::string command, const std::string& out) {
  return "dotek " + command.replace(command.rfind("OUT"), 3, out);
}

} // namespace

TEST_CASE("each command that writes a file keeps its mode, follows its link and fills a pipe") {
  const ProcessFolder folder;
  fill(folder);
  for (const Writer& each : writers()) {
    CAPTURE(each.command);
    const ShellResult plain = folder.run("rm -f OUT; " + with(each.command, "OUT"));
    REQUIRE_MESSAGE(plain.status < 2, plain.err);
    const std::string result = folder.read("OUT");
    REQUIRE_FALSE(result.empty());
    CHECK(folder.run("chmod 640 OUT; echo old > OUT; " + with(each.command, "OUT") + "; stat -c %a OUT")
              .out.ends_with("640\n"));
    CHECK(folder.read("OUT") == result);
    folder.run("rm OUT; echo old > real; ln -s real OUT; " + with(each.command, "OUT"));
    CHECK(folder.run("[ -L OUT ]").status == 0);
    CHECK(folder.read("real") == result);
    folder.run("rm -f OUT real; mkfifo pipe; cat pipe > got & " + with(each.command, "pipe") +
               "; wait; rm pipe");
    CHECK(folder.read("got") == result);
    const ShellResult full =
        folder.run("ln -s /dev/full OUT; " + with(each.command, "OUT") + "; s=$?; rm OUT; exit $s");
    CHECK(full.status == 2);
    CHECK(full.err.find("No space left") != std::string::npos);
  }
}

TEST_CASE("each command that writes a file refuses what it reads, and what is write-protected") {
  const ProcessFolder folder;
  fill(folder);
  for (const Writer& each : writers()) {
    CAPTURE(each.command);
    const std::string before = folder.read(each.input);
    for (const std::string& name : {each.input, "./" + each.input}) {
      const ShellResult refused = folder.run(with(each.command, name));
      CHECK(refused.status == 2);
      CHECK_MESSAGE(refused.err.find("output-is-input") != std::string::npos, refused.err);
      CHECK(folder.read(each.input) == before);
    }
    const ShellResult kept = folder.run("echo old > OUT; chmod a-w OUT; " + with(each.command, "OUT") +
                                        "; s=$?; chmod u+w OUT; exit $s");
    CHECK(kept.status == 2);
    CHECK(folder.read("OUT") == "old\n");
    folder.run("rm -f OUT o.nc");
  }
  const ShellResult both = folder.run("dotek run-post post.cps job.toml -o F --map F");
  CHECK(both.status == 2);
  CHECK(both.err.find("output-given-twice") != std::string::npos);
}
