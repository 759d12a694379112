// What convert leaves on disk: all or nothing. And what a defect of Dotek itself ends in.
#include "driver/Command.h"
#include "support/Output.h"
#include "support/messages/Commands.h"
#include "tests/GoldenRunner.h"

#include <doctest/doctest.h>
#include <fstream>

using namespace dotek;
using namespace dotek::tests;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / "dotek-convert-files";
  Folder() {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  std::size_t files() const {
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(path))
      count += entry.is_regular_file() ? 1 : 0;
    return count;
  }
};

std::string example(const char* name) {
  return (root() / "examples" / name).generic_string();
}

} // namespace

TEST_CASE("convert -d writes a file for each program, and --map beside them") {
  const Folder folder;
  const std::string into = (folder.path / "nc").generic_string();
  const std::string map = (folder.path / "map.json").generic_string();
  const CommandResult result = runDotek({"convert", example("surface-x"), example("surface-y"), "--prog",
                                         example("mill-post.txt"), "--to", "fanuc", "-d", into, "--map", map},
                                        root());
  CHECK_MESSAGE(result.status == 0, result.err);
  CHECK(result.out.empty());
  CHECK(readAll(folder.path / "nc" / "O8000.nc").starts_with("%\nO8000("));
  CHECK(readAll(folder.path / "nc" / "O8001.nc").ends_with("\n%\n"));
  CHECK(readAll(map).find("\"name\": \"O8001.nc\"") != std::string::npos);
  CHECK(folder.files() == 3);
}

TEST_CASE("convert --helpers writes what fragments share beside them") {
  const Folder folder;
  const std::string into = (folder.path / "js").generic_string();
  const std::string helpers = (folder.path / "shared.js").generic_string();
  const std::vector<std::string> command = {"convert",
                                            example("surface-x"),
                                            example("surface-y"),
                                            "--prog",
                                            example("mill-post.txt"),
                                            "--to",
                                            "fusion",
                                            "-d",
                                            into,
                                            "--helpers",
                                            helpers};
  const CommandResult result = runDotek(command, root());
  CHECK_MESSAGE(result.status == 0, result.err);
  CHECK(readAll(helpers).find("function dotekShared_picture(") != std::string::npos);
  CHECK(readAll(folder.path / "js" / "surfaceX.js").find("function surfaceX_picture(") == std::string::npos);
  CHECK(folder.files() == 3);
  std::vector<std::string> whole = command;
  whole.push_back("--whole-post");
  CHECK(runDotek(whole, root()).status == 2);
  std::vector<std::string> fanuc = command;
  fanuc[6] = "fanuc";
  const CommandResult refused = runDotek(fanuc, root());
  CHECK(refused.status == 2);
  CHECK(refused.err.find("--helpers") != std::string::npos);
}

TEST_CASE("convert leaves nothing after it where one program of several is refused") {
  const Folder folder;
  const CommandResult result =
      runDotek({"convert", example("surface-x"), example("surface-y"), "--prog", example("mill-post.txt"),
                "--to", "fanuc", "--set", "X=99999", "-d", (folder.path / "nc").generic_string()},
               root());
  CHECK(result.status == 1);
  CHECK(folder.files() == 0);
}

TEST_CASE("convert -d replaces a program of the same cycle, and no other") {
  const Folder folder;
  const std::string into = (folder.path / "nc").generic_string();
  const fs::path file = folder.path / "nc" / "O8000.nc";
  const auto convert = [&](const char* cycle, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"convert", example(cycle), "--prog", example("mill-post.txt"),
                                          "--to",    "fanuc",        "-d",     into};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runDotek(arguments, root());
  };
  CHECK(convert("surface-x").status == 0);
  const std::string first = readAll(file);
  CHECK(convert("surface-x").status == 0);
  const CommandResult second = convert("surface-y");
  CHECK(second.status == 2);
  CHECK(second.err.find("[output-of-another]") != std::string::npos);
  CHECK(second.err.find("O8000(SURFACE ALONG X)") != std::string::npos);
  CHECK(second.err.find("--program-number") != std::string::npos);
  CHECK(readAll(file) == first);
  CHECK(convert("surface-y", {"--program-number", "8001"}).status == 0);
  CHECK(folder.files() == 2);
  // Nothing is written where one of several is refused.
  fs::remove(folder.path / "nc" / "O8001.nc");
  CHECK(convert("surface-y", {example("surface-x")}).status == 2);
  CHECK(folder.files() == 1);
  // With --keep-going the others are.
  const CommandResult going = convert("surface-y", {example("surface-x"), "--keep-going"});
  CHECK(going.status == 1);
  CHECK(going.err.find("[output-of-another]") != std::string::npos);
  CHECK(readAll(file) == first);
  CHECK(folder.files() == 2);
  fs::remove(folder.path / "nc" / "O8001.nc");
  CHECK(convert("surface-y", {"--force"}).status == 0);
  CHECK(readAll(file) != first);
  // As it comes back from a control or an editor it is the same program.
  std::string text = readAll(file), windows;
  for (const char c : text)
    windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  std::ofstream(file, std::ios::binary) << windows;
  CHECK(convert("surface-y").status == 0);
  // A program that somebody else wrote.
  std::ofstream(file, std::ios::binary) << "%\nO8000(WARM UP)\nM99\n%\n";
  CHECK(convert("surface-y").status == 2);
  CHECK(readAll(file).find("WARM UP") != std::string::npos);
}

