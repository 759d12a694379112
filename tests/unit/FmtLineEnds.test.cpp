// `dotek fmt` keeps what a layout is not about: line ends and the byte order mark of a file.
#include "tests/Process.h"

#include <doctest/doctest.h>
#include <string>

using namespace dotek::tests;

namespace {

const std::string kMark = "\xEF\xBB\xBF";

std::string layOut(const ProcessFolder& folder, const std::string& text, const char* name) {
  folder.write(name, text);
  const ShellResult diff = folder.run(std::string("dotek fmt --diff ") + name);
  const ShellResult check = folder.run(std::string("dotek fmt --check ") + name);
  const ShellResult write = folder.run(std::string("dotek fmt --write ") + name);
  CHECK(write.status == 0);
  const std::string after = folder.run(std::string("cat ") + name).out;
  // The three say the same.
  CHECK((check.status == 0) == (after == text));
  CHECK((diff.out.empty()) == (after == text));
  return after;
}

} // namespace

TEST_CASE("fmt: CR LF and a byte order mark stay") {
  const ProcessFolder folder;
  const std::string laidOut = "O1\r\nN10 M30\r\n";
  CHECK(layOut(folder, laidOut, "a.nc") == laidOut);
  CHECK(layOut(folder, kMark + laidOut, "b.nc") == kMark + laidOut);
  CHECK(layOut(folder, "O1\r\nN10G1X1.F5.\r\nM30\r\n", "c.nc") == "O1\r\nN10 G1 X1. F5.\r\nM30\r\n");
  const std::string cycle = "cycle one \"One\"\r\n\r\nspindle off\r\n";
  CHECK(layOut(folder, cycle, "one.cycle") == cycle);
  CHECK(layOut(folder, "O1\nN10G1X1.F5.\nM30\n", "d.nc") == "O1\nN10 G1 X1. F5.\nM30\n");
  // Of both kinds the first line's is taken.
  CHECK(layOut(folder, "O1\r\nN10G1X1.F5.\nM30\n", "e.nc") == "O1\r\nN10 G1 X1. F5.\r\nM30\r\n");
}
