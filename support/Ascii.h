// Characters of the languages' own syntax: ASCII, whatever the locale. Bytes above 127 are none of them and
// stay as they are.
#pragma once

#include <string>
#include <string_view>

namespace dotek {

constexpr bool isDigit(char c) {
  return c >= '0' && c <= '9';
}
constexpr bool isCapital(char c) {
  return c >= 'A' && c <= 'Z';
}
constexpr bool isLetter(char c) {
  return isCapital(c) || (c >= 'a' && c <= 'z');
}

constexpr char upperCase(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
constexpr char lowerCase(char c) {
  return isCapital(c) ? static_cast<char>(c - 'A' + 'a') : c;
}

inline std::string upperCase(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    c = upperCase(c);
  return out;
}
inline std::string lowerCase(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    c = lowerCase(c);
  return out;
}

} // namespace dotek
