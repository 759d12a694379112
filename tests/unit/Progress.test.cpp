// The line on a terminal while a command takes longer than a second.
#include "driver/Driver.h"
#include "tests/GoldenRunner.h"
#include "tests/Process.h"
#include "tests/Skips.h"

#include <doctest/doctest.h>
#include <string>
#include <vector>

using namespace dotek::tests;

namespace {

// A terminal on which `dotek` reads a program that comes by a pipe after more than a second; what it shows.
std::string onTerminal(const ProcessFolder& folder, const std::string& terminal, const std::string& command) {
  folder.write("part.nc", "%\nO1(PART)\nG0X1.\nM30\n%\n");
  return folder
      .run("PATH=$(dirname \"$DOTEK\"):$PATH\nmkfifo pipe.nc\n{ sleep 1.7; cat part.nc; } >pipe.nc &\nTERM=" +
           terminal + " script -qec '" + command + "' /dev/null </dev/null; rm pipe.nc")
      .out;
}

} // namespace

TEST_CASE("progress: a terminal sees that a command runs, and the line is gone at its end") {
  const ProcessFolder folder;
  if (folder.run("command -v script").status != 0) return skip("there is no script");
  const std::string shown = onTerminal(folder, "xterm", "dotek outline part.nc; dotek lint pipe.nc");
  const std::size_t line = shown.find("\rdotek lint: 0 files read, 1 s\x1b[K");
  REQUIRE_MESSAGE(line != std::string::npos, shown);
  CHECK(shown.find("\r\x1b[K", line + 2) != std::string::npos);
  CHECK(onTerminal(folder, "xterm", "dotek fmt --check pipe.nc").find("\rdotek fmt: 1 s\x1b[K") !=
        std::string::npos);
}

TEST_CASE("progress: nothing of it where it is not wanted") {
  const ProcessFolder folder;
  if (folder.run("command -v script").status != 0) return skip("there is no script");
  for (const char* command :
       {"dotek lint --quiet pipe.nc", "dotek lint pipe.nc 2>log; cat log", "dotek lint pipe.nc 2>&1 | cat"})
    CHECK_MESSAGE(onTerminal(folder, "xterm", command).find(" s\x1b[K") == std::string::npos, command);
  CHECK(onTerminal(folder, "dumb", "dotek lint pipe.nc").find('\x1b') == std::string::npos);
}

TEST_CASE("progress: lint counts files, verify cases, convert also its inputs") {
  std::vector<std::string> said;
  const auto hear = [&](const std::string& text) { said.push_back(text); };
  dotek::driver::LintOptions lint;
  lint.paths = {(root() / "examples" / "macros").string()};
  lint.progress = hear;
  static_cast<void>(dotek::driver::lint(lint));
  REQUIRE(said.size() > 6);
  CHECK(said[1] == "1 files read");
  CHECK(said.back().find(" files read, rules on part ") != std::string::npos);

  said.clear();
  dotek::driver::VerifyOptions verify;
  verify.inputs = {(root() / "examples" / "macros" / "bore.nc").string()};
  verify.to = "fanuc";
  verify.cases = 3;
  verify.progress = hear;
  const dotek::driver::Outcome outcome = dotek::driver::verify(verify);
  REQUIRE_MESSAGE(!said.empty(), outcome.output);
  CHECK(said.front().starts_with("1 of "));
  CHECK(said.front().ends_with(" cases"));

  // Programs that do little: each of the many cases is run.
  said.clear();
  const ProcessFolder folder;
  for (const char* number : {"1", "2"})
    folder.write(std::string(number) + ".nc", std::string("%\nO") + number + "\nG90G0X1.\nM99\n%\n");
  dotek::driver::ConvertOptions convert;
  convert.inputs = {folder.path("1.nc"), folder.path("2.nc")};
  convert.to = "fanuc";
  convert.verify = true;
  convert.progress = hear;
  static_cast<void>(dotek::driver::convert(convert));
  REQUIRE(!said.empty());
  CHECK(said.front().starts_with("input 1 of 2, 1 of "));
  CHECK(said.back().starts_with("input 2 of 2, "));
}
