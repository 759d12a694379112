// Inputs as bytes, with places in them. Front ends work on bytes; a place is a byte range of one file.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek {

enum class Encoding : std::uint8_t { Utf8, Cp1250, Cp852 };

// "utf-8", "cp1250", "cp852"; nullopt for another name.
std::optional<Encoding> encodingByName(std::string_view name);
std::string_view encodingName(Encoding encoding);

bool isUtf8(std::string_view bytes);
// The text of `bytes` as UTF-8; bytes without a meaning in `encoding` become U+FFFD.
std::string toUtf8(std::string_view bytes, Encoding encoding);

using FileId = std::uint32_t;
inline constexpr FileId kNoFile = UINT32_MAX;

// Half-open byte range of one file. The default has no place (the command line, say).
struct SourceRange {
  FileId file = kNoFile;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  bool hasPlace() const { return file != kNoFile; }
  bool operator==(const SourceRange&) const = default;
};

// From the start of `a` to the end of `b`, which lie in one file.
SourceRange spanning(SourceRange a, SourceRange b);

// Both count from 1; columns count characters of the decoded line.
struct LineColumn {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

// One input, immutable. Line ends are LF, CR LF or CR.
class SourceFile {
public:
  // A UTF-8 byte order mark is dropped. `name` is printed as given. Of a file that is too large to keep,
  // `bytes` may be some lines; `firstLine` is the number of the first.
  SourceFile(std::string name, std::string bytes, Encoding encoding, std::uint32_t firstLine = 1);

  const std::string& name() const { return name_; }
  const std::string& bytes() const { return bytes_; }
  Encoding encoding() const { return encoding_; }
  std::uint32_t lineCount() const { return static_cast<std::uint32_t>(lineStarts_.size()); }
  // 1-based line that holds the byte at `offset`; an offset after the end gives the last line.
  std::uint32_t lineOf(std::uint32_t offset) const;
  std::uint32_t lineStart(std::uint32_t line) const;
  // Bytes of a line without its end.
  std::string_view line(std::uint32_t line) const;
  std::string lineUtf8(std::uint32_t line) const { return toUtf8(this->line(line), encoding_); }
  LineColumn place(std::uint32_t offset) const;

private:
  std::string name_;
  std::string bytes_;
  Encoding encoding_;
  std::uint32_t firstLine_;
  std::vector<std::uint32_t> lineStarts_;
};

// Owns the inputs of one command; ids are given in the order of adding.
class SourceMap {
public:
  FileId add(SourceFile file);
  const SourceFile& file(FileId id) const { return files_[id]; }
  FileId size() const { return static_cast<FileId>(files_.size()); }
  std::string_view text(SourceRange range) const;
  std::string textUtf8(SourceRange range) const;
  // 1-based line of the start of `range`; 0 without a place.
  std::uint32_t line(SourceRange range) const;

private:
  std::deque<SourceFile> files_;
};

} // namespace dotek
