// Folders one in another: each file is found, once, with all of its path.
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>

using namespace dotek::tests;

TEST_CASE("lint finds a program below 190 folders, one in another") {
  const TestFolder folder("dotek-deep");
  std::string path;
  for (int level = 0; level < 190; ++level) {
    path += "d/";
    if (level % 50 == 0) folder.write(path + "sound.nc", "%\nO1\n#100=#5061\nM99\n%\n");
  }
  folder.write(path + "bad.nc", "%\nO2\nGOTO 7\nM99\n%\n");
  const CommandResult found = runDotek({"lint", ".", "--control", "fanuc-31i-b"}, folder.path());
  CHECK(found.status == 1);
  const std::string place = path + "bad.nc:3:";
  const std::size_t at = found.out.find(place);
  REQUIRE(at != std::string::npos);
  CHECK(found.out.substr(at, place.size() + 200).find("goto-target-missing") != std::string::npos);
  CHECK(found.out.find("sound.nc:") == std::string::npos);
}
