// `dotek flatten`: the flat program does what its source does.
#include "DataFolder.h"
#include "driver/ProgramTools.h"
#include "tests/Draws.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <random>
#include <sstream>

using namespace dotek;
using namespace dotek::tests;

namespace {

class Flat {
public:
  // `setup`: part, machine and what an operator sets.
  explicit Flat(const std::string& text, std::string control = "fanuc-31i-b",
                const driver::SimOptions& setup = {})
      : setup_(setup) {
    setup_.control = std::move(control);
    folder_.write("source.nc", text);
    driver::SimOptions options = setup_;
    options.program = folder_.path() + "/source.nc";
    out = driver::flatten(options);
    folder_.write("flat.nc", out.output);
  }
  bool has(std::string_view code) const {
    return std::any_of(out.diagnostics.all().begin(), out.diagnostics.all().end(),
                       [&](const Diagnostic& one) { return one.code == code; });
  }
  // Lines of the trace, those of variables aside: a flat program sets none.
  std::string trace(const char* name, int& status) const {
    std::string all;
    driver::SimOptions options = setup_;
    options.program = folder_.path() + "/" + name;
    if (std::string_view(name) == "flat.nc") options.setup.call.clear();
    options.trace = [&](std::string_view text) { all += text; };
    status = driver::sim(options).status;
    std::istringstream lines(all);
    std::string line, kept;
    while (std::getline(lines, line))
      if (!line.starts_with("variable ")) kept += line + "\n";
    return kept;
  }
  // The runs of both do the same; false where the source does not come to its end.
  bool same() const {
    int source = 0, flat = 0;
    const std::string before = trace("source.nc", source);
    if (source != 0) {
      CHECK(out.status == 1);
      CHECK(out.output.empty());
      return false;
    }
    CAPTURE(out.output);
    REQUIRE(out.status == 0);
    CHECK(before == trace("flat.nc", flat));
    CHECK(flat == 0);
    return true;
  }

