// Reading inputs. Nothing here throws.
#pragma once

#include "support/Diagnostics.h"
#include "support/Limits.h"
#include "support/Source.h"

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace dotek {

// Most bytes of an input of which all becomes a tree, whatever is in it: so much may a byte take.
inline constexpr std::size_t kKeptOfByte = 256;
inline std::size_t mostBytes(const Limits& limits) {
  return limits.keptBytes / kKeptOfByte;
}
// The same of NC programs, whose reader counts what it keeps: their text, what it works on, and where lines
// begin.
inline constexpr std::size_t kKeptOfText = 3;

// Bytes of a file, a pipe or a device, whether its size is known or not; of standard input for "-". nullopt
// with a diagnostic if it cannot be read or is larger than mostBytes.
std::optional<std::string> readBytes(const std::string& path, const Limits& limits, Diagnostics& diagnostics);
// As readBytes, of what may be NC programs: what else it is, is to be held to mostBytes.
std::optional<std::string> readPrograms(const std::string& path, const Limits& limits,
                                        Diagnostics& diagnostics);
void reportTooLarge(const std::string& path, const Limits& limits, Diagnostics& diagnostics);

// At most `most` bytes from the beginning of a file; nullopt with a diagnostic.
std::optional<std::string> readBeginning(const std::string& path, std::size_t most, Diagnostics& diagnostics);

// Whether a path is a folder or in it, by the text of both: without links, dots and a slash at the end.
bool isBelow(const std::string& path, const std::string& folder);

// Which files an input may name in its turn: what is below one of these folders, after all links.
struct ReadBounds {
  std::vector<std::string> folders;
  bool allow(const std::string& path) const;
  // For messages: "`a` or `b`".
  std::string text() const;
};

// For messages: "parts" of "parts/plate.stl", "." of "plate.stl".
std::string folderName(const std::string& path);

// An input that gives its bytes once: standard input ("-"), a pipe, a device.
bool isStream(const std::string& path);

// How a path is called in messages: standard input is `<stdin>`.
std::string inputName(const std::string& path);

// The bytes of streams, kept for whoever reads them again: the sessions of one command share it, and their
// threads.
class StreamInputs {
public:
  // As readPrograms, of a stream.
  std::optional<std::string> read(const std::string& path, const Limits& limits, Diagnostics& diagnostics);

private:
  std::mutex mutex_;
  std::map<std::string, std::string> known_; // by path
};

// Reads a text file into the map: UTF-8 if it decodes, else `fallback`; `forced` overrides both.
// UTF-16 and NUL bytes are errors that say so. nullopt where an error was reported.
std::optional<FileId> readText(const std::string& path, Encoding fallback, std::optional<Encoding> forced,
                               const Limits& limits, SourceMap& sources, Diagnostics& diagnostics);

// As readText, for bytes that are at hand; `name` is what diagnostics print.
std::optional<FileId> addText(std::string name, std::string bytes, Encoding fallback,
                              std::optional<Encoding> forced, SourceMap& sources, Diagnostics& diagnostics);

} // namespace dotek
