// lint --cache, by the program: what is taken from the folder is what a fresh run would find.
#include "tests/Process.h"

#include <doctest/doctest.h>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace dotek::tests;

namespace {

const std::string kCaller = "O7411\nG0Z5.\nG65P7412A1.\nGOTO40\nN30M99\n";
const std::string kCalled = "O7412\n#100=#1+#2\nM99\n";

// Of the same command with and without the cache.
void checkSame(const ProcessFolder& folder, const std::string& arguments, const std::string& what) {
  const ShellResult kept = folder.run("dotek lint --cache .kept " + arguments);
  const ShellResult fresh = folder.run("dotek lint " + arguments);
  CHECK_MESSAGE(kept.out == fresh.out, what << "\n" << kept.out << "\nfresh:\n" << fresh.out);
  CHECK_MESSAGE(kept.err == fresh.err, what);
  CHECK_MESSAGE(kept.status == fresh.status, what);
}

// Writes another word into each kept result, so that who takes it from there shows it.
const std::string kMark = "for f in .kept/.*.lint; do tail -c +65 $f | sed 's/block N40/block N4X/g' > body; "
                          "(sha256sum body | head -c 64; cat body) > $f; rm body; done";

bool isFromCache(const ProcessFolder& folder, const std::string& arguments) {
  folder.run(kMark);
  return folder.run("dotek lint --cache .kept " + arguments).out.find("block N4X") != std::string::npos;
}

} // namespace

TEST_CASE("cache: the second run of lint takes the findings from the folder, whole") {
  const ProcessFolder folder;
  folder.run("mkdir shop");
  folder.write("shop/O7411.nc", kCaller);
  folder.write("shop/O7412.nc", kCalled);
  folder.write("shop/post.txt", "progStart:\n SeqC SpinOff EOL\n SeqC ' M5' EOL\nRETURN\n");
  folder.write("shop/\xC4.nc", "O7413\n(\xE1 GOTO40)\nGOTO40\nM99\n"); // a comment in Windows-1250
  for (const char* format : {"", " --format json", " --format sarif", " --format html", " --statistics"}) {
    const std::string arguments = std::string("shop") + format;
    checkSame(folder, arguments, "first run" + arguments);
    checkSame(folder, arguments, "second run" + arguments);
  }
  CHECK(isFromCache(folder, "shop"));
  CHECK_FALSE(folder.run("dotek lint shop").out.find("block N4X") != std::string::npos);
  // Other arguments and another folder of the process have results of their own.
  CHECK(folder.run("dotek lint --cache .kept shop --select none-such").status == 2);
  CHECK(folder.run("cd shop; dotek lint --cache ../.kept .").out.find("block N4X") == std::string::npos);
}

TEST_CASE("cache: whatever a run can see and that changes is seen") {
  const ProcessFolder folder;
  folder.run("mkdir -p shop/mill shop/tools data/controls");
  folder.write("shop/mill/O7411.nc", kCaller);
  folder.write("shop/mill/O7412.nc", kCalled);
  folder.write("shop/mill/t.mac", "include \"part.mac\"\ngoto done\n");
  folder.write("shop/mill/part.mac", "done:\n");
  folder.write("data/controls/mine.toml", "schema = 1\nextends = \"fanuc-31i-b\"\n");
  const std::string arguments = "shop/mill --data data";
  checkSame(folder, arguments, "at first");
  CHECK(isFromCache(folder, arguments));
  const std::pair<const char*, const char*> changes[] = {
      {"a letter, with the size and the time kept",
       "cp -p shop/mill/O7411.nc t; sed -i s/GOTO40/GOTO30/ shop/mill/O7411.nc; touch -r t "
       "shop/mill/O7411.nc; rm t"},
      {"what it includes", "printf 'other:\\n' > shop/mill/part.mac"},
      {"a program that is called", "printf 'O7412\\n#100=#1\\nGOTO8\\nM99\\n' > shop/mill/O7412.nc"},
      {"a program that is gone", "rm shop/mill/O7412.nc"},
      {"a program that is there again", "printf 'O7412\\nM99\\n' > shop/mill/O7412.nc"},
      {"a new file of another kind", "printf 'progStart:\\n CALL none\\nRETURN\\n' > shop/mill/post.txt"},
      {"its name", "mv shop/mill/post.txt shop/mill/prog.txt"},
      {"settings of a folder above", "printf '[lint]\\nfail-on = \"never\"\\n' > shop/dotek.toml"},
      {"these settings", "printf '[lint]\\nignore = [\"goto-target-missing\"]\\n' > shop/dotek.toml"},
      {"nearer settings", "printf '[lint]\\ncontrol = \"fanuc-6m\"\\n' > shop/mill/dotek.toml"},
      {"no settings", "rm shop/mill/dotek.toml shop/dotek.toml"},
      {"a data file", "printf 'schema = 1\\nextends = \"haas-ngc\"\\n' > data/controls/mine.toml"},
      {"a wrong data file", "printf 'schema = 1\\nextend = 1\\n' > data/controls/mine.toml"},
      {"the data file mended", "printf 'schema = 1\\nextends = \"haas-ngc\"\\n' > data/controls/mine.toml"},
      {"a link", "ln -s ../tools shop/mill/tools"},
      {"a link to a file",
       "printf 'O1\\nGOTO9\\nM99\\n' > shop/tools/O1.nc; ln -s ../tools/O1.nc shop/mill/O1.nc"},
      {"an empty file", ": > shop/mill/O7412.nc"},
      {"a picture", "printf '\\x89PNG\\r\\n' > shop/mill/a.png"},
      {"a byte that is no text", "printf 'O7412\\n(\\x00)\\nM99\\n' > shop/mill/O7412.nc"},
  };
  for (const auto& [what, change] : changes) {
    folder.run(change);
    checkSame(folder, arguments, what);
    checkSame(folder, arguments, std::string(what) + ", once more");
  }
}

