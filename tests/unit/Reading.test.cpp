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
  CHECK(run.err == "6 files checked, 2 skipped (README.md: no language that Dotek reads; sub/web.MPF: "
                   "Sinumerik (Siemens))\n");
}

TEST_CASE("reading: bytes 0 around what is no program are reported") {
  const DataFolder folder;
  folder.write("a.mac", "x = 1\n" + std::string(1, '\0'));
  folder.write("b.mac", std::string(3, '\0') + "x = 1\n");
  CHECK(dotekIn(folder, {"lint", "a.mac"}).status == 1);
  CHECK(dotekIn(folder, {"lint", "b.mac"}).status == 1);
}

TEST_CASE("reading: what a tape or a serial line leaves around a program is passed over") {
  const std::string body = "O7312\nG31Z-10.F100\n#101=#5063\nM99\n", plain = "O7313\nG0Z50.\nM30\n";
  const std::string holes(60, '\0'), end = "%\n";
  std::string windows;
  for (const char c : end + body + end)
    windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const std::string& text :
       {end + body + end + "\x1A", end + body + "%\x1A", body + "\x1A", holes + end + body + end + holes,
        holes + windows + holes + "\x1A", end + body + end + std::string(200, '\x1A'),
        end + body + "%" + holes, end + plain + "%" + holes, plain + "\x1A", holes + plain + holes,
        end + body + end + std::string(1, '\0')}) {
    const DataFolder folder;
    folder.write("m/O7312", text);
    CAPTURE(text);
    const CommandResult lint = dotekIn(folder, {"lint", "--select",
                                                "syntax-error,unexpected-character,nul-byte,"
                                                "text-after-end,utf16-input,nothing-read",
                                                "m"});
    CHECK(lint.err == "1 file checked\n");
    CHECK(lint.out == "");
    CHECK(dotekIn(folder, {"lint", "--fail-on", "error", "m/O7312"}).status == 0);
    const CommandResult converted =
        dotekIn(folder, {"convert", "m/O7312", "--to", "fanuc", "--control", "fanuc-31i-b"});
    CHECK_MESSAGE(converted.status == 0, converted.err);
    CHECK(converted.out.find('\0') == std::string::npos);
    CHECK(converted.out.find('\x1A') == std::string::npos);
    folder.write("machine.toml",
                 "schema = 1\n[probe]\nball_diameter = 6\nlength = 80\nlength_to = \"tip\"\non = "
                 "true\n");
    const CommandResult run = dotekIn(
        folder, {"sim", "m/O7312", "--machine", "machine.toml", "--json", "--limit", "sim-steps=1000"});
    CHECK_FALSE(holds(run.out, "not-read"));
    CHECK_FALSE(holds(run.out, "not-run"));
  }
  // Text after the end is one; what lies there besides is not read.
  const DataFolder folder;
  folder.write("late.nc", end + body + "%" + holes + "junk\n");
  CHECK_FALSE(holds(dotekIn(folder, {"lint", "late.nc"}).out, "nul-byte"));
  CHECK_FALSE(holds(dotekIn(folder, {"lint", "late.nc"}).out, "unknown-kind"));
  // Within a program it is a damaged copy; and UTF-16 stays UTF-16.
  folder.write("damaged.nc", holes + end + "O7312\nG0X" + std::string(1, '\0') + "5.\nM99\n" + end + holes);
  CHECK(holds(dotekIn(folder, {"lint", "damaged.nc"}).out, "damaged.nc:3:4: error: the file holds a byte 0"));
  for (const bool low : {false, true}) {
    std::string wide;
    for (const char c : end + body + end) {
      if (low) wide += '\0';
      wide += c;
      if (!low) wide += '\0';
    }
    folder.write("wide.nc", wide);
    CHECK(holds(dotekIn(folder, {"lint", "wide.nc"}).out, "UTF-16"));
  }
}

TEST_CASE("reading: --list-skipped names each file that is skipped") {
  const DataFolder folder;
  folder.write("m/good.nc", kGood);
  for (const char* name : {"a.md", "b.md", "c.md", "d.md", "e.md"})
    folder.write(std::string("m/") + name, "# Macros\n\nLoad them.\n");
  CHECK(dotekIn(folder, {"lint", "m"}).err ==
        "1 file checked, 5 skipped (a.md, b.md, c.md and 2 more: no language that Dotek reads; "
        "`--list-skipped` names each)\n");
  const CommandResult all = dotekIn(folder, {"lint", "m", "--list-skipped"});
  CHECK(holds(all.err, "1 file checked, 5 skipped:\n  a.md: no language that Dotek reads\n"));
  CHECK(holds(all.err, "\n  e.md: no language that Dotek reads\n"));
}

