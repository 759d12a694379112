// Of long stretches of plain moves lint keeps some blocks: it finds the same with all of them.
#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"
#include "frontend/macrob/Stretch.h"
#include "lint/Analyses.h"
#include "lint/Run.h"
#include "stdlib/DataFiles.h"
#include "support/Files.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <random>

namespace fs = std::filesystem;
using namespace dotek;
using namespace dotek::tests;
namespace macrob = dotek::frontend::macrob;
using macrob::Keep;
using macrob::Stretch;

namespace {

// Moves one above the other, each with other numbers.
std::string moves(int count, const char* form = "X{0}.5 Y-{0}.25\n") {
  std::string out;
  for (int i = 1; i <= count; ++i)
    out += fmt::format(fmt::runtime(form), i);
  return out;
}

struct Read {
  SourceMap sources;
  Diagnostics diagnostics;
  macrob::File file;
  explicit Read(const std::string& text, Keep keep = Keep::Summary, const Limits& limits = {}) {
    const FileId id = sources.add(SourceFile("p.nc", text, Encoding::Cp1250));
    file = macrob::parse(id, sources, limits, diagnostics, macrob::Text::Program, macrob::Reader::Fast, {},
                         keep);
  }
  std::uint64_t leftOut() const { return file.leftOut.blocks; }
  std::size_t blocks() const {
    std::size_t out = 0;
    for (const macrob::Program& program : file.programs)
      out += program.blocks.size();
    return out;
  }
};

std::uint64_t leftOut(const std::string& text) {
  return Read(text).leftOut();
}

// What lint finds, each a line, in the order of printing.
std::vector<std::string> findings(const std::string& text, Keep keep, const stdlib::Control* control) {
  static const stdlib::DataFiles data;
  static const auto gibbs = stdlib::GibbsKeywords::load(data);
  static const auto compost = stdlib::ComPostKeywords::load(data);
  static const auto fallback = stdlib::Control::load(data, "fanuc-0i-md");
  Read read(text, keep);
  const Limits limits;
  Diagnostics ignored;
  auto lowered = macrob::lower(read.file, control != nullptr ? *control : *fallback, read.sources, ignored,
                               macrob::LowerFor::Rules);
  lint::Project project{read.sources, limits, gibbs, compost};
  project.control = control;
  project.controls = std::span(&*fallback, 1);
  project.analyses = std::make_shared<lint::Analyses>();
  project.programs.push_back(
      {&read.file, lowered ? std::make_shared<const ir::ProgramFile>(std::move(*lowered)) : nullptr});
  Diagnostics separate;
  lint::runRules(project, read.diagnostics, separate, [](const lint::NamedRule&) { return true; });
  lint::moveInto(read.diagnostics, separate);
  read.diagnostics.sort();
  std::vector<std::string> out;
  for (const Diagnostic& one : read.diagnostics.all()) {
    const LineColumn place = read.sources.file(one.range.file).place(one.range.begin);
    std::string line = fmt::format("{:06}:{} {} {}", place.line, place.column, one.code, one.message);
    for (const DiagnosticNote& note : one.notes)
      line +=
          fmt::format(" | {} {}", note.range.hasPlace() ? read.sources.line(note.range) : 0, note.message);
    out.push_back(std::move(line));
  }
  return out;
}

// Findings of programs that are elsewhere with a part.
std::size_t moved = 0;

// The same findings, save that a rule that speaks of each block speaks of those that are kept. "": it is so.
std::string difference(const std::string& text, const stdlib::Control* control) {
  std::vector<std::string> all = findings(text, Keep::All, control);
  std::vector<std::string> summary = findings(text, Keep::Summary, control);
  // It compares with all coordinates of the program.
  for (auto* list : {&all, &summary})
    std::erase_if(*list, [](const std::string& one) {
      return one.find(" coordinate-as-distance ") != std::string::npos;
    });
  const auto words = [](const std::string& one) { return one.substr(one.find(' ') + 1); };
  const auto code = [&](const std::string& one) { return words(one).substr(0, words(one).find(' ')); };
  // What is said of the first block of a kind may be said of a later one that is kept.
  const auto lacks = [&](const std::vector<std::string>& list, const std::string& one) {
    return std::none_of(list.begin(), list.end(),
                        [&](const std::string& other) { return code(other) == code(one); });
  };
  for (const std::string& one : summary)
    if (lacks(all, one)) return "with a part alone: " + one;
  for (const std::string& one : all)
    if (lacks(summary, one)) return "with all alone: " + one;
  std::size_t elsewhere = 0;
  for (const std::string& one : summary)
    elsewhere += std::find(all.begin(), all.end(), one) == all.end() ? 1 : 0;
  moved += elsewhere;
  return "";
}

// Programs as a CAM prints them, and as hands spoil them.
class Cam {
public:
  explicit Cam(unsigned seed) : random_(seed), numbers_(chance(3)), eachCode_(chance(4)) {}

