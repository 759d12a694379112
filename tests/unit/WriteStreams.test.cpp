// What the process does where its standard streams cannot be written: nothing is a silent success.
#include "tests/Process.h"

#include <doctest/doctest.h>

using namespace dotek::tests;

namespace {

// A program whose trace is longer than any pipe.
std::string longProgram() {
  std::string text = "%\nO1000\nG90 G54 G0 X0 Y0\n";
  for (int i = 0; i < 20'000; ++i)
    text += "G1 X" + std::to_string(i) + ". F100.\n";
  return text + "M30\n%\n";
}

bool isThere(const char* device) {
  return std::filesystem::exists(device);
}

} // namespace

TEST_CASE("a standard output that cannot be written is an error of every command") {
  const ProcessFolder folder;
  folder.write("p.nc", "%\nO1\nG90 G0 X1.\nM30\n%\n");
  for (const std::string command :
       {"--version", "--help", "list limits", "list rules", "explain file-not-found", "sim p.nc",
        "sim p.nc --json", "lint p.nc --format sarif", "lint p.nc --format json", "dump p.nc --stage tokens",
        "convert p.nc --to fanuc --control fanuc-0i-md"}) {
    if (isThere("/dev/full")) {
      const ShellResult full = folder.run("dotek " + command + " > /dev/full");
      CHECK_MESSAGE(full.status == 2, command << "\n" << full.err);
      CHECK_MESSAGE(full.err.find("standard output cannot be written: No space left") != std::string::npos,
                    command << "\n"
                            << full.err);
    }
    const ShellResult closed = folder.run("dotek " + command + " >&-");
    CHECK_MESSAGE(closed.status == 2, command << "\n" << closed.err);
    CHECK_MESSAGE(closed.err.find("[standard-output-failed]") != std::string::npos, command << "\n"
                                                                                            << closed.err);
    CHECK(folder.run("dotek " + command).status == 0);
  }
}

TEST_CASE("nothing to print is no failure of a closed standard output") {
  const ProcessFolder folder;
  folder.write("p.nc", "%\nO1\nG90 G0 X1.\nM30\n%\n");
  CHECK(folder.run("dotek sim p.nc --quiet >&-").status == 0);
  CHECK(folder.run("dotek sim p.nc --trace t >&-").status == 0);
  CHECK(folder.read("t").find("X1.") != std::string::npos);
  CHECK(folder.run("dotek sim p.nc --trace u <&- >&- 2>&-").status == 0);
  CHECK(folder.read("u") == folder.read("t"));
  CHECK(folder.names() == "p.nc t u ");
}

TEST_CASE("a full disk is said, whatever the size of the result") {
  const ProcessFolder folder;
  folder.write("p.nc", longProgram());
  const ShellResult cut = folder.run("ulimit -f 64; dotek sim p.nc > trace");
  CHECK(cut.status == 2);
  CHECK(cut.err.find("standard output cannot be written: File too large") != std::string::npos);
  const ShellResult file = folder.run("rm trace; ulimit -f 64; dotek sim p.nc --trace trace");
  CHECK(file.status == 2);
  CHECK(file.err.find("`trace` cannot be written: File too large") != std::string::npos);
  CHECK(folder.names() == "p.nc ");
}

TEST_CASE("messages that cannot be printed are no success") {
  if (!isThere("/dev/full")) return;
  const ProcessFolder folder;
  folder.write("p.nc", "%\nO1\nG90 G0 X1.\nM30\n%\n");
  CHECK(folder.run("dotek sim p.nc 2> /dev/full").status == 0); // there is none
  folder.write("q.mac", "a = 1\n");
  CHECK(folder.run("dotek list form 2> /dev/full").status == 2);
}

TEST_CASE("a reader that has enough ends the program quietly") {
  const ProcessFolder folder;
  folder.write("p.nc", longProgram());
  const ShellResult piped = folder.run("dotek sim p.nc | head -1; exit ${PIPESTATUS[0]}");
  CHECK(piped.status == 141); // SIGPIPE
  CHECK(piped.err.empty());
  // Where the signal is ignored the write fails instead: no message, and no success.
  const ShellResult ignored = folder.run("trap '' PIPE; dotek sim p.nc | head -1; exit ${PIPESTATUS[0]}");
  CHECK(ignored.status == 2);
  CHECK(ignored.err.empty());
}
