// JSON text for the kernel.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::posts {

// A string literal, ASCII but for UTF-8 as it is.
std::string jsonText(std::string_view utf8);
// The shortest text of a finite number.
std::string jsonNumber(double value);

// An object that is written member by member.
class JsonObject {
public:
  void add(std::string_view name, const std::string& json) {
    text_ += (text_.empty() ? "" : ", ") + jsonText(name) + ": " + json;
  }
  std::string text() const { return "{" + text_ + "}"; }
  bool empty() const { return text_.empty(); }

private:
  std::string text_;
};

std::string jsonList(const std::vector<std::string>& items);

} // namespace dotek::posts
