// examples/pocket-6m: every pass lies on the surface that it finishes, and docs/pocket-6m.md prints what the
// runs give, with the programs' formulas and with those of the listing.
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"
#include "tests/unit/PageCommands.h"
#include "tests/unit/PocketGeometry.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace fs = std::filesystem;
using namespace dotek::tests;
using namespace dotek::tests::pocket;

namespace {

using Names = std::vector<std::string_view>;

// The programs in the order in which main.nc calls them.
enum Program : std::size_t { kO110, kO100, kO70, kO80At20, kO80At10, kO80, kO20At2, kO20, kO40, kO60, kAll };

const Names kOutside = {"cylinder", "outside"};
const Names kPocket = {"cylinder", "floor", "wall 70", "wall X30", "wall 66", "wall 93", "eye"};
const Names kUp = {"cylinder", "floor"};
Names upOf(const Names& surfaces) {
  return surfaces.front() == kOutside.front() && surfaces.size() == 2 ? Names{"cylinder"} : kUp;
}
const Names kPocketWalls = {"wall 70", "wall X30", "wall 66", "wall 93", "eye"};

class Family {
public:
  Family() : folder_("dotek-pocket") {
    fs::create_directories(folder_ / "examples");
    fs::copy(root() / "examples/pocket-6m", folder_ / "examples/pocket-6m", fs::copy_options::recursive);
  }
  const TestFolder& folder() const { return folder_; }
  std::string read(const std::string& name) const {
    return readAll(folder_ / ("examples/pocket-6m/" + name));
  }
  void write(const std::string& name, const std::string& text) const {
    folder_.write("examples/pocket-6m/" + name, text);
  }
  CommandResult run(const std::string& command) const {
    return runDotek(splitArguments(command), folder_.path());
  }
  CommandResult sim(const std::string& further = "") const {
    return run("sim examples/pocket-6m/main.nc --control examples/pocket-6m/6m.toml --programs "
               "examples/pocket-6m/macros "
               "--machine examples/pocket-6m/machine.toml" +
               further);
  }
  std::vector<std::vector<Move>> moves(const std::string& further = "") const {
    const CommandResult result = sim(further);
    CAPTURE(result.err);
    CHECK(result.status == 0);
    auto out = movesOf(result.out);
    REQUIRE(out.size() == kAll);
    return out;
  }

private:
  TestFolder folder_;
};

// Lines of one program in the place of others.
struct Change {
  std::string file, from, to;
};

std::string signedMm(double value) {
  return std::abs(value) < 0.0005 ? "0.000" : fmt::format("{:.3f}", value);
}

void checkRow(const std::string& page, const std::string& row) {
  CHECK_MESSAGE(page.find(row + "\n") != std::string::npos, "docs/pocket-6m.md has no row\n" << row);
}

std::string afterRow(std::string_view program, std::string_view onto, const Surfaces& part,
                     const std::vector<Move>& moves, const Names& surfaces, const Names& walls, bool down) {
  const std::vector<Move> passes = passesOf(moves, 20, down);
  return fmt::format("| {} | {} | {} | {} | {} | {} |", program, onto, passes.size(),
                     signedMm(offSurface(part, passes, upOf(surfaces))),
                     signedMm(offWalls(part, passes, walls)), signedMm(deepest(part, moves, surfaces)));
}

} // namespace