TEST_CASE(
    "reading: a pattern of [[lint.path]] that takes no file is reported where the whole folder is linted") {
  const DataFolder folder;
  folder.write("shop/mill/good.nc", kGood);
  folder.write("shop/lathe/good.nc", kGood);
  folder.write("shop/dotek.toml",
               "schema = 1\n[[lint.path]]\npath = [\"mill/**\", \"lahte/**\"]\n"
               "ignore = [\"indentation\"]\n[[lint.path]]\npath = \"old\"\nexclude = true\n");
  const CommandResult run = dotekIn(folder, {"lint", "shop"});
  CHECK(run.status == 1);
  CHECK(holds(run.out, "dotek.toml:3:20: warning: `lahte/**` takes none"));
  CHECK(holds(run.out, "dotek.toml:6:8: warning: `old` takes none"));
  CHECK_FALSE(holds(run.out, "`mill/**`"));
  CHECK(holds(dotekIn(folder, {"lint", "."}).out, "path-unused"));
  // Of a part of the folder: what is known of it, and that there is no folder of the name.
  const CommandResult part = dotekIn(folder, {"lint", "shop/mill"});
  CHECK(holds(part.out, "`lahte/**` takes none"));
  CHECK_FALSE(holds(part.out, "`old`"));
  folder.write("shop/lahte/sub/a.md", "Text.\n");
  CHECK(dotekIn(folder, {"lint", "shop/mill"}).status == 0);
  CHECK(dotekIn(folder, {"lint", "shop/mill/good.nc"}).status == 0);
  folder.write("shop/dotek.toml", "schema = 1\n[[lint.path]]\npath = \"lathe/old*/**\"\nexclude = true\n");
  CHECK(holds(dotekIn(folder, {"lint", "shop/lathe"}).out, "`lathe/old*/**` takes none"));
  CHECK(dotekIn(folder, {"lint", "shop/mill"}).status == 0);
  folder.write("shop/dotek.toml", "schema = 1\n[[lint.path]]\npath = \"/shop/mill/**\"\nexclude = true\n");
  CHECK(holds(dotekIn(folder, {"lint", "shop/mill"}).out, "`/shop/mill/**` takes no file"));
  // A key that no section has: all that are known.
  folder.write("shop/dotek.toml", "schema = 1\n[[lint.path]]\npath = \"mill/**\"\nlevel = 1\n");
  CHECK(holds(dotekIn(folder, {"lint", "shop"}).out,
              "unknown key `level`; known here: `control`, `exclude`, `form`, `ignore`, `path`, `select`"));
}

