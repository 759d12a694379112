#include "project/SettingsPlace.h"

#include "support/Files.h"
#include "support/messages/Common.h"

namespace dotek::project {

namespace fs = std::filesystem;

fs::path settingsFileIn(const fs::path& folder) {
  std::error_code error;
  fs::path file = folder / "dotek.toml";
  return fs::exists(fs::symlink_status(file, error)) ? file : fs::path();
}

std::optional<FileId> readSettings(const fs::path& file, const Limits& limits, SourceMap& sources,
                                   Diagnostics& diagnostics) {
  const std::string path = file.generic_string();
  if (!isStream(path)) return readText(path, Encoding::Utf8, std::nullopt, limits, sources, diagnostics);
  diagnostics.report<diag::FileNotReadable>({}, path, "it is no regular file");
  return std::nullopt;
}

} // namespace dotek::project
