// Reading inputs and writing results. Nothing here throws.
#pragma once

#include "support/Diagnostics.h"
#include "support/Limits.h"
#include "support/Source.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

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

// Writes a temporary file beside `path` and renames it: the result is complete or absent.
bool writeAtomically(const std::string& path, const std::string& bytes, Diagnostics& diagnostics);

// The same for several files: all temporary files are written before the first is renamed. `folder` is made
// where it is missing ("": none).
bool writeAllAtomically(const std::vector<std::pair<std::string, const std::string*>>& files,
                        const std::string& folder, Diagnostics& diagnostics);

} // namespace dotek
