#include "GibbsRunProject.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

// The corpus cycle `folder` with its own DefineData, other values and tool radius 3, retract plane 5.
GibbsProject corpusCycle(const std::filesystem::path& folder, const std::map<std::string, double>& values) {
  GibbsProject project;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    project.files[entry.path().filename().string()] = readAll(entry.path());
  }
  project.files["main"] = project.files["ToolPath.mac"];
  const FileId id = *project.add("DefineData.txt");
  for (const gibbs::Definition& each : gibbs::parseDefineData(id, project.parsing()).definitions) {
    project.fields[gibbs::foldCase(each.name.text)] = each.number.value_or(0);
  }
  for (const auto& [name, value] : values)
    project.fields[gibbs::foldCase(name)] = value;
  project.hosts = {{"tool_radius", 3}, {"retract", 5}, {"start_x", 10}, {"start_y", 10}};
  return project;
}

constexpr const char* kCornerPath =
    "feed(0,0,45)\nz -10\nx 7\nx 0\nz 45\nfeed(-10,-10,45)\nz -10\ny -3\ny -10\nz 45\n"
    "feed(-10,-10,45)\nz 5\nz -5\nz 45\nfeed(0,0,45)\n";

} // namespace

TEST_CASE("the published cycles give the paths of the golden vectors") {
  std::filesystem::path folder;
  if (!haveCorpus(folder)) return;
  const auto path = [&](const char* cycle, const std::map<std::string, double>& values) {
    GibbsProject project = corpusCycle(folder / "gibbs" / cycle, values);
    const std::string text = project.path();
    CHECK(project.findings() == "");
    return text;
  };
  CHECK(path("MERENI.OSA.X", {{"Zb", 50}}) == "feed(0,0,45)\nz -10\nx 7\nx 0\nz 45\n");
  CHECK(path("MERENI.OSA.X", {{"a", -10}}) == "feed(0,0,45)\nz -10\nx -7\nx 0\nz 45\n");
  CHECK(path("MERENI.OSA.Z", {}) == "feed(0,0,45)\nz 5\nz -5\nz 45\n");
  CHECK(path("MERENI.OSA.XYZ", {}) == kCornerPath);
  CHECK(path("MERENI.STRED.OTVOR", {{"D", 30}}) ==
        "z -10\nx 12\nx -12\nx 0\ny 12\ny -12\nfeed(0,0,-10)\nfeed(0,0,0)\n");
}

TEST_CASE("the published checks decide as their conditions say") {
  std::filesystem::path folder;
  if (!haveCorpus(folder)) return;
  const auto verdict = [&](const char* cycle, const std::map<std::string, double>& values) {
    GibbsProject project = corpusCycle(folder / "gibbs" / cycle, values);
    project.files["main"] = project.files["CycleData.mac"];
    return project.checks();
  };
  using Verdict = gibbs::ChecksResult::Verdict;
  CHECK(verdict("MERENI.OSA.X", {}).verdict == Verdict::Passes);
  CHECK(verdict("MERENI.OSA.X", {{"a", 2.9}}).verdict == Verdict::Rejected);
  CHECK(verdict("MERENI.OSA.X", {{"a", -3}}).verdict == Verdict::Passes);
  CHECK(verdict("MERENI.OSA.XYZ", {{"b", -3}}).verdict == Verdict::Rejected);
  CHECK(verdict("MERENI.OSA.Y", {{"G", 60}}).verdict == Verdict::Rejected);
  CHECK(verdict("MERENI.OSA.Z", {{"d", 0}}).rejections.size() == 1);
  CHECK(verdict("MERENI.STRED.OTVOR", {}).verdict == Verdict::Rejected);
  CHECK(verdict("MERENI.STRED.OTVOR", {{"D", 7}}).verdict == Verdict::Passes);
  CHECK(verdict("MERENI.STRED.OTVOR", {{"D", 100001}}).verdict == Verdict::Rejected);
}

