// Files that commands write: what is kept of the file before, what is refused, what is left after a signal.
#include "support/Temporary.h"
#include "tests/Process.h"
#include "tests/Skips.h"
#include "tests/TestFolder.h"

#include <csignal>
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace dotek::tests;

namespace {

constexpr const char* kProgram = "%\nO1\nG90 G0 X1.\nM30\n%\n";

// A program that `lint --fix` mends.
constexpr const char* kMendable =
    "progStart:\n SeqC SpinOff EOL\n IF Flag? ('a')\n  SeqC' M5''' EOL\n END\nRETURN\n";

} // namespace

TEST_CASE("a file that is written anew keeps its mode") {
  const ProcessFolder folder;
  folder.write("p.nc", kProgram);
  const ShellResult kept =
      folder.run("umask 022; for m in 600 640 755 2664 666; do echo old > o; chmod $m o; "
                 "dotek sim p.nc --trace o; stat -c %a o; rm o; done");
  CHECK(kept.out == "600\n640\n755\n2664\n666\n");
  const ShellResult made = folder.run("umask 027; dotek sim p.nc --trace new; stat -c %a new");
  CHECK(made.out == "640\n");
}

TEST_CASE("a file that is written anew keeps owner and group, or it is said") {
  if (!isRoot()) {
    skip("only root can give a file to another owner");
    return;
  }
  const ProcessFolder folder;
  folder.write("p.nc", kProgram);
  const ShellResult kept = folder.run(
      "echo old > o; chown 1234:4321 o; chmod 664 o; dotek sim p.nc --trace o; stat -c '%u %g %a' o; cat o");
  CHECK(kept.out.starts_with("1234 4321 664\n"));
  CHECK(kept.out.find("X1.") != std::string::npos);
  CHECK(kept.err.empty());
  if (folder.run("setpriv --version && setpriv --reuid 1234 true").status != 0) {
    skip("there is no setpriv");
    return;
  }
  const ShellResult lost =
      folder.run("chmod 777 .; echo old > o; chown 1:1 o; chmod 4666 o; cp \"$DOTEK\" d; chmod 755 d; "
                 "setpriv --reuid 1234 --regid 4321 --clear-groups ./d sim p.nc --trace o; echo $?; stat -c "
                 "'%u %g %a' o");
  CHECK(lost.out == "0\n1234 4321 666\n");
  CHECK(lost.err.find("note: `o` has another owner now") != std::string::npos);
  CHECK(lost.err.find("[output-owner]") != std::string::npos);
  // Who may not replace it in a folder of others is told so, and not that its owner has changed.
  const ShellResult sticky = folder.run(
      "chmod 1777 .; rm -f o; echo old > o; chmod 666 o; setpriv --reuid 1234 --regid 4321 --clear-groups "
      "./d sim p.nc --trace o; echo $?; stat -c '%u %a' o; cat o");
  CHECK(sticky.out == "2\n0 666\nold\n");
  CHECK(sticky.err.find("[output-owner]") == std::string::npos);
}

TEST_CASE("a link is followed, also one that leads to nothing yet") {
  const ProcessFolder folder;
  folder.write("p.nc", kProgram);
  const ShellResult result =
      folder.run("mkdir a b; echo old > a/real; chmod 600 a/real; ln -s ../a/real b/link; "
                 "ln -s b/link far; ln -s a/later next\n"
                 "dotek sim p.nc --trace far && dotek sim p.nc --trace next; echo $?\n"
                 "readlink far b/link next; stat -c %a a/real; cmp a/real a/later; ls -A a b");
  CHECK(result.out == "0\nb/link\n../a/real\na/later\n600\na:\nlater\nreal\n\nb:\nlink\n");
  CHECK(result.err.empty());
}