TEST_CASE("pocket: every finishing pass lies on the surfaces, and the page prints by how much") {
  const Family family;
  const Surfaces part;
  const std::string page = readAll(root() / "docs/pocket-6m.md");
  const auto moves = family.moves();
  checkRow(page, afterRow("O20", "cylinder, outer wall", part, moves[kO20], kOutside, {"outside"}, false));
  checkRow(page,
           afterRow("O40", "cylinder, walls 70° and X30", part, moves[kO40], kPocket, kPocketWalls, true));
  checkRow(page, afterRow("O60", "floor, walls 66.536° and 93.91°, eye", part, moves[kO60], kPocket,
                          kPocketWalls, false));
  for (const Program program : {kO20, kO40, kO60}) {
    const bool inside = program != kO20;
    const auto passes = passesOf(moves[program], 20, program == kO40);
    CHECK(std::abs(offSurface(part, passes, inside ? kUp : Names{"cylinder"})) < 0.002);
    CHECK(std::abs(offWalls(part, passes, inside ? kPocketWalls : Names{"outside"})) < 0.002);
    CHECK(deepest(part, moves[program], inside ? kPocket : kOutside) > -0.002);
  }
  // With an allowance the cylinder alone is larger.
  CHECK(offSurface(part, passesOf(moves[kO20At2], 20, false), {"cylinder"}) ==
        doctest::Approx(2).epsilon(0.001));

  // Roughing: how much is left.
  const auto rough = [&](std::string_view name, Program program, double radius) {
    std::string row = fmt::format("| {} |", name);
    for (const std::string_view surface : kPocket)
      row += " " + signedMm(flatMill(part, moves[program], radius, surface)) + " |";
    checkRow(page, row);
    for (const std::string_view surface : kPocket)
      CHECK(flatMill(part, moves[program], radius, surface) > 0.3);
  };
  rough("O110", kO110, 31.5);
  rough("O100", kO100, 16);
  rough("O70", kO70, 16);
  rough("O80", kO80, 16);

  // A mill that is 0.1 smaller in radius, as its offset says, finishes the same surfaces; the two walls at
  // the floor, whose place the programs take from the ball, move.
  const auto worn = family.moves(" --var 2005=-0.1");
  const double ball = kBall - 0.1;
  CHECK(std::abs(offSurface(part, passesOf(worn[kO20], 20, false), {"cylinder"}, ball)) < 0.002);
  CHECK(std::abs(offSurface(part, passesOf(worn[kO40], 20, true), kUp, ball)) < 0.002);
  CHECK(std::abs(offSurface(part, passesOf(worn[kO60], 20, false), kUp, ball)) < 0.002);
  CHECK(std::abs(offWalls(part, passesOf(worn[kO20], 20, false), {"outside"}, ball)) < 0.002);
  CHECK(std::abs(offWalls(part, passesOf(worn[kO40], 20, true), {"wall 70", "wall X30"}, ball)) < 0.002);
  const std::string moved = signedMm(offWalls(part, passesOf(worn[kO60], 20, false), kPocketWalls, ball));
  CHECK_MESSAGE(page.find("by " + moved + " mm at the floor") != std::string::npos, moved);
}

