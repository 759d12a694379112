// How inputs come to a command: folders, links, pipes, standard input.
#include "tests/GoldenRunner.h"
#include "tests/unit/DataFolder.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

const std::string kBad = "%\nO7310\nG65P9810Z-5.\n#141=[#5061\nM99\n%\n"; // a bracket stays open
const std::string kGood = "%\nO7311\nG0Z50.\nM99\n%\n";

CommandResult dotekIn(const DataFolder& folder, std::vector<std::string> arguments) {
  return runDotek(arguments, folder.path());
}

// A FIFO that gets `text` from whoever opens it for reading, once.
class Fifo {
public:
  Fifo(const DataFolder& folder, const std::string& name, const std::string& text)
      : path_(folder.path() + "/" + name) {
    REQUIRE(mkfifo(path_.c_str(), 0600) == 0);
    writer_ = std::thread([this, text] {
      const int to = open(path_.c_str(), O_WRONLY);
      std::size_t at = 0;
      while (at < text.size()) {
        const ssize_t n = write(to, text.data() + at, text.size() - at);
        if (n <= 0) break;
        at += static_cast<std::size_t>(n);
      }
      close(to);
    });
  }
  ~Fifo() { writer_.join(); }
  Fifo(const Fifo&) = delete;
  Fifo& operator=(const Fifo&) = delete;

private:
  std::string path_;
  std::thread writer_;
};

