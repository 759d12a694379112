// ToolPath.mac as protected moves and the touches that its code shows.
#include "tests/unit/GibbsLowerProject.h"

#include <doctest/doctest.h>

namespace fs = std::filesystem;
using namespace dotek;
using namespace dotek::tests;

namespace {

const std::string kData = "op = callback_op\nget_custom_drill_cycle_data retract_plane, plane\n"
                          "get_custom_drill_cycle_data x, px\nget_custom_drill_cycle_data y, py\n"
                          "get_op_data op, TOOL_NUM, t\nget_tool_data t, MTOOL_RADIUS, r\n";
// As in a macro: `x a-r` for a move along X, `to 1, 2, 3` for one along all.
std::string spelt(const std::string& moves) {
  std::string out;
  std::istringstream lines(moves);
  for (std::string line; std::getline(lines, line);) {
    for (const auto& [word, command] : {std::pair("x ", "feed_x, "), std::pair("y ", "feed_y, "),
                                        std::pair("z ", "feed_z, "), std::pair("to ", "feed, ")}) {
      const std::size_t then = line.find(" then ");
      const std::size_t at = then == std::string::npos ? 0 : then + 6;
      if (line.compare(at, std::string(word).size(), word) != 0) continue;
      line = line.substr(0, at) + "add_custom_drill_cycle_path " + command +
             line.substr(at + std::string(word).size());
      break;
    }
    out += line + "\n";
  }
  return out;
}

struct PathProject : LowerProject {
  explicit PathProject(const std::string& moves) {
    files["DefineData.txt"] = "a = 10\nb = 4\nc = -8\nZ = -5\nh = 20\n";
    files["ToolPath.mac"] = kData + spelt(moves);
  }
};

// Body, or what it was refused for; notes aside. The body has to lead the probe as the macro does.
std::string path(const std::string& moves, const std::set<std::string>& assumptions = {},
                 const std::map<std::string, std::string>& others = {}) {
  PathProject project(moves);
  project.assumptions = assumptions;
  for (const auto& [name, text] : others)
    project.files[name] = spelt(text);
  const bool done = project.lowerPath();
  std::erase_if(project.diagnostics.all(),
                [](const Diagnostic& each) { return each.severity == Severity::Note; });
  if (!done) return project.findings();
  const std::string findings = project.findings();
  const std::string found = project.comparePaths();
  return found.empty() ? findings + project.text(project.cycle.body) : found;
}

std::string folderPath(const fs::path& folder, const std::vector<std::string>& touches = {}) {
  LowerProject project;
  project.readFolder(folder);
  project.touches = touches;
  const bool done = project.lowerPath();
  std::erase_if(project.diagnostics.all(),
                [](const Diagnostic& each) { return each.severity == Severity::Note; });
  if (!done) return project.findings();
  // A touch that the user names comes back before the next move, whatever the macro does.
  const std::string found = touches.empty() ? project.comparePaths() : "";
  return found.empty() ? project.text(project.cycle.body) : found;
}

const std::string kRefusedX = "touch-not-shown@add_custom_drill_cycle_path feed_x, ";

} // namespace

