#include "support/LineChunks.h"
#include "support/Tape.h"
#include "support/messages/Common.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dotek {
namespace {

// [begin, end) without what a tape leaves after a text.
const char* textEnd(const char* begin, const char* end) {
  while (end > begin && kAfterTape.find(end[-1]) != std::string_view::npos)
    --end;
  return end;
}

bool isNoText(char c) {
  return c == '\0' || c == '\x1A';
}

// After the last whole line of [begin, end); `begin` where there is none. A lone CR ends a line too.
const char* afterLastLine(const char* begin, const char* end) {
  const std::string_view text(begin, static_cast<std::size_t>(end - begin));
  std::size_t at = text.rfind('\n');
  if (at == std::string_view::npos) {
    // The byte after a CR decides whether it ends the line, so the last byte does not count.
    at = text.size() < 2 ? std::string_view::npos : text.rfind('\r', text.size() - 2);
  }
  return at == std::string_view::npos ? begin : begin + at + 1;
}

} // namespace

LineChunks::LineChunks(std::string_view text, std::size_t buffer) : LineChunks(-1, buffer) {
  text_ = text;
}

LineChunks::LineChunks(int descriptor, std::size_t buffer)
    : descriptor_(descriptor), size_(std::max<std::size_t>(buffer, 16)),
      buffer_(
          new char[size_ + kPadding]) { // not value-initialised: pages are touched when they are read into
  begin_ = end_ = buffer_.get();
}

LineChunks::~LineChunks() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::unique_ptr<LineChunks> LineChunks::open(const std::string& path, Diagnostics& diagnostics,
                                             std::size_t buffer) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    if (errno == ENOENT || errno == ENOTDIR)
      diagnostics.report<diag::FileNotFound>({}, path);
    else
      diagnostics.report<diag::FileNotReadable>({}, path, std::strerror(errno));
    return nullptr;
  }
  struct stat status {};
  if (::fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode)) {
    ::close(descriptor);
    diagnostics.report<diag::FileNotReadable>({}, path, "it is a folder; name the files in it");
    return nullptr;
  }
  return std::unique_ptr<LineChunks>(new LineChunks(descriptor, buffer));
}

std::size_t LineChunks::fill(char* into, std::size_t most) {
  if (descriptor_ < 0) {
    const std::size_t n = std::min(most, text_.size() - textAt_);
    std::memcpy(into, text_.data() + textAt_, n);
    textAt_ += n;
    return n;
  }
  for (;;) {
    const ssize_t n = ::read(descriptor_, into, most);
    if (n >= 0) return static_cast<std::size_t>(n);
    if (errno == EINTR) continue;
    error_ = std::strerror(errno);
    return 0;
  }
}

LineChunks::State LineChunks::next() {
  char* const base = buffer_.get();
  std::size_t left = filled_ - static_cast<std::size_t>(end_ - base);
  std::memmove(base, end_, left);
  while (!ended_ && left < size_) {
    const std::size_t n = fill(base + left, size_ - left);
    ended_ = n == 0;
    left += n;
  }
  filled_ = left;
  char* const end = base + left;
  if (leader_) {
    char* at = base;
    for (; at < end && kBeforeTape.find(*at) != std::string_view::npos; ++at)
      if (*at == '\0') *at = ' ';
    leader_ = at == end;
  }
  const char* known = end; // whether what follows is after the text is not known yet
  if (end > base && kAfterTape.find(end[-1]) != std::string_view::npos) {
    char* const after = base + (textEnd(base, end) - base);
    if (ended_)
      std::replace_if(after, end, isNoText, ' ');
    else
      known = std::find_if(after, end, isNoText);
  }
  begin_ = base;
  end_ = end;
  if (!error_.empty()) return State::Failed;
  if (left == 0) return State::End;
  if (ended_) {
    std::memset(base + left, '\n', kPadding);
    return State::Chunk;
  }
  const char* const whole = afterLastLine(base, known);
  if (whole == base) {
    std::memset(base + left, '\n', kPadding);
    return State::TooLong;
  }
  end_ = whole;
  return State::Chunk;
}

bool LineChunks::rewind() {
  if (descriptor_ >= 0 && ::lseek(descriptor_, 0, SEEK_SET) != 0) return false;
  textAt_ = 0;
  filled_ = 0;
  ended_ = false;
  leader_ = true;
  error_.clear();
  begin_ = end_ = buffer_.get();
  return true;
}

} // namespace dotek
