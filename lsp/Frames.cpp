#include "lsp/Frames.h"

#include "support/Ascii.h"

#include <cerrno>
#include <charconv>
#include <poll.h>
#include <string_view>
#include <unistd.h>

namespace dotek::lsp {
namespace {

constexpr std::size_t kMostHeader = 4096;
constexpr std::string_view kLength = "content-length:";

// The number after `Content-Length:`; nullopt: none, or too large.
std::optional<std::size_t> lengthIn(std::string_view header) {
  while (!header.empty()) {
    const std::size_t end = header.find("\r\n");
    const std::string_view line = header.substr(0, end);
    header.remove_prefix(end == std::string_view::npos ? header.size() : end + 2);
    if (line.size() < kLength.size() || lowerCase(line.substr(0, kLength.size())) != kLength) continue;
    std::string_view digits = line.substr(kLength.size());
    while (!digits.empty() && digits.front() == ' ')
      digits.remove_prefix(1);
    std::size_t value = 0;
    const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || last == digits.data() || value > kMostBytes) return std::nullopt;
    return value;
  }
  return std::nullopt;
}

} // namespace

bool FrameReader::fill() {
  char bytes[65536];
  for (;;) {
    const ssize_t count = ::read(descriptor_, bytes, sizeof bytes);
    if (count > 0) {
      buffer_.append(bytes, static_cast<std::size_t>(count));
      return true;
    }
    if (count == 0 || errno != EINTR) return false;
  }
}

std::optional<std::string> FrameReader::next() {
  const auto none = [&] {
    broken_ = !buffer_.empty();
    return std::nullopt;
  };
  std::size_t end = std::string::npos;
  while ((end = buffer_.find("\r\n\r\n")) == std::string::npos) {
    if (buffer_.size() > kMostHeader || !fill()) return none();
  }
  const std::optional<std::size_t> length = lengthIn(std::string_view(buffer_).substr(0, end));
  if (!length) return none();
  buffer_.erase(0, end + 4);
  while (buffer_.size() < *length)
    if (!fill()) return none();
  std::string body = buffer_.substr(0, *length);
  buffer_.erase(0, *length);
  return body;
}

bool FrameReader::waiting() const {
  if (!buffer_.empty()) return true;
  pollfd one{descriptor_, POLLIN, 0};
  return ::poll(&one, 1, 0) > 0;
}

bool writeFrame(int descriptor, const std::string& body) {
  const std::string text = "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
  std::string_view rest = text;
  while (!rest.empty()) {
    const ssize_t count = ::write(descriptor, rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

} // namespace dotek::lsp
