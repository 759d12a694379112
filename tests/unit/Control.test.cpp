#include "stdlib/Control.h"
#include "stdlib/CalledProgram.h"

#include "ControlText.h"
#include "stdlib/DataFiles.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <set>

using namespace dotek;
using namespace dotek::stdlib;
using tests::changed;
using tests::controlError;
using tests::own;

namespace {

Control control(std::string_view name) {
  std::optional<Control> out = Control::load(DataFiles(), name);
  REQUIRE(out);
  return std::move(*out);
}

std::optional<int> group(const Control& control, char letter, std::uint32_t tenths) {
  const CodeInfo* code = control.find(letter, tenths);
  REQUIRE(code != nullptr);
  return code->group;
}

Function function(const Control& control, char letter, std::uint32_t number) {
  const CodeInfo* code = control.find(letter, number * 10);
  REQUIRE(code != nullptr);
  return code->function;
}

} // namespace

TEST_CASE("every built-in control loads, and every code has a title, a grade and a source") {
  const DataFiles files;
  std::set<std::string> names;
  for (const DataFile* file : files.list("controls")) {
    CAPTURE(file->name);
    names.insert(file->name);
    const Control control = ::control(file->name);
    CHECK(control.name == file->name);
    CHECK(control.origin == "built in");
    CHECK_FALSE(control.title.empty());
    for (const CodeInfo& code : control.codes) {
      CAPTURE(code.tenths);
      CHECK_FALSE(code.title.empty());
      CHECK_FALSE(code.grade.empty());
      CHECK_FALSE(code.source.empty());
    }
  }
  for (const char* name : {"fanuc-0i-md", "fanuc-31i-b", "fanuc-6m"})
    CHECK(names.contains(name));
  CHECK_FALSE(Control::load(files, "fanuc"));
}

TEST_CASE("what every built-in control of Fanuc has: the functions that a probing program uses") {
  const DataFiles files;
  for (const DataFile* file : files.list("controls")) {
    const Control control = ::control(file->name);
    if (!file->name.starts_with("fanuc") || control.turning) continue;
    CAPTURE(file->name);
    CHECK(function(control, 'G', 0) == Function::Rapid);
    CHECK(function(control, 'G', 1) == Function::Feed);
    CHECK(function(control, 'G', 17) == Function::PlaneXY);
    CHECK(function(control, 'G', 20) == Function::Inch);
    CHECK(function(control, 'G', 21) == Function::Metric);
    CHECK(function(control, 'G', 31) == Function::Skip);
    CHECK(function(control, 'G', 40) == Function::CutterCompOff);
    CHECK(function(control, 'G', 41) == Function::CutterCompLeft);
    CHECK(function(control, 'G', 2) == Function::ArcClockwise);
    CHECK(function(control, 'G', 28) == Function::ReferenceReturn);
    CHECK(function(control, 'G', 92) == Function::SetPosition);
    CHECK(function(control, 'G', 10) == Function::DataInput);
    CHECK(function(control, 'G', 43) == Function::ToolLengthPlus);
    CHECK(function(control, 'G', 49) == Function::ToolLengthOff);
    CHECK(function(control, 'G', 52) == Function::LocalShift);
    CHECK(function(control, 'G', 56) == Function::WorkSystem);
    CHECK(function(control, 'G', 65) == Function::MacroCall);
    CHECK(function(control, 'G', 80) == Function::CannedCycleOff);
    CHECK(function(control, 'G', 81) == Function::CannedCycle);
    CHECK(function(control, 'G', 87) == Function::BackBoring);
    CHECK(function(control, 'G', 99) == Function::ReturnR);
    CHECK(function(control, 'M', 6) == Function::ToolChange);
    CHECK(function(control, 'G', 27) == Function::Other);
    CHECK(function(control, 'G', 90) == Function::Absolute);
    CHECK(function(control, 'G', 91) == Function::Incremental);
    CHECK(function(control, 'M', 5) == Function::SpindleOff);
    CHECK(function(control, 'M', 9) == Function::CoolantOff);
    CHECK(function(control, 'M', 30) == Function::ProgramEnd);
    CHECK(function(control, 'M', 99) == Function::Return);
    CHECK(control.find('G', 5101 * 10) == nullptr); // a call of that machine's own macros
    // What the program asks before it begins is in the same groups on all three.
    CHECK(group(control, 'G', 0) == 1);
    CHECK(group(control, 'G', 170) == 2);
    CHECK(group(control, 'G', 900) == 3);
    CHECK(group(control, 'G', 940) == 5);
    CHECK(group(control, 'G', 210) == 6);
    CHECK(group(control, 'G', 400) == 7);
    CHECK(group(control, 'G', 430) == 8);
    CHECK(group(control, 'G', 800) == 9);
    CHECK(group(control, 'G', 980) == 10);
    CHECK(group(control, 'G', 510) == 11);
    CHECK(group(control, 'G', 680) == 16);
    CHECK(group(control, 'G', 310) == std::nullopt);
    CHECK(group(control, 'G', 650) == std::nullopt);
    CHECK(control.variables.modalFirst == 4000);
    CHECK(control.variables.modalFeed == 4109);
    CHECK(control.variables.blockEnd == 5001);
    CHECK(control.variables.machine == 5021);
    CHECK(control.variables.position == 5041);
    CHECK(control.increment == 0.001);
    CHECK(control.decimals == 3);
    CHECK(control.bracketDepth == 5);
    CHECK(control.locals == 33);
    CHECK(control.alarmFirst == 0);
    CHECK(control.alarmLast == 200);
    CHECK(control.programLast == 9999);
    for (const char* name : {"SIN", "COS", "TAN", "ATAN", "ATAN[y]", "SQRT", "ABS", "ROUND", "FIX", "FUP"})
      CHECK(control.functions.contains(name));
  }
}