TEST_CASE("a pipe and a device are written directly") {
  const ProcessFolder folder;
  folder.write("p.nc", kProgram);
  const ShellResult result =
      folder.run("dotek sim p.nc --trace plain; mkfifo pipe; cat pipe > got & "
                 "dotek sim p.nc --trace pipe; echo $?; wait; cmp got plain; "
                 "test -p pipe && echo pipe; dotek sim p.nc --trace /dev/null; echo $?\n"
                 "dotek sim p.nc --trace - > dash; cmp dash plain\n"
                 "echo before > both; dotek sim p.nc --trace /dev/stdout >> both; head -1 both");
  CHECK(result.out == "0\npipe\n0\nbefore\n");
  CHECK(result.err.empty());
  CHECK(folder.read("both") == "before\n" + folder.read("plain"));
  if (std::filesystem::exists("/dev/full")) {
    const ShellResult full = folder.run("dotek sim p.nc --trace /dev/full");
    CHECK(full.status == 2);
    CHECK(full.err.find("`/dev/full` cannot be written: No space left") != std::string::npos);
  }
}

TEST_CASE("a write-protected file is written with --force only") {
  const ProcessFolder folder;
  folder.write("p.nc", kProgram);
  folder.write("old", "old\n");
  folder.write("post.txt", kMendable);
  for (const std::string command :
       {"sim p.nc --trace old", "sim p.nc --html old", "convert p.nc --to fanuc --control fanuc-0i-md -o old",
        "convert p.nc --to fanuc --control fanuc-0i-md --map old"}) {
    const ShellResult refused = folder.run("chmod 444 old; dotek " + command);
    CHECK_MESSAGE(refused.status == 2, command);
    CHECK_MESSAGE(refused.out.empty(), command);
    CHECK_MESSAGE(refused.err.find("`old` is write-protected; `--force` replaces it [output-protected]") !=
                      std::string::npos,
                  command << "\n"
                          << refused.err);
    CHECK(folder.read("old") == "old\n");
    const ShellResult forced = folder.run("cp -p old keep; dotek " + command +
                                          " --force && stat -c %a old; "
                                          "cmp -s old keep; echo $?; mv -f keep old");
    CHECK_MESSAGE(forced.out.ends_with("444\n1\n"), command << "\n" << forced.out << forced.err);
  }
  const ShellResult mended = folder.run("chmod 444 post.txt; cp -p post.txt before; dotek lint --select all "
                                        "--fix post.txt > /dev/null; echo $?; "
                                        "cmp post.txt before && dotek lint --select all --fix --force "
                                        "post.txt > /dev/null; cmp -s post.txt before; "
                                        "echo $?; stat -c %a post.txt");
  CHECK(mended.out == "2\n1\n444\n");
}

TEST_CASE("a planted link is not followed, and a name of full length has room") {
  const ProcessFolder folder;
  folder.write("p.nc", kProgram);
  folder.write("victim", "mine\n");
  // The names that a program could guess: of the process and of its target.
  const ShellResult planted = folder.run(
      "for i in $(seq $$ $(($$ + 300))); do ln -s victim t.dotek-$i; done; dotek sim p.nc --trace t; echo "
      "$?; cat victim; rm -f t.dotek-*; n=$(printf 'n%.0s' $(seq 255)); dotek sim p.nc --trace $n; echo $?; "
      "rm $n; dotek sim p.nc --trace ${n}n; echo $?");
  CHECK(planted.out == "0\nmine\n0\n2\n");
  CHECK(planted.err.find("File name too long") != std::string::npos);
  CHECK(folder.names() == "p.nc t victim ");
}

TEST_CASE("a signal ends the program and leaves nothing") {
  const ProcessFolder folder;
  const std::string text = "%\nO1\n#1=0\nWHILE[#1 LT 5]DO1\nG1 X1. F100.\nX2.\nEND1\nM30\n%\n";
  folder.write("p.nc", text);
  folder.write("t", "old\n");
  for (const auto& [name, number] : {std::pair("INT", 130), std::pair("TERM", 143), std::pair("HUP", 129)}) {
    const std::string signal = name;
    // A background job of a script ignores INT, so it is given its default by a shell with job control.
    const ShellResult ended =
        folder.run("set -m; \"$DOTEK\" sim p.nc --limit sim-steps=60000000 --trace t & "
                   "for i in $(seq 500); do ls -A | grep -q '^.dotek-' && break; sleep 0.02; done; "
                   "ls -A | grep -c '^.dotek-'; kill -" +
                   signal + " -- -$!; wait $!; echo $?");
    CHECK_MESSAGE(ended.out == "1\n" + std::to_string(number) + "\n", signal << ended.out << ended.err);
    CHECK_MESSAGE(folder.names() == "p.nc t ", signal);
    CHECK_MESSAGE(folder.read("t").size() == 4, signal); // "old"
  }
  const ShellResult ignored = folder.run("trap '' HUP; set -m; \"$DOTEK\" sim p.nc --limit sim-steps=3000000 "
                                         "--quiet & kill -HUP -- -$!; wait $!; echo $?");
  CHECK(ignored.out != "129\n");
}

