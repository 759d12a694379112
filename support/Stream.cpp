#include "support/Stream.h"

#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace dotek {

int writeFully(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EAGAIN) {
      pollfd ready{descriptor, POLLOUT, 0};
      if (::poll(&ready, 1, -1) < 0 && errno != EINTR) return errno;
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

bool DescriptorBuffer::drain() {
  const std::string_view text(pbase(), static_cast<std::size_t>(pptr() - pbase()));
  if (error_ == 0) error_ = writeFully(descriptor_, text);
  setp(buffer_.data(), buffer_.data() + buffer_.size());
  return error_ == 0;
}

DescriptorBuffer::int_type DescriptorBuffer::overflow(int_type c) {
  if (!drain()) return traits_type::eof();
  if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
  return traits_type::not_eof(c);
}

int DescriptorBuffer::sync() {
  return drain() ? 0 : -1;
}

std::streamsize DescriptorBuffer::xsputn(const char* text, std::streamsize size) {
  if (size < epptr() - pptr()) {
    traits_type::copy(pptr(), text, static_cast<std::size_t>(size));
    pbump(static_cast<int>(size));
    return size;
  }
  if (!drain()) return 0;
  error_ = writeFully(descriptor_, {text, static_cast<std::size_t>(size)});
  return error_ == 0 ? size : 0;
}

int finishStream(std::ostream& stream) {
  if (stream.flush()) return 0;
  const auto* buffer = dynamic_cast<const DescriptorBuffer*>(stream.rdbuf());
  return buffer != nullptr && buffer->error() != 0 ? buffer->error() : EIO;
}

void holdStandardDescriptors() {
  // Opened the wrong way round, so that using it fails as using a closed one does. Whoever closes standard
  // error wants no messages.
  for (const auto& [descriptor, mode] :
       {std::pair(STDIN_FILENO, O_WRONLY), {STDOUT_FILENO, O_RDONLY}, {STDERR_FILENO, O_WRONLY}}) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    if (::open("/dev/null", mode) < 0) return; // the lowest free number is this one
  }
}

} // namespace dotek
