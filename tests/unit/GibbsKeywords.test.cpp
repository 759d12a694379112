#include "stdlib/GibbsKeywords.h"

#include "DataFolder.h"
#include "stdlib/DataFiles.h"
#include "stdlib/Signature.h"

#include <algorithm>
#include <chrono>
#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::stdlib;

namespace {

// Loads the tables with one of them replaced by its text after `change`; "" where they load.
std::string loadError(const std::string& name, const std::string& from, const std::string& to) {
  DataFiles files;
  std::string text(files.find("keywords", name)->text);
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  const tests::DataFolder folder;
  const std::string path = folder.write("keywords/" + name + ".toml", text);
  Diagnostics diagnostics;
  REQUIRE(files.addFolder(folder.path(), Limits{}, diagnostics));
  try {
    GibbsKeywords::load(files);
  } catch (const DataError& error) {
    const std::string what = error.what();
    // the file at fault, or the one that finds that the two do not agree
    REQUIRE((what.starts_with(path + ":") || what.starts_with("keywords/gibbs-")));
    return what.substr(what.find(": ") + 2);
  }
  return "";
}

const GibbsKeywords& keywords() {
  static const GibbsKeywords loaded = GibbsKeywords::load(DataFiles());
  return loaded;
}

} // namespace

TEST_CASE("gibbs keywords: commands and signatures") {
  const GibbsKeywords& k = keywords();
  CHECK(k.isCommand("get_tool_list"));
  CHECK_FALSE(k.isCommand("GET_TOOL_LISTS"));
  CHECK(k.commands("nothing").empty());
  CHECK(k.commands("circle_cr").size() == 2);
  const auto data = k.commands("Get_Tool_Data");
  REQUIRE(data.size() == 1);
  REQUIRE(data[0]->arguments.size() == 3);
  CHECK(data[0]->arguments[1].kind == ArgumentSpec::Kind::Parameter);
  CHECK(data[0]->arguments[1].family == "tool_data");
  CHECK(data[0]->arguments[2].kind == ArgumentSpec::Kind::Result);
  CHECK(data[0]->arguments[2].type == ArgumentSpec::Type::ByParameter);
  CHECK(k.commands("FILE_READ_VARS")[0]->arguments[1].repeat == 10);
  CHECK(k.commands("DEBUG")[0]->arguments[0].repeat == kNoBound);
  CHECK(k.commands("POINT_2P")[0]->arguments[1].geometry);
  CHECK_FALSE(k.commands("POINT_2P")[0]->arguments[0].geometry);
  CHECK(k.commands("STOP")[0]->unsure);
  CHECK_FALSE(k.commands("GET_TOOL_DATA")[0]->unsure);
  const auto path = k.commands("ADD_CUSTOM_DRILL_CYCLE_PATH");
  REQUIRE(path.size() == 4);
  CHECK(path[0]->openKeywords);
  CHECK(path[0]->grade == 'O');
  CHECK(path[1]->arguments[0].keywords == std::vector<std::string>{"FEED_X"});
  CHECK(k.isCore("if"));
  CHECK(k.isCore("THEN"));
  CHECK(k.isCore("#include"));
  CHECK_FALSE(k.isCore("GET_TOOL_DATA"));
  const auto onError = k.commands("ON_ERROR");
  REQUIRE(onError[0]->arguments.size() == 2);
  CHECK(onError[0]->arguments[0].keywords[0] == "GOTO");
  CHECK(k.renamedTo("holefr_get_feat") == "HOLEFR_GET_HOLE");
  CHECK(k.renamedTo("GET_CLEAR_PROG_NOTES") == "CLEAR_PROG_NOTES");
  CHECK_FALSE(k.renamedTo("GET_TOOL_DATA"));
  CHECK(k.hasCommandPrefix("progress_open"));
  CHECK_FALSE(k.hasCommandPrefix("PROGRES"));
  CHECK(k.commandNotes("file_open").size() == 2);
}

