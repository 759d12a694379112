// Parts as TOML files; docs/part.md states the format.
#pragma once

#include "sim/geometry/Part.h"
#include "support/Diagnostics.h"
#include "support/Files.h"
#include "support/Limits.h"

#include <functional>
#include <optional>
#include <string>

namespace dotek::sim {

struct PartFile {
  Part part; // placed as the file says
  Placement nominal, error;
};

// Bytes of a mesh that a part names; nothing: it cannot be read, which is reported.
using ReadMesh = std::function<std::optional<std::string>(const std::string& name, SourceRange where)>;

// Nothing where an error was reported: every unknown key, contradiction and size that makes no solid is one.
std::optional<PartFile> readPart(FileId file, const SourceMap& sources, const ReadMesh& readMesh,
                                 Diagnostics& diagnostics);
// The same for a file on disk; meshes are looked for from its folder on, and read where `bounds` allow it.
std::optional<PartFile> loadPart(const std::string& path, const Limits& limits, const ReadBounds& bounds,
                                 SourceMap& sources, Diagnostics& diagnostics);
// "parts/" of "parts/plate.toml", "" of "plate.toml".
std::string folderOf(const std::string& path);

} // namespace dotek::sim