TEST_CASE("pocket: what the formulas of the listing would do, one at a time") {
  const Family family;
  const Surfaces part;
  const std::string page = readAll(root() / "docs/pocket-6m.md");
  const auto with = [&](const std::vector<Change>& changes, const auto& measure, const std::string& row) {
    std::map<std::string, std::string> kept;
    for (const Change& change : changes) {
      std::string text = family.read(change.file);
      kept.emplace(change.file, text);
      const std::size_t at = text.find(change.from);
      REQUIRE_MESSAGE(at != std::string::npos, change.file << ": " << change.from);
      family.write(change.file, text.replace(at, change.from.size(), change.to));
    }
    CAPTURE(row);
    const CommandResult result = family.sim();
    const auto moves = movesOf(result.out);
    checkRow(page, fmt::format("| {} | {} |", row, measure(moves, result)));
    for (const auto& [name, text] : kept)
      family.write(name, text);
  };
  using All = std::vector<std::vector<Move>>;
  const auto into = [&](Program program, const Names& surfaces) {
    return [&part, program, surfaces](const All& moves, const CommandResult& result) {
      return moves.size() > program ? signedMm(deepest(part, moves[program], surfaces))
                                    : result.err.substr(0, 200);
    };
  };
  const auto off = [&](Program program) {
    return [&part, program](const All& moves, const CommandResult& result) {
      return moves.size() > program ? signedMm(offSurface(part, passesOf(moves[program], 20, program == kO40),
                                                          program == kO20 ? Names{"cylinder"} : kUp))
                                    : result.err.substr(0, 200);
    };
  };
  const auto walls = [&](Program program) {
    return [&part, program](const All& moves, const CommandResult& result) {
      const Names names = program == kO20 ? Names{"outside"} : kPocketWalls;
      return moves.size() > program
                 ? signedMm(offWalls(part, passesOf(moves[program], 20, program == kO40), names))
                 : result.err.substr(0, 200);
    };
  };
  const auto flat = [&](Program program, double radius, std::string_view name) {
    return [&part, program, radius, name](const All& moves, const CommandResult& result) {
      return moves.size() > program ? signedMm(flatMill(part, moves[program], radius, name))
                                    : result.err.substr(0, 200);
    };
  };
  const std::string m = "macros/";
  with({{m + "O20.nc", "#100=#1+#105+#21", "#100=#1+#105*#21"}}, off(kO20),
       "O20 | `#100 = #1 + #105 * #21` | cylinder");
  with({{m + "O10.nc", "#103=1.+#102*#102", "#103=1.+#102*#101"}, {m + "O10.nc", "[2.*#103]", "[2.*#104]"}},
       walls(kO20), "O10 | `#103 = 1. + #102 * #101`, `/ [2. * #104]` | outer wall");
  with({{m + "O20.nc", "N10 G91 Z2. F500", "N10 Y[#102+1.] F500\nG91 Z2."}}, into(kO20, {"cylinder"}),
       "O20 | `N10 Y[#102 + 1.] F 500` | cylinder");
  with({{m + "O20.nc", "#117=SQRT[[1.-#118*#118]*#114]-#118*#112", "#117=#105-COS[20.]*[#105-SQRT[#114]]"}},
       walls(kO20), "O20 | `#117 = #105 - #116`, along X | edge of the outer wall");
  with({{m + "O30.nc", "#106=1.+#104", "#106=1.+#100"},
        {m + "O30.nc", "#107=2.*#103", "#107=2.*#101"},
        {m + "O30.nc", "#108=#103*#103-#104*#102*#102", "#108=#101*#101-#100*#102*#102"},
        {m + "O30.nc", "4.*#106*#108", "4.*#106*#107"},
        {m + "O30.nc", "[SQRT[#109]+#107]/[2.*#106]", "[SQRT[#109]-#103]/[2.*#102]"}},
       into(kO40, {"cylinder"}), "O30 | all of `#106` to `#500` | cylinder");
  with({{m + "O40.nc", "[30.-#105]/SIN[20.]\n", "[30.+#105]/SIN[20.]\n"}}, walls(kO40),
       "O40 | `#103 = .. + [#105 /SIN [20.]]` | wall 70°");
  with({{m + "O40.nc", "[#129 LT 8.]", "[#129 LE 8.]"},
        {m + "O40.nc", "X[30.-#105]\n#128=#128+#105/8.\n", "X[30.-#105]\n"}},
       off(kO40), "O40 | `WHILE [#129 LE 8.]`, one step of `#128` a pass | corner");
  with({{m + "O40.nc", "#117=#105\n", "#117=#105-16.*COS[20.]\n"}}, walls(kO40),
       "O40 | `N6 X [.. - #117]`, left by O20 | wall 70°");
  with({{m + "O45.nc", "#117=SQRT[[1.-#118*#118]*#114]+#118*#112", "#117=#105-COS[20.]*[#105-SQRT[#114]]"}},
       walls(kO40), "O40 | `#117 = #105 - #116`, along X | edge of the wall 70°");
  with({{m + "O60.nc", "#107=[54.-#105]/SIN[51.]+#105", "#107=54./SIN[39.]"}}, off(kO60),
       "O60 | `54. / SIN [39.]` | floor");
  with({{"main.nc", "P60 A80.", "P60 A40."}}, into(kO60, {"eye"}), "O60 | `A 40.` and `#1/2.` | eye");
  with({{m + "O60.nc", "#120=#120+#3\nIF[#120 LE #121]GOTO11", "#120=#120+15.4\nIF[#120 LE #121]GOTO11"}},
       off(kO60), "O60 | `G2` with Z, rows 2 mm apart | floor");
  with({{m + "O70.nc", "Y[64.+#105]", "Y[80.+#105]"}, {m + "O70.nc", "N10 G1 X13. F#9", "N10 G1 X13. F#9"}},
       flat(kO70, 16, "floor"), "O70 | `#2602 = #2602 + #105` for the slot, too | floor");
  with({{m + "O80.nc", "#139=53.5/SIN[51.]", "#139=54.5/SIN[51.]"}}, flat(kO80, 16, "floor"),
       "O80 | `70.13` = 54.5/SIN51 | floor");
  with({{m + "O80.nc", "#106=10.", "#106=13."}}, flat(kO80, 16, "wall 93"),
       "O80 | `#106 = 13.` | wall 93.91°");
  with({{m + "O80.nc", "#106=10.", "#106=13."},
        {m + "O80.nc", "IF[#106 GE -29.]GOTO7\n#106=-29.\nN7 X#106\n",
         "X#106\nIF[#106 GE -29.]GOTO7\n#106=-29.\nN7 G1 F#9\n"}},
       flat(kO80, 16, "wall 66"), "O80 | `N7 G1 x#106` before the bound of -29 | wall 66.536°");
  with({{m + "O110.nc", "X-32.4", "X-34.5"}}, flat(kO110, 31.5, "wall 66"),
       "O110 | `X[- 34.5]` | wall 66.536°");
  with(
      {{m + "O70.nc", "#134=#134-#1\nIF[#134 GE #500]GOTO4", "#134=#134+#1\nIF[#134 LE #500]GOTO4"}},
      [](const All& moves, const CommandResult& result) {
        double step = 0;
        if (moves.size() > kO70)
          for (const Move& move : moves[kO70])
            if (!move.rapid && !move.arc && move.from[0] == move.to[0] && move.to[2] < 64)
              step = std::min(step, move.to[2] - move.from[2]);
        return step < 0 ? signedMm(step) : result.err.substr(0, 200);
      },
      "O70 | `#134 = #134 + #1`, `GT` | slot, one step down");
  const auto end = [](const All&, const CommandResult& result) {
    const std::size_t at = result.err.find("error: ");
    if (at == std::string::npos) return std::string("runs");
    const std::string text = result.err.substr(at + 7, result.err.find('\n', at) - at - 7);
    return text.substr(0, std::min({text.find(';'), text.find(" ("), text.find(" at X")}));
  };
  with({{m + "O50.nc", "#138=#140-177.8", "#138=#140"}, {m + "O50.nc", "#139=#141-177.8", "#139=#141"}}, end,
       "O50 | circle about Y0 instead of Y177.8");
  with({{m + "O50.nc", "#140=#501-#102*TAN", "#140=#501+#102*TAN"}}, end,
       "O60 | `#140 = #102 * TAN [66.536] + #501`");
  with({{m + "O40.nc", "N4 G1 X", "N4 X"}}, end, "O40 | `N4 X ..` after `G3 G19`");
  with({{m + "O80.nc", "G0 G17 G43", "G0 G43"}}, end, "all | `GO G43 G56 Z 300.` while G19 of O70 holds");
  with(
      {{"main.nc", "U0 X-129.5", "U0 X129.5"}},
      [&](const All&, const CommandResult&) {
        return end({}, family.sim(" --part examples/pocket-6m/part.toml --quiet"));
      },
      "O500 | `X129.5`");
}