  driver::Outcome out;

private:
  DataFolder folder_;
  driver::SimOptions setup_;
};

// A plate of 100 x 80 x 20 with a bore of 30 at X30 Y40, Z0 at its upper face, in G54; the probe is tool 1.
class Plate {
public:
  Plate() {
    folder_.write("part.toml",
                  "schema = 1\n[place]\nshift = [-300.0, -200.0, -400.0]\n"
                  "[[shape]]\nkind = \"box\"\nmin = [0.0, 0.0, -20.0]\nmax = [100.0, 80.0, 0.0]\n"
                  "[[shape]]\nkind = \"hole\"\nat = [30.0, 40.0, 0.0]\ndiameter = 30.0\nthrough = true\n");
    folder_.write("machine.toml", "schema = 1\n[setup]\ntool = 1\nwork_offset = { G54 = \"part\" }\n"
                                  "[probe]\ntool = 1\nball_diameter = 6.0\neffective_radius = 2.99\n"
                                  "length = 180.0\nlength_to = \"tip\"\nstem_diameter = 4.0\n"
                                  "stem_length = 50.0\nbody_diameter = 40.0\nbody_length = 60.0\n"
                                  "overtravel = 6.0\non = true\n");
    setup.part = folder_.path() + "/part.toml";
    setup.machine = folder_.path() + "/machine.toml";
  }
  driver::SimOptions setup;

private:
  DataFolder folder_;
};

std::string randomProgram(std::mt19937& random) {
  const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  std::string text = fmt::format("O{}\nG{} G90 G54 G0 X0 Y0 Z50.\nS#[0] M3\n#500={}.{}\n", 1 + pick(9000),
                                 20 + pick(2), pick(90), pick(1000));
  const auto value = [&]() -> std::string {
    switch (pick(8)) {
    case 0: return fmt::format("#{}", 500 + pick(3)); // may be null
    case 1: return fmt::format("[#500*{}/7]", 1 + pick(9));
    case 2: return fmt::format("[{}.5-#1]", pick(40));
    case 3: return fmt::format("-{}.{:03}", pick(50), pick(1000));
    case 4: return fmt::format("[SIN[#500]*{}]", pick(60));
    case 5: return "#0";
    case 6: return fmt::format("[ROUND[#500/{}]]", 1 + pick(6));
    default: return fmt::format("{}.", pick(100));
    }
  };
  const int loops = 1 + pick(3);
  for (int loop = 0; loop < loops; ++loop) {
    text += fmt::format("#1={}\nWHILE[#1 LT {}]DO1\n", pick(2), 2 + pick(4));
    const int blocks = 1 + pick(6);
    for (int i = 0; i < blocks; ++i) {
      const std::string v = value(), w = value();
      switch (pick(14)) {
      case 0: text += fmt::format("G0 X{} Y{}\n", v, w); break;
      case 1: text += fmt::format("G1 X{} Z{} F[#500*{}+1]\n", v, w, 1 + pick(50)); break;
      case 2: text += fmt::format("G65 P8 A{} X{} I{}\n", v, w, value()); break;
      case 3: text += fmt::format("IF[#1 GT {}]THEN #501={}\n", pick(4), v); break;
      case 4: text += fmt::format("#502={}\n", v); break;
      case 5: text += pick(2) == 0 ? "G91\n" : "G90\n"; break;
      case 6: text += fmt::format("G4 P[#500*{}]\n", pick(100)); break;
      case 7: text += fmt::format("#{}={}\n", 5221 + 20 * pick(6) + pick(3), v); break;
      case 8: text += fmt::format("G{} G0 X#500\n", 54 + pick(6)); break;
      case 9: text += fmt::format("G10 L2 P{} X{} Y{}\n", 1 + pick(6), v, w); break;
      case 10: text += fmt::format("/G0 Y{} M{}\n", v, 8 + pick(2)); break;
      case 11: text += fmt::format("G81 X{} Y{} Z-5. R2. F{}\nG80\n", v, w, 100 + pick(900)); break;
      case 12: text += fmt::format("T[{}+#1]\nM6\nG43 H#1 Z50.\n", pick(9)); break;
      default: text += "#3006=1(LOOK)\n"; break;
      }
    }
    text += "#1=#1+1\nEND1\n";
  }
  return text + "M98 P9 L2\nM30\nO8\nG1 X[#24/3] F#500\nIF[#1 EQ #0]GOTO5\nG1 Z#1 F120.\n"
                "N5 G0 Y[#4*2]\nM99\nO9\nG0 Z[#500+60]\nM99\n";
}

} // namespace

TEST_CASE("flatten writes values, passes and called blocks, each with its line") {
  const Flat flat("O7(PART)\n#1=0\nG0 X#9\nWHILE[#1 LT 2]DO1\nG65 P8 X[#1*20.5] D2\n#1=#1+1\nEND1\nT#1\n"
                  "/2 G0 Y5\nM30\nO8\nG0 X#24 Y[1/3]\nG1 Z-#7 F[100/3]\nM99\n");
  CHECK(flat.out.output == "%\nO7 (FLAT: SOURCE.NC)\n"
                           "G0 (LINE 3)\n"
                           "G0 X0. Y0.333 (O0008 LINE 12)\nG1 Z-2. F33.33333333 (O0008 LINE 13)\n"
                           "G0 X20.5 Y0.333 (O0008 LINE 12)\nG1 Z-2. F33.33333333 (O0008 LINE 13)\n"
                           "T2 (LINE 8)\n/2 G0 Y5 (LINE 9)\nM30 (LINE 10)\n%\n");
  CHECK(flat.same());
}

TEST_CASE("flatten keeps offsets, messages, names and what is printed") {
  const Flat flat("O7\n#500=12.5\n#5221=#500\n#2005=-#500\n#3006=1(LOOK HERE)\nSETVN500[LEFT]\nPOPEN\n"
                  "DPRNT[X*#500[43]*END]\nPCLOS\nG0 X#5221\nM30\n");
  CHECK(flat.out.output.find("#5221=12.5 (LINE 3)") != std::string::npos);
  CHECK(flat.out.output.find("#3006=1(LOOK HERE)\n") != std::string::npos);
  CHECK(flat.out.output.find("*12.500*END] (LINE 8)") != std::string::npos);
  CHECK(flat.same());
  CHECK_FALSE(flat.has("flatten-reads")); // it has set #5221 itself
}