TEST_CASE("gibbs lower: paths of the examples") {
  const fs::path folder = root() / "examples";
  CHECK(
      folderPath(folder / "surface-x") ==
      "callback_returncode = 0\nmove Z W Z\nX<=0 -> L1\nmeasure X S X\nL1:\nX>=0 -> L2\nmeasure X S X\nL2:\n"
      "move Z W R\n");
  CHECK(
      folderPath(folder / "surface-y") ==
      "callback_returncode = 0\nmove Z W Z\nY<=0 -> L1\nmeasure Y S Y\nL1:\nY>=0 -> L2\nmeasure Y S Y\nL2:\n"
      "move Z W R\n");
  CHECK(folderPath(folder / "surface-z") == "touch-not-shown@add_custom_drill_cycle_path feed_z, W+D-plane");
  CHECK(folderPath(folder / "surface-z", {"feed_z, W+D"}) ==
        "callback_returncode = 0\nmove Z W W\nmeasure Z W (W+D)\nmove Z W R\n");
  CHECK(folderPath(folder / "corner-xyz") ==
        "touch-not-shown@add_custom_drill_cycle_path feed_z, WC-plane+ZC");
  CHECK(folderPath(folder / "corner-xyz", {"WC-plane+ZC"}) ==
        "callback_returncode = 0\nmove Z W Z\nXA<=0 -> L1\nmeasure X S XA\nL1:\nXA>=0 -> L2\nmeasure X S "
        "XA\nL2:\n"
        "move Z W R\nmove X W UB Y W VB Z W R\nmove Z W Z\n"
        "YB<=0 -> L3\nmeasure Y W (VB+YB)\nL3:\nYB>=0 -> L4\nmeasure Y W (VB+YB)\nL4:\nmove Z W R\n"
        "move X W UC Y W VC Z W R\nmove Z W WC\nmeasure Z W (WC+ZC)\nmove Z W R\n");
  // Which way a touch goes that the user names is decided when the program runs.
  const std::string bore =
      folderPath(folder / "bore", {"feed_x, reach", "feed_x, -reach", "feed_y, reach", "feed_y, -reach"});
  CHECK(bore.starts_with("callback_returncode = 0\nreach = ((D/2)-tool_radius)\nmove Z W Z\n"
                         "reach<=0 -> L1\nmeasure X S (0.5*D)\n-> L2\nL1:\nreach>=0 -> L2\n"
                         "measure X S ((0.5*D)-(2*tool_radius))\nL2:\n-(reach)<=0 -> L3\n"));
  CHECK(bore.ends_with("measure Y S -((0.5*D))\nL8:\nmove Z W R\n"));
}

TEST_CASE("gibbs lower: paths of the corpus") {
  fs::path corpus;
  if (!haveCorpus(corpus)) return;
  const fs::path folder = corpus / "gibbs";
  CHECK(folderPath(folder / "MERENI.OSA.X") ==
        "callback_returncode = 0\nmove X S 0 Y S 0 Z W Zb\nmove Z W Z\na<=0 -> L1\nmeasure X S a\nL1:\n"
        "a>=0 -> L2\nmeasure X S a\nL2:\nmove Z W Zb\n");
  CHECK(folderPath(folder / "MERENI.OSA.Y") ==
        "callback_returncode = 0\nmove X S 0 Y S 0 Z W Zb\nmove Z W Z\nb<=0 -> L1\nmeasure Y S b\nL1:\n"
        "b>=0 -> L2\nmeasure Y S b\nL2:\nmove Z W Zb\n");
  CHECK(folderPath(folder / "MERENI.OSA.Z") ==
        "touch-not-shown@add_custom_drill_cycle_path feed_z, C+d-retract");
  CHECK(folderPath(folder / "MERENI.OSA.XYZ") ==
        "touch-not-shown@add_custom_drill_cycle_path feed_z, KC-retract+c");
  CHECK(folderPath(folder / "MERENI.OSA.XYZ", {"KC-retract+c"}).find("measure Y W (JB+b)") !=
        std::string::npos);
  CHECK(folderPath(folder / "MERENI.STRED.OTVOR").starts_with(kRefusedX + "D/2-toolrad"));
}

