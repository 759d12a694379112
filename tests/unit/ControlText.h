// A control of a test's own, in a line a section.
#pragma once

#include "DataFolder.h"
#include "stdlib/Control.h"
#include "stdlib/DataFiles.h"

#include <doctest/doctest.h>
#include <string>
#include <string_view>

namespace dotek::tests {

// Loads controls/own.toml with this text: what is wrong with it, without the path. "" where it loads.
inline std::string controlError(const std::string& text) {
  const DataFolder folder;
  const std::string path = folder.write("controls/own.toml", text);
  stdlib::DataFiles files;
  Diagnostics diagnostics;
  REQUIRE(files.addFolder(folder.path(), Limits{}, diagnostics));
  try {
    const std::optional<stdlib::Control> control = stdlib::Control::load(files, "own");
    CHECK(control->origin == path);
  } catch (const stdlib::DataError& error) {
    const std::string what = error.what();
    REQUIRE(what.starts_with(path + ":"));
    return what.substr(path.size() + 1);
  }
  return "";
}

// A control in one line a section, so that lines are easy to tell. `from` in it is replaced by `to`.
inline std::string own(std::string_view from = "", std::string_view to = "") {
  std::string text =
      "schema = 1\n"
      "title = 'Own'\n"
      "decimal = {mode='increment',grade='observed',source='x'}\n"                                     // 3
      "words = {increment=0.001,decimals=3,integer_digits=5,grade='assumed',source='x'}\n"             // 4
      "language = {if_then=true,joined_conditions=false,bracket_depth=5,locals=33,macro_levels=4,"     // 5
      "functions=['SIN','ATAN','ATAN[y]'],grade='assumed',source='x'}\n"                               //
      "common = [{first=100,last=149,kept=false,grade='assumed',source='x'},\n"                        // 6
      "{first=500,last=531,kept=true,grade='assumed',source='x'}]\n"                                   // 7
      "alarm = {first=0,last=200,length=26,grade='assumed',source='x'}\n"                              // 8
      "programs = {last=9999,last_sequence=9999,grade='assumed',source='x'}\n"                         // 9
      "variables = {modal_first=4000,block_end=5001,skip=5061,work_offset_x=5221,system_step=20,"      // 10
      "axis_step=1,grade='assumed',source='x'}\n"                                                      //
      "codes = [{group=3,grade='assumed',source='x',list=['G90 absolute: a','G91 incremental: b']},\n" // 11
      "{group=14,grade='assumed',source='x',list=['G54 work-system: c']},\n"                           // 12
      "{grade='assumed',source='x',list=['G4 dwell: d','M31 probe-on: e']}]\n";                        // 13
  if (from.empty()) return text;
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

inline std::string changed(std::string_view from, std::string_view to) {
  return controlError(own(from, to));
}

} // namespace dotek::tests
