// Fragments of Fanuc lathe programs for Mikroprog: each is refused at the lines that have no certain
// counterpart, and at no other; of the others no word is lost.
#include "MikroprogConversion.h"

using namespace dotek;
using namespace dotek::tests;

namespace {

using Lines = std::set<std::uint32_t>;

struct Fragment {
  std::string name;
  std::string text;             // between O1 and M30
  Lines refused = {};           // from 1
  std::string more = "";        // after M30: subprograms
  const char* result = nullptr; // a block of it
};

std::string program(const Fragment& one, const std::string& text) {
  return "O1\n" + text + "M30\n" + one.more;
}

const std::vector<Fragment>& fragments() {
  static const std::vector<Fragment> all = {
      {"start",
       "G21 G40 G54\nG28 U0 W0\nT0101\nG97 S1200 M3\nG0 X62. Z2. M8\nG1 X60. F0.2\nM9\nM5\n",
       {},
       "",
       "M3 S1200"},
      {"clamp without effect", "G50 S2000\nT0101\nG97 S1200 M3\nG0 X62. Z2.\n", {}, "", "M6 T1"},
      {"clamp of a surface speed", "G50 S2000\nT0101\nG96 S180 M3\nG0 X62. Z2.\nG1 Z-30. F0.2\n", {1, 3}},
      {"clamp below a speed", "G50 S1000\nT0101\nG97 S1500 M3\n", {1}},
      {"clamp with coordinates", "G50 X100. Z50. S1000\n", {1}},
      {"thread in two lines",
       "T0303\nG97 S600 M3\nG0 X29. Z5.\nG76 P021060 Q100 R0.05\nG76 X26.16 Z-20. P920 Q300 F1.5\nG0 X60. "
       "Z60.\n",
       {4, 5}},
      {"thread cycle and its passes",
       "S600 M3\nG0 X30. Z5.\nG92 X28.2 Z-20. F1.5\nX27.6\nX27.2\nG0 X60. Z60.\n",
       {3, 4, 5}},
      {"thread passes",
       "S600 M3\nG0 X28.2 Z5.\nG32 Z-20. F1.5\nG0 X35.\nZ5.\nX27.6\nG32 Z-20. F1.5\n",
       {},
       "",
       "G33 Z-20 K1.5"},
      {"roughing and finishing",
       "G0 X62. Z2.\nG71 U2. R0.5\nG71 P10 Q20 U0.4 W0.1 F0.25\nN10 G0 X20.\nG1 Z-20. F0.1\nN20 X62.\nG70 "
       "P10 Q20\n",
       {2, 3, 7}},
      {"pecking", "G0 X0 Z5.\nG74 R1.\nG74 Z-30. Q5000 F0.1\nG0 Z50.\n", {2, 3}},
      {"grooving", "G0 X42. Z-10.\nG75 R0.5\nG75 X30. Z-16. P2000 Q2500 F0.05\n", {2, 3}},
      {"subprogram", "M98 P2 L2\nG0 X60. Z60.\n", {}, "O2\nG0 X30. Z2.\nG1 Z-5. F0.1\nM99\n", "G26 L1000"},
      {"subprogram elsewhere", "G0 X30.\nM98 P7\nG0 X60. Z60.\n", {2}},
      {"dwells", "G4 P1500\nG4 X1.5\nG4 U0.5\n", {}, "", "G4 E1.5"},
      {"one axis home", "G28 U0\nG28 W0\n", {1, 2}},
      {"second home", "G30 U0 W0\n", {1}},
      {"single cycles",
       "G0 X64. Z2.\nG90 X56. Z-40. F0.25\nX52. R-2.\nG94 X10. Z-1. F0.2\n",
       {},
       "",
       "G1 X56 Z-40 F0.25"},
      {"macro statements", "#100=5.\nIF[#100GT3]GOTO10\nG0 X#100\nN10 G0 X1.\n", {1, 2, 3}},
      {"units of feed", "G0 X30. Z2.\nG99 G1 X28. F0.2\nG98 G1 Z-5. F100.\n", {}, "", "G94"},
      {"offsets and places", "T0304\nG10 L2 P1 Z-5.\nG53 X0 Z0\nG55\n", {1, 2, 3, 4}},
      {"codes of the builder", "M41\nM19\nM7\nM1\nM10\n", {1, 2, 3, 4, 5}},
      {"compensation", "G0 X30. Z2.\nG42 G0 X20. Z0.\nG1 Z-20. F0.1\nG40 G0 X40.\n", {}, "", "G42"},
      {"corners", "G0 X30. Z2.\nG1 X40. ,C2. F0.1\nG1 Z-9. ,R1.\n", {2, 3}},
      {"arcs",
       "G0 X20. Z0.\nG3 X40. Z-10. R10. F0.1\nG2 X60. Z-20. I10. K0\nG3 X40. Z-30. R-10.\n",
       {4},
       "",
       ""},
      {"one step back", "G0 X20. Z0.\nG1 W-5. F0.1\nU2.\nG0 U10. W5.\n", {}, "", "G0 X32 Z0"},
      {"repeats in P", "M98 P20002\nM98 P2\n", {}, "O2\nG0 X30. Z2.\nG1 Z-5. F0.1\nM99\n", "G26 L1000"},
      {"the same system again", "G54\nT0101\nG0 X30. Z2.\nG54\nT0202\nG0 X30. Z2.\n", {}, "", "M6 T2"},
      {"holes of a cycle",
       "G0 X0 Z5.\nG83 Z-30. Q5000 F0.1\nZ-40.\nG80\nG0 Z50.\nG84 Z-20. F1.\nZ-21.\nG0 Z5.\n",
       {2, 3, 6, 7}},
      {"a variable lead", "S500 M3\nG0 X20. Z5.\nG34 Z-20. F1. K0.1\nZ-30.\nG0 X60.\n", {3, 4}},
      {"a way after the turret has turned",
       "T0101\nG0 X100. Z100.\nT0202\nG0 U-10.\nW-5.\nG0 X50. Z2.\nT0202\nW-5.\n",
       {4, 5}},
      {"a cycle after the turret has turned", "G0 X64. Z2.\nT0202\nG90 X56. Z-40. F0.25\n", {3}},
      {"a thread over two blocks", "S500 M3\nG0 X30. Z5.\nG32 Z-10. F2.\nZ-20.\nG0 X40.\n", {4}},
      {"speed, feed and time below what there is",
       "S-5\nG4 P-1\nG0 X30. Z5.\nG1 Z0 F0.\nG1 Z-1. F-.2\nM3 S-9\n",
       {1, 2, 4, 5, 6}},
      {"an F of the other unit",
       "G0 X9. Z1.\nG1 X8. F.1\nG98\nG1 X7.\nX6. F90.\nG98\nX5.\nG0 X6. F80.\nG99\nG1 X7.\n",
       {4, 10}},
      {"two codes for one thing", "S300\nM5 M3\nM8 M9\nM3 M4\nM5 M9\n", {2, 3, 4}},
  };
  return all;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    out.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

// All that a user sees of a conversion.
std::string said(const Converted& one) {
  std::string out = one.lines ? one.text() : "";
  for (const Diagnostic& d : one.diagnostics.all())
    out += std::string(d.code) + d.message + "\n";
  return out;
}

} // namespace

TEST_CASE("mikroprog fragments: refusals are at their lines, and what converts is there") {
  CHECK(fragments().size() >= 20);
  for (const Fragment& one : fragments()) {
    CAPTURE(one.name);
    const Converted result = converted(program(one, one.text));
    Lines lines;
    for (const std::uint32_t line : result.errorLines())
      lines.insert(line - 1);
    CHECK(lines == one.refused);
    CHECK(result.lines.has_value() == one.refused.empty());
    if (one.result != nullptr && result.lines) CHECK(result.text().find(one.result) != std::string::npos);
  }
}

TEST_CASE("mikroprog fragments: every word is in the result, in a note or in an error") {
  std::size_t words = 0;
  for (const Fragment& one : fragments()) {
    CAPTURE(one.name);
    // Without the lines that are refused.
    std::vector<std::string> lines;
    const std::vector<std::string> all = linesOf(one.text);
    std::string text;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (one.refused.contains(static_cast<std::uint32_t>(i + 1))) continue;
      lines.push_back(all[i]);
      text += all[i] + "\n";
    }
    const Converted complete = converted(program(one, text));
    CHECK(complete.lines.has_value());
    const std::string whole = said(complete);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (std::size_t at = 0; at <= lines[i].size();) {
        const std::size_t end = std::min(lines[i].find(' ', at), lines[i].size());
        const std::string word = lines[i].substr(at, end - at);
        std::string without;
        for (std::size_t j = 0; j < lines.size(); ++j)
          without +=
              (j == i ? lines[j].substr(0, at) + (end < lines[j].size() ? lines[j].substr(end + 1) : "")
                      : lines[j]) +
              "\n";
        at = end + 1;
        // In force already, or of a block number: nothing that could be lost.
        const bool again = word == "G0" || word == "G1" || word == "K0" || word.starts_with("N");
        CAPTURE(lines[i]);
        CAPTURE(word);
        CHECK((again || said(converted(program(one, without))) != whole));
        ++words;
      }
    }
  }
  CHECK(words > 80);
}

