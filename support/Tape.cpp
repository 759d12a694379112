#include "support/Tape.h"

#include "support/LineEnds.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace dotek {
namespace {

// Every second byte is 0 at the beginning: UTF-16 without its mark.
bool isWide(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 64);
  std::array<std::size_t, 2> nuls{};
  for (std::size_t i = 0; i < head.size(); ++i)
    nuls.at(i % 2) += head[i] == '\0' ? 1 : 0;
  const std::size_t half = head.size() / 2;
  return half > 1 && (nuls[0] >= half) != (nuls[1] >= half);
}

// `%`, a comment, or a letter of NC with a number: no file of a CAM or of Dotek begins so.
bool isProgram(std::string_view text) {
  if (text.front() == '%' || text.front() == '(') return true;
  const bool letter = std::string_view("OoNnGgMmTt:").find(text.front()) != std::string_view::npos;
  const std::size_t after = text.find_first_not_of(' ', 1);
  return letter && after != std::string_view::npos && text[after] >= '0' && text[after] <= '9';
}

// After the second line that begins with `%`; the end where there is none.
std::size_t afterProgram(std::string_view bytes, std::size_t from) {
  std::size_t marks = 0;
  for (std::size_t at = from; at < bytes.size();) {
    const std::size_t first = bytes.find_first_not_of(std::string_view("\0 \t", 3), at);
    if (first != std::string_view::npos && bytes[first] == '%' && ++marks == 2) return first + 1;
    at = std::min(endOfLine(bytes, at) + 1, bytes.size());
  }
  return bytes.size();
}

} // namespace

void blankTape(std::string& bytes) {
  const std::string_view view = bytes;
  if ((view.find('\0') == std::string_view::npos && view.find('\x1A') == std::string_view::npos) ||
      isWide(view))
    return;
  const std::size_t first = view.find_first_not_of(kBeforeTape);
  if (first == std::string_view::npos) return; // nothing but feed holes
  if (!isProgram(view.substr(first))) return;
  const std::size_t last = std::min(view.find_last_not_of(kAfterTape) + 1, afterProgram(view, first));
  const auto blank = [&](std::size_t begin, std::size_t end, bool controlZ) {
    for (std::size_t i = begin; i < end; ++i)
      if (bytes[i] == '\0' || (controlZ && bytes[i] == '\x1A')) bytes[i] = ' ';
  };
  blank(0, first, false);
  blank(last, bytes.size(), true);
}

} // namespace dotek