TEST_CASE("pocket: the commands of the page do what it says") {
  const Family family;
  const std::string page = readAll(root() / "docs/pocket-6m.md");
  std::map<std::string, CommandResult> ran;
  for (const auto& [heading, command] : commandsOf(page)) {
    if (command.find("pocket.nc") != std::string::npos || command.find("LISTING") != std::string::npos)
      continue;
    const CommandResult result = family.run(command);
    CAPTURE(command);
    CAPTURE(result.err);
    CHECK(result.status == (command.find("32.01") != std::string::npos ? 1 : 0));
    ran[command.substr(0, command.find(' '))] = result;
  }
  CHECK(ran["lint"].out == "");
  CHECK(fs::exists(family.folder() / "pocket.svg"));
  const std::string picture = readAll(family.folder() / "pocket.svg");
  CHECK(picture.find(">PASS<") != std::string::npos);
  CHECK(picture.find("0 collisions") != std::string::npos);

  // A ball as large as the mill, and 0.005 more, touches what it finishes; 0.005 less does not.
  std::string machine = family.read("machine.toml");
  machine.replace(machine.find("31.99"), 5, "32.01");
  family.write("machine.toml", machine);
  const CommandResult touch = family.sim(" --part examples/pocket-6m/part.toml --quiet");
  CHECK(touch.status == 1);
  CHECK(touch.err.find("the ball touches the part") != std::string::npos);
}

