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

TEST_CASE("convert leaves nothing after it where one program of several is refused") {
  const Folder folder;
  const CommandResult result =
      runDotek({"convert", example("surface-x"), example("surface-y"), "--prog", example("mill-post.txt"),
                "--to", "fanuc", "--set", "X=99999", "-d", (folder.path / "nc").generic_string()},
               root());
  CHECK(result.status == 1);
  CHECK(folder.files() == 0);
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
