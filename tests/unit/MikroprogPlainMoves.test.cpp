// Of a long program of Mikroprog lint keeps some of the plain moves: it finds the same with all of them.
#include "DataFolder.h"
#include "MikroprogHelper.h"
#include "frontend/mikroprog/Parse.h"
#include "lint/Analyses.h"
#include "lint/Project.h"
#include "lint/Run.h"
#include "stdlib/ComPostKeywords.h"
#include "stdlib/GibbsKeywords.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"

#include <random>

using namespace dotek;
using namespace dotek::tests;
namespace mikroprog = frontend::mikroprog;

namespace {

std::size_t kept(const std::string& text, std::string_view axes = "XYZ") {
  SourceMap sources;
  Diagnostics diagnostics;
  const FileId file = sources.add(SourceFile("P.SUF", text, Encoding::Utf8));
  return mikroprog::parse(file, sources, diagnostics, {}, {axes, 0}).lines.size();
}
std::string moves(std::size_t count, std::size_t from, const std::string& code = "G1 ") {
  std::string out;
  for (std::size_t i = 0; i < count; ++i)
    out += fmt::format("N{} {}X{}.5 Z-{}.25\n", from + 10 * i, code, 10 + i % 30, i % 40);
  return out;
}

// Each as line, place, code and text; of all rules but those that look at each move.
std::vector<std::string> findings(const std::string& text, const stdlib::MikroprogControl& control,
                                  const mikroprog::Keeping& keeping) {
  static const stdlib::DataFiles data;
  static const auto gibbs = stdlib::GibbsKeywords::load(data);
  static const auto compost = stdlib::ComPostKeywords::load(data);
  SourceMap sources;
  Diagnostics diagnostics;
  const Limits limits;
  const FileId file = sources.add(SourceFile("P.SUF", text, Encoding::Utf8));
  const auto program = mikroprog::parse(file, sources, diagnostics, limits, keeping);
  const mikroprog::Reading reading(program, control, sources);
  lint::Project project{sources, limits, gibbs, compost};
  project.analyses = std::make_shared<lint::Analyses>();
  project.sufPrograms.push_back(&reading);
  Diagnostics separate;
  lint::runRules(project, diagnostics, separate, [](const lint::NamedRule& rule) {
    return rule.id != "suf-zeros" && rule.id != "suf-short-form" && rule.id != "suf-not-joined";
  });
  lint::moveInto(diagnostics, separate);
  diagnostics.sort();
  std::vector<std::string> out;
  for (const Diagnostic& one : diagnostics.all())
    out.push_back(fmt::format("{}-{} {} {}", one.range.begin, one.range.end, one.code, one.message));
  return out;
}

// Programs as a CAM writes them, with what rules speak of between their moves.
class Cam {
public:
  explicit Cam(unsigned seed) : random_(seed) {}
  std::string file() {
    std::string out = block("G18 G90 G94");
    out += block("M6 T1");
    if (chance(3)) out += block("M3 S800");
    for (int i = 0; i < 12; ++i)
      out += stretch(), out += chance(6) ? "" : special();
    out += chance(5) ? "" : block("M30");
    if (chance(2)) out += "N90000 G1 Z-1\nN90010 M17\n";
    return out;
  }

private:
  unsigned below(unsigned n) { return static_cast<unsigned>(random_() % n); }
  bool chance(unsigned n) { return below(n) == 0; }
  std::string block(const std::string& text) { return fmt::format("N{} {}\n", number_ += 10, text); }
  std::string length() { return fmt::format("{}{}.{}", chance(2) ? "-" : "", below(60), 1 + below(9)); }
  std::string stretch() {
    const std::string code = chance(3) ? "" : chance(4) ? "G0 " : "G1 ";
    const unsigned letters = below(3), count = below(20);
    const std::string feed = chance(4) ? fmt::format(" F{}.5", below(7)) : "";
    std::string out;
    for (unsigned i = 0; i < count; ++i)
      out += block(code +
                   (letters == 0   ? "X" + length()
                    : letters == 1 ? "Z" + length()
                                   : "X" + length() + " Z" + length()) +
                   feed);
    return out;
  }
  std::string special() {
    switch (below(26)) {
    case 0: return block("G1 Z-1 F100");
    case 1: return block("G2 X" + length() + " Z" + length() + " R5");
    case 2: return block("G3 X10 Z2 R0.5");
    case 3: return block(chance(2) ? "G1 X3 FP1" : "G1 X2 Z4 F80");
    case 4: return block(chance(2) ? "M5" : chance(2) ? "P1=5 ;FEED" : "P1=0.5");
    case 5: return block("M4 S500");
    case 6: return block("G24");
    case 7: return block("G90");
    case 8: return block("G91");
    case 9: return block("G41");
    case 10: return block("G96 A2000");
    case 11: return block(fmt::format("G27 L{}", 10 * below(number_ / 10 + 20)));
    case 12: return block(fmt::format("G23 L{} O1", 10 * below(number_ / 10 + 20)));
    case 13: return block("G26 L90000");
    case 14: return block("G78 X20 Z-10 U0.2 K1");
    case 15: return block("G64 X20 Z-10 U1");
    case 16: return block("M40");
    case 17: return block("G31 X5 L10");
    case 18: return block("G92 X0");
    case 19: return block("G95");
    case 20: return block("G1 X1.23456");
    case 21: return block("HELLO");
    case 22: return block("G1 X1 X2");
    case 23: return chance(9) ? "N10 G0 X1\n" : "";
    case 24: return block("M6 T2");
    default: return ";COMMENT\n";
    }
  }