TEST_CASE("pocket: the programs of the 0i-MD make the same moves") {
  const Family family;
  const auto& folder = family.folder();
  const std::string page = readAll(root() / "docs/pocket-6m.md");
  const std::string controls =
      " --from-control examples/pocket-6m/6m.toml --control examples/pocket-6m/0i-md.toml --to fanuc ";
  std::string inputs = "examples/pocket-6m/main.nc", whole;
  const auto append = [&](const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      if (line != "%") whole += line + "\n";
  };
  append(family.read("main.nc"));
  for (const char* name :
       {"O10", "O15", "O20", "O30", "O40", "O45", "O50", "O60", "O70", "O80", "O90", "O100", "O110"}) {
    inputs += fmt::format(" examples/pocket-6m/macros/{}.nc", name);
    append(std::string_view(name) == "O15" ? "O15\n#105=0\nM99\n"
                                           : family.read(fmt::format("macros/{}.nc", name)));
  }
  const CommandResult made = family.run("convert " + inputs + controls + "-d new --keep-going");
  CHECK(made.status == 1);
  CHECK(made.err.find("13 of 14 inputs converted; refused: `examples/pocket-6m/macros/O15.nc`") !=
        std::string::npos);
  // By hand, as the page has it.
  const std::size_t at = page.find("    O0015");
  REQUIRE(at != std::string::npos);
  std::string byHand;
  std::istringstream lines(page.substr(at, page.find("\n\n", at) - at));
  for (std::string line; std::getline(lines, line);)
    byHand += line.substr(4) + "\n";
  folder.write("new/O15.nc", byHand);
  const auto movesOnly = [](const std::string& trace) {
    std::string out;
    std::istringstream in(trace);
    for (std::string line; std::getline(in, line) && !line.starts_with("variable ");)
      out += line + "\n";
    return out;
  };
  const std::string machine = " --machine examples/pocket-6m/machine.toml --programs ";
  const CommandResult before = family.sim();
  const CommandResult after =
      family.run("sim new/main.nc --control examples/pocket-6m/0i-md.toml" + machine + "new");
  CHECK(after.status == 0);
  CHECK(movesOnly(before.out).size() > 50000);
  CHECK(movesOnly(before.out) == movesOnly(after.out));
  const std::string worn = " --var 12005=-0.1";
  CHECK(
      movesOnly(family.sim(" --var 2005=-0.1").out) ==
      movesOnly(family.run("sim new/main.nc --control examples/pocket-6m/0i-md.toml" + worn + machine + "new")
                    .out));

  folder.write("pocket.nc", "%\n" + whole + "%\n");
  const CommandResult agrees = family.run("verify pocket.nc" + controls + "--cases 20");
  CAPTURE(agrees.err);
  CHECK(agrees.status == 0);
  CHECK((agrees.out + agrees.err).find("AGREES: 20 of 20 drawn cases") != std::string::npos);
  REQUIRE(family.run("convert pocket.nc" + controls + "-o other.nc").status == 0);
  std::string other = readAll(folder / "other.nc");
  other.replace(other.find("X-29."), 5, "X-28.");
  folder.write("other.nc", other);
  CHECK(family.run("verify pocket.nc" + controls + "--cases 20 --translation other.nc").status == 1);
}

TEST_CASE("pocket: what is left of a block beside the surfaces") {
  const Family family;
  const std::string page = readAll(root() / "docs/pocket-6m.md");
  const auto stockOf = [&](const std::string& name, const std::string& further) {
    const CommandResult result = family.sim(" --stock examples/pocket-6m/" + name + " --json" + further);
    CAPTURE(result.err);
    CHECK(result.status == 0);
    return nlohmann::json::parse(result.out)["stock"];
  };
  const auto row = [&](const std::string& name) {
    const std::size_t at = page.find("| `" + name + "`");
    REQUIRE(at != std::string::npos);
    return page.substr(at, page.find('\n', at) - at);
  };
  const auto mm = [](const nlohmann::json& value) { return fmt::format("{:.4f}", value.get<double>()); };
  for (const char* name : {"stock-cylinder.toml", "stock-floor.toml"}) {
    const nlohmann::json stock = stockOf(name, "");
    CHECK(row(name).ends_with(
        fmt::format("| {} | {} |", mm(stock["cutInto"]["most"]), mm(stock["leftOver"]["most"]))));
    CHECK(stock["leftOver"]["cells"] == 0);
    CHECK(stock["lostMoves"].get<int>() < 10);
  }
  CHECK(row("stock.toml").find("| " + mm(stockOf("stock.toml", "")["cutInto"]["most"]) + " |") !=
        std::string::npos);
  // A mill that is smaller than its correction says.
  const nlohmann::json worn = stockOf("stock-floor.toml", " --var 2005=0.1");
  CHECK(page.find(mm(worn["leftOver"]["most"]) + " mm stay on the floor") != std::string::npos);
  CHECK(worn["cutInto"]["most"] == 0);
}

TEST_CASE("pocket: how many repairs of the listing lint proposes") {
  fs::path folder;
  if (!haveCorpus(folder)) return;
  const std::string page = readAll(root() / "docs/pocket-6m.md");
  for (const char* name :
       {"O10", "O20", "O30", "O40", "O50", "O60", "O70", "O80", "O90", "O100", "O110", "O500"}) {
    const fs::path file = folder / "pocket" / fmt::format("{}.ocr.nc", name);
    const CommandResult found = runDotek(
        {"lint", "--fix", "--diff", "--from", "listing", "--control", "fanuc-6m", file.string()}, root());
    const std::size_t at = found.err.find(" repairs in 1 file");
    std::string count = "0";
    if (at != std::string::npos) {
      const std::size_t begin = found.err.rfind('\n', at) + 1;
      count = found.err.substr(begin, at - begin);
    }
    CHECK_MESSAGE(page.find(fmt::format("\n| {} | {} |", name, count)) != std::string::npos,
                  std::string(name) << ": " << count);
  }
}
