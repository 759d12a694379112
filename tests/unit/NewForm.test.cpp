#include "tests/GoldenRunner.h"
#include "tests/unit/DataFolder.h"

#include <doctest/doctest.h>
#include <filesystem>

using namespace dotek::tests;

namespace fs = std::filesystem;

TEST_CASE("a form that `new form` begins prints what the forms print that it is made of") {
  const DataFolder folder;
  const std::string data = folder.path();
  fs::create_directories(fs::path(data) / "forms");
  const std::string prog = (root() / "examples" / "mill-post.txt").string();
  const CommandResult made =
      runDotek({"new", "form", "shop", "--prog", prog, "-o", data + "/forms/shop.toml"}, root());
  REQUIRE_MESSAGE(made.status == 0, made.err);
  const auto posted = [&](const std::string& form) {
    return runDotek({"post", "examples/surface-x", "--prog", prog, "--host", "clearance=5", "--data", data,
                     "--form", form},
                    root());
  };
  const CommandResult theirs = posted("thesis-a"), ours = posted("shop");
  REQUIRE_MESSAGE(theirs.status == 0, theirs.err);
  REQUIRE_MESSAGE(ours.status == 0, ours.err);
  CHECK(ours.out == theirs.out);
  // Copied, so nobody has seen it printed by this post.
  CHECK(ours.err.find("the form `shop` only assumes that `SpinOff` prints ` M5`") != std::string::npos);
  CHECK(theirs.err.find("SpinOff") == std::string::npos);
}
