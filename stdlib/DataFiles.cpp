#include "stdlib/DataFiles.h"

#include "stdlib/ControlFiles.h"
#include "stdlib/EmbeddedData.h"
#include "stdlib/Toml.h"
#include "support/Files.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace dotek::stdlib {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kKinds[] = {"controls", "cycles", "forms",  "fusion",
                                       "keywords", "macrob", "macros", "mikroprog"};
constexpr std::string_view kReads =
    "`controls/*.toml`, `cycles/*.cycle`, `forms/*.toml`, `fusion/*.toml`, `keywords/*.toml`, "
    "`macrob/*.nc`, `macros/*.toml` and `mikroprog/*.toml`";

// Entries of a folder in byte order; false with a diagnostic where it cannot be read.
bool listFolder(const fs::path& folder, const Limits& limits, std::vector<fs::path>& out,
                Diagnostics& diagnostics) {
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  for (; !error && entries != fs::directory_iterator(); entries.increment(error)) {
    if (out.size() == limits.files) {
      diagnostics.report<diag::FileNotReadable>({}, folder.string(),
                                                "it holds more files than `--limit files=N` allows");
      return false;
    }
    out.push_back(entries->path());
  }
  if (error) {
    diagnostics.report<diag::FileNotReadable>({}, folder.string(), error.message());
    return false;
  }
  std::sort(out.begin(), out.end());
  return true;
}

bool before(const DataFile& file, std::string_view folder, std::string_view name) {
  return file.folder != folder ? file.folder < folder : file.name < name;
}

// In the place of one of the same name.
void put(std::vector<DataFile>& files, DataFile one) {
  const auto at = std::lower_bound(files.begin(), files.end(), 0, [&](const DataFile& other, int) {
    return before(other, one.folder, one.name);
  });
  if (at == files.end() || at->folder != one.folder || at->name != one.name)
    files.insert(at, std::move(one));
  else
    *at = std::move(one);
}

// Programs of a control in `macrob`, cycles in `cycles`, data elsewhere.
bool isDataFile(const fs::path& path, std::string_view kind) {
  std::error_code error;
  const char* const end = kind == "macrob" ? ".nc" : kind == "cycles" ? ".cycle" : ".toml";
  return path.extension() == end && !path.stem().empty() && !fs::is_directory(path, error);
}

} // namespace

DataFiles::DataFiles() {
  for (const EmbeddedFile& file : embeddedFiles()) {
    const std::size_t slash = file.path.find('/');
    const std::string_view name = file.path.substr(slash + 1);
    files_.push_back({std::string(file.path.substr(0, slash)), std::string(name.substr(0, name.rfind('.'))),
                      "built in", file.text});
  }
  std::sort(files_.begin(), files_.end(),
            [](const DataFile& a, const DataFile& b) { return before(a, b.folder, b.name); });
}

bool DataFiles::addFolder(const std::string& path, const Limits& limits, Diagnostics& diagnostics) {
  std::error_code error;
  const fs::path root(path);
  if (!fs::exists(root, error)) {
    diagnostics.report<diag::FileNotFound>({}, path);
    return false;
  }
  // A control by its path (ControlFiles.h).
  if (fs::is_regular_file(root, error) && root.extension() == ".toml") {
    std::optional<std::string> bytes = readBytes(path, limits, diagnostics);
    if (!bytes) return false;
    loaded_.push_back(std::make_unique<std::string>(std::move(*bytes)));
    put(files_, {"controls", path, path, *loaded_.back()});
    // The controls that it extends by their paths.
    std::string base;
    try {
      base = TomlDocument::parse(*find("controls", path)).root().value("extends").text();
    } catch (const DataError& defect) {
      diagnostics.report<diag::FileNotReadable>({}, path, defect.what());
      return false;
    }
    if (!isDataPath(base) || find("controls", base) != nullptr) return true;
    const std::string next = besideFile(path, base);
    return find("controls", next) != nullptr || !fs::is_regular_file(next, error) ||
           addFolder(next, limits, diagnostics);
  }
  if (!fs::is_directory(root, error)) {
    diagnostics.report<diag::FileNotReadable>({}, path, "it is no folder");
    return false;
  }
  std::vector<fs::path> folders;
  if (!listFolder(root, limits, folders, diagnostics)) return false;

  bool ok = true;
  bool any = false;
  for (const fs::path& folder : folders) {
    if (isDataFile(folder, "")) diagnostics.report<diag::DataFolderUnused>({}, folder.string(), kReads);
    if (!fs::is_directory(folder, error)) continue;
    const std::string kind = folder.filename().string();
    const bool known = std::find(std::begin(kKinds), std::end(kKinds), kind) != std::end(kKinds);
    std::vector<fs::path> paths;
    if (!listFolder(folder, limits, paths, diagnostics)) {
      ok = false;
      continue;
    }
    for (const fs::path& file : paths) {
      if (!isDataFile(file, kind)) continue;
      any = true;
      if (!known) {
        diagnostics.report<diag::DataFolderUnused>({}, file.string(), kReads);
        continue;
      }
      // Nobody named a pipe in the folder, and it may never end.
      const bool stream = isStream(file.string());
      if (stream) diagnostics.report<diag::FileNotReadable>({}, file.string(), "it is no regular file");
      std::optional<std::string> bytes =
          stream ? std::nullopt : readBytes(file.string(), limits, diagnostics);
      if (!bytes) {
        ok = false;
        continue;
      }
      loaded_.push_back(std::make_unique<std::string>(std::move(*bytes)));
      put(files_, {kind, file.stem().string(), file.string(), *loaded_.back()});
    }
  }
  if (ok && !any) diagnostics.report<diag::DataFolderEmpty>({}, path, kReads);
  return ok;
}

const DataFile* DataFiles::find(std::string_view folder, std::string_view name) const {
  const auto at = std::lower_bound(files_.begin(), files_.end(), 0,
                                   [&](const DataFile& file, int) { return before(file, folder, name); });
  return at != files_.end() && at->folder == folder && at->name == name ? &*at : nullptr;
}

std::vector<const DataFile*> DataFiles::list(std::string_view folder) const {
  std::vector<const DataFile*> out;
  for (const DataFile& file : files_) {
    if (file.folder == folder) out.push_back(&file);
  }
  return out;
}

} // namespace dotek::stdlib