// Standard input of this process is `text` while this lives.
class StandardInput {
public:
  explicit StandardInput(const std::string& text) : kept_(dup(STDIN_FILENO)) {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    REQUIRE(write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    close(ends[1]);
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
  }
  ~StandardInput() {
    dup2(kept_, STDIN_FILENO);
    close(kept_);
  }
  StandardInput(const StandardInput&) = delete;
  StandardInput& operator=(const StandardInput&) = delete;

private:
  int kept_;
};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("reading: a folder is checked whatever the names are, and says what it passed over") {
  const DataFolder folder;
  for (const char* name : {"O7310", "A.EIA", "b.PRG", "sub/c.cnc", "sub/d.tap", "e"})
    folder.write(std::string("m/") + name, kBad);
  folder.write("m/README.md", "# Macros\n\nLoad them.\n");
  folder.write("m/sub/web.MPF", "%_N_WEB_MPF\nR1=5\nG1 X=R1\n");
  const CommandResult run = dotekIn(folder, {"lint", "m"});
  CHECK(run.status == 1);
  for (const char* name : {"m/O7310:4", "m/A.EIA:4", "m/b.PRG:4", "m/sub/c.cnc:4", "m/sub/d.tap:4", "m/e:4"})
    CHECK_MESSAGE(holds(run.out, name), name);
  CHECK(run.err ==
        "6 files checked, 2 skipped (README.md: no language that Dotek reads; sub/web.MPF: Sinumerik "
        "(`%_N_`))\n");
}

TEST_CASE("reading: a folder of which nothing is read is no clean folder") {
  const DataFolder folder;
  folder.write("m/README", "Nothing here yet, as you see.\n");
  fs::create_directories(folder.path() + "/none");
  CommandResult run = dotekIn(folder, {"lint", "m"});
  CHECK(run.status == 2);
  CHECK(holds(run.out, "no file that Dotek reads in `m`; nothing was checked [nothing-read]"));
  CHECK(run.err == "0 files checked, 1 skipped (README: no language that Dotek reads)\n");
  run = dotekIn(folder, {"lint", "none"});
  CHECK(run.status == 2);
  CHECK(run.err == "0 files checked\n");
}

TEST_CASE("reading: UTF-16, empty files and images in a folder") {
  const DataFolder folder;
  folder.write("m/good.nc", kGood);
  folder.write("m/empty.mac", "");
  folder.write("m/nothing.txt", "");
  folder.write("m/probe.bmp", std::string("BM\x36\0\0\0\0\0\0\0\x36\0", 12));
  std::string wide = "\xFF\xFE";
  for (const char c : kGood)
    wide += std::string{c, '\0'};
  folder.write("m/wide.nc", wide);
  const CommandResult run = dotekIn(folder, {"lint", "m"});
  CHECK(run.status == 1);
  CHECK(holds(run.out, "m/empty.mac:1:1: error: `m/empty.mac` is empty"));
  CHECK(holds(run.out, "m/wide.nc:1:1: error: the file is UTF-16"));
  CHECK(run.err == "3 files checked, 2 skipped (nothing.txt: empty; probe.bmp: an image)\n");
}

TEST_CASE("reading: what is no input is one error that names the kinds, in every command") {
  const DataFolder folder;
  folder.write("a.js", "var a = 1;\nfunction f(x) {\n  if (x == 3) { return x; }\n}\n");
  folder.write("out.json", "{\"schema\": 1}\n");
  folder.write("a.mac", "x = 1\nif x > 3 then message \"big\"\n");
  for (const std::string file : {"a.js", "out.json"}) {
    const std::vector<std::vector<std::string>> commands = {{"lint", file},
                                                            {"dump", file},
                                                            {"dump", file, "--stage", "ir"},
                                                            {"sim", file},
                                                            {"convert", file, "--to", "fanuc"},
                                                            {"verify", file, "--to", "fanuc"},
                                                            {"post", file, "--prog", file},
                                                            {"new", "form", "x", "--prog", file}};
    for (const std::vector<std::string>& command : commands) {
      const CommandResult run = dotekIn(folder, command);
      const std::string all = run.out + run.err;
      CHECK_MESSAGE(run.status == 2, command[0]);
      if (command[0] == "post") continue; // the folder is what is missing
      CHECK_MESSAGE(holds(all, "`" + file + "` is none of the files that Dotek reads"), command[0] << all);
      CHECK_MESSAGE(holds(all, "NC programs (nc, listing)"), command[0]);
      CHECK_MESSAGE(all.find("error:") == all.rfind("error:"), command[0] << all);
    }
  }
  const CommandResult run = dotekIn(folder, {"sim", "a.mac"});
  CHECK(run.status == 2);
  CHECK(run.err ==
        "dotek: error: `a.mac` is a GibbsCAM macro, and an NC program is expected here; `--from nc` "
        "reads it as one [wrong-kind]\n");
}

TEST_CASE("reading: FIFOs, standard input and its names give what the file gives") {
  const DataFolder folder;
  folder.write("bad.nc", kBad);
  folder.write("good.nc", kGood);
  const std::string expected = dotekIn(folder, {"lint", "bad.nc"}).out;
  REQUIRE(holds(expected, "bad.nc:4"));
  const auto renamed = [](std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
    return text;
  };
  {
    const Fifo fifo(folder, "pipe1", kBad);
    CHECK(dotekIn(folder, {"lint", "pipe1"}).out == renamed(expected, "bad.nc", "pipe1"));
  }
  for (const std::string name : {"-", "/dev/stdin"}) {
    const StandardInput input(kBad);
    const CommandResult run = dotekIn(folder, {"lint", name});
    CHECK(run.status == 1);
    CHECK(run.out == renamed(expected, "bad.nc", name == "-" ? "<stdin>" : name));
  }
  {
    // Names of one stream are read once.
    const StandardInput input(kBad);
    CHECK(dotekIn(folder, {"lint", "-", "/dev/stdin", "/dev/fd/0"}).out ==
          renamed(expected, "bad.nc", "<stdin>"));
  }
  const std::vector<std::vector<std::string>> commands = {{"dump", "FILE"},
                                                          {"dump", "FILE", "--stage", "ir"},
                                                          {"sim", "FILE"},
                                                          {"convert", "FILE", "--to", "fanuc"},
                                                          {"convert", "FILE", "--to", "fanuc", "--verify"},
                                                          {"verify", "FILE", "--to", "fanuc", "--cases", "5"},
                                                          {"lint", "FILE", "--fix"}};
  for (std::vector<std::string> command : commands) {
    std::vector<std::string> byName = command;
    byName[1] = "good.nc";
    const CommandResult file = dotekIn(folder, byName);
    command[1] = "-";
    const StandardInput input(kGood);
    const CommandResult pipe = dotekIn(folder, command);
    CHECK_MESSAGE(pipe.status == file.status, command[0] << pipe.out << pipe.err);
    CHECK_MESSAGE(renamed(pipe.out, "<stdin>", "good.nc") == file.out, command[0]);
  }
  {
    const StandardInput input(std::string(5000, 'G'));
    const CommandResult run = dotekIn(folder, {"lint", "-", "--limit", "input-bytes=1000"});
    CHECK(run.status == 2);
    CHECK(holds(run.out, "`<stdin>` is larger than 1000 bytes"));
  }
}

TEST_CASE("reading: a walk ends, leaves links out of its folder and what is no regular file") {
  const DataFolder folder;
  folder.write("m/a.nc", kGood);
  folder.write("m/sub/b.nc", kGood);
  folder.write("other/c.nc", kBad);
  fs::create_directory_symlink("..", folder.path() + "/m/sub/up1");
  fs::create_directory_symlink("..", folder.path() + "/m/sub/up2");
  fs::create_directory_symlink("../other", folder.path() + "/m/out");
  fs::create_symlink("nowhere.nc", folder.path() + "/m/broken.nc");
  fs::create_symlink("a.nc", folder.path() + "/m/same.nc");
  REQUIRE(mkfifo((folder.path() + "/m/x.nc").c_str(), 0600) == 0);
  CommandResult run = dotekIn(folder, {"lint", "m"});
  CHECK(run.status == 0);
  CHECK(run.out.empty());
  CHECK(run.err ==
        "2 files checked, 3 skipped (broken.nc: a link to nothing; out: a link that leads out of the "
        "folder; `--follow-links` follows it; x.nc: no regular file)\n");
  run = dotekIn(folder, {"lint", "m", "--follow-links"});
  CHECK(run.status == 1);
  CHECK(holds(run.out, "m/out/c.nc:4"));
  CHECK(holds(run.err, "3 files checked, 2 skipped"));
  // A file is one file under all its names.
  run = dotekIn(folder, {"lint", "m", "m/sub", "m/same.nc", "other/c.nc", "other"});
  CHECK(holds(run.err, "3 files checked"));
  CHECK(run.out.find("c.nc:4") == run.out.rfind("c.nc:4"));
}