TEST_CASE("a surface in X, with other names, order and spelling") {
  GibbsProject project(
      "ADD_CUSTOM_DRILL_CYCLE_PATH FEED, 0, 0, safe - plane ! before the data is read: wrong order\n");
  project.files["main"] = "GET_CUSTOM_DRILL_CYCLE_DATA RETRACT_PLANE, Plane\n"
                          "Get_Op_Data CALLBACK_OP, tool_Num, t\n"
                          "GET_TOOL_DATA t, MTOOL_RADIUS, ball\n"
                          "Add_Custom_Drill_Cycle_Path FEED, 0, 0, safe - PLANE\n"
                          "add_custom_drill_cycle_path feed_z, depth-plane\n"
                          "if reach < 0 then goto left\n"
                          "add_custom_drill_cycle_path feed_x, reach-ball\n"
                          "goto back\n"
                          "left:\n"
                          "add_custom_drill_cycle_path feed_x, reach+ball\n"
                          ":back\n"
                          "add_custom_drill_cycle_path feed_x, 0\n"
                          "add_custom_drill_cycle_path feed_z, safe-plane\n"
                          "callback_returncode = 0";
  project.fields = {{"Safe", 50}, {"depth", -5}, {"Reach", 10}};
  project.hosts = {{"tool_radius", 3}, {"retract", 5}};
  SUBCASE("right") {
    CHECK(project.path() == "feed(0,0,45)\nz -10\nx 7\nx 0\nz 45\n");
  }
  SUBCASE("left") {
    project.fields["Reach"] = -10;
    CHECK(project.path() == "feed(0,0,45)\nz -10\nx -7\nx 0\nz 45\n");
  }
  CHECK(project.findings() == "");
}

TEST_CASE("a corner, with its sides in a called macro and an included one") {
  GibbsProject project("LOCAL px, py\n"
                       "get_custom_drill_cycle_data x, px\n"
                       "get_custom_drill_cycle_data y, py\n"
                       "#INCLUDE \"tool\"\n"
                       "h = up - rp\n"
                       "add_custom_drill_cycle_path feed, 0, 0, h\n"
                       "CALL \"side.mac\", 1, 0, reach, za - rp\n"
                       "add_custom_drill_cycle_path feed, -px, -py, h\n"
                       "call \"side\", 2, -py, reach, za - rp\n"
                       "add_custom_drill_cycle_path feed, -px, -py, h\n"
                       "add_custom_drill_cycle_path feed_z, zc - rp\n"
                       "add_custom_drill_cycle_path feed_z, zc - rp - reach\n"
                       "add_custom_drill_cycle_path feed_z, h\n"
                       "add_custom_drill_cycle_path feed, 0, 0, h\n");
  project.files["tool.mac"] = "get_op_data callback_op, tool_num, it\n"
                              "get_tool_data it, mtool_radius, r\n"
                              "get_custom_drill_cycle_data retract_plane, rp\n";
  project.files["side.mac"] = "ARGS axis, base, way, low\n"
                              "add_custom_drill_cycle_path feed_z, low\n"
                              "if axis = 1 then add_custom_drill_cycle_path feed_x, base + way - r\n"
                              "if axis = 2 then add_custom_drill_cycle_path feed_y, base + way - r\n"
                              "if axis = 1 then add_custom_drill_cycle_path feed_x, base\n"
                              "if axis = 2 then add_custom_drill_cycle_path feed_y, base\n"
                              "add_custom_drill_cycle_path feed_z, h\n";
  project.fields = {{"up", 50}, {"reach", 10}, {"za", -5}, {"zc", 10}};
  project.hosts = {{"tool_radius", 3}, {"retract", 5}, {"start_x", 10}, {"start_y", 10}};
  CHECK(project.path() == kCornerPath);
  CHECK(project.findings() == "");
}

TEST_CASE("a bore by a loop over its four directions") {
  GibbsProject project("get_custom_drill_cycle_data retract_plane, rp\n"
                       "get_op_data callback_op, tool_num, t\n"
                       "get_tool_data t, mtool_radius, r\n"
                       "add_custom_drill_cycle_path feed_z, low - rp\n"
                       "way = dia / 2 - r\n"
                       "FOR i = 0 TO 1\n"
                       "  FOR side = 1 TO 2\n"
                       "    s = 3 - 2 * side\n"
                       "    IF i = 0 THEN add_custom_drill_cycle_path feed_x, s * way\n"
                       "    IF i = 1 THEN add_custom_drill_cycle_path feed_y, s * way\n"
                       "  NEXT side\n"
                       "  IF i = 1 THEN CONTINUE\n"
                       "  add_custom_drill_cycle_path feed_x, 0\n"
                       "NEXT i\n"
                       "add_custom_drill_cycle_path feed, 0, 0, low - rp\n"
                       "add_custom_drill_cycle_path feed, 0, 0, 5 - rp\n");
  project.fields = {{"dia", 30}, {"low", -5}};
  project.hosts = {{"tool_radius", 3}, {"retract", 5}};
  CHECK(project.path() == "z -10\nx 12\nx -12\nx 0\ny 12\ny -12\nfeed(0,0,-10)\nfeed(0,0,0)\n");
  CHECK(project.findings() == "");
}

