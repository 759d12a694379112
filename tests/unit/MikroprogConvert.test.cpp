// Plain programs for Mikroprog: each word is in the result, in a note or in an error at its place, and a run
// of the result does what a run of the source does.
#include "DataFolder.h"
#include "MikroprogConversion.h"
#include "sim/machine/Compile.h"
#include "sim/machine/Trace.h"
#include "tests/GoldenRunner.h"

#include <algorithm>

using namespace dotek;
using namespace dotek::tests;

namespace {

// Blocks of the result without numbers and comments, the first one (of the beginning) left out.
std::vector<std::string> blocks(const std::string& body, bool lathe = true) {
  const Converted result = converted("O1\n" + body + "M30\n", lathe);
  std::string errors;
  for (const Diagnostic& one : result.diagnostics.all())
    if (one.severity == Severity::Error) errors += one.message + "\n";
  CHECK_MESSAGE(result.lines.has_value(), errors);
  std::vector<std::string> out;
  if (!result.lines) return out;
  for (const auto& line : *result.lines) {
    if (!line.text.starts_with("N")) continue;
    const std::string words = line.text.substr(line.text.find(' ') + 1);
    out.push_back(words.substr(0, words.find(" ;")));
  }
  out.erase(out.begin());
  out.pop_back(); // M30
  return out;
}

// The lines of the body with an error, from 1.
std::set<std::uint32_t> refusedLines(const std::string& body, bool lathe = true) {
  const Converted result = converted("O1\n" + body + "M30\n", lathe);
  CHECK_FALSE(result.lines.has_value());
  std::set<std::uint32_t> out;
  for (const std::uint32_t line : result.errorLines())
    out.insert(line - 1);
  return out;
}

using Texts = std::vector<std::string>;
using Lines = std::set<std::uint32_t>;

} // namespace

TEST_CASE("mikroprog programs: what means the same is written") {
  CHECK(blocks("G0 X30. Z2.\nG1 Z-5. F0.2\nX32.\n") == Texts{"G0 X30 Z2", "G1 Z-5 F0.2", "G1 X32"});
  CHECK(blocks("G0 X30. Z2.\nU2. W-1.\n") == Texts{"G0 X30 Z2", "G0 X32 Z1"});
  CHECK(blocks("G97 S500 M3\nM8\nS600\nM9\nM5\n") == Texts{"M3 S500", "M8", "S600", "M9", "M5"});
  CHECK(blocks("G4 P500\nG4 X1.5\nG4 U2.\n") == Texts{"G4 E0.5", "G4 E1.5", "G4 E2"});
  CHECK(blocks("G98\nG99\nG18 G40\n") == Texts{"G94", "G95", "G18 G40"});
  CHECK(blocks("T0303\n") == Texts{"M6 T3"});
  CHECK(blocks("G28 U0 W0\n") == Texts{"G98"});
  CHECK(blocks("G54\nG21\n") == Texts{});
  CHECK(blocks("G50 S2000\nG97 S2000 M3\n") == Texts{"M3 S2000"});
  CHECK(blocks("S500 M3\nG0 X29. Z5.\nG32 Z-20. F1.5\n") == Texts{"M3 S500", "G0 X29 Z5", "G33 Z-20 K1.5"});
  CHECK(blocks("M0(MEASURE)\n") == Texts{"M0"});
  // A feed of a block that moves in rapid, threads or does not move is that of the next move in feed.
  CHECK(blocks("F0.2\nG0 X30. Z2.\nG1 Z-5.\nZ-6.\n") == Texts{"G0 X30 Z2", "G1 Z-5 F0.2", "G1 Z-6"});
  CHECK(blocks("S500 M3\nG0 X29. Z5.\nG32 Z-20. F1.5\nG1 X35.\n") ==
        Texts{"M3 S500", "G0 X29 Z5", "G33 Z-20 K1.5", "G1 X35 F1.5"});
  // I and K count from the start in the source; a corner of radius 10 is at most a quarter turn.
  CHECK(blocks("G0 X20. Z0.\nG3 X40. Z-10. K-10. F0.1\n") == Texts{"G0 X20 Z0", "G3 X40 Z-10 R10 F0.1"});
  CHECK(blocks("G0 X20. Z0.\nG3 X40. Z-10. R10. F0.1\n") == Texts{"G0 X20 Z0", "G3 X40 Z-10 R10 F0.1"});
  // The single cycle and the block that repeats it.
  CHECK(blocks("G0 X64. Z2.\nG90 X56. Z-40. F0.25\nX52.\n") ==
        Texts{"G0 X64 Z2", "G0 X56", "G1 X56 Z-40 F0.25", "G1 X64", "G0 Z2", "G0 X52", "G1 X52 Z-40",
              "G1 X64", "G0 Z2"});
  CHECK(blocks("G0 X64. Z2.\nG94 X10. Z-1. F0.25\n") ==
        Texts{"G0 X64 Z2", "G0 Z-1", "G1 X10 Z-1 F0.25", "G1 Z2", "G0 X64"});
  CHECK(blocks("G17 G90 G54\nT3 M6\nG0 G43 H3 Z50.\nG0 X10. Y10.\nG91 G1 X5. F100.\n", false) ==
        Texts{"G17", "M6 T3", "G0 Z50", "G0 X10 Y10", "G1 X15 F100"});
}