TEST_CASE("convert takes --field for the inputs whose post and macro know it") {
  const Folder folder;
  const auto convert = [&](const std::string& field) {
    return runDotek({"convert", example("surface-x"), example("surface-y"), "--prog",
                     example("mill-post.txt"), "--to", "fanuc", "--field", field, "-d",
                     (folder.path / "nc").generic_string()},
                    root());
  };
  const CommandResult one = convert("X=X"); // surface-y prints no X
  CHECK_MESSAGE(one.status == 0, one.err);
  CHECK(folder.files() == 2);
  for (const std::string wrong : {"Q=X", "X=Q"}) {
    const CommandResult none = convert(wrong);
    CHECK(none.status == 2);
    const std::size_t told = none.err.find("`--field` names `" + wrong + "`");
    REQUIRE(told != std::string::npos);
    CHECK(none.err.find("`surface-x, surface-y`", told) != std::string::npos);
    CHECK(none.err.find("error:", none.err.find("error:") + 1) == std::string::npos);
  }
}

TEST_CASE("post takes --field for the folders whose post and macro know it") {
  const auto post = [&](const std::string& field) {
    return runDotek({"post", example("surface-x"), example("surface-y"), "--prog", example("mill-post.txt"),
                     "--field", field, "--host", "clearance=50"},
                    root());
  };
  const CommandResult one = post("X=X");
  CHECK_MESSAGE(one.status == 0, one.err);
  CHECK(post("Q=X").err.find("`--field` names `Q=X`") != std::string::npos);
}

TEST_CASE("convert of several cycles takes --set for those that know it") {
  const Folder folder;
  std::ofstream(folder.path / "one.cycle")
      << "cycle one \"One\"\n\nparameter diameter : length \"Size\"\n\n"
         "spindle off\nprobe on\ntouch x by diameter -> face\nprobe off\n";
  std::ofstream(folder.path / "two.cycle") << "cycle two \"Two\"\n\nspindle off\nprobe on\n"
                                              "touch x by 9 mm -> face\nprobe off\n";
  const auto convert = [&](const std::string& set) {
    return runDotek({"convert", (folder.path / "one.cycle").generic_string(),
                     (folder.path / "two.cycle").generic_string(), "--to", "fanuc", "--set", set, "-d",
                     (folder.path / "nc").generic_string()},
                    root());
  };
  const CommandResult known = convert("diameter=30");
  CHECK_MESSAGE(known.status == 0, known.err);
  const CommandResult unknown = convert("diametre=30");
  CHECK(unknown.status == 2);
  CHECK(unknown.err.find("[no-such-field]") != std::string::npos);
}

TEST_CASE("a file that cannot be renamed leaves no temporary file") {
  const Folder folder;
  fs::create_directories(folder.path / "O2.nc" / "in the way");
  const std::string text = "%\n";
  Diagnostics diagnostics;
  CHECK_FALSE(writeAll(
      {{(folder.path / "O1.nc").generic_string(), &text}, {(folder.path / "O2.nc").generic_string(), &text}},
      "", {}, diagnostics));
  CHECK(diagnostics.hasErrors());
  CHECK_FALSE(fs::exists(folder.path / "O1.nc"));
  for (const auto& entry : fs::directory_iterator(folder.path))
    CHECK(entry.path().filename().string().find(".dotek-") == std::string::npos);
}

TEST_CASE("internal-defect ends with status 3 and writes nothing") {
  const driver::CommonOptions options;
  project::Session session(options);
  session.diagnostics().report<diag::InternalDefect>({}, "a label appears twice");
  const driver::Outcome outcome = driver::outcomeOf(session, "half a program");
  CHECK(outcome.diagnostics.all().front().code == "internal-defect");
  CHECK(outcome.status == 3);
  CHECK(outcome.output.empty());
}

namespace {

const std::string kSound = "%\nO0061\nG90 G54\nG0 X1.5\nM30\n%\n";
const std::string kBroken = "%\nO0062\n#1=[2.+\nM30\n%\n";

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

CommandResult keptGoing(const Folder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "convert");
  for (const char* one : {"--to", "fanuc", "--control", "fanuc-31i-b", "-d", "out", "--keep-going"})
    arguments.emplace_back(one);
  return runDotek(arguments, folder.path);
}

} // namespace

