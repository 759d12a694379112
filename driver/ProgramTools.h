// Commands for programs of Macro B: `dotek outline`, `dotek renumber`, `dotek new macros`, `dotek flatten`.
#pragma once

#include "driver/Driver.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dotek::driver {

struct OutlineOptions {
  std::vector<std::string> inputs;
  CommonOptions common;
  bool json = false;
};

struct RenumberCommandOptions {
  std::vector<std::string> inputs;
  CommonOptions common;
  std::uint64_t start = 10, step = 10;
  bool all = false;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> range; // N numbers as they are
  std::string control; // whose greatest number counts; "": of dotek.toml, else 99999
};

// An outline of no file, as JSON.
inline constexpr std::string_view kEmptyOutline = "[\n]\n";
// Programs, their N numbers, calls, jumps and variables. What of a file cannot be read is reported, and the
// rest is shown.
Outcome outline(const OutlineOptions& options);
// `files`: the programs with new numbers, by the name of the input; `inputs`: those that change. A file with
// an error, or with a jump that nobody can follow, gives none.
Outcome renumber(const RenumberCommandOptions& options);
// The programs of a set of probing macros, as the control's memory holds them. Of most sets only the vendor
// has them, which is an error.
Outcome newMacros(const std::string& name, const CommonOptions& common);
// The blocks that a run of the program makes, with values in the place of variables, as one program: a run of
// it with the same part and setup, and without `setup.call`, does the same. A run that does not come to its
// end gives none. Of `options` count those that say what runs, on what, and where it begins.
Outcome flatten(const SimOptions& options);

} // namespace dotek::driver
