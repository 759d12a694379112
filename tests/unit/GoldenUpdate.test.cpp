// What --update rewrites, and what it refuses to.
#include "tests/GoldenRunner.h"
#include "tests/Goldens.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {} // namespace

TEST_CASE("goldens: --update rewrites what is ours and refuses the reference") {
  const TestFolder scratch("dotek-golden-update");
  scratch.write("REFERENCE", "# from a book\narea/case/stdout\n");
  scratch.write("area/case/stdout", "as printed\n");
  scratch.write("area/case/stderr", "ours\n");
  const auto file = [&](const char* name) {
    return GoldenFile{scratch.path(), scratch / "area" / "case" / name, ""};
  };
  int rewritten = 0;
  CHECK(settle(file("stdout"), "as printed\n", true, rewritten) == "");
  const std::string refused = settle(file("stdout"), "other\n", true, rewritten);
  CHECK(refused.find("--update does not rewrite it") != std::string::npos);
  CHECK(settle(file("stdout"), "", true, rewritten) != "");
  CHECK(readAll(scratch / "area" / "case" / "stdout") == "as printed\n");
  CHECK(rewritten == 0);

  CHECK(settle(file("stderr"), "other\n", false, rewritten) != "");
  CHECK(readAll(scratch / "area" / "case" / "stderr") == "ours\n");
  CHECK(settle(file("stderr"), "other\n", true, rewritten) == "");
  CHECK(readAll(scratch / "area" / "case" / "stderr") == "other\n");
  CHECK(settle(file("stderr"), "", true, rewritten) == "");
  CHECK_FALSE(fs::exists(scratch / "area" / "case" / "stderr"));
  CHECK(rewritten == 2);
}

TEST_CASE("goldens: each file of REFERENCE is there") {
  const fs::path goldens = root() / "tests" / "golden";
  CHECK(!referenceFiles(goldens).empty());
  for (const std::string& name : referenceFiles(goldens))
    CHECK_MESSAGE(fs::is_regular_file(goldens / name), name);
}
