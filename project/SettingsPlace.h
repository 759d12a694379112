// Where a dotek.toml is found, and how it is read.
#pragma once

#include "support/Diagnostics.h"
#include "support/Limits.h"
#include "support/Source.h"

#include <filesystem>
#include <optional>

namespace dotek::project {

// The dotek.toml of a folder; empty where nothing there is called so. A link that leads nowhere, a folder and
// a pipe count: whoever reads it says what is wrong, instead of going on without the settings.
std::filesystem::path settingsFileIn(const std::filesystem::path& folder);

// nullopt with a diagnostic. A pipe or a device is refused: nobody named it, and it may never end.
std::optional<FileId> readSettings(const std::filesystem::path& file, const Limits& limits,
                                   SourceMap& sources, Diagnostics& diagnostics);

} // namespace dotek::project
