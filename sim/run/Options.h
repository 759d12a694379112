// The options of `sim`.
#pragma once

#include "project/Options.h"
#include "stdlib/Setup.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::sim {

using stdlib::Setup; // what an operator sets

struct SimOptions {
  std::string program; // path
  project::CommonOptions common;
  std::string control;               // "": the first
  project::NamedTexts variables;     // --var N=VALUE
  project::NamedTexts shown;         // --show N=NAME or N=NAME=NOMINAL
  std::vector<std::string> programs; // --programs DIR: what can be called beside the programs of the file
  // --probe-macros: the set of vendors' macros that runs by its meaning; nothing: all.
  std::optional<std::string> probeMacros;
  std::optional<std::string> part, machine; // --part, --machine: paths
  Setup setup;                              // --tool, --length, --diameter, --work-offset, --at, --call
  std::optional<std::string> stock;         // --stock: path of a block that the program cuts
  bool stockMap = false;                    // the picture of it as file "stock-map"
  bool svg = false, html = false;           // pictures of the run as files "svg" and "html"
  std::uint8_t activeSystem = 0;            // --active-system: 0 to 5 for G54 to G59
  std::string date;                         // that the pictures show; "": none
  bool json = false;                        // the output is the summary as JSON
  // Takes the trace while the program runs, in pieces of whole lines. Empty: no trace is made.
  std::function<void(std::string_view)> trace;
};

} // namespace dotek::sim
