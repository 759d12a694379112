// Which files a command line names.
#pragma once

#include "cli/Arguments.h"
#include "support/OutputCheck.h"

#include <string>
#include <vector>

namespace dotek::cli {

// The picture that a report links: "run.svg" of "run.md"; "" of "".
std::string pictureBeside(const std::string& report);

// Where --report of this input goes: as named, or with the input's name before the ending where there are
// several inputs.
std::string reportPath(const Arguments& arguments, const std::string& input);

// `path`, or standard output where none is given.
std::string orStandardOutput(const std::string& path);

// false with a diagnostic: the inputs shall be changed in place, and one is a pipe or a device.
bool canChangeInputs(const Arguments& arguments, Diagnostics& diagnostics);

// What the command will write, standard output where it prints there. Files of `-d` have names later.
std::vector<OutputName> outputsOf(const Arguments& arguments);

// What it names to be read, and the data files below `--data`.
std::vector<std::string> inputsOf(const Arguments& arguments);

} // namespace dotek::cli
