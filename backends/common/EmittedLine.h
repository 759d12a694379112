// What every back end gives: text, line by line, with what each line comes from.
#pragma once

#include "support/Source.h"

#include <string>
#include <vector>

namespace dotek::backends {

struct EmittedLine {
  std::string text;                // ASCII, without line end
  std::vector<SourceRange> ranges; // empty: made up
  std::string reason;              // why it is made up, or what else there is to say; "": the ranges say all
};

} // namespace dotek::backends