TEST_CASE("gibbs lower: touches at an angle") {
  const std::string refused = "touch-oblique@add_custom_drill_cycle_path feed, ";
  // Out and straight back.
  CHECK(path("to 0, 0, Z-plane\nto a, b, Z-plane\nto 0, 0, Z-plane\nz h-plane\n") ==
        refused + "a, b, Z-plane");
  // The radius before a point, and on to the next.
  CHECK(path("degrees\nto 0, 0, Z-plane\nto (a-r)*cos(30), (a-r)*sin(30), Z-plane\nto 0, 1, Z-plane\n"
             "z h-plane\n") == refused + "(a-r)*cos(30), (a-r)*sin(30), Z-plane");
  // The same with Z: whatever the defaults are, and through what is computed.
  CHECK(path("to 0, 0, Z-plane\nto a, 0, b-plane\nto 0, 0, Z-plane\nz h-plane\n") ==
        refused + "a, 0, b-plane");
  CHECK(path("to 0, 0, Z-plane\nto 0, a-r, Z-3-plane\nto 0, 0, Z-plane\nz h-plane\n") ==
        refused + "0, a-r, Z-3-plane");
  CHECK(path("degrees\nto 0, 0, Z-plane\nto (a-r)*cos(30), 0, b+r*sin(30)-plane\nto 0, 1, h-plane\n")
            .starts_with(refused + "(a-r)*cos(30), 0, b+r*sin(30)-plane"));
  CHECK(path("to 0, 0, Z-plane\nto a, 1, b-plane\nto 0, 0, b-plane\nz h-plane\n").find("touch-oblique") ==
        std::string::npos);
  // A start that keeps the radius away from both walls, or that the path leaves another way, is none.
  CHECK(path("to a-r, b-r, Z-plane\nz h-plane\nz Z-plane\n").find("touch-oblique") == std::string::npos);
  CHECK(path("z h-plane\nto a, b, h-plane\nz h+1-plane\nto 0, 0, h+1-plane\n").find("touch-oblique") ==
        std::string::npos);
}