TEST_CASE(
    "mikroprog fragments: a subprogram has the speed, the feed and the modes of its calls, or says its own") {
  const auto errors = [](const std::string& text) { return converted("O1\n" + text).errorLines(); };
  // The speed of the call, not that at the end of the program.
  const Converted one = converted("O1\nS700 M3\nM5\nM98 P2\nS900 M3\nM30\nO2\nM3\nG0 X20.\nM99\n");
  REQUIRE(one.lines);
  CHECK(one.text().find("N1000 M3 S700") != std::string::npos);
  CHECK(errors("S700 M3\nM5\nM98 P2\nS900\nM98 P2\nM30\nO2\nM3\nG0 X20.\nM99\n") == Lines{9});
  // What it leaves.
  CHECK(errors("S700 M3\nM5\nM98 P2\nM3\nM30\nO2\nM3 S200\nG0 X20.\nM99\n") == Lines{5});
  CHECK(errors("S700 M3\nM98 P2\nM3\nM30\nO2\nG0 X20.\nM99\n").empty());
  // An F that no move before the call could take.
  const std::string cut = "M30\nO2\nG1 X20.\nM99\n";
  CHECK(errors("G0 X40. Z5.\nG1 X39. F.1\nM98 P2\n" + cut).empty());
  CHECK(errors("G0 X40. Z5.\nG1 X39. F.1\nF.3\nM98 P2\n" + cut) == Lines{8});
  CHECK(errors("G0 X40. Z5.\nM98 P2\nG1 X39.\nM30\nO2\nG0 X20. Z5.\nF.2\nM99\n") == Lines{4});
  CHECK(errors("G0 X40. Z5.\nM98 P2\nG1 X39. F.1\nM30\nO2\nG0 X20. Z5.\nF.2\nM99\n").empty());
  // Modes.
  const std::string whole = "G0 X40. Z5.\nM98 P2\nG1 X5. F10\nM30\nO2\n";
  CHECK(errors("G98\n" + whole + "G98\nM99\n").empty());
  CHECK(errors("G98\n" + whole + "G99\nM99\n") == Lines{5});
  const std::string arc = "M30\nO2\nG0 X30. Z0.\nG2 X40. Z-5. R5. F.1\nM99\n";
  CHECK(errors("M98 P2\n" + arc).empty());
  CHECK(errors("M98 P2\nG17\nM98 P2\n" + arc) == Lines{8});
}