TEST_CASE("flatten says what its blocks depend on, and refuses what no plain program does") {
  CHECK(Flat("O7\nG0 X[#5221+1.]\nM30\n").has("flatten-reads"));
  CHECK(Flat("O7\n/#1=5\nG0 X#1\nM30\n").has("flatten-switch"));
  CHECK(Flat("O7\nG0 X[#501]\nM30\n").has("variable-not-set"));
  CHECK(Flat("O7\n#500=1\nPOPEN\nBPRNT[#500[0]]\nPCLOS\nM30\n").has("flatten-binary"));
  CHECK(Flat("O7\n#500=1\nPOPEN\nDPRNT[A,B]\nPCLOS\nM30\n").has("flatten-text"));
  CHECK(Flat("O7\n#3000=5(NO TOOL)\nM30\n").out.output.empty());
  CHECK(Flat("O7\nG31 X10. F100.\nM30\n").out.output.empty()); // what it touches no plain block says
  DataFolder folder;
  folder.write("a.nc", "O7\n#1=0\nWHILE[#1 LT 9999]DO1\nG0 X#1\n#1=#1+1\nEND1\nM30\n");
  driver::SimOptions options;
  options.program = folder.path() + "/a.nc";
  options.common.limits.outputBytes = 1000;
  const driver::Outcome out = driver::flatten(options);
  CHECK(out.status == 1);
  CHECK(out.output.empty());
  CHECK(out.diagnostics.all().front().code == "flatten-long");
}

TEST_CASE("a flat program runs as its source: random programs") {
  std::mt19937 random(20261124);
  int ran = 0;
  const int rounds = draws(200);
  for (int round = 0; round < rounds; ++round) {
    const std::string text = randomProgram(random);
    CAPTURE(text);
    ran += Flat(text, round % 2 == 0 ? "fanuc-31i-b" : "fanuc-0i-md").same() ? 1 : 0;
  }
  CHECK(ran * 2 > rounds);
}

TEST_CASE("flatten runs a macro that is called, on a part, from a place") {
  Plate plate;
  plate.setup.setup.at = {30, 40, 10};
  plate.setup.setup.call = "D30. Z-5. S55";
  const std::string macro = "O9100\n#1=#5001\n#2=#5003\nG31 Z#26 F900\nG31 X[#1+#7/2+3.] F60\n#3=#5061\n"
                            "G0 X#1\nG31 X[#1-#7/2-3.] F60\n#4=#5061\nG0 X[[#3+#4]/2]\n"
                            "#[5221+[#19-54]*20]=[#3+#4]/2\nG0 Z#2\nM99\n";
  const Flat flat(macro, "fanuc-31i-b", plate.setup);
  CHECK(flat.same());
  CHECK(flat.has("flatten-position"));
  CHECK(flat.out.output.find("(O9100 LINE 5)") != std::string::npos);
  CHECK(flat.out.output.find("M30 (--CALL LINE ") != std::string::npos);
  CHECK(flat.out.output.find("G65") == std::string::npos);
  // As for sim, whose words name the command.
  driver::SimOptions noProbe = plate.setup;
  noProbe.machine.reset();
  const Flat without(macro, "fanuc-31i-b", noProbe);
  CHECK(without.out.output.empty());
  REQUIRE(without.has("missing-option"));
  CHECK(without.out.diagnostics.all().front().message.find("flatten") != std::string::npos);
}

TEST_CASE("flatten keeps the call of a macro that runs by its meaning") {
  Plate plate;
  plate.setup.setup.at = {50, 40, 10};
  const Flat flat("O7\nG43 H1 Z10.\n#1=5.\nG65 P9810 X[#1*12] F[#1*100]\nG65 P9811 Z[#1-5.]\nM30\n",
                  "fanuc-31i-b", plate.setup);
  CAPTURE(flat.out.output);
  CHECK(flat.same());
  CHECK(flat.out.output.find("G65 P9810 F500. X60. (LINE 4)") != std::string::npos);
  CHECK(flat.out.output.find("G65 P9811 Z0. (LINE 5)") != std::string::npos);
  const Flat second("O7\nG43 H1 Z10.\nG65 P9811 Z0 I1. I2. I3. I4.\nM30\n", "fanuc-31i-b", plate.setup);
  CHECK(second.out.output.empty());
}