TEST_CASE("gibbs keywords: dialog") {
  const GibbsKeywords& k = keywords();
  const auto input = k.dialogControls("input");
  REQUIRE(input.size() == 1);
  REQUIRE(input[0]->arguments.size() == 6);
  CHECK(input[0]->arguments[5].optional);
  CHECK(k.dialogControls("DROPDOWN_LIST").size() == 2);
  CHECK(k.isUnprovedControl("set_state"));
  CHECK_FALSE(k.isUnprovedControl("INPUT"));
  REQUIRE(k.requiredControls().size() == 2);
  CHECK(k.requiredControls()[1] == "CANCEL");
  CHECK(k.firstControl() == "DIALOG");
  CHECK(k.imageSuffix() == "bmp");
  CHECK(k.controlNotes("BUTTON").size() == 2);
}

TEST_CASE("gibbs keywords: functions") {
  const GibbsKeywords& k = keywords();
  REQUIRE(k.function("mid$") != nullptr);
  CHECK(k.function("mid$")->types == "tnn");
  CHECK(k.function("mid$")->result == 't');
  CHECK(k.function("FORMAT$")->open);
  CHECK(k.function("MID") == nullptr);
}

TEST_CASE("gibbs keywords: parameters") {
  const GibbsKeywords& k = keywords();
  CHECK(k.hasFamily("TOOL_DATA"));
  CHECK_FALSE(k.hasFamily("tool"));
  CHECK(k.isParameter("tool_data", "mtool_radius"));
  CHECK_FALSE(k.isParameter("tool_data", "NONSENSE"));
  CHECK_FALSE(k.isParameter("nonsense", "OFFSET"));
  CHECK(k.isTextParameter("tool_data", "COMMENT"));
  CHECK(k.parameterKind("process_type", "MILL_DRILL") == ParameterKind::Keyword);
  CHECK(k.isOpenFamily("custom_drill_cycle_data"));
  CHECK_FALSE(k.isOpenFamily("tool_data"));
  CHECK(k.hostInput("custom_drill_cycle_data", "retract_plane") == "retract");
  CHECK(k.hostInput("part_data", "CP1") == "clearance");
  CHECK_FALSE(k.hostInput("tool_data", "ID"));
}

TEST_CASE("gibbs keywords: variables") {
  const GibbsKeywords& k = keywords();
  for (const char* name : {"button", "CALLBACK_PROC", "next_tool_number", "GIBBSCAM_LANGUAGE"})
    CHECK(k.isSystemVariable(name));
  CHECK_FALSE(k.isSystemVariable("x"));
  CHECK(k.isConstant("tool_type_drill"));
  CHECK_FALSE(k.isConstant("button"));
  REQUIRE(k.callback("Callback_ReturnCode") != nullptr);
  CHECK(k.callback("callback_returncode")->write);
  CHECK(k.callback("button") == nullptr);
  REQUIRE(k.cursor("first_op_number") != nullptr);
  CHECK(k.cursor("first_op_number")->snapshot == std::vector<std::string>{"GET_OP_LIST"});
  CHECK(k.cursor("NEXT_NEW_OP_NUMBER")->after == "GET_OLD_OP_LIST");
  CHECK(k.readAdvances("next_op_number"));
  CHECK_FALSE(k.readAdvances("first_op_number"));
  CHECK(k.removedSince("HoleFrCs") == "10.8.78");
  CHECK(k.isReservedField("usemacrodialog"));
  CHECK(k.hasVariablePrefix("callback_other"));
  CHECK(k.systemMacros().size() == 13);
}

TEST_CASE("gibbs keywords: nearest names") {
  const GibbsKeywords& k = keywords();
  CHECK(k.nearestCommand("mesage") == "MESSAGE");
  CHECK(k.nearestCommand("GET_TOLO_DATA") == "GET_TOOL_DATA");
  CHECK(k.nearestCommand("qqqqqq") == "");
  CHECK(k.nearestControl("LABLE") == "LABEL");
  CHECK(k.nearestFunction("SQRR") == "SQRT");
  CHECK(k.nearestParameter("tool_data", "MTOOL_RADIS") == "MTOOL_RADIUS");
  CHECK(k.nearestVariable("callback_returncod") == "callback_returncode");
}