TEST_CASE("gibbs lower: shapes that show a touch") {
  const std::string wanted =
      "move Z W Z\na<=0 -> L1\nmeasure X S a\nL1:\na>=0 -> L2\nmeasure X S a\nL2:\nmove Z W h\n";
  const std::string down = "z Z-plane\n";
  const std::string up = "x 0\nz h-plane\n";
  SUBCASE("one line each") {
    CHECK(path(down + "if a > 0 then x a-r\nif a < 0 then x a+r\n" + up) == wanted);
  }
  SUBCASE("turned round") {
    CHECK(path(down + "if 0 < a then x a-r\nif 0 > a then x r+a\n" + up) ==
          "move Z W Z\n0>=a -> L1\nmeasure X S a\nL1:\n0<=a -> L2\nmeasure X S a\nL2:\nmove Z W h\n");
  }
  SUBCASE("blocks") {
    CHECK(path(down + "if a > 0 then\n[\nx a-r\nx 0\n]\nif a < 0 then\n[\nx a+r\nx 0\n]\nz h-plane\n",
               {"block-if"}) == wanted);
  }
  SUBCASE("GOTO") {
    CHECK(path(down +
               "if a > 0 then goto plus\nif a < 0 then goto minus\ngoto back\n:plus\nx a-r\ngoto back\n"
               ":minus\nx a+r\n:back\n" +
               up) == "move Z W Z\na>0 -> L1\na<0 -> L2\n-> L3\nL1:\nmeasure X S a\n-> L3\nL2:\nmeasure X S "
                      "a\nL3:\nmove Z W h\n");
  }
  SUBCASE("a variable holds the target") {
    const std::string text = path(down + "t = 0\nif a > 0 then t = a-r\nif a < 0 then t = a+r\nx t\n" + up);
    CHECK(text.find("measure X S a\n") != std::string::npos);
    CHECK(text.find("move X") == std::string::npos);
  }
  SUBCASE("a macro with values") {
    CHECK(path(down + "call \"touch\", a, r\nz h-plane\n", {},
               {{"touch.mac",
                 "args e, radius\nif e > 0 then x e - radius\nif e < 0 then x e + radius\nx 0\n"}}) ==
          "move Z W Z\ne = a\ne<=0 -> L1\nmeasure X S e\nL1:\ne>=0 -> L2\nmeasure X S e\nL2:\nmove Z W h\n");
  }
  SUBCASE("a stronger condition") {
    CHECK(path(down + "if a >= 5 then x a-r\n" + up) ==
          "move Z W Z\na<5 -> L1\nmeasure X S a\nL1:\nmove Z W h\n");
  }
  // At a = 0 the macro goes the radius to one side and back, and the program stays.
  const auto stays = [](const std::string& moves) {
    PathProject project(moves);
    return project.lowerPath() ? project.text(project.cycle.body) : project.findings();
  };
  SUBCASE("0 is with one side, and is no touch") {
    CHECK(stays(down + "if a >= 0 then x a-r\nif a < 0 then x a+r\n" + up) ==
          "move Z W Z\na<0 -> L1\na<=0 -> L1\nmeasure X S a\nL1:\na>=0 -> L2\nmeasure X S a\nL2:\n"
          "move Z W h\n");
    CHECK(stays(down + "if a <= 0 then x a+r\nif a > 0 then x a-r\n" + up) ==
          "move Z W Z\na>0 -> L1\na>=0 -> L1\nmeasure X S a\nL1:\na<=0 -> L2\nmeasure X S a\nL2:\n"
          "move Z W h\n");
  }
  SUBCASE("a factor of the radius by the side") {
    CHECK(stays("d = 1\nif a < 0 then d = -1\n" + down + "x a-d*r\n" + up) ==
          "d = 1\na>=0 -> L1\nd = -1\nL1:\nmove Z W Z\na>=0 -> L2\nmeasure X S a\n-> L3\nL2:\n"
          "a<=0 -> L3\nmeasure X S a\nL3:\nmove Z W h\n");
  }
  SUBCASE("a constant") {
    CHECK(path(down + "x 5-r\n" + up) == "move Z W Z\nmeasure X S 5\nmove Z W h\n");
  }
  SUBCASE("begun elsewhere") {
    CHECK(path(down + "to b-px, c-py, Z-plane\nif a > 0 then x a+b-px-r\nx b-px\nz h-plane\n") ==
          "move Z W Z\nmove X W b Y W c Z W Z\na<=0 -> L1\nmeasure X W (a+b)\nL1:\nmove Z W h\n");
  }
  SUBCASE("in both directions, one after the other") {
    CHECK(path(down +
               "if a > 0 then goto touches\ngoto out\n:touches\nx a-r\nx 0\nx r-a\nx 0\n:out\nz h-plane\n") ==
          "move Z W Z\na<=0 -> L1\nmeasure X S a\nmeasure X S -(a)\nL1:\nmove Z W h\n");
  }
  SUBCASE("FOR over touches") {
    const std::string text = path("for i = 1 to 3\nto 0, i*10, h-plane\nz Z-plane\nif a > 0 then x a-r\nx 0\n"
                                  "z h-plane\nnext i\n");
    CHECK(text.find("a<=0 -> L2\nmeasure X S a\nL2:\n") != std::string::npos);
    CHECK(text.find("touch-not-shown") == std::string::npos);
  }
  SUBCASE("FOR over as many touches as a field says") {
    const std::string text = path(down + "n = 0\nfor i = 1 to b\nn = n + 1\nif n > 400 then goto out\n"
                                         "if a > 0 then x a-r\nx 0\nnext i\n:out\nz h-plane\n");
    CHECK(text.find("measure X S a\n") != std::string::npos);
    CHECK(text.find("move X") == std::string::npos);
  }
  SUBCASE("after a loop of many rounds, a condition at the head of the next") {
    // The second loop is reached with so many values of b that its counter is no longer followed one by one.
    const std::string text =
        path(down + "i = 0\nfor j = 1 to b\ni = 0\nnext j\nfor j = 1 to 3\n"
                    "if c <> 2+i then i = 5\nif b < 0 then x b+r\nx 0\nnext j\nz h-plane\n");
    CHECK(text.find("measure X S b\n") != std::string::npos);
  }
  SUBCASE("the path back on all axes") {
    CHECK(path(down + "if a > 0 then x a-r\nto 0, 0, Z-plane\nz h-plane\n") ==
          "move Z W Z\na<=0 -> L1\nmeasure X S a\nL1:\nmove Z W h\n");
  }
}

