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

TEST_CASE("dotek.toml: the folder of data files of a project counts for all commands") {
  const DataFolder folder;
  const std::string prog = (root() / "examples" / "mill-post.txt").string();
  fs::create_directories(fs::path(folder.path()) / "job");
  fs::copy(root() / "examples" / "surface-x", fs::path(folder.path()) / "job" / "surface-x",
           fs::copy_options::recursive);
  fs::copy_file(prog, fs::path(folder.path()) / "job" / "post.txt");
  fs::create_directories(fs::path(folder.path()) / "own" / "forms");
  const auto in = [&](const std::string& where, std::vector<std::string> arguments) {
    return runDotek(std::move(arguments), fs::path(folder.path()) / where);
  };
  REQUIRE(in(".", {"new", "form", "shop", "--prog", "job/post.txt", "-o", "own/forms/shop.toml"}).status ==
          0);
  folder.write("dotek.toml", "schema = 1\ndata = [\"own\"]\nform = \"shop\"\n");
  const std::vector<std::string> post = {"post", "surface-x", "--prog", "post.txt", "--host", "clearance=5"};
  // From the folder of the input: what dotek.toml names is seen from its own folder.
  const CommandResult ours = in("job", post);
  CHECK_MESSAGE(ours.status == 0, ours.err);
  CHECK(ours.err.find("the form `shop` only assumes") != std::string::npos);
  CHECK(in("job", {"list", "forms"}).out.find("shop") != std::string::npos);
  const CommandResult converted = in("job", {"convert", "surface-x", "--prog", "post.txt", "--to", "fanuc"});
  CHECK(converted.err.find("the form `shop` only assumes") != std::string::npos);
  CHECK(in(".", {"lint", "job"}).out.find("unknown") == std::string::npos);
  // A form that is nowhere: what would make it known.
  folder.write("dotek.toml", "schema = 1\nform = \"shop\"\n");
  const CommandResult none = in("job", post);
  CHECK(none.status != 0);
  CHECK(none.err.find("`data = [\"DIR\"]` in dotek.toml") != std::string::npos);
  // A key that nobody reads is no setting.
  for (const char* key : {"datta = [\"own\"]\n", "[lint]\nselekt = [\"all\"]\n"}) {
    folder.write("dotek.toml", "schema = 1\nform = \"thesis-a\"\n" + std::string(key));
    const CommandResult linted = in("job", {"lint", "post.txt"});
    CHECK(linted.out.find("unknown key") != std::string::npos);
  }
  folder.write("dotek.toml", "schema = 1\ndatta = [\"own\"]\n");
  const CommandResult unknown = in("job", post);
  CHECK(unknown.status != 0);
  CHECK(unknown.err.find("dotek.toml:2:1: error: unknown key `datta`; the nearest known one is `data`") !=
        std::string::npos);
}