TEST_CASE("flatten warns of each use of what a macro without text has measured") {
  Plate plate;
  plate.setup.setup.at = {50, 40, 10};
  const std::string before = "O7\nG43 H1 Z10.\n#137=1.\n#1=#137\nG65 P9832\nG65 P9811 Z0. S2\n";
  const auto warned = [&](const std::string& use) {
    const Flat flat(before + use + "\nM30\n", "fanuc-31i-b", plate.setup);
    CAPTURE(use);
    CAPTURE(flat.out.output);
    REQUIRE(flat.out.status == 0);
    CHECK_FALSE(flat.has("flatten-reads"));
    return std::count_if(flat.out.diagnostics.all().begin(), flat.out.diagnostics.all().end(),
                         [](const Diagnostic& one) { return one.code == "flatten-position"; });
  };
  CHECK(warned("#5223=#137") == 1);
  CHECK(warned("#1=#137*2.\nG0 X#1") == 1); // where it is read; what follows from it is part of that
  CHECK(warned("G0 X#137\nG1 Y#137 F100.") == 1);
  CHECK(warned("#1=137\n#2=#[#1]") == 1);
  CHECK(warned("IF[#137 GT 0.1]GOTO5\nG0 X1.\nN5") == 1);
  CHECK(warned("G65 P9810 X[#137+50.] F100.") == 1);
  CHECK(warned("G65 P8 X1.\nM30\nO8\nG0 X[#24+#137]\nM99") == 1);
  CHECK(warned("POPEN\nDPRNT[Z#137[43]]\nPCLOS") == 1);
  CHECK(warned("#1=#137\n#2=#5243") == 2);
  CHECK(warned("#5221=#5243") == 1); // the offset that it has set
  CHECK(warned("#137=5.\nG0 X#137\n#5243=2.\n#5223=#5243") == 0);
  CHECK(warned("#1=137\n#[#1]=5.\nG0 X#137") == 0);
  CHECK(warned("G0 X1.") == 0);
}

TEST_CASE("flatten names everything that the blocks depend on") {
  std::string text = "O7\n";
  for (int i = 1; i <= 60; ++i)
    text += fmt::format("#{}=#{}\n", 100 + i % 40, 2000 + i);
  const Flat flat(text + "M30\n");
  const auto& all = flat.out.diagnostics.all();
  CHECK(std::count_if(all.begin(), all.end(),
                      [](const Diagnostic& one) { return one.code == "flatten-reads"; }) == 60);
}

TEST_CASE("a flat program of a macro on a part runs as its source: random touches") {
  std::mt19937 random(20261125);
  const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  int ran = 0;
  const int rounds = draws(60);
  for (int round = 0; round < rounds; ++round) {
    Plate plate;
    plate.setup.setup.at = {30.0 + pick(5) - 2, 40.0 + pick(5) - 2, 10};
    plate.setup.setup.call = fmt::format("D{}. Z-{}.{}", 28 + pick(5), 3 + pick(5), pick(10));
    std::string macro = "O9100\n#10=#5001\n#11=#5002\n#12=#5003\nG31 Z#26 F900\n#1=0\n"
                        "WHILE[#1 LT 4]DO1\n#2=#1*90.\n";
    macro += fmt::format("G31 X[#10+[#7/2+4.]*COS[#2]] Y[#11+[#7/2+4.]*SIN[#2]] F{}\n", 30 + pick(300));
    macro += "#[20+#1]=#5061\n#[28+#1]=#5062\nG0 X#10 Y#11\n#1=#1+1\nEND1\n";
    macro += pick(2) == 0 ? "IF[#20 GT #22]THEN #5241=[#20+#22]/2\n" : "G10 L2 P2 X[[#20+#22]/2] Y#29\n";
    macro += "G0 Z#12\nG0 X[[#20+#22]/2]\nM99\n";
    CAPTURE(macro);
    CAPTURE(plate.setup.setup.call);
    ran += Flat(macro, round % 2 == 0 ? "fanuc-31i-b" : "fanuc-0i-md", plate.setup).same() ? 1 : 0;
  }
  CHECK(ran * 4 > rounds * 3);
}