TEST_CASE("gibbs lower: what does not show a touch is refused where it could be one") {
  const std::string down = "z Z-plane\n";
  const std::string up = "x 0\nz h-plane\n";
  // Nothing says on which side.
  CHECK(path(down + "x a-r\n" + up) == kRefusedX + "a-r");
  CHECK(path(down + "x a\n" + up) == kRefusedX + "a");
  // The wrong side, the wrong sign, another variable.
  CHECK(path(down + "if a < 0 then x a-r\n" + up) == kRefusedX + "a-r");
  CHECK(path(down + "if a > 0 then x a+r\n" + up) == kRefusedX + "a+r");
  CHECK(path(down + "if b > 0 then x a-r\n" + up) == kRefusedX + "a-r");
  CHECK(path(down + "if a >= 0 then x a-r\n" + up) == kRefusedX + "a-r");
  CHECK(path(down + "if a > 0 then x a-2*r\n" + up) == kRefusedX + "a-2*r");
  CHECK(path(down + "if a >= 0 then x a-r\nif b < 0 then x b+r\n" + up).starts_with(kRefusedX));
  CHECK(path(down + "x abs(a)-r\n" + up) == kRefusedX + "abs(a)-r");
  // The variable changes between the condition and the move.
  CHECK(path(down + "e = a\nif e > 0 then goto on\ngoto out\n:on\ne = b\nx e-r\n:out\n" + up) ==
        kRefusedX + "e-r");
  // The side is known from elsewhere, not from where the move begins.
  CHECK(path(down + "x b\nif a > 0 then x a-r\nx b\nz h-plane\n").starts_with("touch-not-shown@"));
  // The path does not come back, or elsewhere.
  CHECK(path(down + "if a > 0 then x a-r\nz h-plane\n") == kRefusedX + "a-r");
  CHECK(path(down + "if a > 0 then x a-r\nx 1\nz h-plane\n") == kRefusedX + "a-r");
  CHECK(path(down + "if a > 0 then x a-r\nif b > 0 then x 0\nz h-plane\n") == kRefusedX + "a-r");
  // Said twice, the measurement would have come back in between.
  CHECK(path(down + "if a > 0 then goto on\ngoto out\n:on\nx a-r\nx a-r\n:out\n" + up) == kRefusedX + "a-r");
  // The radius is in the begin and not in the target.
  CHECK(path(down + "x a-r\nif a > 0 then x 0\nx a-r\ny 5\nz h-plane\n").starts_with("touch-not-shown@"));
  // Down and up again without anything in between.
  CHECK(path("z Z-plane\nz h-plane\n") == "touch-not-shown@add_custom_drill_cycle_path feed_z, Z-plane");
  // A loop comes back by itself.
  CHECK(path("for i = 1 to 2\nx a*i\nnext i\nz h-plane\n").starts_with(kRefusedX));
}