TEST_CASE("moves carry the other axes along, and round binary fractions away") {
  GibbsProject project("add_custom_drill_cycle_path feed, 1, 2, 3\n"
                       "add_custom_drill_cycle_path feed_y, 0.1+0.2\n"
                       "add_custom_drill_cycle_path feed_z, -0.0000001\n");
  auto context = project.context();
  const auto path = gibbs::runToolPath(*project.load("main"), context);
  REQUIRE(path);
  CHECK((*path)[1].x == 1);
  CHECK((*path)[1].z == 3);
  CHECK((*path)[2].y == doctest::Approx(0.3));
  CHECK(gibbs::pathText(*path) == "feed(1,2,3)\ny 0.3\nz 0\n");
}

TEST_CASE("a path that depends on a host input names its flag") {
  GibbsProject project("get_custom_drill_cycle_data retract_plane, rp\n"
                       "add_custom_drill_cycle_path feed_z, 10-rp\n");
  CHECK(project.path() == "");
  CHECK(project.findings() == "host-input-unknown@10-rp");
  CHECK(project.diagnostics.all()[0].message.find("--host retract=VALUE") != std::string::npos);

  GibbsProject branch("get_op_data callback_op, tool_num, t\n"
                      "get_tool_data t, mtool_radius, r\n"
                      "if r > 2 then add_custom_drill_cycle_path feed_z, 1\n");
  CHECK(branch.path() == "");
  CHECK(branch.findings() == "host-input-unknown@r > 2");

  GibbsProject length("get_op_data callback_op, tool_num, t\n"
                      "get_tool_data t, mtool_length, l\n"
                      "add_custom_drill_cycle_path feed_z, -l\n");
  CHECK(length.path() == "");
  CHECK(length.findings() == "unknown-value@-l");
}

TEST_CASE("the radius is that of the operation's tool only") {
  GibbsProject project("get_tool_data 7, mtool_radius, r\nadd_custom_drill_cycle_path feed_x, r\n");
  project.hosts = {{"tool_radius", 3}};
  CHECK(project.path() == "");
  CHECK(project.findings() == "unknown-value@r");

  GibbsProject same("get_tool_data 7, mtool_radius, r\nadd_custom_drill_cycle_path feed_x, r\n");
  same.hosts = {{"tool_radius", 3}, {"tool_number", 7}};
  CHECK(same.path() == "x 3\n");

  GibbsProject written("get_op_data callback_op, tool_num, t\n"
                       "set_tool_data t, mtool_radius, 4\n"
                       "get_tool_data t, mtool_radius, r\nadd_custom_drill_cycle_path feed_x, r\n");
  written.hosts = {{"tool_radius", 3}};
  CHECK(written.path() == "x 4\n");
}

TEST_CASE("a path macro that ends in an error gives no path") {
  CHECK(refusal("callback_returncode = 1\n") == "return-code-set@callback_returncode = 1");
  CHECK(refusal("add_custom_drill_cycle_path feed_x, 1\nSTOP \"no\"\n") == "tool-path-stopped@STOP \"no\"");
  CHECK(refusal("add_custom_drill_cycle_path rapid, 1, 2, 3\n") == "path-kind-unknown@rapid");
  CHECK(refusal("DIALOG \"x.dlg\"\n") == "needs-user@DIALOG");
  CHECK(refusal("INPUT \"how\", x\n") == "needs-user@INPUT");
  CHECK(refusal("MESSAGE \"mind\"\nadd_custom_drill_cycle_path feed_x, 1\n") ==
        "message-shown@MESSAGE \"mind\"");
  CHECK(
      refusal("callback_returncode = 1\ncallback_returncode = 0\nadd_custom_drill_cycle_path feed_x, 1\n") ==
      "x 1\n");
}