TEST_CASE("convert --keep-going writes what is good and lists what is refused") {
  const Folder folder;
  write(folder.path / "first.nc", kSound);
  write(folder.path / "bad.EIA", kBroken);
  write(folder.path / "last", "%\nO0063\nG90 G55\nG1 Y2. F100.\nM30\n%\n");
  write(folder.path / "note.txt", "Change the stylus on Monday.\n");
  const CommandResult result = keptGoing(folder, {"first.nc", "bad.EIA", "last", "note.txt", "gone.nc"});
  CHECK(result.status == 1);
  CHECK(fs::exists(folder.path / "out/first.nc"));
  CHECK(readAll(folder.path / "out/first.nc").find("X1.5") != std::string::npos);
  CHECK(std::distance(fs::directory_iterator(folder.path / "out"), fs::directory_iterator()) == 2);
  CHECK(result.err.find("2 of 5 inputs converted; refused: `bad.EIA`, `note.txt`, `gone.nc`\n") !=
        std::string::npos);
  CHECK(result.err.find("bad.EIA:3:") != std::string::npos);
}

TEST_CASE("convert --keep-going gives each input what it gets alone, and 0 where none is refused") {
  const Folder folder;
  write(folder.path / "a.nc", kSound);
  write(folder.path / "b.nc", "%\nO0064\nG90 G55\nG1 Y2. F100.\nM30\n%\n");
  const CommandResult result = keptGoing(folder, {"a.nc", "b.nc"});
  CHECK(result.status == 0);
  CHECK(result.err.find("refused") == std::string::npos);
  const CommandResult alone =
      runDotek({"convert", "b.nc", "--to", "fanuc", "--control", "fanuc-31i-b"}, folder.path);
  CHECK(alone.status == 0);
  CHECK(readAll(folder.path / "out/b.nc") == alone.out);
}

TEST_CASE("convert --keep-going writes nothing where every input is refused, or the flags are") {
  const Folder folder;
  write(folder.path / "bad.nc", kBroken);
  const CommandResult all = keptGoing(folder, {"bad.nc"});
  CHECK(all.status == 1);
  CHECK(!fs::exists(folder.path / "out"));
  write(folder.path / "good.nc", kSound);
  CHECK(runDotek({"convert", "good.nc", "--to", "fanuc", "--keep-going"}, folder.path).status == 2);
  CHECK(runDotek({"convert", "good.nc", "--to", "fanuk", "-d", "out", "--keep-going"}, folder.path).status ==
        2);
  CHECK(!fs::exists(folder.path / "out"));
}

TEST_CASE("convert --keep-going --verify writes the inputs that agree") {
  const Folder folder;
  write(folder.path / "good.nc", "%\nO0065\nG90 G54\nG0 X1.5\n#500=2.\nM30\n%\n");
  write(folder.path / "bad.nc", kBroken);
  std::vector<std::string> arguments = {"good.nc", "bad.nc", "--verify"};
  const CommandResult result = keptGoing(folder, arguments);
  CHECK(result.status == 1);
  CHECK(fs::exists(folder.path / "out/good.nc"));
  CHECK(!fs::exists(folder.path / "out/bad.nc"));
  CHECK(result.err.find("1 of 2 inputs converted; refused: `bad.nc`") != std::string::npos);
}

TEST_CASE("convert --verify --report writes what verify found, for each input") {
  const Folder folder;
  write(folder.path / "one.nc", "%\nO0066\nG90 G54\nG0 X1.5\n#500=2.\nM30\n%\n");
  write(folder.path / "two.nc", "%\nO0067\nG90 G54\nG0 Y1.5\n#501=3.\nM30\n%\n");
  const auto convert = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "convert");
    for (const char* one : {"--to", "fanuc", "--verify"})
      arguments.emplace_back(one);
    return runDotek(arguments, folder.path);
  };
  const CommandResult single =
      convert({"one.nc", "-o", "new.nc", "--report", "page.html", "--date", "24 May"});
  CHECK_MESSAGE(single.status == 0, single.err);
  const std::string page = readAll(folder.path / "page.html");
  CHECK(page.find("<strong>AGREES</strong>200 of 200") != std::string::npos);
  CHECK(page.find("24 May") != std::string::npos);
  CHECK(readAll(folder.path / "new.nc").starts_with("%\nO0066"));

  const CommandResult several = convert({"one.nc", "two.nc", "-d", "out", "--report", "checks/of.json"});
  CHECK(several.status == 2); // no folder is made for it
  CHECK(!fs::exists(folder.path / "out"));
  CHECK(convert({"one.nc", "two.nc", "-d", "out", "--report", "of.json"}).status == 0);
  CHECK(readAll(folder.path / "of-one.json").find("\"name\": \"one.nc\"") != std::string::npos);
  CHECK(readAll(folder.path / "of-two.json").find("\"name\": \"two.nc\"") != std::string::npos);
  CHECK(!fs::exists(folder.path / "of.json"));

  CHECK(convert({"one.nc", "-o", "new.nc", "--report", "one.nc"}).status == 2); // an input
  CHECK(convert({"one.nc", "-o", "a.md", "--report", "a.md"}).status == 2);
  CHECK(runDotek({"convert", "one.nc", "--to", "fanuc", "--report", "x.md"}, folder.path).status == 2);
  CHECK(!fs::exists(folder.path / "x.md"));
}