TEST_CASE("gibbs keywords: contradictions in the tables are refused") {
  CHECK(loadError("gibbs-commands", "@tool_data, >value*", "@tol_data, >value*") ==
        "`TOL_DATA` is no family of the tables; the nearest is `TOOL_DATA`");
  CHECK(loadError("gibbs-commands", "use = \"CLEAR_PART_COMMENT\"", "use = \"CLEAR_PART_COMENT\"") ==
        "`CLEAR_PART_COMENT` is no command of the tables; the nearest is `CLEAR_PART_COMMENT`");
  CHECK(loadError("gibbs-commands", "\"POINT_XY point_number, x, y\"", "\"POINT_XY point_number, X y\"") ==
        "signature `POINT_XY point_number, X y`: `X y` is no argument");
  CHECK(loadError("gibbs-commands", "\"NEXT_TOOL_NUMBER\", ", "") ==
        "`NEXT_TOOL_NUMBER` is missing in `unpure_reads` of keywords/gibbs-commands.toml");
  CHECK(loadError("gibbs-commands", "grade = \"U\"", "grade = \"X\"") ==
        "`grade` is \"X\"; one of \"D\", \"O\", \"I\", \"U\" is expected");
  CHECK(loadError("gibbs-commands", "core = true", "cor = true").starts_with("unknown key `cor`"));
  CHECK(loadError("gibbs-parameters", "name = \"tg_data\"", "name = \"tool_data\"") ==
        "`TOOL_DATA` is given twice");
  CHECK(loadError("gibbs-parameters", "\"COMMENT\"", "\"ID\"") == "`ID` of `TOOL_DATA` has two kinds");
  CHECK(loadError("gibbs-parameters", "host = \"retract\"", "host = \"retrakt\"") ==
        "`retrakt` is no host input");
  CHECK(loadError("gibbs-functions", "args = \"tnn\"", "args = \"tnx\"").starts_with("`args` is \"tnx\""));
  CHECK(loadError("gibbs-variables", "\"CircleRef\"", "\"LineRef\"") == "`LINEREF` is given twice");
  CHECK(loadError("gibbs-variables", "[\"GET_OP_LIST\"]", "[\"GET_OPS\"]") ==
        "`GET_OPS` is no command of the tables");
  CHECK(loadError("gibbs-dialog", "first = \"DIALOG\"", "first = \"WINDOW\"") ==
        "`WINDOW` is no control of the tables");
  CHECK(
      loadError("gibbs-system-macros", "when = \"at\"\n", "when = \"on\"\n").starts_with("`when` is \"on\""));
}

TEST_CASE("signatures") {
  std::string defect;
  const auto s = parseSignature("A_B ?>x$[]...4, ?CW|CCW", defect);
  REQUIRE(s);
  CHECK(s->name == "A_B");
  CHECK(s->arguments[0].optional);
  CHECK(s->arguments[0].kind == ArgumentSpec::Kind::Result);
  CHECK(s->arguments[0].type == ArgumentSpec::Type::Text);
  CHECK(s->arguments[0].array);
  CHECK(s->arguments[0].repeat == 4);
  CHECK(s->arguments[1].keywords.size() == 2);
  CHECK(parseSignature("X <>y*", defect)->arguments[0].kind == ArgumentSpec::Kind::ReadWrite);
  CHECK(parseSignature("X", defect)->arguments.empty());
  for (const char* bad : {"", "x y", "X ", "X y,", "X y,z", "X y, ", "X @", "X @A", "X >", "X A|", "X y...0",
                          "X ?y, z", "X y..", "X y$$", "X  y", "X y...99999999999"}) {
    CAPTURE(bad);
    CHECK_FALSE(parseSignature(bad, defect));
  }
}
