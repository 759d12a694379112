// Messages of the protocol on a pair of descriptors: a header that gives the length, then JSON.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace dotek::lsp {

// Bytes of one message at most: an editor sends whole files.
inline constexpr std::size_t kMostBytes = 256u << 20;

class FrameReader {
public:
  explicit FrameReader(int descriptor) : descriptor_(descriptor) {}

  // The next message; nullopt: the other side has ended, or what came is no message of the protocol.
  std::optional<std::string> next();
  // After next() gave nothing: what came is no message, or a part of one.
  bool broken() const { return broken_; }
  // Something has come that next() would read, at least in part.
  bool waiting() const;

private:
  bool fill();
  int descriptor_;
  std::string buffer_;
  bool broken_ = false;
};

// false: the other side no longer reads.
bool writeFrame(int descriptor, const std::string& body);

} // namespace dotek::lsp