TEST_CASE("a signal while files take their places waits for the last of them") {
  const TestFolder folder("dotek-signals");
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    dotek::removeTemporariesOnSignals();
    for (const int signal : {SIGTERM, SIGHUP}) {
      const dotek::SignalHold together;
      raise(signal);
      folder.write(std::to_string(signal), "written");
    }
    _exit(1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGTERM);
  CHECK(std::filesystem::exists(folder.path() / std::to_string(SIGTERM)));
  CHECK_FALSE(std::filesystem::exists(folder.path() / std::to_string(SIGHUP)));
}

TEST_CASE("a folder for results that could not be written is gone") {
  const ProcessFolder folder;
  folder.write("cycles/spare.cycle", "cycle spare \"" + std::string(2000, 'x') + "\"\nspindle off\n");
  // No file may be larger than 1 KB.
  const ShellResult full = folder.run("ulimit -f 1; dotek doc cycles -o new/site; echo $?");
  CHECK(full.out == "2\n");
  CHECK(folder.names() == "cycles ");
  CHECK(folder.run("dotek doc cycles -o new/site").status == 0);
}

TEST_CASE("what cannot be written is said before anything is done") {
  const ProcessFolder folder;
  folder.write("p.nc", kProgram);
  const ShellResult loop = folder.run("ln -s loop loop; dotek sim p.nc --trace loop");
  CHECK(loop.status == 2);
  CHECK(loop.err.find("`loop` cannot be written: Too many levels of symbolic links") != std::string::npos);
  for (const std::string bad : {"none/t", "p.nc/t", ".", "none/"}) {
    const ShellResult result = folder.run("dotek sim p.nc --quiet --html " + bad);
    CHECK_MESSAGE(result.status == 2, bad);
    CHECK_MESSAGE(result.err.find("`" + bad + "` cannot be written: ") != std::string::npos,
                  bad << result.err);
  }
  CHECK(folder.run("dotek sim p.nc --trace ''").status == 2);
  CHECK(folder.names() == "loop p.nc ");
  if (isRoot()) {
    skip("permissions of a folder do not bind root");
    return;
  }
  const ShellResult folderOf = folder.run("mkdir ro; chmod 555 ro; dotek sim p.nc --trace ro/t");
  CHECK(folderOf.status == 2);
  CHECK(folderOf.err.find("`ro/t` cannot be written: Permission denied") != std::string::npos);
}

TEST_CASE("several results are written all or none") {
  const ProcessFolder folder;
  folder.write("p.nc", kProgram);
  folder.write("old", "old\n");
  const ShellResult first = folder.run("dotek sim p.nc --trace old --html none/page --svg picture");
  CHECK(first.status == 2);
  CHECK(folder.read("old") == "old\n");
  CHECK(folder.names() == "old p.nc ");
  if (!std::filesystem::exists("/dev/full")) return;
  // The program goes to standard output, so its map is not written where that fails.
  const ShellResult full =
      folder.run("dotek convert p.nc --to fanuc --control fanuc-0i-md --map old > /dev/full");
  CHECK(full.status == 2);
  CHECK(folder.read("old") == "old\n");
  CHECK(folder.run("dotek sim p.nc --trace old --svg /dev/full").status == 2);
  CHECK(folder.read("old") == "old\n");
  CHECK(folder.names() == "old p.nc ");
}
