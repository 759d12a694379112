// `dotek sim` as a command: files, pipes, sizes.
#include "DataFolder.h"
#include "tests/GoldenRunner.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <thread>

namespace fs = std::filesystem;
using namespace dotek::tests;

TEST_CASE("sim command: the trace file is complete or absent") {
  const DataFolder folder;
  folder.write("good.nc", "G0 X1.\nM30\n");
  folder.write("alarm.nc", "G0 X1.\nG1 X2.\n");
  const fs::path trace = fs::path(folder.path()) / "out.trace";
  CommandResult result = runDotek({"sim", "good.nc", "--trace", "out.trace"}, folder.path());
  CHECK(result.status == 0);
  CHECK(result.out.empty());
  CHECK(readAll(trace) == "rapid X1.000000 Y0.000000 Z0.000000\nend\n");
  // What stops the program belongs to its trace.
  result = runDotek({"sim", "alarm.nc", "--trace", "out.trace", "--json"}, folder.path());
  CHECK(result.status == 1);
  CHECK(readAll(trace) == "rapid X1.000000 Y0.000000 Z0.000000\nalarm 11 NO FEEDRATE COMMANDED\n");
  CHECK(result.out.find("\"ending\": \"alarm\"") != std::string::npos);
  // Wrong arguments leave the file as it was.
  result = runDotek({"sim", "none.nc", "--trace", "out.trace"}, folder.path());
  CHECK(result.status == 2);
  CHECK(readAll(trace).starts_with("rapid"));
  result = runDotek({"sim", "good.nc", "--trace", "no/such/folder/out"}, folder.path());
  CHECK(result.status == 2);
  CHECK(result.err.find("[file-not-writable]") != std::string::npos);
  // A program that is refused before it runs leaves none.
  folder.write("refused.nc", "#1=[2\nG0 X#1\nM30\n");
  folder.write("REFUSED.SUF", "N10 G0 X10 Q\n");
  for (const char* name : {"refused.nc", "REFUSED.SUF"}) {
    CAPTURE(name);
    result = runDotek({"sim", name, "--trace", "refused.trace"}, folder.path());
    CHECK(result.status == 1);
    CHECK_FALSE(fs::exists(fs::path(folder.path()) / "refused.trace"));
  }
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder.path()))
    files += entry.path().string().find(".dotek-") != std::string::npos ? 1 : 0;
  CHECK(files == 0);
}

TEST_CASE("sim command: a file without a program is refused, whatever runs it") {
  const DataFolder folder;
  const std::string device = (root() / "examples/ram-compensation/device.toml").string();
  for (const char* text : {"", "\n\n", "%\n%\n", "%"}) {
    CAPTURE(text);
    folder.write("e.nc", text);
    for (std::vector<std::string> arguments :
         std::vector<std::vector<std::string>>{{"flatten", "e.nc"},
                                               {"sim", "e.nc"},
                                               {"sim", "e.nc", "--programs", "."},
                                               {"sim", "e.nc", "--device", device}}) {
      const CommandResult result = runDotek(arguments, folder.path());
      CAPTURE(arguments[0]);
      CHECK(result.status == 1);
      CHECK(result.err.find("`e.nc` holds no program; nothing can be run [no-program]") != std::string::npos);
      if (arguments[0] == "flatten") continue;
      arguments.emplace_back("--json");
      CHECK(runDotek(arguments, folder.path()).out.find("\"ending\": \"not-run\"") != std::string::npos);
    }
  }
  folder.write("c.nc", "(NOTHING)\n");
  CHECK(runDotek({"sim", "c.nc"}, folder.path()).status == 0);
  CHECK(runDotek({"flatten", "c.nc"}, folder.path()).status == 0);
}

