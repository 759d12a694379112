// What the process does where it is started with little room on the stack.
#include "tests/GoldenRunner.h"
#include "tests/Process.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>

using namespace dotek::tests;

namespace {

// Brackets within brackets, up to the limit of them.
std::string deepProgram() {
  std::string text = "%\nO1\n";
  for (int i = 0; i < 50; ++i)
    text += "#1=" + std::string(60, '[') + "1." + std::string(60, ']') + "\n";
  return text + "M30\n%\n";
}

} // namespace

TEST_CASE("a small limit of the stack changes nothing") {
  const ProcessFolder folder;
  folder.write("p.nc", deepProgram());
  folder.write("c.nc", "%\nO1\nM98 P1\nM30\n%\n");
  for (const std::string command :
       {"--version", "lint p.nc", "sim p.nc --control fanuc-0i-md", "lint c.nc"}) {
    const ShellResult plain = folder.run("dotek " + command);
    for (const int kilobytes : {64, 128, 1024}) {
      const ShellResult hard = folder.run(fmt::format("ulimit -s {}; dotek {}", kilobytes, command));
      INFO(command << ", " << kilobytes << " KB\n" << hard.err);
      CHECK(hard.status == plain.status);
      CHECK(hard.out == plain.out);
      CHECK(hard.err == plain.err);
      const ShellResult soft = folder.run(fmt::format("ulimit -S -s {}; dotek {}", kilobytes, command));
      CHECK(soft.status == plain.status);
      CHECK(soft.out == plain.out);
    }
  }
}

TEST_CASE("threads and scripts have room where the stack is small") {
  const ProcessFolder folder;
  const std::string verify = fmt::format(
      "dotek verify {0}/examples/surface-x --prog {0}/examples/post.txt --to fusion --assume probe-on "
      "--cases 70 --jobs 2",
      root().string());
  const ShellResult plain = folder.run(verify);
  CHECK(plain.status == 0);
  const ShellResult small = folder.run("ulimit -s 64; " + verify);
  CHECK_MESSAGE(small.status == 0, small.err);
  CHECK(small.out == plain.out);
}
