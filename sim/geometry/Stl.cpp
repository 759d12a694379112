// STL, binary and text. Every number and count is checked before it is used.
#include "sim/geometry/Mesh.h"
#include "sim/geometry/Shape.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {
namespace {

constexpr std::size_t kHeader = 80, kTriangle = 50;

std::uint32_t word(std::string_view bytes, std::size_t at) {
  std::uint32_t out = 0;
  for (std::size_t n = 4; n-- > 0;)
    out = out << 8 | static_cast<unsigned char>(bytes[at + n]);
  return out;
}

// Words between blanks, with the line on which they stand.
class Words {
public:
  explicit Words(std::string_view text) : text_(text) {}
  std::size_t line() const { return line_; }
  std::string_view next() {
    while (at_ < text_.size() && isBlank(text_[at_]))
      line_ += text_[at_++] == '\n' ? 1 : 0;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !isBlank(text_[at_]))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }
  void skipLine() { at_ = std::min(text_.find('\n', at_), text_.size()); }

private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

bool isWord(std::string_view given, std::string_view wanted) {
  if (given.size() != wanted.size()) return false;
  for (std::size_t n = 0; n < given.size(); ++n) {
    if ((given[n] | 0x20) != wanted[n]) return false;
  }
  return true;
}

// What is printed of a word of a file that may be anything.
std::string shown(std::string_view word) {
  std::string out;
  for (const char c : word.substr(0, 20))
    out += c > 32 && c < 127 ? c : '?';
  return out;
}

bool isUsable(double value) {
  return std::isfinite(value) && std::abs(value) <= kFar;
}

} // namespace

std::string Mesh::readStl(std::string_view bytes, double scale) {
  // Programs begin binary files with `solid`, too: the size tells.
  if (bytes.size() >= kHeader + 4 &&
      std::uint64_t{bytes.size()} == kHeader + 4 + std::uint64_t{word(bytes, kHeader)} * kTriangle)
    return readBinary(bytes, scale);
  Words words(bytes.substr(0, 512));
  if (isWord(words.next(), "solid")) return readText(bytes, scale);
  if (bytes.size() < kHeader + 4)
    return fmt::format("it is no STL: it has {} bytes and does not begin with `solid`", bytes.size());
  return fmt::format("it is no STL, or its copy is damaged: its header announces {} triangles, which take {} "
                     "bytes, and it has {}",
                     word(bytes, kHeader), kHeader + 4 + std::uint64_t{word(bytes, kHeader)} * kTriangle,
                     bytes.size());
}

std::string Mesh::readBinary(std::string_view bytes, double scale) {
  const std::size_t count = word(bytes, kHeader);
  if (count > kMostTriangles)
    return fmt::format("it has {} triangles; at most {} are read", count, kMostTriangles);
  std::vector<Eigen::Vector3d> corners;
  corners.reserve(count * 3);
  for (std::size_t n = 0; n < count; ++n) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Eigen::Vector3d v;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at = kHeader + 4 + n * kTriangle + 12 + corner * 12 + axis * 4;
        const double value = scale * static_cast<double>(std::bit_cast<float>(word(bytes, at)));
        if (!isUsable(value))
          return fmt::format("triangle {} has a coordinate that is no number or beyond {} mm", n + 1, kFar);
        v[static_cast<Eigen::Index>(axis)] = value + 0.0; // no -0
      }
      corners.push_back(v);
    }
  }
  return addCorners(corners);
}

std::string Mesh::readText(std::string_view bytes, double scale) {
  Words words(bytes);
  std::vector<Eigen::Vector3d> corners;
  const auto expected = [&](std::string_view what, std::string_view found) {
    return fmt::format("line {}: {} is expected, found {}", words.line(), what,
                       found.empty() ? std::string("the end of the file") : "`" + shown(found) + "`");
  };
  const auto number = [&](double& out) -> std::string {
    const std::string_view text = words.next();
    const std::string_view digits = text.substr(text.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), out);
    if (digits.empty() || error != std::errc() || end != digits.data() + digits.size())
      return expected("a number", text);
    out *= scale;
    if (!isUsable(out)) return fmt::format("line {}: `{}` is beyond {} mm", words.line(), shown(text), kFar);
    return "";
  };
  words.next(); // solid
  words.skipLine();
  for (bool open = true;;) {
    const std::string_view first = words.next();
    if (first.empty() && !open) break;
    if (!open && isWord(first, "solid")) { // several in one file
      open = true;
      words.skipLine();
      continue;
    }
    if (open && isWord(first, "endsolid")) {
      open = false;
      words.skipLine();
      continue;
    }
    if (!open || !isWord(first, "facet")) return expected(open ? "`facet` or `endsolid`" : "`solid`", first);
    for (const std::string_view wanted : {"normal", "", "", "", "outer", "loop"}) {
      const std::string_view given = words.next();
      if (given.empty() || (!wanted.empty() && !isWord(given, wanted)))
        return expected(wanted.empty() ? "a number" : fmt::format("`{}`", wanted), given);
    }
    for (int corner = 0; corner < 3; ++corner) {
      if (const std::string_view given = words.next(); !isWord(given, "vertex"))
        return expected("`vertex`", given);
      Eigen::Vector3d v;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        double value = 0;
        if (std::string fault = number(value); !fault.empty()) return fault;
        v[axis] = value + 0.0;
      }
      corners.push_back(v);
    }
    for (const std::string_view wanted : {"endloop", "endfacet"}) {
      if (const std::string_view given = words.next(); !isWord(given, wanted))
        return expected(fmt::format("`{}`", wanted), given);
    }
    if (corners.size() > kMostTriangles * 3)
      return fmt::format("it has more than {} triangles", kMostTriangles);
  }
  return addCorners(corners);
}

} // namespace dotek::sim
