#include "posts/Json.h"

#include <fmt/format.h>

namespace dotek::posts {

std::string jsonText(std::string_view utf8) {
  std::string out = "\"";
  for (const char c : utf8) {
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + "\"";
}

std::string jsonNumber(double value) {
  return fmt::format("{}", value);
}

std::string jsonList(const std::vector<std::string>& items) {
  std::string out = "[";
  for (const std::string& item : items)
    out += (out.size() > 1 ? ", " : "") + item;
  return out + "]";
}

} // namespace dotek::posts