  std::string file() {
    std::string out = "%\n";
    const int programs = chance(4) ? 2 : 1;
    for (int i = 0; i < programs; ++i)
      out += program(i);
    return out + "%\n";
  }

private:
  int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool chance(int of) { return number(1, of) == 1; }
  std::string line(const std::string& text) {
    line_ += 10;
    return (numbers_ ? fmt::format("N{} ", line_) : "") + text + (chance(40) ? "\r\n" : "\n");
  }
  std::string coordinate(int& at) {
    if (!chance(30)) at += number(-900, 900);
    return chance(60) ? "0." : fmt::format("{:.3f}", at / 1000.);
  }
  std::string move() {
    if (chance(25) && !words_.empty()) return line(words_);
    if (chance(70)) return "\n";
    std::string out;
    if (eachCode_ || chance(30)) out += chance(5) ? "G0 " : "G1 ";
    const int axes = number(1, 7);
    if ((axes & 1) != 0) out += "X" + coordinate(x_);
    if ((axes & 2) != 0) out += "Y" + coordinate(y_);
    if ((axes & 4) != 0) out += " Z" + coordinate(z_);
    if (chance(50) && !out.starts_with("G0")) out += fmt::format(" F{}.", number(1, 3000));
    words_ = out;
    return line(out);
  }
  std::string special() {
    switch (number(1, 24)) {
    case 1: return line("G91") + line("X1. Y-2.") + (chance(2) ? line("G90") : "");
    case 2: return line("G91 G28 Z0.") + line("G90");
    case 3: return line("G41 D1 X1.");
    case 4: return line("G40 X2.");
    case 5: return line("G2 X5. Y5. I2.5 J2.5");
    case 6: return line("G17 G3 X1. Y1. R0.1");
    case 7: return line("G81 X1. Y1. Z-5. R1. F100.") + (chance(2) ? line("G80") : "");
    case 8: return line("G65 P9810 X1.") + (chance(2) ? line("G90") : "");
    case 9: return line("M98 P100");
    case 10:
      return line("#1=#5041+1.") + line("IF[#1GT5.]GOTO" + std::to_string(number(1, 90) * 10)) + line("G90");
    case 11: return "N" + std::to_string(number(1, 90) * 10) + " X1.\n";
    case 12: return line("M5");
    case 13: return line("T2 M6");
    case 14: return line("G43 H1 Z50.");
    case 15: return line("G49");
    case 16: return line("X1000 Y.5");
    case 17: return line("G31 Z-5. F50.") + line("#100=#5063");
    case 18: return line("G66 P9000 A1.") + (chance(2) ? line("G67") + line("G90") : "");
    case 19: return line("G53 Z0.");
    case 20: return line("G68 X0. Y0. R30.") + (chance(2) ? line("G69") : "");
    case 21: return line("G0 X0. F100.");
    case 22: return line("(A COMMENT)");
    case 23: return line("WHILE[#1LT5]DO1") + line("G90") + stretch() + line("#1=#1+1") + line("END1");
    default: return line("G92 X0.");
    }
  }
  std::string stretch() {
    std::string out;
    for (int i = number(1, 250); i > 0; --i)
      out += move();
    return out;
  }
  std::string program(int index) {
    std::string out = index == 0 ? "O1\n" : "O100\n";
    if (!chance(5)) out += line("G21 G17 G40 G49 G80 G90 G54");
    if (!chance(3)) out += line("T1 M6") + line("G0 G43 H1 Z50. S1000 M3");
    if (!chance(3)) out += line("G1 Z1. F100.");
    for (int i = number(1, 5); i > 0; --i)
      out += stretch() + (chance(3) ? "" : special());
    return out + (chance(6) ? "" : line(index == 0 ? "M30" : "M99"));
  }