TEST_CASE("cache: a folder that holds inputs, too, is looked at for changes") {
  const ProcessFolder folder;
  folder.run("mkdir -p shop/in; ln -s shop/in .kept");
  folder.write("shop/O7411.nc", kCaller);
  checkSame(folder, "shop", "at first");
  CHECK(isFromCache(folder, "shop"));
  folder.run("rm .kept/.*.lint");
  checkSame(folder, "shop", "anew");
  folder.write("shop/in/O7412.nc", "O7412\nGOTO8\nM99\n");
  checkSame(folder, "shop", "a program beside the results");
  checkSame(folder, "shop", "once more");
}

TEST_CASE("cache: after random edits of random files it gives what a fresh run gives") {
  const ProcessFolder folder;
  folder.run("mkdir shop");
  std::mt19937 random(20); // the same in each run
  const std::vector<std::string> names = {"shop/O1.nc", "shop/O2.nc", "shop/p.txt", "shop/a.mac",
                                          "shop/dotek.toml"};
  const std::vector<std::string> texts = {kCaller,
                                          kCalled,
                                          "O1\nM98P2\nM30\n",
                                          "O2\nG91\nM99\n",
                                          "progStart:\nRETURN\n",
                                          "goto nowhere\n",
                                          "[lint]\nignore = [\"goto-target-missing\"]\n",
                                          ""};
  for (int turn = 0; turn < 24; ++turn) {
    folder.write(names[random() % names.size()], texts[random() % texts.size()]);
    checkSame(folder, "shop", "turn " + std::to_string(turn));
  }
}

TEST_CASE("cache: a torn or foreign file in the folder is no result") {
  const ProcessFolder folder;
  folder.write("O7411.nc", kCaller);
  const std::string arguments = "O7411.nc";
  checkSame(folder, arguments, "at first");
  for (const char* damage : {"for f in .kept/.*.lint; do : > $f; done",
                             "for f in .kept/.*.lint; do head -c 100 $f > x; mv x $f; done",
                             "for f in .kept/.*.lint; do sed -i s/GOTO40/GOTO41/ $f; done",
                             "for f in .kept/.*.lint; do head -c 5000 /dev/urandom > $f; done",
                             "for f in .kept/.*.lint; do printf '\\xa0' > b; (sha256sum b | head -c 64; cat "
                             "b) > $f; rm b; done"}) {
    folder.run(damage);
    checkSame(folder, arguments, damage);
  }
}

TEST_CASE("cache: what cannot be kept is said, and the findings are those of now") {
  const ProcessFolder folder;
  folder.run("mkdir shop");
  folder.write("shop/O7411.nc", kCaller);
  folder.write("O7411.nc", "");
  const ShellResult fresh = folder.run("dotek lint shop");
  const ShellResult noFolder = folder.run("dotek lint shop --cache O7411.nc");
  CHECK(noFolder.status == fresh.status);
  CHECK(noFolder.out.starts_with(fresh.out));
  CHECK(noFolder.out.find("lint-not-kept") != std::string::npos);
  folder.run("dotek lint shop --cache .full; for f in .full/.*.lint; do rm $f; mkdir $f; done");
  CHECK(folder.run("dotek lint shop --cache .full").out.find("Is a directory") != std::string::npos);
  for (const char* refused : {"--fix", "--changed-since HEAD", "--write-baseline b.json", "--follow-links"}) {
    const ShellResult result = folder.run(std::string("dotek lint shop --cache .kept ") + refused);
    CHECK(result.status == 2);
    CHECK(result.err.find("--cache keeps no result of --") != std::string::npos);
  }
  CHECK(folder.run("dotek lint - --cache .kept < shop/O7411.nc").status == 2);
  // A profile that rests on a file which nobody looks at.
  folder.run("mkdir mine far; printf 'schema = 1\\nextends = \"fanuc-31i-b\"\\n' > far/base.toml; "
             "printf 'schema = 1\\nextends = \"../far/base.toml\"\\n' > mine/own.toml");
  const ShellResult far = folder.run("dotek lint shop --cache .kept --control mine/own.toml");
  CHECK(far.out.find("lint-not-kept") != std::string::npos);
}

TEST_CASE("cache: with a baseline, and of no more than 64 command lines") {
  const ProcessFolder folder;
  folder.run("mkdir shop");
  folder.write("shop/O7411.nc", kCaller);
  folder.run("dotek lint shop --write-baseline known.json");
  checkSame(folder, "shop --baseline known.json", "known");
  checkSame(folder, "shop --baseline known.json", "known again");
  folder.write("shop/O7411.nc", "O7411\nM99\n");
  checkSame(folder, "shop --baseline known.json", "gone");
  folder.write("known.json", R"({"schema": 1, "findings": []})");
  checkSame(folder, "shop --baseline known.json", "another baseline");
  folder.run("for i in $(seq 70); do dotek lint shop --cache .kept --limit files=$((500 + i)); done");
  CHECK(folder.run("ls -A .kept | wc -l").out == "64\n");
}
