// Writing to descriptors: standard output, pipes, files. No byte is lost without a word.
#pragma once

#include <array>
#include <ostream>
#include <streambuf>
#include <string_view>

namespace dotek {

// Writes all bytes, also where the system takes them in pieces or is not ready. 0, or the errno of the
// failure.
int writeFully(int descriptor, std::string_view bytes);

// Standard output or standard error as a stream: a failure sets badbit and is remembered.
class DescriptorBuffer : public std::streambuf {
public:
  explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor) {
    setp(buffer_.data(), buffer_.data() + buffer_.size());
  }
  int error() const { return error_; } // errno of the first failure; 0: none

protected:
  int_type overflow(int_type c) override;
  int sync() override;
  std::streamsize xsputn(const char* text, std::streamsize size) override;

private:
  bool drain();

  int descriptor_;
  int error_ = 0;
  std::array<char, 65536> buffer_;
};

// Flushes. 0, or the errno of the first failure of the stream so far (EIO where the stream does not say).
int finishStream(std::ostream& stream);

// A standard descriptor that is closed would be given to the next file that is opened, and messages would be
// written into it. To be called before any other file is opened.
void holdStandardDescriptors();

} // namespace dotek