TEST_CASE("the 0i-MD: facts of the reference") {
  const Control c = control("fanuc-0i-md");
  CHECK(c.decimal == DecimalMode::Calculator);
  CHECK(c.decimalGrade == "assumed");
  CHECK(c.ifThen);
  CHECK(c.joinedConditions);
  CHECK(c.macroLevels == 5);
  CHECK(c.alarmLength == 26);
  CHECK(group(c, 'G', 560) == 14);
  CHECK(group(c, 'G', 541) == 14);
  CHECK(group(c, 'G', 501) == 22);
  CHECK(group(c, 'G', 160) == 17);
  CHECK(c.find('G', 541)->function == Function::ExtendedWorkSystem);
  CHECK(c.find('G', 501)->function == Function::MirrorOff);
  CHECK(c.find('G', 71)->function == Function::Other);
  CHECK(c.variables.extendedX == 7001);
  CHECK(c.variables.extendedCount == 48);
  CHECK(c.variables.toolWear == 2000);
  CHECK(c.repeatLetter == 'K');
  CHECK(c.arcTolerance == 0.03);
  CHECK(c.find(Alarm::WriteProtected)->number == 116);
  CHECK(c.find(Alarm::WriteProtected)->text == "WRITE PROTECTED VARIABLE");
  CHECK(c.find(Alarm::NoFeed)->number == 11);
  CHECK(c.find(Function::ProbeOn)->letter == 'M');
  CHECK(c.find(Function::ProbeOn)->tenths == 310);
  CHECK(c.find(Function::ProbeOff)->tenths == 320);
  CHECK(c.find(Function::WorkSystem)->tenths == 540);
  CHECK(c.variables.skip == 5061);
  CHECK(c.variables.externalX == 5201);
  CHECK(c.variables.workOffsetX == 5221);
  CHECK(c.variables.systemStep == 20);
  CHECK(c.variables.axisStep == 1);
  // Y of G56 is #5262
  CHECK(*c.variables.workOffsetX + 2 * c.variables.systemStep + c.variables.axisStep == 5262);
  CHECK(c.functions.contains("ACOS"));
  CHECK(c.functions.contains("ATAN[y]/[x]"));
  CHECK_FALSE(c.functions.contains("MOD"));
  CHECK_FALSE(c.functions.contains("POW"));
}

TEST_CASE("the 31i-B: facts of the reference") {
  const Control c = control("fanuc-31i-b");
  CHECK(c.decimal == DecimalMode::Calculator);
  CHECK(c.decimalGrade == "observed");
  CHECK(c.ifThen);
  CHECK(c.joinedConditions);
  CHECK(c.alarmLength == 31);
  CHECK(group(c, 'G', 590) == 14);
  CHECK(group(c, 'G', 661) == 12);
  CHECK(c.variables.skip == 5061);
  CHECK(c.variables.workOffsetX == 5221);
  CHECK(c.functions.contains("MOD"));
  CHECK(c.functions.contains("ATAN[y,x]"));
  // Which of M10 and M11 switches the probe on is not known.
  CHECK(c.find(Function::ProbeOn) == nullptr);
  CHECK(c.find(Function::ProbeOff) == nullptr);
  CHECK(c.find('M', 100) == nullptr);
  CHECK(c.find('M', 110) == nullptr);
}

