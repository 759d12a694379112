// Reading inputs. Nothing here throws.
#pragma once

#include "support/Diagnostics.h"
#include "support/Limits.h"
#include "support/Source.h"

#include <optional>
#include <string>

namespace dotek {

// Bytes of a file; nullopt with a diagnostic if it cannot be read or is larger than the limit.
std::optional<std::string> readBytes(const std::string& path, const Limits& limits, Diagnostics& diagnostics);

// Reads a text file into the map: UTF-8 if it decodes, else `fallback`; `forced` overrides both.
// UTF-16 and NUL bytes are errors that say so. nullopt where an error was reported.
std::optional<FileId> readText(const std::string& path, Encoding fallback, std::optional<Encoding> forced,
                               const Limits& limits, SourceMap& sources, Diagnostics& diagnostics);

// As readText, for bytes that are at hand; `name` is what diagnostics print.
std::optional<FileId> addText(std::string name, std::string bytes, Encoding fallback,
                              std::optional<Encoding> forced, SourceMap& sources, Diagnostics& diagnostics);

} // namespace dotek
