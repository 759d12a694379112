#include "support/Files.h"
#include "support/Tape.h"
#include "support/messages/Common.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>
#include <unistd.h>

namespace dotek {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kStandardInput = "-";

using OpenFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

OpenFile openInput(const std::string& path, Diagnostics& diagnostics) {
  OpenFile file(nullptr, &std::fclose);
  if (path == kStandardInput) {
    const int copy = dup(STDIN_FILENO);
    if (copy >= 0) file.reset(fdopen(copy, "rb"));
    if (!file) diagnostics.report<diag::FileNotReadable>({}, inputName(path), std::strerror(errno));
    return file;
  }
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    // A link that leads to itself is there, and nothing can be read from it.
    if (error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory)
      diagnostics.report<diag::FileNotReadable>({}, path, error.message());
    else
      diagnostics.report<diag::FileNotFound>({}, path);
    return file;
  }
  if (fs::is_directory(status)) {
    diagnostics.report<diag::FileNotReadable>({}, path, "it is a folder; name the files in it");
    return file;
  }
  file.reset(std::fopen(path.c_str(), "rb"));
  if (!file) diagnostics.report<diag::FileNotReadable>({}, path, std::strerror(errno));
  return file;
}

// nullopt where reading fails, reported. More than `most` bytes are read only as far as the buffer.
std::optional<std::string> readMost(const std::string& path, std::size_t most, Diagnostics& diagnostics) {
  const OpenFile file = openInput(path, diagnostics);
  if (!file) return std::nullopt;
  std::string bytes;
  std::error_code error;
  // A guess: the size of a pipe is not known, and a file may grow.
  if (const std::uintmax_t size = fs::file_size(path, error); !error && size <= most) bytes.reserve(size);
  char buffer[65536];
  while (bytes.size() <= most) {
    const std::size_t n = std::fread(buffer, 1, sizeof buffer, file.get());
    if (n == 0) break;
    bytes.append(buffer, n);
  }
  if (std::ferror(file.get()) == 0) return bytes;
  diagnostics.report<diag::FileNotReadable>({}, inputName(path), std::strerror(errno));
  return std::nullopt;
}

} // namespace

namespace {

std::optional<std::string> readUpTo(const std::string& path, std::size_t most, const Limits& limits,
                                    Diagnostics& diagnostics) {
  std::optional<std::string> bytes = readMost(path, most, diagnostics);
  if (!bytes || bytes->size() <= most) return bytes;
  reportTooLarge(path, limits, diagnostics);
  return std::nullopt;
}

} // namespace

std::optional<std::string> readBytes(const std::string& path, const Limits& limits,
                                     Diagnostics& diagnostics) {
  return readUpTo(path, mostBytes(limits), limits, diagnostics);
}

std::optional<std::string> readPrograms(const std::string& path, const Limits& limits,
                                        Diagnostics& diagnostics) {
  return readUpTo(path, limits.keptBytes / kKeptOfText, limits, diagnostics);
}

void reportTooLarge(const std::string& path, const Limits& limits, Diagnostics& diagnostics) {
  diagnostics.report<diag::FileTooLarge>({}, inputName(path), limits.keptBytes);
}

std::optional<std::string> readBeginning(const std::string& path, std::size_t most,
                                         Diagnostics& diagnostics) {
  std::optional<std::string> bytes = readMost(path, most, diagnostics);
  if (bytes && bytes->size() > most) bytes->resize(most);
  return bytes;
}

bool isBelow(const std::string& path, const std::string& folder) {
  return path == folder || folder == "/" ||
         (path.starts_with(folder) && path.size() > folder.size() && path[folder.size()] == '/');
}

namespace {

// Without links, as far as the path exists.
std::string realPath(const std::string& path) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path.empty() ? "." : path, error);
  std::string out = (error ? fs::path(path).lexically_normal() : real).generic_string();
  while (out.size() > 1 && out.ends_with('/'))
    out.pop_back();
  return out;
}

} // namespace

bool ReadBounds::allow(const std::string& path) const {
  const std::string real = realPath(path);
  return std::any_of(folders.begin(), folders.end(),
                     [&](const std::string& folder) { return isBelow(real, realPath(folder)); });
}