TEST_CASE("the 6M: facts of the reference") {
  const Control c = control("fanuc-6m");
  CHECK(c.decimal == DecimalMode::Increment);
  CHECK_FALSE(c.ifThen);
  CHECK_FALSE(c.joinedConditions);
  CHECK(c.macroLevels == 4);
  CHECK(c.alarmLength == 26);
  CHECK_FALSE(c.variables.skip);
  CHECK(c.variables.externalX == 2500);
  CHECK(c.variables.workOffsetX == 2501);
  // Y of G56 is #2603
  CHECK(*c.variables.workOffsetX + 2 * c.variables.systemStep + c.variables.axisStep == 2603);
  for (const char* name : {"ASIN", "ACOS", "LN", "EXP", "MOD", "POW", "AND", "ATAN[y]/[x]"})
    CHECK_FALSE(c.functions.contains(name));
  // Group 12 or 14: not known, so no program may ask it.
  CHECK(group(c, 'G', 540) == std::nullopt);
  // What may exist is listed, so that nothing counts on its absence.
  CHECK(c.find('G', 520)->grade == "assumed");
  CHECK(c.find('G', 680)->grade == "assumed");
  CHECK(c.find(Function::ExtendedWorkSystem) == nullptr);
  CHECK(c.find(Function::ProbeOn) == nullptr);
}

TEST_CASE("common variables of the controls") {
  struct Row {
    const char* control;
    std::uint32_t number;
    bool common;
  };
  constexpr Row kRows[] = {
      {"fanuc-0i-md", 33, false}, {"fanuc-0i-md", 99, false},  {"fanuc-0i-md", 100, true},
      {"fanuc-0i-md", 199, true}, {"fanuc-0i-md", 200, false}, {"fanuc-0i-md", 499, false},
      {"fanuc-0i-md", 500, true}, {"fanuc-0i-md", 999, true},  {"fanuc-0i-md", 1000, false},
      {"fanuc-31i-b", 199, true}, {"fanuc-31i-b", 999, true},  {"fanuc-31i-b", 5061, false},
      {"fanuc-6m", 149, true},    {"fanuc-6m", 150, false},    {"fanuc-6m", 511, true},
      {"fanuc-6m", 512, true},    {"fanuc-6m", 559, true},     {"fanuc-6m", 560, false},
  };
  for (const Row& row : kRows) {
    CAPTURE(row.control);
    CAPTURE(row.number);
    CHECK(control(row.control).isCommon(row.number) == row.common);
  }
  CHECK_FALSE(control("fanuc-6m").common.at(0).kept);
  CHECK(control("fanuc-6m").common.at(1).kept);
}

TEST_CASE("names of functions") {
  CHECK(functionName(Function::Other) == "other");
  CHECK(functionName(Function::ProbeOff) == "probe-off");
  CHECK(functionName(Function::Return) == "return");
}

TEST_CASE("a control of one's own") {
  CHECK(controlError(own()) == "");
  CHECK(changed(",'M31 probe-on: e'", "") == "");
  CHECK(changed("G4 dwell: d", "G5.1: anything: with a colon") == "");
  CHECK(changed("'M31 probe-on: e'", "'G131 probe-on: e'") == ""); // a G code on some machines
}