  std::mt19937 random_;
  unsigned number_ = 0;
};

} // namespace

TEST_CASE("mikroprog plain moves: some of a long run of them are kept") {
  const std::string head = "N1 G18 G90\nN2 M3 S500\nN3 G1 X1 Z1 F100\n";
  CHECK(kept(head + moves(100, 10) + "N2000 M30\n") == 3 + 1 + 1);
  CHECK(kept(head + moves(100, 10) + "N2000 M30\n", "") == 3 + 100 + 1);
  CHECK(kept(head + moves(100, 10, "") + "N2000 M30\n") == 3 + 2 + 1);
  CHECK(kept(head + moves(2, 10) + "N2000 M30\n") == 3 + 1 + 1);
  // A feed in each, as in the last block of the head; before a G31 one more.
  CHECK(kept(head + moves(100, 10, "G1 F100 ") + "N2000 M30\n") == 3 + 1 + 1);
  CHECK(kept(head + moves(100, 10) + "N2000 G31 X5\n") == 3 + 2 + 1);
  // A feed, a parameter, an arc between them: the line before an arc says where it begins.
  const std::string rest = moves(50, 1000) + "N2000 M30\n";
  CHECK(kept(head + moves(50, 10) + "N900 G1 X1 Z1 F90\n" + rest) == 3 + 1 + 1 + 1);
  CHECK(kept(head + moves(50, 10) + "N900 P1=-0.5\n" + rest) == 3 + 1 + 1 + 1);
  CHECK(kept(head + moves(50, 10) + "N900 G2 X1 Z1 R5\n" + rest) == 3 + 1 + 1 + 1 + 1);
  CHECK(kept(head + moves(50, 10) + "N900 G1 X3 FP1\n" + rest) == 3 + 1 + 1 + 1 + 1);
  for (const char* other : {"P1=P2", "M8", "G2 X1 Z1 L5", "G1 XP1", ";A", "G2 X1 ;A"})
    CHECK_MESSAGE(kept(head + moves(50, 10) + "N900 " + other + "\n" + rest) == 3 + 1 + 1 + 2 + 1, other);
  // Another code or other letters.
  CHECK(kept(head + moves(50, 10) + moves(50, 1000, "G0 ") + "N2000 M30\n") == 3 + 3 + 1);
  // A letter that the control does not have.
  CHECK(kept(head + moves(100, 10) + "N2000 M30\n", "XY") == 3 + 100 + 1);
}

TEST_CASE("mikroprog plain moves: nothing is left out that a jump or a sum may need") {
  const std::string head = "N1 G18 G90\nN3 G1 X1 Z1 F100\n";
  CHECK(kept(head + moves(100, 10) + "N2000 G27 L500\n") == 2 + 2 + 1);
  CHECK(kept(head + "N5 G91\n" + moves(100, 10) + "N2000 M30\n") == 3 + 100 + 1);
  CHECK(kept(head + "N5 G24\n" + moves(100, 10) + "N2000 M30\n") == 3 + 100 + 1);
  // Numbers that do not rise.
  CHECK(kept(head + moves(100, 10) + "N500 M30\n") == 2 + 100 + 1);
  CHECK(kept(head + moves(50, 10) + moves(50, 400) + "N2000 M30\n") == 2 + 100 + 1);
  const auto around = [&](const std::string& odd) {
    return kept(head + moves(2, 10) + "N40 G1 " + odd + "\n" + moves(2, 50) + "N90 M30\n");
  };
  for (const char* odd : {"X+1", "G2 X1", "X1;A", "X1.", "X", "XP1"})
    CHECK_MESSAGE(around(odd) == 2 + 4 + 1, odd);
  // A move, whatever is wrong with it: the line after it says all again.
  for (const char* odd : {"X1.2345", "X123456", "X1 X2", "X1 F0.5", "X1 FP1"})
    CHECK_MESSAGE(around(odd) == 2 + 3 + 1, odd);
}

TEST_CASE("mikroprog plain moves: rules find the same on random programs of a CAM") {
  const stdlib::DataFiles data;
  const auto lathe = loadMikroprog("mikroprog-s280"), mill = loadMikroprog("mikroprog-mill");
  std::size_t found = 0, left = 0;
  const unsigned count = draws(400U);
  for (unsigned seed = 1; seed <= count; ++seed) {
    const std::string text = Cam(seed).file();
    CAPTURE(seed);
    for (const auto* control : {&lathe, &mill}) {
      CHECK(mikroprog::takesPlainMoves(*control));
      const auto all = findings(text, *control, {});
      const auto some = findings(text, *control, {control->axes, 0});
      CHECK(all == some);
      found += all.size();
    }
    left += kept(text, "") - kept(text);
  }
  CHECK(found > count);
  CHECK(left > count * 10);
}

TEST_CASE("mikroprog plain moves: more than may be kept is one error at its place") {
  const std::string text = "N1 G18 G90\nN3 G1 X1 Z1 F100\n" + moves(3000, 10) + "N50000 M30\n";
  Limits limits;
  limits.keptBytes = 1'000'000;
  for (const std::string_view axes : {"", "XZ"}) {
    SourceMap sources;
    Diagnostics diagnostics;
    const FileId file = sources.add(SourceFile("P.SUF", text, Encoding::Utf8));
    const auto program = mikroprog::parse(file, sources, diagnostics, limits, {axes, 0});
    CHECK(program.lines.empty() == axes.empty());
    CHECK(diagnostics.all().size() == (axes.empty() ? 1 : 0));
    if (axes.empty()) CHECK(diagnostics.all().front().code == "file-too-large");
  }
}