TEST_CASE("gibbs lower: moves that are no touch") {
  CHECK(path("to 0, 0, h-plane\nz Z-plane\nx a\ny b\nz h-plane\n") ==
        "move X S 0 Y S 0 Z W h\nmove Z W Z\nmove X S a\nmove Y S b\nmove Z W h\n");
  // Further along the same way.
  CHECK(path("z h-plane\nx 5\nx 10\ny b\n") == "move Z W h\nmove X S 5\nmove X S 10\nmove Y S b\n");
  CHECK(path("z h-plane\nif a > 0 then x a\nif a > 0 then x 2*a\ny b\n") ==
        "move Z W h\na<=0 -> L1\nmove X S a\nL1:\na<=0 -> L2\nmove X S (2*a)\nL2:\nmove Y S b\n");
  // An approach before the touch along the same axis.
  CHECK(path("z Z-plane\nx 2\nif a > 0 then x 2+a-r\nx 2\nz h-plane\n") ==
        "move Z W Z\nmove X S 2\na<=0 -> L1\nmeasure X S (2+a)\nL1:\nmove Z W h\n");
  // Coordinates that keep counting from the entry or the retract plane.
  CHECK(path("z 5\nx px\ny 2*py\n") == "move Z R 5\nmove X S start_x\nmove Y S (2*start_y)\n");
  // A variable holds the work coordinate less the origin.
  CHECK(path("low = Z-plane\nz low\nx a\n") == "low = (Z-retract)\nmove Z W Z\nmove X S a\n");
}

TEST_CASE("gibbs lower: a touch goes to where the path has not stood") {
  const std::string touchX = "if a > 0 then x a-r\nx 0\n";
  const std::string touchY = "if b > 0 then y b-r\ny 0\n";
  const std::string measureX = "a<=0 -> L1\nmeasure X S a\nL1:\n";
  const std::string measureY = "b<=0 -> L2\nmeasure Y S b\nL2:\n";
  const auto refused = [](const std::string& what) {
    return "touch-not-shown@add_custom_drill_cycle_path feed_" + what;
  };
  // Up to the clearance and down again, at one place.
  CHECK(path("z Z-plane\n" + touchX + "z h-plane\nz Z-plane\n" + touchY + "z h-plane\n") ==
        "move Z W Z\n" + measureX + "move Z W h\nmove Z W Z\n" + measureY + "move Z W h\n");
  CHECK(path("to 0, 0, h-plane\nz Z-plane\n" + touchX + "z h-plane\nz Z-plane\n" + touchY + "z c-plane\n") ==
        "move X S 0 Y S 0 Z W h\nmove Z W Z\n" + measureX + "move Z W h\nmove Z W Z\n" + measureY +
            "move Z W c\n");
  // The other descent goes deeper: there it may touch, and the clearance is none.
  CHECK(path("z Z-plane\n" + touchX + "z h-plane\nz c-plane\nz h-plane\n") == refused("z, c-plane"));
  CHECK(path("to 0, 0, h-plane\nz Z-plane\n" + touchX + "z h-plane\nz c-plane\nz h-plane\n") ==
        refused("z, c-plane"));
  // A touch that the path does not name as such is reported at each of its lines.
  CHECK(path("to 0, 0, h-plane\nz Z-plane\nz h-plane\nto 5, 0, h-plane\nz Z-plane\nz h-plane\n") ==
        refused("z, Z-plane") + "; " + refused("z, Z-plane"));
  // On one way the path has stood there, on the other it has not.
  CHECK(
      path("z h-plane\nif a > 0 then goto on\nz c-plane\ny 5\n:on\nto 0, 0, h-plane\nz c-plane\nz h-plane\n")
          .starts_with(refused("z, c-plane")));
  // Neither a height that the path proves higher is touched.
  CHECK(path("z 0\n" + touchX + "z 5\nz 1\n" + touchY + "z 9\n") ==
        "move Z R 0\n" + measureX + "move Z R 5\nmove Z R 1\n" + measureY + "move Z R 9\n");
  // Nothing shows that the move leads up; naming it a touch would be no remedy.
  CHECK(path("z Z-plane\n" + touchX + "z h-plane\nz Z-plane\n" + touchY + "z 50-plane\n") ==
        "retract-not-shown@add_custom_drill_cycle_path feed_z, h-plane");
  // Along X and Y it is the point that counts.
  CHECK(path("z Z-plane\nx 5\ny 3\nx 0\nx 5\nx 0\ny 0\nx 5\nx 0\nz h-plane\n") !=
        path("z Z-plane\nx 5\ny 3\nx 0\ny 9\nx 5\nx 0\nz h-plane\n"));
  CHECK(path("z Z-plane\nx 5\ny 3\nx 0\ny 9\nx 5\nx 0\nz h-plane\n") == refused("x, 5"));
}

