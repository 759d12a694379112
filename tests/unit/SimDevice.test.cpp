// Devices beside the control: tables of errors, windows and handshakes, the report, and the ram of examples.
#include "sim/device/ErrorTable.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"
#include "tests/unit/PageCommands.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <string>
#include <string_view>

namespace fs = std::filesystem;
using namespace dotek::tests;
using dotek::sim::ErrorTable;

namespace {

CommandResult runIn(const TestFolder& folder, const std::string& command) {
  return runDotek(splitArguments(command), folder.path());
}

bool has(const CommandResult& result, std::string_view part) {
  CAPTURE(result.err);
  CAPTURE(result.out);
  return (result.out + result.err).find(part) != std::string::npos;
}

void replace(std::string& text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
}

constexpr std::string_view kPart =
    "schema = 1\n[[shape]]\nkind = \"box\"\nmin = [-50, -50, -900]\nmax = [50, 0, 50]\n";
constexpr std::string_view kMachine =
    "schema = 1\n[setup]\ntool = 1\nwork_offset = { G54 = [0, 0, 0] }\nat = [0, 20, 0]\n"
    "[probe]\ntool = 1\nball_diameter = 6\nlength = 100\nlength_to = \"tip\"\non = true\n";
constexpr std::string_view kRun =
    "sim main.nc --control fanuc-31i-b --part part.toml --machine machine.toml --device device.toml ";

} // namespace

TEST_CASE("device: a table of errors is read in each of its shapes and is linear between its points") {
  ErrorTable table;
  CHECK(table.addCsv("pos,0V,1 V,2V\n-50,-0.01,0,0.02\n-100,-0.03,,0.01\n") == "");
  CHECK(table.at(-50, 1) == doctest::Approx(0));
  CHECK(table.at(-50, 1.5) == doctest::Approx(0.01));
  CHECK(table.at(-100, 1) == doctest::Approx(-0.01)); // an empty cell is no point
  CHECK(table.at(-75, 0) == doctest::Approx(-0.02));
  CHECK(table.at(-10, 0) == doctest::Approx(-0.01));
  CHECK(table.at(-200, 9) == doctest::Approx(0.01));
  CHECK(table.covers(-75, 2));
  CHECK_FALSE(table.covers(-10, 1));
  CHECK_FALSE(table.covers(-50, 2.1));
  // A later point counts.
  CHECK(table.addCsv("pos;volt;err\r\n-50;1;0.004\r\n") == "");
  CHECK(table.at(-50, 1) == doctest::Approx(0.004));
  ErrorTable pitch;
  CHECK(pitch.addCsv("# pitch\nx,error\n0,0\n100,0.02\n") == "");
  CHECK(pitch.at(25, 7) == doctest::Approx(0.005));
  CHECK(ErrorTable().addCsv("pos,volt,err\n1,2\n") != "");
  CHECK(ErrorTable().addCsv("pos,volt,err\n1,2,x\n").find("line 2") != std::string::npos);
  CHECK(ErrorTable().addCsv("1,2\n3,4\n").find("names the columns") != std::string::npos);
  CHECK(ErrorTable().addCsv("") != "");
  CHECK(ErrorTable().addCsv("a,b\n") != "");
}

