// Private to InputKind.cpp: texts that look like an input of Dotek and are none.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace dotek::project {

// Signs of the languages of other controls, line by line.
class Dialects {
public:
  void look(std::string_view line);

  // The weight of the language that most lines speak for; `lines`: of the text. A few remarks after `;` are a
  // mistake in a program, not another language.
  int weight(int lines) const;
  // One of its signs is in no other text.
  bool certain() const { return certain_; }
  // "Sinumerik (`GOTOF`)": its name and its first sign.
  std::string name(int lines) const;

private:
  static constexpr std::size_t kCount = 10;
  struct Seen {
    int weight = 0;
    std::string sign;
  };
  void see(std::size_t dialect, int weight, std::string_view sign);
  std::size_t best(int lines) const;

  std::array<Seen, kCount> seen_;
  bool certain_ = false;
};

// What the bytes are as a whole, where they are no text of any line-based language: "an image", "JSON".
std::optional<std::string> otherFormat(std::string_view bytes);

} // namespace dotek::project