TEST_CASE("gibbs lower: points of the probe, ranges, and fields that no move uses") {
  PathProject project("to 0, 0, h-plane\nz Z-plane\nif a > 0 then x a-r\nx 0\nz h-plane\n");
  REQUIRE(project.lowerPath());
  CHECK_FALSE(project.cycle.measurementStated);
  REQUIRE(project.diagnostics.all().size() == 1);
  CHECK(project.diagnostics.all()[0].code == "fields-without-move");
  CHECK(project.diagnostics.all()[0].message.find("`b` and `c`") != std::string::npos);
  int measures = 0;
  for (const ir::CycleStatement& each : project.cycle.body) {
    if (const auto* move = std::get_if<ir::Move>(&each.node)) {
      CHECK(move->motion == ir::Motion::Protected);
      CHECK(move->point == ir::ProbePoint::Lowest);
    }
    const auto* measure = std::get_if<ir::Measure>(&each.node);
    if (measure == nullptr) continue;
    ++measures;
    CHECK(measure->feature == ir::Feature::Surface);
    CHECK_FALSE(measure->setting);
    REQUIRE(each.origin.ranges.size() == 2);
    CHECK(project.sources.text(each.origin.ranges[0]).find("a-r") != std::string_view::npos);
    CHECK(project.sources.text(each.origin.ranges[1]) == "add_custom_drill_cycle_path feed_x, 0");
  }
  CHECK(measures == 1);
}

TEST_CASE("gibbs lower: what ends a path early is refused") {
  CHECK(path("z h-plane\nif a > 0 then callback_returncode = 1\n") ==
        "return-code-set@callback_returncode = 1");
  CHECK(path("z h-plane\nif a > 0 then stop \"no\"\n") == "tool-path-stopped@stop \"no\"");
  CHECK(path("dialog \"d.dlg\"\n") == "needs-user@dialog");
  CHECK(path("get_tool_data t, MTOOL_LENGTH, l\nz l-plane\n") == "cam-value@l-plane");
  CHECK(path("add_custom_drill_cycle_path rapid, 0, 0, 0\n") == "path-kind-unknown@rapid");
  CHECK(path("z h-plane\nif a > 0 then message \"far\"\n") ==
        "message-informs@message \"far\"move Z W h\na<=0 -> L1\ncomment [far]\nL1:\n");
}

TEST_CASE("gibbs lower: touches that the user names") {
  const auto named = [](const std::string& moves, const std::vector<std::string>& touches) {
    PathProject project(moves);
    project.touches = touches;
    const bool done = project.lowerPath();
    std::erase_if(project.diagnostics.all(),
                  [](const Diagnostic& each) { return each.severity == Severity::Note; });
    return done ? project.text(project.cycle.body) : project.findings();
  };
  CHECK(
      named("z Z-plane\nif a < 0 then x a+r+1\nx 0\nz h-plane\n", {"x, a+r+1"}) ==
      "move Z W Z\na>=0 -> L2\n((a+tool_radius)+1)<=0 -> L1\nmeasure X S (((a+tool_radius)+1)+tool_radius)\n"
      "-> L2\nL1:\n((a+tool_radius)+1)>=0 -> L2\nmeasure X S (a+1)\nL2:\nmove Z W h\n");
  CHECK(named("z Z-plane\nx 7\nx 0\nz h-plane\n", {"x, 7"}) ==
        "move Z W Z\nmeasure X S (7+tool_radius)\nmove Z W h\n");
  CHECK(named("z Z-plane\nz h-plane\n", {"Z-plane"}) == "measure Z W Z\nmove Z W h\n");
  CHECK(named("to a, b, Z-plane\nto 0, 0, Z-plane\n", {"a, b"}) ==
        "cannot-translate@add_custom_drill_cycle_path feed, a, b, Z-plane");
  CHECK(named("z Z-plane\n", {"TOOL_NUM"}) == "no-move-here@get_op_data op, TOOL_NUM, t");
}