TEST_CASE("reading: what a whole file has for one cause is told once") {
  const DataFolder folder;
  folder.write("small.nc", "O9111\ng65 p9103 x10.\ng0 x1. y2.\nM99\n");
  const CommandResult run = dotekIn(folder, {"lint", "--select", "small-letter", "small.nc"});
  CHECK(holds(run.out, "small.nc:2:1: warning: `g` is in small letters"));
  CHECK(holds(run.out, "and 5 more in this file: `p` (line 2), `x` (line 2), `g` (line 3), `x` (line 3), `y` "
                       "(line 3); `dotek fmt --write` writes all of them in capitals"));
  CHECK(run.out.find("[small-letter]") == run.out.rfind("[small-letter]"));
  // The letter of the number is one of them.
  folder.write("header.nc", "o9113\ng0 x1.\nm99\n");
  const CommandResult header = dotekIn(folder, {"lint", "header.nc"});
  CHECK(holds(header.out, "header.nc:1:1: warning: `o` is in small letters"));
  CHECK_FALSE(holds(header.out, "error:"));
  CHECK(holds(dotekIn(folder, {"convert", "header.nc", "--to", "fanuc"}).out, "O9113"));
  // Files are not each other's.
  folder.write("other.nc", "O9112\ng0 X1.\nM99\n");
  const CommandResult two = dotekIn(folder, {"lint", "--select", "small-letter", "small.nc", "other.nc"});
  CHECK(holds(two.out, "other.nc:2:1: warning: `g` is in small letters"));
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

TEST_CASE("reading: an NC file without a program is no clean one") {
  const DataFolder folder;
  folder.write("m/cut.nc", "%\n%\n");
  const CommandResult run = dotekIn(folder, {"lint", "m"});
  CHECK(run.status == 1);
  CHECK(holds(run.out, "m/cut.nc:1:1: error: `m/cut.nc` holds no program"));
}

TEST_CASE("reading: a translation without a program is refused, whatever the source") {
  const DataFolder folder;
  folder.write("side.nc", "%\nO1\nG90 G54\n#500=1.\nM30\n%\n");
  folder.write("one.cycle", "cycle one \"One\"\n\nresult r : length\n\nr = 1 mm\n");
  for (const std::string text : {"", "%\n", "%\n%\n"}) {
    CAPTURE(text);
    folder.write("t.nc", text);
    for (const std::string source : {"side.nc", "one.cycle"}) {
      const CommandResult run =
          dotekIn(folder, {"verify", source, "--to", "fanuc", "--translation", "t.nc", "--cases", "2"});
      CHECK(run.status == 1);
      CHECK_MESSAGE(holds(run.err, "t.nc` cannot be read back: `t.nc` holds no program"), run.err);
    }
  }
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
      CHECK_MESSAGE(holds(all, "`" + file + "` is no file of a kind that Dotek reads"), command[0] << all);
      CHECK_MESSAGE(holds(all, "NC programs (nc, listing)"), command[0]);
      CHECK_MESSAGE(all.find("error:") == all.rfind("error:"), command[0] << all);
    }
  }
  const CommandResult run = dotekIn(folder, {"sim", "a.mac"});
  CHECK(run.status == 2);
  CHECK(run.err ==
        "a.mac:1:1: error: `a.mac` is a GibbsCAM macro, and an NC program is expected here; if it is "
        "one after all, `--from nc` "
        "says so [wrong-kind]\n");
}

TEST_CASE("reading: a post where a program is expected is named with the commands that take it") {
  const DataFolder folder;
  for (const char* name : {"tool.cps", "tool.js"}) {
    folder.write(name, "var xyzFormat = createFormat({decimals: 3});\nfunction onSection() {\n"
                       "  writeBlock(gFormat.format(0));\n}\nfunction onClose() {\n  writeln(\"%\");\n}\n");
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"sim", name}, {"verify", name}, {"convert", name, "--to", "fanuc"}}) {
      const CommandResult run = dotekIn(folder, command);
      CHECK(run.status == 2);
      CHECK_MESSAGE(holds(run.err, std::string("`") + name + "` is a post of Fusion"), run.err);
      CHECK_MESSAGE(holds(run.err, std::string("`dotek lint ") + name + "`"), run.err);
      CHECK_MESSAGE(holds(run.err, "[post-not-taken]"), run.err);
      CHECK_MESSAGE(!holds(run.err, "none of the files"), run.err);
    }
  }
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
    const CommandResult run = dotekIn(folder, {"lint", "-", "--limit", "kept-bytes=1000"});
    CHECK(run.status == 2);
    CHECK(holds(run.out, "`<stdin>` may take more than 1000 bytes of memory"));
  }
}

TEST_CASE("reading: a walk of more files than the limit says so and reports nothing of them") {
  const DataFolder folder;
  for (const char* name : {"m/a.nc", "m/b.nc", "m/sub/c.nc", "m/sub/readme.md", "m/z/d.nc"})
    folder.write(name, kBad);
  const CommandResult run = dotekIn(folder, {"lint", "m", "--limit", "files=4"});
  CHECK(run.status == 2);
  CHECK(holds(run.out, "more than 4 files"));
  CHECK_FALSE(holds(run.out, "a.nc"));
  CHECK(dotekIn(folder, {"lint", "m", "--limit", "files=5"}).status == 1);
}

TEST_CASE("reading: a walk says what is too deep for it") {
  const DataFolder folder;
  std::string path = "m/";
  for (int i = 0; i < 199; ++i)
    path += "d/";
  folder.write(path + "a.nc", kGood);
  folder.write(path + "d/b.nc", kGood);
  folder.write(path + "d/e/c.nc", kBad);
  const CommandResult run = dotekIn(folder, {"lint", "m"});
  CHECK(run.status == 0);
  CHECK(holds(run.err, "2 files checked, 1 skipped (d/"));
  CHECK(holds(run.err, "d/e: more than 200 folders deep)\n"));
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