TEST_CASE("defects of a control, with line and column: values") {
  CHECK(controlError("title = 'x'\n") == "1:1: `schema = 1` is missing; it is expected as the first key");
  CHECK(changed("title = 'Own'", "titel = 'Own'").find("`title` is missing") != std::string::npos);
  CHECK(changed("schema = 1\n", "schema = 1\nkind = 'mill'\n").starts_with("2:1: unknown key `kind`"));
  CHECK(changed("'increment'", "'metric'") ==
        "3:17: `mode` is \"metric\"; one of \"increment\", \"calculator\" is expected");
  CHECK(changed("grade='observed'", "grade='sure'").starts_with("3:35: `grade` is \"sure\""));
  CHECK(changed(",source='x'", "") == "3:11: `source` is missing; where the fact comes from is expected");
  CHECK(changed("increment=0.001", "increment=0.01") ==
        "4:20: an increment of 0.01 is not one unit of decimal 3");
  CHECK(changed("decimals=3", "decimals=7") == "4:35: `decimals` is 7; 0 to 6 is expected");
  CHECK(changed("if_then=true,", "") == "5:12: `if_then` is missing; true or false is expected");
  CHECK(changed("'SIN'", "'SINE'") ==
        "5:102: `SINE` is no function of macro statements; the nearest is `SIN`");
  CHECK(changed("'SIN'", "'ATAN'").starts_with("5:109: `ATAN` is given twice"));
  CHECK(changed("'ATAN',", "").ends_with("`ATAN[y]` is a form of `ATAN`, which is missing"));
  CHECK(changed("first=100", "first=150") == "6:11: #150 to #149 is no range");
  CHECK(changed("first=100", "first=33") == "6:11: #33 is a local variable");
  CHECK(changed("first=500", "first=149") == "7:1: #149 to #531 overlaps #100 to #149");
  CHECK(changed("first=0", "first=201") == "8:9: 201 to 200 is no range");
  CHECK(changed("length=26", "length=0") == "8:34: `length` is 0; 1 to 999 is expected");
  CHECK(changed("last=9999,", "").starts_with("9:12: `last` is missing"));
  std::string many = "common = [";
  for (int i = 0; i < 101; ++i)
    many += fmt::format("{{first={0},last={0},kept=true,grade='assumed',source='x'}},", 600 + i);
  CHECK(changed("common = [", many).ends_with("more than 100 ranges"));
}

TEST_CASE("defects of a control, with line and column: variables") {
  CHECK(changed("system_step=20,", "") == "10:70: `work_offset_x` is without `system_step`");
  CHECK(changed("axis_step=1,", "") == "10:70: an offset of X is without `axis_step`");
  CHECK(changed("skip=5061", "skip=5003") == "10:51: #5003 is a variable of `block_end` and of `skip`");
  CHECK(changed("system_step=20", "system_step=2") ==
        "10:70: #5223 is a variable of `work_offset_x` twice: its steps meet");
  CHECK(changed("skip=5061", "skip=500").ends_with("`skip` is 500; 1000 to 999999 is expected"));
  CHECK(changed("modal_first=4000", "modal_first=4998").find("#5001 is a variable of") != std::string::npos);
  CHECK(changed("last=531", "last=5061").ends_with("#5001 is a common variable"));
}

TEST_CASE("defects of a control, with line and column: motion and alarms") {
  const auto with = [](const std::string& text) {
    return controlError(own("codes = [", text + "\ncodes = ["));
  };
  const std::string origin = "grade='assumed',source='x'";
  CHECK(with("motion = {arc_tolerance=0.02,repeat='L'," + origin + "}") == "");
  CHECK(with("motion = {arc_tolerance=0," + origin + "}") == "11:25: `arc_tolerance` is a length in mm");
  CHECK(with("motion = {repeat='P'," + origin + "}").starts_with("11:18: `repeat` is \"P\""));
  CHECK(with("motion = {repeat='K'}").find("`grade` is missing") != std::string::npos);
  const auto alarm = [&](const std::string& list) {
    return with("alarms = [{" + origin + ",list=[" + list + "]}]");
  };
  CHECK(alarm("'no-feed 11: NO FEED','arc-radius 20: RADIUS'") == "");
  CHECK(
      alarm("'no-feed: NO FEED'").ends_with("is no alarm; `no-feed 11: NO FEEDRATE COMMANDED` is the form"));
  CHECK(alarm("'no-feed 1x: NO FEED'").find("is no alarm") != std::string::npos);
  CHECK(alarm("'no-feed 0: NO FEED'").find("is no alarm") != std::string::npos);
  CHECK(alarm("'no-fead 11: NO FEED'") ==
        "11:45: `no-fead` is no alarm that Dotek raises; the nearest is `no-feed`");
  CHECK(alarm("'no-feed 11: A','no-feed 12: B'").ends_with("`no-feed` is given twice"));
  CHECK(changed("axis_step=1,", "axis_step=1,extended_x=7001,")
            .ends_with("`extended_x` is without `extended_step` and `extended_count`"));
  CHECK(changed("axis_step=1,", "axis_step=1,tool_wear=2000,")
            .ends_with("tool offsets are without `tool_count`"));
}