TEST_CASE("gibbs lower: what the messages say") {
  // The first finding of the checks, or of the path, its severity and its text.
  const auto first = [](const std::string& macro, bool checks, const std::vector<std::string>& touches = {}) {
    LowerProject project("a = 10\n", macro);
    project.files["ToolPath.mac"] = macro;
    project.touches = touches;
    checks ? project.lowerChecks() : project.lowerPath();
    REQUIRE_FALSE(project.diagnostics.empty());
    return project.diagnostics.all().front();
  };
  struct Case {
    const char* macro;
    bool checks;
    std::vector<std::string> touches;
    const char* code;
    Severity severity;
    const char* part;
  };
  const std::vector<Case> cases = {
      {"x(1) = 2\n:ask", true, {}, "unverified-construct-run", Severity::Error, "--assume array-round"},
      {"goto far", true, {}, "cannot-translate", Severity::Error, "no label of this name"},
      {"if callback_proc = 1 then stop", true, {}, "cam-value", Severity::Error, "CALLBACK_PROC"},
      {":ask\ndialog \"d\"\nmessage \"m\"\nif a > 1 then goto ask",
       true,
       {},
       "message-paths",
       Severity::Error,
       "some"},
      {"dialog \"d\"\nmessage \"hint\"", true, {}, "message-informs", Severity::Warning, "`hint`"},
      {"dialog \"d\"\nstop \"by\", a", true, {}, "message-computed", Severity::Note, "`by`"},
      {":round\ngoto round", true, {}, "goes-round-for-ever", Severity::Error, "leads to the end"},
      {"degrees", false, {"degrees"}, "no-move-here", Severity::Error, "holds no move"},
      {"add_custom_drill_cycle_path feed_x, 5\nadd_custom_drill_cycle_path feed_x, 0",
       false,
       {},
       "touch-not-shown",
       Severity::Error,
       "`--assume touch=ToolPath.mac:1`"},
      {"add_custom_drill_cycle_path feed_x, 5", false, {}, "fields-without-move", Severity::Note, "`a`"},
  };
  for (const Case& each : cases) {
    INFO(each.macro);
    const Diagnostic found = first(each.macro, each.checks, each.touches);
    CHECK(found.code == each.code);
    CHECK(found.severity == each.severity);
    CHECK_MESSAGE(found.message.find(each.part) != std::string::npos, found.message);
  }
}

TEST_CASE("gibbs lower: seeds of the fuzz targets do no harm") {
  int seeds = 0;
  for (const char* name : {"gibbs-lower", "gibbs-macro"}) {
    for (const auto& entry : fs::directory_iterator(root() / "tests" / "fuzz" / "seeds" / name)) {
      LowerProject project;
      project.readFolder(entry.path().parent_path());
      const std::string text = project.files[entry.path().filename().string()];
      ++seeds;
      INFO(entry.path().filename().string());
      project.files = {{"DefineData.txt", "a = 1\nb = 2\nZ = 3\n"},
                       {"CycleData.mac", text.substr(std::min<std::size_t>(1, text.size()))},
                       {"ToolPath.mac", text.substr(std::min<std::size_t>(1, text.size()))}};
      const bool checks = project.lowerChecks();
      CHECK((checks || project.diagnostics.hasErrors()));
      CHECK(project.violations() == "");
      project.diagnostics = {};
      const bool moves = project.lowerPath();
      CHECK((moves || project.diagnostics.hasErrors()));
      CHECK(project.violations() == "");
    }
  }
  CHECK(seeds > 0);
}