std::string ReadBounds::text() const {
  std::string out;
  std::vector<std::string> told;
  for (const std::string& folder : folders) {
    std::string real = realPath(folder);
    if (std::find(told.begin(), told.end(), real) != told.end()) continue;
    told.push_back(std::move(real));
    out += (out.empty() ? "`" : " or `") + (folder.empty() ? "." : folder) + "`";
  }
  return out;
}

// Of a link the folder of the file that it leads to.
std::string folderName(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path(), real = fs::path(realPath(path)).parent_path();
  std::error_code error;
  const bool leads = real != fs::path(realPath(folder.generic_string()));
  const fs::path seen = leads ? fs::proximate(real, error) : folder;
  const std::string out = (error ? real : seen).generic_string();
  return out.empty() ? "." : out;
}

bool isStream(const std::string& path) {
  if (path == kStandardInput) return true;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

std::string inputName(const std::string& path) {
  return path == kStandardInput ? "<stdin>" : path;
}

std::optional<std::string> StreamInputs::read(const std::string& path, const Limits& limits,
                                              Diagnostics& diagnostics) {
  const bool standard = path == "/dev/stdin" || path == "/dev/fd/0" || path == "/proc/self/fd/0";
  const std::string key = standard ? std::string(kStandardInput) : path;
  const std::lock_guard lock(mutex_);
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  std::optional<std::string> bytes = readPrograms(path, limits, diagnostics);
  if (bytes) known_.emplace(key, *bytes);
  return bytes;
}

namespace {

// In the first line that is no UTF-8: its first byte outside ASCII.
std::size_t firstBadLetter(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    const std::string_view line = bytes.substr(at, end - at);
    if (!isUtf8(line)) {
      const auto letter = std::find_if(line.begin(), line.end(), [](char c) { return (c & 0x80) != 0; });
      return at + static_cast<std::size_t>(letter - line.begin());
    }
    at = end + 1;
  }
  return 0;
}

} // namespace

std::optional<FileId> readText(const std::string& path, Encoding fallback, std::optional<Encoding> forced,
                               const Limits& limits, SourceMap& sources, Diagnostics& diagnostics) {
  std::optional<std::string> bytes = readBytes(path, limits, diagnostics);
  if (!bytes) return std::nullopt;
  return addText(inputName(path), std::move(*bytes), fallback, forced, sources, diagnostics);
}

std::optional<FileId> addText(std::string name, std::string bytes, Encoding fallback,
                              std::optional<Encoding> forced, SourceMap& sources, Diagnostics& diagnostics) {
  if (fallback != Encoding::Utf8) blankTape(bytes); // a language of controls
  // Every second byte NUL is UTF-16 without its mark.
  const auto nulAt = [&bytes](std::size_t i) { return bytes[i] == '\0'; };
  const bool wide = bytes.size() > 3 && (nulAt(0) || nulAt(1)) && (nulAt(2) || nulAt(3));
  if (wide || bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    const FileId id = sources.add(SourceFile(std::move(name), "", Encoding::Utf8));
    diagnostics.report<diag::Utf16Input>({id, 0, 0});
    return std::nullopt;
  }
  const Encoding encoding = forced ? *forced : isUtf8(bytes) ? Encoding::Utf8 : fallback;
  const std::size_t nul = bytes.find('\0');
  const bool decodes = encoding != Encoding::Utf8 || isUtf8(bytes);
  const std::size_t bad = decodes ? 0 : firstBadLetter(bytes);
  // Shown in an encoding that knows every byte.
  const FileId id =
      sources.add(SourceFile(std::move(name), std::move(bytes), decodes ? encoding : Encoding::Cp1250));
  if (nul != std::string::npos) {
    const auto at = static_cast<std::uint32_t>(nul);
    diagnostics.report<diag::NulByte>({id, at, at + 1});
    return std::nullopt;
  }
  if (!decodes) {
    const auto at = static_cast<std::uint32_t>(bad);
    diagnostics.report<diag::NotUtf8>({id, at, at + 1});
    return std::nullopt;
  }
  return id;
}

} // namespace dotek
