// What a command is about to write, looked at before it does anything.
#pragma once

#include "support/Output.h"
#include "support/OutputFile.h"

#include <set>
#include <string>
#include <vector>

namespace dotek {

struct OutputName {
  std::string name; // as messages call it: "`--map F`", "standard output"
  std::string path;
};

// false with a diagnostic: one cannot be written, one is written by two, or one is an input.
bool checkOutputs(const std::vector<OutputName>& outputs, const std::vector<std::string>& inputs, bool force,
                  Diagnostics& diagnostics);

// Names of `files` that would replace a file of `folder` which is not of the same input; a diagnostic each.
std::set<std::string> heldByOthers(const std::vector<OutputFile>& files, const std::string& folder,
                                   Diagnostics& diagnostics);

// false with a diagnostic: one of `paths` is one of the files that were read.
bool checkRead(const std::vector<std::string>& paths, const SourceMap& sources, Diagnostics& diagnostics);

} // namespace dotek