TEST_CASE("defects of a control, with line and column: codes") {
  CHECK(changed("'G91 incremental: b'", "'G90: b'") == "11:70: `G90` is given twice");
  CHECK(changed("G4 dwell: d", "G54: d") == "13:35: `G54` is given twice");
  CHECK(changed("G4 dwell: d", "G4 dwell") ==
        "13:35: `G4 dwell` has no title; `G90 absolute: absolute programming` is the form");
  CHECK(changed("G4 dwell: d", "G4 dwell: ").find("has no title") != std::string::npos);
  CHECK(changed("G4 dwell: d", "G4 dwel: d") ==
        "13:35: `dwel` is no meaning of a code; the nearest is `dwell`");
  for (const char* bad : {"G04", "G", "4", "X4", "G4.", "G4.0", "G4.12", "G-4", "G123456", "g4", ""}) {
    CAPTURE(bad);
    CHECK(changed("G4 dwell: d", std::string(bad) + ": d") ==
          "13:35: `" + std::string(bad) + "` is no code; `G0`, `G54.1` or `M30` is the form");
  }
  CHECK(changed("G4 dwell: d", "M4 dwell: d") == "13:35: `dwell` is no M function, which `M4` is");
  CHECK(changed("G4 dwell: d", "G4 spindle-off: d") ==
        "13:35: `spindle-off` is no G function, which `G4` is");
  CHECK(changed("G54 work-system: c", "M54: c") == "12:44: `M54` is in modal group 14, which holds G codes");
  CHECK(changed("G54 work-system: c", "G60 work-system: c") ==
        "12:44: `G60` is no work system; they are G54 to G59");
  CHECK(changed("G54 work-system: c", "G90.1 absolute: c") ==
        "12:44: `G90.1` belongs with `G90` and is in another group");
  CHECK(changed("G91 incremental: b", "G20 inch: b") ==
        "11:70: `G20` cannot appear in group 3 with `G90`: one does not end the other");
  std::string many;
  for (int i = 100; i < 2200; ++i)
    many += fmt::format("'G{}: x',", i);
  CHECK(changed("'G4 dwell: d'", many + "'G4 dwell: d'").ends_with("more than 2000 codes"));
}

TEST_CASE("addresses that count lengths are data of the control") {
  for (const char* name : {"fanuc-0i-md", "fanuc-31i-b", "fanuc-6m"}) {
    CAPTURE(name);
    const Control one = control(name);
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
      CAPTURE(letter);
      const bool length = std::string_view("ABCIJKQRUVWXYZ").find(letter) != std::string_view::npos;
      CHECK(one.isLength(letter) == length);
      CHECK(one.countsIncrements(letter) == (length && one.decimal == DecimalMode::Increment));
    }
    CHECK_FALSE(one.isLength('#'));
  }
  const auto with = [](const char* letters) {
    return changed("words =", "lengths = {addresses='" + std::string(letters) +
                                  "',grade='assumed',source='x'}\nwords =");
  };
  CHECK(with("XYZE") == "");
  CHECK(with("XX") == "4:22: `X` is given twice");
  CHECK(with("xyz") == "4:22: `x` is no address; capital letters are");
  CHECK(with("XYP") == "4:22: `P` counts whole units on every control");
}

TEST_CASE("Haas NGC: what it has otherwise than the Fanuc that it extends") {
  const Control haas = control("haas-ngc");
  CHECK(haas.programLast == 99999);
  CHECK(haas.find('G', 541) == nullptr);
  CHECK(function(haas, 'G', 154) == Function::ExtendedWorkSystem);
  CHECK(function(haas, 'G', 103) == Function::Auxiliary);
  CHECK(function(haas, 'M', 97) == Function::SubprogramCall);
  CHECK(function(haas, 'G', 31) == Function::Skip);
  CHECK(haas.alarms.empty()); // Fanuc's numbers are not its own
  CHECK(haas.variables.toolGeometry == 2000);
  CHECK(haas.variables.toolWear == 2200);
  CHECK_FALSE(haas.variables.toolWearToo);
  CHECK_FALSE(haas.window);
  REQUIRE(haas.callCodes.size() == 2); // M97 P and M98 Q: a block of the same program
  CHECK(localCallAddress(haas, 'M', 97) == 'P');
  CHECK(localCallAddress(haas, 'M', 98) == 'Q');
  CHECK(localCallAddress(control("fanuc-6m"), 'M', 98) == 0);
  CHECK(haas.isCommon(10200));
  CHECK_FALSE(haas.isCommon(10150)); // another name of #150
  CHECK(haas.isCommon(700));         // macros made for it write #701
  CHECK_FALSE(haas.isCommon(750));
}
