// The beginning of a project's settings.
#include "tests/GoldenRunner.h"
#include "tests/unit/DataFolder.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <regex>

using namespace dotek::tests;

TEST_CASE("dotek init writes settings that change nothing, and never takes the place of others") {
  const DataFolder folder;
  const std::string path = folder.path() + "/dotek.toml";
  folder.write("O1.nc", "O1\nG1 X5\nM30\n");
  const CommandResult before = runDotek({"lint", "."}, folder.path());
  const CommandResult made = runDotek({"init"}, folder.path());
  CHECK(made.status == 0);
  CHECK(made.out == "`./dotek.toml` is written; `dotek lint .` checks the folder\n");
  const CommandResult after = runDotek({"lint", "."}, folder.path());
  CHECK(after.out == before.out);
  CHECK(after.status == before.status);
  const std::string text = readAll(path);
  const CommandResult again = runDotek({"init", "--control", "haas-ngc"}, folder.path());
  CHECK(again.status == 2);
  CHECK(again.err.find("[settings-exist]") != std::string::npos);
  CHECK(readAll(path) == text);
  CHECK(runDotek({"init", "--control", "haas-ngc", "--force"}, folder.path()).status == 0);
  CHECK(readAll(path).find("\ncontrol = \"haas-ngc\"\n") != std::string::npos);
  CHECK(runDotek({"init", "--control", "no-such", "--force"}, folder.path()).status == 2);
  CHECK(runDotek({"init", "nowhere"}, folder.path()).status == 2);
  // A control of one's own is found from the folder that it is written for.
  std::filesystem::create_directory(folder.path() + "/sub");
  folder.write("mine.toml", runDotek({"new", "control", "mine", "--from", "fanuc-31i-b"}, folder.path()).out);
  folder.write("sub/O2.nc", "O2\nM30\n");
  CHECK(runDotek({"init", "sub", "--control", "./mine.toml"}, folder.path()).status == 0);
  CHECK(readAll(folder.path() + "/sub/dotek.toml").find("\ncontrol = \"../mine.toml\"\n") !=
        std::string::npos);
  CHECK(runDotek({"lint", "sub"}, folder.path()).status != 2);
}

TEST_CASE("each setting that dotek init proposes is one that Dotek reads") {
  const DataFolder folder;
  folder.write("O1.nc", "O1\nM30\n");
  runDotek({"init"}, folder.path());
  const std::string text = readAll(folder.path() + "/dotek.toml");
  const std::regex setting("(^|\n)# ([a-z-]+ = |\\[)");
  CHECK(std::distance(std::sregex_iterator(text.begin(), text.end(), setting), std::sregex_iterator()) > 12);
  std::string used = text;
  while (std::regex_search(used, setting))
    used = std::regex_replace(used, setting, "$1$2");
  // What they name is not in this folder: a folder of data, a form.
  used = std::regex_replace(used, std::regex("\n(data|form|prog) = [^\n]*"), "");
  folder.write("dotek.toml", used);
  const CommandResult result = runDotek({"lint", "."}, folder.path());
  CHECK_MESSAGE(result.status != 2, result.err << result.out);
}
