#include "stdlib/Control.h"

#include "DataFolder.h"
#include "stdlib/DataFiles.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <set>

using namespace dotek;
using namespace dotek::stdlib;

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

TEST_CASE("what every built-in control has: the functions that a probing program uses") {
  const DataFiles files;
  for (const DataFile* file : files.list("controls")) {
    CAPTURE(file->name);
    const Control control = ::control(file->name);
    CHECK(function(control, 'G', 0) == Function::Rapid);
    CHECK(function(control, 'G', 1) == Function::Feed);
    CHECK(function(control, 'G', 17) == Function::PlaneXY);
    CHECK(function(control, 'G', 20) == Function::Inch);
    CHECK(function(control, 'G', 21) == Function::Metric);
    CHECK(function(control, 'G', 31) == Function::Skip);
    CHECK(function(control, 'G', 40) == Function::CutterCompOff);
    CHECK(function(control, 'G', 41) == Function::Other);
    CHECK(function(control, 'G', 43) == Function::ToolLengthPlus);
    CHECK(function(control, 'G', 49) == Function::ToolLengthOff);
    CHECK(function(control, 'G', 52) == Function::LocalShift);
    CHECK(function(control, 'G', 56) == Function::WorkSystem);
    CHECK(function(control, 'G', 65) == Function::MacroCall);
    CHECK(function(control, 'G', 80) == Function::CannedCycleOff);
    CHECK(function(control, 'G', 81) == Function::Other);
    CHECK(function(control, 'G', 90) == Function::Absolute);
    CHECK(function(control, 'G', 91) == Function::Incremental);
    CHECK(function(control, 'M', 5) == Function::SpindleOff);
    CHECK(function(control, 'M', 9) == Function::CoolantOff);
    CHECK(function(control, 'M', 30) == Function::ProgramEnd);
    CHECK(function(control, 'M', 99) == Function::Return);
    CHECK(control.find('G', 5101 * 10) == nullptr); // a call of that machine's own macros
    // What the program asks before it begins stands in the same groups on all three.
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
  CHECK(c.find('G', 501)->function == Function::Other);
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