TEST_CASE("convert --verify --report writes the report of what differs, and no program") {
  const Folder folder;
  // The macro draws X, the post prints the other sign.
  std::string post = readAll(root() / "examples/post.txt");
  const std::string touch = "X'OpFieldData#('X')";
  REQUIRE(post.find(touch) != std::string::npos);
  post.replace(post.find(touch), touch.size(), "X-'OpFieldData#('X')");
  write(folder.path / "post.txt", post);
  const CommandResult result = runDotek({"convert", example("surface-x"), "--prog", "post.txt", "--to",
                                         "fanuc", "--verify", "-d", "out", "--report", "found.md"},
                                        folder.path);
  CHECK(result.status == 1);
  CHECK(!fs::exists(folder.path / "out"));
  const std::string report = readAll(folder.path / "found.md");
  CHECK(report.find("**DIFFERS: 200 of 200") != std::string::npos);
  CHECK(report.find("drawn path against post") != std::string::npos);
  CHECK(report.find("[form-assumed]") != std::string::npos);
  // Refused before anything was compared: no report.
  CHECK(runDotek({"convert", example("surface-x"), "--prog", "post.txt", "--to", "fanuc", "--set", "X=99999",
                  "--verify", "--report", "none.md"},
                 folder.path)
            .status == 1);
  CHECK(!fs::exists(folder.path / "none.md"));
}

TEST_CASE("convert of a folder of programs says to name its files") {
  const Folder folder;
  write(folder.path / "macros/O9161", kSound);
  write(folder.path / "macros/README", "Macros of the shop.\n");
  const CommandResult result = runDotek({"convert", "macros", "--to", "fanuc"}, folder.path);
  CHECK(result.status == 1);
  CHECK(
      result.err.find("`macros` holds programs, and none of the files of a cycle; name the files instead of "
                      "the folder: `macros/O9161` [folder-of-programs]") != std::string::npos);
  CHECK(result.err.find("DefineData") == std::string::npos);
  // A flag of programs is no mistake there.
  const CommandResult flagged = runDotek({"convert", "macros", "--to", "fanuc", "--from-control",
                                          "fanuc-0i-md", "--control", "fanuc-31i-b", "-d", "out"},
                                         folder.path);
  CHECK(flagged.err.find("[folder-of-programs]") != std::string::npos);
  CHECK(flagged.err.find("[option-of-programs]") == std::string::npos);
}

TEST_CASE("convert refuses a program whose jump leads nowhere") {
  const Folder folder;
  write(folder.path / "O9162", "%\nO9162\nIF[#7EQ#0]GOTO90\nG0X#7\nM99\n%\n");
  const CommandResult result = runDotek({"convert", "O9162", "--to", "fanuc"}, folder.path);
  CHECK(result.status == 1);
  CHECK(result.out.empty());
  CHECK(result.err.find("O9162:3:15: error: ") != std::string::npos);
  CHECK(result.err.find("[goto-target-missing]") != std::string::npos);
  CHECK(result.err.find("[not-structured]") == std::string::npos);
}

TEST_CASE("convert --verify of a program takes --assume probe-on, which its message names") {
  const Folder folder;
  write(folder.path / "O9163", "%\nO9163\nG91G31Z-[#26]F80.\n#111=#5063-#5083\nG0Z#26\nG90\nM99\n%\n");
  const std::vector<std::string> arguments = {"convert",   "O9163",          "--to",
                                              "fanuc",     "--from-control", "fanuc-0i-md",
                                              "--control", "fanuc-31i-b",    "--verify"};
  const CommandResult without = runDotek(arguments, folder.path);
  CHECK(without.err.find("--assume probe-on") != std::string::npos);
  std::vector<std::string> with = arguments;
  with.insert(with.end(), {"--assume", "probe-on"});
  const CommandResult result = runDotek(with, folder.path);
  CHECK(result.err.find("[option-of-cycles]") == std::string::npos);
  CHECK(result.err.find("the probe is off") == std::string::npos);
  // Without --verify nothing runs, and it would change nothing.
  with.erase(with.begin() + 8);
  CHECK(runDotek(with, folder.path).err.find("[option-of-cycles]") != std::string::npos);
}