TEST_CASE("mikroprog programs: each word without a counterpart is refused at its line") {
  for (const char* block : {"G55",
                            "G50 S2000 X5.",
                            "G96 S150 M3",
                            "G28 U0",
                            "G28 X10. Z10.",
                            "T0102",
                            "T0900",
                            "T1",
                            "G70 P10 Q20",
                            "G71 U2. R1.",
                            "G76 P010060 Q100 R0.1",
                            "G92 X29. Z-10. F1.5",
                            "G50 X10. Z10.",
                            "M1",
                            "M7",
                            "M98 P7",
                            "M41",
                            "G1 X30.12345 F0.1",
                            "G0 X10. Q3.",
                            "/G0 X50.",
                            "#1=5.",
                            "G1 X#1",
                            "G65 P9001 A1.",
                            "G20",
                            "G0 Y5.",
                            "G0 U1.",
                            "M99",
                            "G0 X1. U1.",
                            "G10 L2 P1 X0.",
                            "G53 X0."}) {
    CAPTURE(block);
    CHECK(refusedLines(std::string(block) + "\n") == Lines{1});
  }
  CHECK(refusedLines("G50 S2000\nS2001 M3\n") == Lines{1});
  CHECK(refusedLines("G50 S2000\nG96 S100 M3\n") == Lines{1, 2});
  CHECK(refusedLines("G0 X20. Z0.\nG3 X20. Z0. K-10. F0.1\n") == Lines{2}); // a full turn
  CHECK(refusedLines("G0 X20. Z0.\nG32 X30. Z-30. F1.5\n") == Lines{2});    // a taper
  CHECK(refusedLines("G0 X20. Z0. T0101\n") == Lines{1});
  CHECK(refusedLines("G41 G0 X10. D5\n", false) == Lines{1});
}

// In a table of all codes and letters: a block is in the result, in a note or in an error; no word is lost.
TEST_CASE("mikroprog programs: no code and no word is dropped in silence") {
  for (const bool lathe : {true, false}) {
    const stdlib::Control& source = sourceControl(lathe);
    for (const stdlib::CodeInfo& code : source.codes) {
      const std::string name =
          code.letter + (code.tenths % 10 == 0 ? std::to_string(code.tenths / 10)
                                               : fmt::format("{}.{}", code.tenths / 10, code.tenths % 10));
      CAPTURE(name);
      const bool ends =
          code.function == stdlib::Function::ProgramEnd || code.function == stdlib::Function::Return;
      const Converted alone = converted("O1\nG0 X20. Z5.\n" + name + "\n" + (ends ? "" : "M30\n"), lathe);
      const bool motion = code.letter == 'G' && code.group == 1; // in force for the blocks to come
      CHECK((alone.speaksOf(3) || motion));
      for (const char letter : std::string_view("ABCDEHIJKLPQRSTUVWY")) {
        CAPTURE(letter);
        const std::string block = fmt::format("{} {}7.{}", name, letter, letter == 'P' ? "" : "25");
        const Converted with = converted("O1\nG0 X20. Z5.\n" + block + "\n" + (ends ? "" : "M30\n"), lathe);
        if (!with.lines) {
          CHECK(with.speaksOf(3));
          continue;
        }
        // The word is in the result: without it, that is another one.
        CHECK((!alone.lines || with.text() != alone.text() ||
               with.diagnostics.all().size() > alone.diagnostics.all().size()));
      }
    }
  }
}