  std::mt19937 random_;
  bool numbers_, eachCode_;
  int line_ = 0, x_ = 0, y_ = 0, z_ = 0;
  std::string words_;
};

} // namespace

TEST_CASE("macrob stretch: some blocks of a long stretch of moves are kept") {
  const std::string text = "O1\nG90 G1 F100.\n" + moves(1000) + "M30\n";
  const Read all(text, Keep::All);
  CHECK(all.leftOut() == 0);
  CHECK(all.blocks() == 1002);
  const Read summary(text);
  CHECK(summary.blocks() + summary.leftOut() == 1002);
  CHECK(summary.blocks() < 50);
  CHECK(summary.file.programs.size() == 1);
  CHECK(summary.file.leftOut.lengths == 2 * summary.leftOut());
  CHECK(summary.diagnostics.empty());
  // The first and the last ones are among them.
  const std::vector<macrob::Block>& blocks = summary.file.programs.front().blocks;
  CHECK(summary.sources.text(blocks[1].range) == "X1.5 Y-1.25");
  CHECK(summary.sources.text(blocks[Stretch::kEdge].range) == "X16.5 Y-16.25");
  CHECK(summary.sources.text(blocks[blocks.size() - 2].range) == "X1000.5 Y-1000.25");
}

TEST_CASE("macrob stretch: what a finding may depend on is kept") {
  const auto keeps = [](const std::string& line, const std::string& before = "", int count = 100) {
    const std::string text =
        "O1\nG90 G1 F100.\n" + moves(count) + before + line + "\n" + moves(count) + "M30\n";
    const Read read(text);
    CHECK(read.leftOut() > 0);
    const auto& blocks = read.file.programs.front().blocks;
    return std::any_of(blocks.begin(), blocks.end(),
                       [&](const macrob::Block& one) { return read.sources.text(one.range) == line; });
  };
  CHECK_FALSE(keeps("X7.5 Y-7.2"));
  CHECK(keeps("X7. Y1. Z1."));             // other letters
  CHECK(keeps("X5000. Y-7.2"));            // farther than all others
  CHECK(keeps("G0 X7.5 Y-7.2"));           // another motion
  CHECK(keeps("X7.5 Y-7.2 F50."));         // the last F
  CHECK(keeps("X7.5", "X7.5\n"));          // written twice
  CHECK(keeps("Z-3.", "Z4.\nZ5.\nZ2.\n")); // the lowest
  // What is no plain move ends the stretch.
  for (const char* line : {"X7", "x7.5", "X7.5 X8.", "X7.5(NOTE)", "/X7.5", "X+7.5", "X77777.5", "U1.",
                           "G2 X1. R1.", "X#1", "X7.5 F0", "G0 X7.5 F50.", "X7.12345", "N5", "M8"}) {
    CAPTURE(line);
    CHECK(keeps(line));
  }
}

