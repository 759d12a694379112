// The library as others use it: installed, or as a part of their build. docs/library.md
#include "tests/GoldenRunner.h"
#include "tests/Goldens.h"
#include "tests/Skips.h"
#include "tests/TestFolder.h"

#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

struct ShellResult {
  int status = 0;
  std::string output; // of both streams
};

ShellResult shell(const std::string& command) {
  const fs::path log = fs::temp_directory_path() / "dotek-package.txt";
  ShellResult out;
  out.status = std::system(("(" + command + ") >'" + log.string() + "' 2>&1").c_str());
  out.output = readAll(log);
  fs::remove(log);
  return out;
}

std::string quoted(const fs::path& path) {
  return "'" + path.string() + "'";
}

bool haveTools() {
  for (const char* tool : {DOTEK_CMAKE, DOTEK_COMPILER}) {
    if (shell(std::string("'") + tool + "' --version").status == 0) continue;
    skip(std::string("there is no ") + tool);
    return false;
  }
  return true;
}

// Configures docs/library in `folder`.
ShellResult configure(const std::string& folder, const std::string& arguments) {
  return shell("'" DOTEK_CMAKE "' -G '" DOTEK_GENERATOR "' -DCMAKE_CXX_COMPILER='" DOTEK_COMPILER "' -S '" +
               (root() / "docs" / "library").string() + "' -B " + folder + " " + arguments);
}

} // namespace

TEST_CASE("package: a program finds, links and uses the installed library") {
  if (!haveTools()) return;
  const TestFolder scratch("dotek-package");
  const ShellResult installed =
      shell("'" DOTEK_CMAKE "' --install '" DOTEK_BUILD "' --prefix " + quoted(scratch / "prefix"));
  REQUIRE_MESSAGE(installed.status == 0, installed.output);
  CHECK(fs::exists(scratch / "prefix" / "bin" / "dotek"));
  CHECK(fs::exists(scratch / "prefix" / "include" / "dotek" / "driver" / "Driver.h"));

  const ShellResult configured =
      configure(quoted(scratch / "build"),
                "-DCMAKE_CXX_FLAGS='-Wall -Wextra' -DCMAKE_PREFIX_PATH=" + quoted(scratch / "prefix"));
  REQUIRE_MESSAGE(configured.status == 0, configured.output);
  const ShellResult built = shell("'" DOTEK_CMAKE "' --build " + quoted(scratch / "build"));
  REQUIRE_MESSAGE(built.status == 0, built.output);
  CHECK_MESSAGE(built.output.find("warning") == std::string::npos, built.output);

  const ShellResult clean =
      shell(quoted(scratch / "build/shop") + " '" + (root() / "examples" / "surface-x").string() + "'");
  CHECK_MESSAGE(clean.status == 0, clean.output);
  const ShellResult missing = shell(quoted(scratch / "build/shop") + " nowhere");
  CHECK_MESSAGE(missing.status != 0, missing.output);
  CHECK_MESSAGE(missing.output.find("nowhere") != std::string::npos, missing.output);
}

TEST_CASE("package: as a part of another project there is the library alone") {
  if (!haveTools()) return;
  const TestFolder scratch("dotek-package");
  const ShellResult configured =
      configure(quoted(scratch / "build"), "-DDOTEK_SOURCE='" + root().string() + "'");
  REQUIRE_MESSAGE(configured.status == 0, configured.output);
  const ShellResult targets =
      shell("'" DOTEK_CMAKE "' --build " + quoted(scratch / "build") + " --target help");
  REQUIRE_MESSAGE(targets.status == 0, targets.output);
  CHECK_MESSAGE(targets.output.find("dotek_library") != std::string::npos, targets.output);
  CHECK_MESSAGE(targets.output.find("dotek_tests") == std::string::npos, targets.output);
  // Nothing of it is installed along with the project, and its warnings stop nobody.
  CHECK(readAll(scratch / "build" / "dotek" / "cmake_install.cmake").find("libdotek") == std::string::npos);
  CHECK(readAll(scratch / "build" / "CMakeCache.txt").find("DOTEK_WERROR:BOOL=OFF") != std::string::npos);
}

TEST_CASE("ctest knows each case and each golden by its name") {
  const std::string ctest = (fs::path(DOTEK_CMAKE).parent_path() / "ctest").string();
  if (shell("'" + ctest + "' --version").status != 0) {
    skip("there is no " + ctest);
    return;
  }
  const ShellResult listed = shell("'" + ctest + "' --test-dir '" DOTEK_BUILD "' -N");
  REQUIRE_MESSAGE(listed.status == 0, listed.output);
  const auto knows = [&](const std::string& name) {
    return listed.output.find(": " + name + "\n") != std::string::npos;
  };
  CHECK(knows("ctest knows each case and each golden by its name"));
  CHECK(knows("policy: a source file is one room"));
  for (const std::string& name : goldenNames(root() / "tests" / "golden"))
    CHECK_MESSAGE(knows("golden " + name), name);
}
