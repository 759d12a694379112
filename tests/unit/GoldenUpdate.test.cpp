// What --update rewrites, and what it refuses to.
#include "tests/GoldenRunner.h"
#include "tests/Goldens.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

class Scratch {
public:
  Scratch() : root(fs::temp_directory_path() / "dotek-golden-update") {
    fs::create_directories(root / "area" / "case");
    write("REFERENCE", "# from a book\narea/case/stdout\n");
    write("area/case/stdout", "as printed\n");
    write("area/case/stderr", "ours\n");
  }
  ~Scratch() { fs::remove_all(root); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  void write(const char* name, const char* text) const {
    std::ofstream(root / name, std::ios::binary) << text;
  }
  GoldenFile file(const char* name) const { return {root, root / "area" / "case" / name, ""}; }
  fs::path root;
};

} // namespace

TEST_CASE("goldens: --update rewrites what is ours and refuses the reference") {
  const Scratch scratch;
  int rewritten = 0;
  CHECK(settle(scratch.file("stdout"), "as printed\n", true, rewritten) == "");
  const std::string refused = settle(scratch.file("stdout"), "other\n", true, rewritten);
  CHECK(refused.find("--update does not rewrite it") != std::string::npos);
  CHECK(settle(scratch.file("stdout"), "", true, rewritten) != "");
  CHECK(readAll(scratch.root / "area" / "case" / "stdout") == "as printed\n");
  CHECK(rewritten == 0);

  CHECK(settle(scratch.file("stderr"), "other\n", false, rewritten) != "");
  CHECK(readAll(scratch.root / "area" / "case" / "stderr") == "ours\n");
  CHECK(settle(scratch.file("stderr"), "other\n", true, rewritten) == "");
  CHECK(readAll(scratch.root / "area" / "case" / "stderr") == "other\n");
  CHECK(settle(scratch.file("stderr"), "", true, rewritten) == "");
  CHECK_FALSE(fs::exists(scratch.root / "area" / "case" / "stderr"));
  CHECK(rewritten == 2);
}

TEST_CASE("goldens: each file of REFERENCE is there") {
  const fs::path goldens = root() / "tests" / "golden";
  CHECK(!referenceFiles(goldens).empty());
  for (const std::string& name : referenceFiles(goldens))
    CHECK_MESSAGE(fs::is_regular_file(goldens / name), name);
}