TEST_CASE("device: the commands of the ram's page do what it says, and its numbers are those of the run") {
  const TestFolder scratch("dotek-ram");
  fs::create_directories(scratch / "examples");
  fs::copy(root() / "examples/ram-compensation", scratch / "examples/ram-compensation",
           fs::copy_options::recursive);
  const auto commands = commandsOf(readAll(root() / "examples/ram-compensation/README.md"));
  REQUIRE(commands.size() == 4);
  const CommandResult lint = runIn(scratch, commands[0].second);
  CHECK(lint.out == "");
  CHECK(lint.status == 0);
  const CommandResult run = runIn(scratch, commands[1].second);
  CAPTURE(run.err);
  REQUIRE(run.status == 0);
  CHECK(run.err.find("warning:") == std::string::npos);
  const std::string page = readAll(scratch / "ram.md");
  CHECK(page.find("| Run | to the end of the program |") != std::string::npos);
  CHECK(page.find("lower, V: 14 of 14 are those of `range-out.csv`") != std::string::npos);
  CHECK(page.find("upper, V: 14 of 14 are those of `range-out.csv`") != std::string::npos);
  CHECK(page.find("chosen, V: 13 of 14 are those of `result-out.csv`") != std::string::npos);
  CHECK(page.find("| -400 | 4.5 | -0.001 | 0.001 | 4.5, 4.6 | a tie: the program took this one |") !=
        std::string::npos);
  CHECK(page.find("The limit of 0.01 mm is kept.") != std::string::npos);
  CHECK(page.find("NOT KEPT") == std::string::npos);
  CHECK(page.find("(<ram.svg>)") != std::string::npos);
  CHECK(page.find("The run was not clean") == std::string::npos);
  CHECK(page.find("| -700 |") != std::string::npos); // the end of the comparison, not a whole step on
  const std::string picture = readAll(scratch / "ram.svg");
  CHECK(picture.find("<polyline") != std::string::npos);
  CHECK(picture.find(">after, both ways<") != std::string::npos); // no curve lies on another
  CHECK(picture.find(">after +<") == std::string::npos);
  // Y0 above the face: the magnitude of a negative reading grows with the sag.
  const CommandResult sign = runIn(scratch, commands[2].second);
  CHECK(sign.status == 1);
  CHECK(has(sign, "NO READING BELOW THE WANTED"));

  // Both rules at each extension: they differ where the readings are negative, and there at each of them.
  const CommandResult both = runIn(scratch, commands[3].second);
  CAPTURE(both.err);
  REQUIRE(both.status == 0);
  CHECK(both.err.find("warning:") == std::string::npos);
  const std::string rules = readAll(scratch / "sign.md");
  CHECK(rules.find("| -50 | 0.497 | 3 | 3 |") != std::string::npos);
  CHECK(rules.find("| -700 | 0.343 | 8 | 8 |") != std::string::npos);
  CHECK(rules.find("| -50 | -0.503 | 1 | 3 |") != std::string::npos);
  CHECK(rules.find("| -700 | -0.657 | 1 | 8 |") != std::string::npos);

  // Without the dwell that lets the voltage settle the page says that its numbers come from a faulty run.
  const std::string reading = "examples/ram-compensation/macros/O9070.nc";
  const std::string whole = readAll(scratch / reading);
  std::string hasty = whole;
  replace(hasty, "G4 X5. (UNTIL THE VOLTAGE HOLDS)\n", "");
  scratch.write(reading, hasty);
  CHECK(runIn(scratch, commands[1].second).status == 1);
  const std::string faulty = readAll(scratch / "ram.md");
  CHECK(faulty.find("**The run was not clean") != std::string::npos);
  CHECK(faulty.find("O9070.nc` line ") != std::string::npos);
  CHECK(faulty.find("before `voltage` of ") != std::string::npos);
  scratch.write(reading, whole);

  // Another table: another page.
  std::string fine = readAll(scratch / "examples/ram-compensation/fine-out.csv");
  replace(fine, "-250,3.3,-0.004", "-250,3.3,0");
  scratch.write("examples/ram-compensation/fine-out.csv", fine);
  REQUIRE(runIn(scratch, commands[1].second).status == 0);
  const std::string other = readAll(scratch / "ram.md");
  CHECK(other != page);
  CHECK(other.find("- chosen, V at -250: the run has 3.3, `result-out.csv` has 3.6") != std::string::npos);
}

