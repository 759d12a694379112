// The documents that a command prints for another program.
#pragma once

#include "driver/Driver.h"

#include <string>
#include <string_view>

namespace dotek::cli {

// Findings as --format names it; "" for a text or a format that does not exist.
std::string findingsDocument(std::string_view format, const driver::Outcome& outcome);

// What a command prints that did not run, where a document is asked for: by `json`, or as `format` of
// findings. "": none is.
std::string notRunDocument(std::string_view command, bool json, std::string_view format,
                           const driver::Outcome& outcome);

} // namespace dotek::cli