TEST_CASE("sim command: a line that no buffer holds") {
  const DataFolder folder;
  folder.write("long.nc", "G0 X1.\n(" + std::string(300'000, 'x') + ")\nM30\n");
  const CommandResult result = runDotek({"sim", "long.nc", "--quiet"}, folder.path());
  CHECK(result.status == 1);
  CHECK(result.err.find("long.nc:2:1: error: the line is longer than 262144 bytes") != std::string::npos);
  CHECK(result.err.find("[block-too-long]") != std::string::npos);
}

TEST_CASE("sim command: a defect far into a long program has its line") {
  const DataFolder folder;
  std::string text;
  for (int i = 0; i < 100'000; ++i)
    text += fmt::format("N{} G1 X{}.5 F100\n", i, i % 1000);
  folder.write("big.nc", text + "G1 X1. E5\n");
  const CommandResult result = runDotek({"sim", "big.nc", "--quiet"}, folder.path());
  CHECK(result.status == 1);
  CHECK(result.out.empty());
  CHECK(result.err ==
        "big.nc:100001:8: error: `E5`: nothing in the block takes it; the run ends here as inconclusive "
        "[run-inconclusive]\n  G1 X1. E5\n         ^~\n");
}

TEST_CASE("sim command: a pipe is read once") {
  const DataFolder folder;
  const std::string pipe = folder.path() + "/pipe.nc";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::thread writer([&] {
    std::ofstream out(pipe);
    out << "G0 X7.\nM30\n";
  });
  const CommandResult result = runDotek({"sim", "pipe.nc"}, folder.path());
  writer.join();
  CHECK(result.status == 0);
  CHECK(result.out == "rapid X7.000000 Y0.000000 Z0.000000\nend\n");
}

TEST_CASE("sim command: binary data") {
  const DataFolder folder;
  folder.write("binary.nc", std::string("G0 X1.\n\0\x01\x02", 10));
  const CommandResult result = runDotek({"sim", "binary.nc", "--quiet"}, folder.path());
  CHECK(result.status == 1);
  CHECK(result.err.find("binary.nc:2:1: error: the file holds a byte 0") != std::string::npos);
}

TEST_CASE("sim command: a loop reports what each round meets no more than three times") {
  const DataFolder folder;
  folder.write(
      "wall.toml",
      "schema = 1\n[[shape]]\nkind = \"box\"\nmin = [500.0, -20.0, -20.0]\nmax = [560.0, 20.0, 0.0]\n");
  folder.write("corner.nc", "O9031\nG91 G31 X-20. F100\nG53\n#101=#5061\nM99\n");
  const std::vector<std::string> run = {"sim",     "corner.nc", "--part",        "wall.toml",  "--tool",
                                        "1",       "--length",  "100",           "--diameter", "6",
                                        "--quiet", "--limit",   "sim-steps=2000"};
  const CommandResult result = runDotek(run, folder.path());
  std::size_t missed = 0;
  for (std::size_t at = result.err.find("[miss-measured]"); at != std::string::npos;
       at = result.err.find("[miss-measured]", at + 1))
    ++missed;
  CHECK(missed == 3);
  CHECK(result.err.find("no more than 3 are reported [run-repeats]") != std::string::npos);
  CHECK(result.err.find("`--call \" \"` calls it once") != std::string::npos);
  CHECK(
      runDotek({"sim", "corner.nc", "--call", ""}, folder.path()).err.find("`--call \" \"` calls a macro") !=
      std::string::npos);
  // A position that is not known: since when, and what settles it.
  folder.write("length.nc", "G21 G90 G54\nG43 H1\n#3=#5043\nM30\n");
  const CommandResult lost = runDotek({"sim", "length.nc", "--tool", "1", "--length", "100"}, folder.path());
  CHECK_MESSAGE(lost.err.find("Z is lost since `G43` in line 2") != std::string::npos, lost.err);
}

TEST_CASE("sim command: arguments of --call with signs between them are shown as they are written") {
  const DataFolder folder;
  folder.write("keep.nc", "O9031\nIF[#7EQ#0]THEN#3000=1(D MISSING)\n#100=#7+#19\nM99\n");
  const auto err = [&](std::string_view call) {
    return runDotek({"sim", "keep.nc", "--quiet", "--call", std::string(call)}, folder.path()).err;
  };
  for (const std::string_view slip :
       {"D=25. S=54", "D25., S54", "D25.,S54", "#7=25. #19=54", "G65 P9031 D=25. S54"}) {
    CAPTURE(slip);
    const std::string told = err(slip);
    CHECK_MESSAGE(told.find("[setup-flag]") != std::string::npos, told);
    const bool shown = told.find("`--call \"D25. S54\"`") != std::string::npos ||
                       told.find("`--call \"G65 P9031 D25. S54\"`") != std::string::npos;
    CHECK_MESSAGE(shown, told);
  }
  // Within brackets and comments they mean something else, or nothing.
  CHECK(err("D[ATAN[1.,2.]] S54 (A=1, B)").find("setup-flag") == std::string::npos);
  CHECK(err("D25. S54").empty());
  CHECK(err("#31=2").find("write") == std::string::npos); // no letter sets #31
}

TEST_CASE("sim command: a copy of a program, and which of several lies beside") {
  const DataFolder folder;
  const std::string own = "O9811\nM99\n";
  folder.write("main.nc", "O0012\nG65 P9811 Z0.\nM30\n");
  for (const char* name : {"O9811.BAK", "O9811.nc", "O9811.old", "O9811.nc~"})
    folder.write(name, own);
  const std::string beside = runDotek({"sim", "main.nc", "--quiet"}, folder.path()).err;
  CHECK_MESSAGE(beside.find("`O9811.nc`, which lies beside") != std::string::npos, beside);
  folder.write("O9811", own);
  const std::string bare = runDotek({"sim", "main.nc", "--quiet"}, folder.path()).err;
  CHECK_MESSAGE(bare.find("`O9811`, which lies beside") != std::string::npos, bare);
  const std::string twice = runDotek({"sim", "main.nc", "--programs", ".", "--quiet"}, folder.path()).err;
  CHECK_MESSAGE(twice.find("note: the first one") != std::string::npos, twice);
}