TEST_CASE("macrob stretch: nothing is left out where jumps, distances or macros may meet it") {
  const std::string head = "O1\nG90 G1 F100.\n";
  CHECK(leftOut(head + moves(100) + "M30\n") > 0);
  CHECK(leftOut(head + moves(63) + "M30\n") == 0);              // short
  CHECK(leftOut("O1\nG1 F100.\n" + moves(100) + "M30\n") == 0); // a caller may have said G91
  CHECK(leftOut("O1\nG91 G1 F100.\n" + moves(100) + "M30\n") == 0);
  CHECK(leftOut("O1\n/G90 G1 F100.\n" + moves(100) + "M30\n") == 0);
  CHECK(leftOut(head + "G91 G28 Z0.\n" + moves(100) + "M30\n") == 0);
  CHECK(leftOut(head + "G91 G28 Z0.\nG90\n" + moves(100) + "M30\n") > 0);
  CHECK(leftOut(head + "M30\nO2\n" + moves(100) + "M99\n") == 0);
  CHECK(leftOut(head + "M98 P2\n" + moves(100) + "M30\n") == 0);
  CHECK(leftOut(head + "G66 P9000\nG90\n" + moves(100) + "M30\n") == 0);
  CHECK(leftOut(head + "G66 P9000\nX1.\nG67\nG90\n" + moves(100) + "M30\n") > 0);
  CHECK(leftOut(head + "IF[#1EQ1]GOTO5\n" + moves(100) + "N5 M30\n") == 0);
  CHECK(leftOut(head + "(G91)\n" + moves(100) + "M30\n") > 0);
  // Numbers of blocks count where something may go to them.
  const std::string numbered = moves(100, "N{0} X{0}.5\n");
  CHECK(leftOut(head + numbered + "M30\n") > 0);
  CHECK(leftOut(head + numbered + "GOTO5\nM30\n") == 0);
  CHECK(leftOut(head + numbered + "go to 5\nM30\n") == 0);
  CHECK(leftOut(head + numbered + "M99 P5\n") == 0);
  CHECK(leftOut(head + numbered + "M099\n") > 0);
  CHECK(leftOut(head + numbered + "M98 P7 Q5\nM30\n") == 0);
  CHECK(leftOut(head + numbered + "G71 P5 Q9 U1.\nM30\n") == 0);
}

TEST_CASE("macrob stretch: rules find the same on random programs of a CAM") {
  const stdlib::DataFiles data;
  const auto control = stdlib::Control::load(data, "fanuc-0i-md");
  const auto haas = stdlib::Control::load(data, "haas-ngc");
  std::uint64_t left = 0;
  std::size_t found = 0;
  const unsigned count = draws(400U);
  for (unsigned seed = 1; seed <= count; ++seed) {
    const std::string text = Cam(seed).file();
    left += leftOut(text);
    found += findings(text, Keep::Summary, &*control).size();
    for (const stdlib::Control* one : {static_cast<const stdlib::Control*>(nullptr), &*control, &*haas}) {
      CAPTURE(seed);
      CHECK(difference(text, one) == "");
    }
  }
  CHECK(moved == 0);
  CHECK(left > count * 50);
  CHECK(found > count);
}

TEST_CASE("macrob stretch: rules find the same on the corpus") {
  fs::path corpus;
  if (!haveCorpus(corpus)) return;
  const stdlib::DataFiles data;
  const auto control = stdlib::Control::load(data, "fanuc-0i-md");
  for (const auto& entry : fs::recursive_directory_iterator(corpus)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".nc" && ending != ".NC" && ending != ".tap" && ending != ".txt") continue;
    const std::string text = readAll(entry.path());
    if (leftOut(text) == 0) continue;
    CAPTURE(entry.path().string());
    CHECK(difference(text, nullptr) == "");
    CHECK(difference(text, &*control) == "");
  }
}

TEST_CASE("macrob: what would be kept beyond the limit is one error at its place") {
  Limits limits;
  limits.keptBytes = 100000;
  const Read plain("O1\nG90 G1 F100.\n" + moves(1000) + "M30\n", Keep::All, limits);
  REQUIRE(plain.diagnostics.all().size() == 1);
  CHECK(plain.diagnostics.all().front().code == "file-too-large");
  CHECK(plain.diagnostics.all().front().range.begin > 0);
  CHECK(plain.file.tooLarge);
  CHECK(plain.file.hasErrors);
  CHECK(plain.file.programs.empty());
  // The same text fits where its moves are left out; a text that does not fit itself is not read.
  CHECK_FALSE(Read("O1\nG90 G1 F100.\n" + moves(1000) + "M30\n", Keep::Summary, limits).file.tooLarge);
  CHECK(Read("O1\nG90 G1 F100.\n" + moves(3000) + "M30\n", Keep::Summary, limits).file.tooLarge);
  // What the grammar has to read takes more.
  std::string sums = "O1\n";
  for (int i = 0; i < 100; ++i)
    sums += "#1=ATAN[1+2]/[3]\n";
  CHECK(Read(sums + "M30\n", Keep::All, limits).file.tooLarge);
}