TEST_CASE("device: another window, another code, an error without a value") {
  const TestFolder scratch("dotek-device-other");
  scratch.write("part.toml", kPart);
  scratch.write("machine.toml", kMachine);
  scratch.write(
      "device.toml",
      "schema = 1\n[window]\naddress = 3980\nword = 3981\n[[value]]\nname = \"air\"\nrange = [0, 6]\n"
      "[[call]]\ncode = \"M160\"\nsets = { air = \"B\" }\nsettle = 1\n"
      "[[table]]\nname = \"t\"\nindex = { address = 10 }\nstrobe = { address = 20 }\nlast = 3\n"
      "column = [{ name = \"a\", cell = { address = 30, size = \"word\" }, scale = 0.1 }]\n"
      "[[error]]\naxis = \"Y\"\nalong = { axis = \"Z\", zero = 100 }\npoints = [[0, 0.25], [-100, 0.5]]\n");
  scratch.write("main.nc",
                "O1\nG90 G54 G43 H1 Z-50.\nG1 Y6. F500\nM160 B4.\nG4 X1.\n#3980=10\n#3981=2\n#3980=30\n"
                "#3981=-35\n#3980=20\n#3981=1\nG31 Y-5. F50\n#100=#5062\nG0 Y20.\nM30\n");
  const CommandResult good = runIn(scratch, std::string(kRun) + "--quiet --report page.md");
  CAPTURE(good.err);
  CHECK(good.status == 0);
  const std::string page = readAll(scratch / "page.md");
  CHECK(page.find("| 2 | -3.5 |") != std::string::npos);
  CHECK(page.find("2 of its 3 rows are empty") != std::string::npos);
  CHECK(has(runIn(scratch, std::string(kRun)), "variable 100 3.375000"));

  scratch.write("main.nc",
                "O1\nG90 G54 G43 H1 Z-50.\nG1 Y6. F500\nM160 B7.\nG4 X0.5\nG31 Y-5. F50\n#3980=10\n#3981=9\n"
                "#3980=20\n#3981=1\n#3981=1\n#3980=10\n#3981=2\nM30\n");
  const CommandResult bad = runIn(scratch, std::string(kRun) + "--quiet");
  CHECK(bad.status == 1);
  CHECK(has(bad, "device-fault"));
  CHECK(has(bad, "the device applies 6"));
  CHECK(has(bad, "before `air` of M160 has settled"));
  CHECK(has(bad, "the index of `t` is 9"));
  CHECK(has(bad, "is on already"));
  CHECK(has(bad, "change while its strobe is on"));

  scratch.write("main.nc", "O1\nM160 C7.\nM30\n");
  CHECK(has(runIn(scratch, std::string(kRun) + "--quiet"), "M160 without a value for `air`"));
  scratch.write("main.nc", "O1\nG90 G54 G43 H1 Z-150.\nG1 Y6. F500\nG31 Y-5. F50\nM30\n");
  CHECK(has(runIn(scratch, std::string(kRun) + "--quiet"), "device-beyond-table"));
}

TEST_CASE("device: what is wrong with its file or its flags is said") {
  const TestFolder scratch("dotek-device-wrong");
  scratch.write("part.toml", kPart);
  scratch.write("machine.toml", kMachine);
  scratch.write("main.nc", "O1\nM30\n");
  scratch.write("device.toml", "schema = 1\n[[call]]\ncode = \"M160\"\nsets = { air = \"B\" }\n"
                               "[[error]]\naxis = \"Q\"\nalong = { axis = \"Z\" }\n");
  const CommandResult wrong = runIn(scratch, kRun.data());
  CHECK(wrong.status != 0);
  CHECK(has(wrong, "no value is called `air`"));
  CHECK(has(wrong, "X, Y or Z is expected"));
  CHECK(has(wrong, "the error has no points"));
  CHECK(has(runIn(scratch, "sim main.nc --report page.md"), "no-device"));
  scratch.write("device.toml",
                "schema = 1\n[[table]]\nname = \"t\"\nlast = 2\nindex = { address = 1 }\n"
                "strobe = { address = 2 }\ncolumn = [{ name = \"a\", cell = { address = 3 } }]\n");
  CHECK(has(runIn(scratch, "sim main.nc --control fanuc-6m --device device.toml"), "device-needs-window"));
}
