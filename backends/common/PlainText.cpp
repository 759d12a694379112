#include "backends/common/PlainText.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

namespace dotek::backends {

namespace {

struct Plain {
  char32_t code;
  std::string_view text;
};

// Letters of Latin-1 and Latin Extended-A, and signs that texts of CAM systems hold. Sorted by code.
constexpr Plain kPlain[] = {
    {0xA0, " "},    {0xAB, "<<"},   {0xB0, " DEG"}, {0xB1, "+-"},    {0xB5, "u"},    {0xBB, ">>"},
    {0xC0, "A"},    {0xC1, "A"},    {0xC2, "A"},    {0xC3, "A"},     {0xC4, "A"},    {0xC5, "A"},
    {0xC6, "AE"},   {0xC7, "C"},    {0xC8, "E"},    {0xC9, "E"},     {0xCA, "E"},    {0xCB, "E"},
    {0xCC, "I"},    {0xCD, "I"},    {0xCE, "I"},    {0xCF, "I"},     {0xD0, "D"},    {0xD1, "N"},
    {0xD2, "O"},    {0xD3, "O"},    {0xD4, "O"},    {0xD5, "O"},     {0xD6, "O"},    {0xD7, "x"},
    {0xD8, "O"},    {0xD9, "U"},    {0xDA, "U"},    {0xDB, "U"},     {0xDC, "U"},    {0xDD, "Y"},
    {0xDF, "ss"},   {0xE0, "a"},    {0xE1, "a"},    {0xE2, "a"},     {0xE3, "a"},    {0xE4, "a"},
    {0xE5, "a"},    {0xE6, "ae"},   {0xE7, "c"},    {0xE8, "e"},     {0xE9, "e"},    {0xEA, "e"},
    {0xEB, "e"},    {0xEC, "i"},    {0xED, "i"},    {0xEE, "i"},     {0xEF, "i"},    {0xF0, "d"},
    {0xF1, "n"},    {0xF2, "o"},    {0xF3, "o"},    {0xF4, "o"},     {0xF5, "o"},    {0xF6, "o"},
    {0xF7, "/"},    {0xF8, "o"},    {0xF9, "u"},    {0xFA, "u"},     {0xFB, "u"},    {0xFC, "u"},
    {0xFD, "y"},    {0xFF, "y"},    {0x100, "A"},   {0x101, "a"},    {0x102, "A"},   {0x103, "a"},
    {0x104, "A"},   {0x105, "a"},   {0x106, "C"},   {0x107, "c"},    {0x108, "C"},   {0x109, "c"},
    {0x10A, "C"},   {0x10B, "c"},   {0x10C, "C"},   {0x10D, "c"},    {0x10E, "D"},   {0x10F, "d"},
    {0x110, "D"},   {0x111, "d"},   {0x112, "E"},   {0x113, "e"},    {0x116, "E"},   {0x117, "e"},
    {0x118, "E"},   {0x119, "e"},   {0x11A, "E"},   {0x11B, "e"},    {0x11E, "G"},   {0x11F, "g"},
    {0x122, "G"},   {0x123, "g"},   {0x12A, "I"},   {0x12B, "i"},    {0x12E, "I"},   {0x12F, "i"},
    {0x130, "I"},   {0x131, "i"},   {0x136, "K"},   {0x137, "k"},    {0x139, "L"},   {0x13A, "l"},
    {0x13B, "L"},   {0x13C, "l"},   {0x13D, "L"},   {0x13E, "l"},    {0x141, "L"},   {0x142, "l"},
    {0x143, "N"},   {0x144, "n"},   {0x145, "N"},   {0x146, "n"},    {0x147, "N"},   {0x148, "n"},
    {0x14C, "O"},   {0x14D, "o"},   {0x150, "O"},   {0x151, "o"},    {0x152, "OE"},  {0x153, "oe"},
    {0x154, "R"},   {0x155, "r"},   {0x158, "R"},   {0x159, "r"},    {0x15A, "S"},   {0x15B, "s"},
    {0x15E, "S"},   {0x15F, "s"},   {0x160, "S"},   {0x161, "s"},    {0x162, "T"},   {0x163, "t"},
    {0x164, "T"},   {0x165, "t"},   {0x16A, "U"},   {0x16B, "u"},    {0x16E, "U"},   {0x16F, "u"},
    {0x170, "U"},   {0x171, "u"},   {0x172, "U"},   {0x173, "u"},    {0x178, "Y"},   {0x179, "Z"},
    {0x17A, "z"},   {0x17B, "Z"},   {0x17C, "z"},   {0x17D, "Z"},    {0x17E, "z"},   {0x218, "S"},
    {0x219, "s"},   {0x21A, "T"},   {0x21B, "t"},   {0x2010, "-"},   {0x2011, "-"},  {0x2012, "-"},
    {0x2013, "-"},  {0x2014, "-"},  {0x2018, "'"},  {0x2019, "'"},   {0x201A, "'"},  {0x201C, "\""},
    {0x201D, "\""}, {0x201E, "\""}, {0x2022, "*"},  {0x2026, "..."}, {0x2192, "->"}, {0x2212, "-"},
    {0x2264, "<="}, {0x2265, ">="}, {0x2300, "DIA"}};

// One character of `utf8` at `at`, which moves after it; bytes that are no UTF-8 give U+FFFD.
char32_t next(std::string_view utf8, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(utf8[i]); };
  const std::uint8_t lead = byte(at++);
  if (lead < 0x80) return lead;
  const int more = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC2 ? 1 : 0;
  if (more == 0) return 0xFFFD;
  char32_t code = lead & (0x3F >> more);
  for (int i = 0; i < more; ++i) {
    if (at >= utf8.size() || (byte(at) & 0xC0) != 0x80) return 0xFFFD;
    code = code << 6 | (byte(at++) & 0x3F);
  }
  return code;
}

} // namespace

PlainText plainText(std::string_view utf8) {
  PlainText out;
  for (std::size_t at = 0; at < utf8.size();) {
    const char32_t code = next(utf8, at);
    if (code >= 0x20 && code < 0x7F) {
      out.text += static_cast<char>(code);
      continue;
    }
    out.changed = true;
    if (code < 0x20 || code == 0x7F) {
      out.text += ' ';
    } else if (code >= 0x300 && code <= 0x36F) {
      // An accent that follows its letter.
    } else {
      const auto* found = std::lower_bound(std::begin(kPlain), std::end(kPlain), code,
                                           [](const Plain& p, char32_t c) { return p.code < c; });
      const bool known = found != std::end(kPlain) && found->code == code;
      out.text += known ? found->text : "?";
      out.lost = out.lost || !known;
    }
  }
  return out;
}

std::vector<std::string> wrapWords(std::string_view text, std::size_t width) {
  std::vector<std::string> out;
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find_first_not_of(' ', at);
    if (begin == std::string_view::npos) break;
    std::size_t end = std::min(text.find(' ', begin), text.size());
    if (end - begin > width) end = begin + width;
    const std::string_view word = text.substr(begin, end - begin);
    at = end;
    if (!line.empty() && line.size() + 1 + word.size() > width) out.push_back(std::exchange(line, ""));
    if (!line.empty()) line += ' ';
    line += word;
  }
  if (!line.empty()) out.push_back(line);
  return out;
}

} // namespace dotek::backends