TEST_CASE("mikroprog programs: subprograms come after M30, once for each call") {
  const Converted result = converted("O1\nM98 P2 L2\nM98 P3\nM30\nO2\nG0 X10. Z1.\nM99\nO3\nM98 P2\nM99\n");
  REQUIRE(result.lines);
  CHECK(result.text() ==
        ";FROM a, FOR fanuc-0i-tf\nN10 G18 G90 G95\nN20 G26 L1000\nN30 G26 L1000\nN40 G26 L2000\n"
        "N50 M30\nN1000 G0 X10 Z1\nN1010 M17\nN2000 G26 L1000\nN2010 M17\n");
  // Where the tool is after a call is not known.
  CHECK(converted("O1\nG0 X10. Z1.\nM98 P2\nG0 U1.\nM30\nO2\nG0 X5.\nM99\n").errorLines() == Lines{4});
  CHECK(converted("O1\nM30\nO2\nM99\n").errorLines() == Lines{3}); // nobody calls it
}

TEST_CASE("mikroprog programs: the result runs as the source does") {
  const std::string text =
      "O1\nT0101\nG97 S1200 M3\nG0 X64. Z2. M8\nG90 X56. Z-40. F0.25\nX52.\nG0 X40. Z0.\n"
      "G3 X60. Z-10. K-10. F0.1\nG1 W-5.\nG4 P500\nM98 P2\nG0 X60. Z5.\nG98\nG1 U4. F200.\n"
      "M9\nM5\nM30\nO2\nG0 X62. Z-12.\nG1 X50. F0.1\nG0 X62.\nM99\n";
  const Converted result = converted(text);
  REQUIRE(result.lines);
  const auto kept = [](std::string trace) { // what both say in the same words
    std::string out;
    for (std::size_t at = 0; at < trace.size();) {
      const std::size_t end = trace.find('\n', at);
      const std::string line = trace.substr(at, end - at);
      at = end + 1;
      const bool tool = line.starts_with("tool");
      if (!tool) out += line + "\n";
    }
    return out;
  };
  std::string source, target;
  {
    const stdlib::Control& control = sourceControl(true);
    sim::Machine machine(control);
    sim::Trace trace([&](std::string_view piece) { source += piece; });
    machine.setTrace(&trace);
    std::vector<const ir::Program*> programs;
    for (const ir::Program& one : result.programs->programs)
      programs.push_back(&one);
    const sim::Bytecode code = sim::compile(programs, control, result.sources);
    Limits limits;
    sim::Run run(machine, code, limits);
    run.run();
    CHECK(machine.end().ending == sim::Ending::ProgramEnd);
    machine.setTrace(nullptr);
  }
  {
    MikroprogRun run(result.text(), loadMikroprog("mikroprog-s280"));
    sim::Trace trace([&](std::string_view piece) { target += piece; });
    run.machine.setTrace(&trace);
    run.start();
    CHECK_MESSAGE(run.ending() == sim::Ending::ProgramEnd, run.why());
    run.machine.setTrace(nullptr);
  }
  CHECK(kept(source) == kept(target));
}

TEST_CASE(
    "mikroprog: all examples of the post for mills convert, and lint has nothing against the programs") {
  const DataFolder folder;
  const auto example = [](const char* name) { return (root() / "examples" / name).generic_string(); };
  for (const char* cycle : {"surface-x", "surface-y", "surface-z", "corner-xyz", "bore"}) {
    CAPTURE(cycle);
    std::vector<std::string> arguments = {"convert",     example(cycle),
                                          "--prog",      example("mill-post.txt"),
                                          "--to",        "mikroprog",
                                          "--control",   "mikroprog-mill",
                                          "--assume",    "Q7,Q10,Q13",
                                          "--host",      "tool_radius=3,overtravel=5,return_feed=1000",
                                          "--host",      "start_x=0",
                                          "--host",      "start_y=0,start_z=60",
                                          "--clearance", "5",
                                          "-o",          "A.SUF"};
    if (cycle == std::string("surface-z")) arguments.insert(arguments.end(), {"--set", "D=-10"});
    const auto converted = runDotek(arguments, folder.path());
    CHECK_MESSAGE(converted.status == 0, converted.out);
    const auto linted = runDotek(
        {"lint", "A.SUF", "--control", "mikroprog-mill", "--ignore", "suf-datum-lasts,suf-parameter-use"},
        folder.path());
    CHECK_MESSAGE(linted.out.empty(), linted.out);
  }
}
