// A text of any size, read through one fixed buffer in chunks of whole lines.
#pragma once

#include "support/Diagnostics.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace dotek {

class LineChunks {
public:
  // Bytes that may be read after the end of a chunk; after the last one they are line ends.
  static constexpr std::size_t kPadding = 96;
  static constexpr std::size_t kBuffer = 256 * 1024;

  // `text` outlives this object.
  explicit LineChunks(std::string_view text, std::size_t buffer = kBuffer);
  ~LineChunks();
  LineChunks(const LineChunks&) = delete;
  LineChunks& operator=(const LineChunks&) = delete;

  // nullptr with a diagnostic where the file cannot be opened. `path` "-" is a file of that name.
  static std::unique_ptr<LineChunks> open(const std::string& path, Diagnostics& diagnostics,
                                          std::size_t buffer = kBuffer);

  enum class State : std::uint8_t {
    Chunk,   // [begin, end) holds whole lines; only the last line of the text may lack its end
    End,     // nothing is left
    TooLong, // the next line, or what may follow the text, is longer than the buffer: [begin, end) begins it
    Failed,  // reading failed: error()
  };
  // The chunk before is no longer good. Feed holes before and after the text, and the Ctrl-Z of a DOS file,
  // are blanks (Tape.h).
  State next();
  const char* begin() const { return begin_; }
  const char* end() const { return end_; }
  const std::string& error() const { return error_; }
  // From the first line again; false where the file does not let us (a pipe).
  bool rewind();

private:
  LineChunks(int descriptor, std::size_t buffer);
  std::size_t fill(char* into, std::size_t most);

  int descriptor_ = -1; // -1: of a text
  std::string_view text_;
  std::size_t textAt_ = 0;
  std::size_t size_;
  std::unique_ptr<char[]> buffer_;
  const char* begin_ = nullptr;
  const char* end_ = nullptr;
  std::size_t filled_ = 0; // bytes in the buffer
  bool ended_ = false;     // the source is empty
  bool leader_ = true;     // no byte of the text has been read
  std::string error_;
};

} // namespace dotek