TEST_CASE("mikroprog fragments: a subprogram of ways is written in place of its calls") {
  const Converted grooves = converted(
      "O1\nG0 X40. Z0.\nM98 P20002\nG1 X30. F.1\nM30\nO2\n(GROOVE)\nG0 W-4.\nG1 X36. F.1\nG0 U4.\nM99\n");
  REQUIRE(grooves.lines);
  CHECK(grooves.text().find(";GROOVE\nN30 G0 Z-4\nN40 G1 X36 F0.1\nN50 G0 X40\n;GROOVE\nN60 G0 Z-8\n") !=
        std::string::npos);
  CHECK(grooves.text().find("M17") == std::string::npos);
  CHECK(converted("O1\nM98 P2\nM30\nO2\nG0 U1.\nM99\n").errorLines() == Lines{5});
  // One that ends the program, one that calls itself, one without an end.
  const Converted ends = converted("O1\nG0 X4.\nM98 P30002\nG0 X9.\nM30\nO2\nG0 U1.\nM30\n");
  REQUIRE(ends.lines);
  CHECK(ends.text().find("G0 X5\nN40 M30\n") != std::string::npos);
  CHECK(ends.text().find("X9") == std::string::npos);
  CHECK(converted("O1\nG0 X4.\nM98 P2\nM30\nO2\nG0 U1.\nM98 P2\nM99\n").errorLines() == Lines{7});
  CHECK_FALSE(converted("O1\nG0 X4.\nM98 P2\nM30\nO2\nG0 U1.\n").lines);
  // Within one that is called.
  const Converted nested = converted("O1\nM98 P2\nM30\nO2\nG0 X5. Z5.\nM98 P3\nM99\nO3\nG0 W-1.\nM99\n");
  REQUIRE(nested.lines);
  CHECK(nested.text().find("N1000 G0 X5 Z5\nN1010 G0 Z4\nN1020 M17\n") != std::string::npos);
  const Converted mill =
      converted("O1\nG90 G0 X4. Y0\nM98 P2\nG0 X0\nM30\nO2\nG91 G0 X2.\nG90\nM99\n", false);
  REQUIRE(mill.lines);
  CHECK(mill.text().find("G0 X6\n") != std::string::npos);
}

TEST_CASE("mikroprog fragments: what no move and no way leads to is left out with a note") {
  const auto notes = [](const std::string& text) {
    const Converted one = converted(text);
    REQUIRE(one.lines);
    std::string out;
    for (const Diagnostic& d : one.diagnostics.all())
      out += d.message + "\n";
    return out + one.text();
  };
  const std::string after = notes("O1\nG0 X1.\nM30\nG0 X5.\n");
  CHECK(after.find("the program has ended before it") != std::string::npos);
  CHECK(after.find("X5") == std::string::npos);
  CHECK(notes("O1\nG0 X1. F.2\nM30\n").find("`F0.2` is left out") != std::string::npos);
  CHECK(notes("O1\nG0 X1. F.2\nG1 X2. F.3\nM30\n").find("`F0.2` is left out") != std::string::npos);
  CHECK(notes("O1\nG0 X1. F.2\nG1 X2.\nM30\n").find("left out") == std::string::npos);
  CHECK(notes("O1\nS5 M3\nG0 X1. Z2.\nG32 Z1. F2.\nM30\n").find("left out") == std::string::npos);
}
