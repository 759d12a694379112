// Private to InputKind.cpp: texts that look like an input of Dotek and are none.
#pragma once

#include "project/DialectMarks.h"
#include "project/Foreign.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::project {

// Marks of the languages of other controls, line by line. Comments after `;` or `//` are none: controls of
// many kinds take them.
class Dialects {
public:
  // Of each line in its order, blank ones too.
  void look(std::string_view line);

  // Of the language that most marks speak for; 0: of none enough.
  int weight() const;
  // One of its marks is in no other text.
  bool certain() const { return certain_; }
  // Two lines of it are no block of Macro B, whatever the others are.
  bool marked() const;
  std::string name() const;
  // Where it is a control's language.
  std::optional<Foreign> foreign() const;

private:
  struct Shown {
    int line = 0, weight = 0;
    std::string text;
  };
  struct Seen {
    int weight = 0, lines = 0, strong = 0, lastLine = 0;
    std::vector<Shown> shown; // the lines to name
  };
  void see(const Mark& mark, std::string_view line);
  std::size_t strongest() const; // by its marks
  std::size_t best() const;
  bool isText(std::size_t best) const; // of no language, whatever marks of a control are in it

  std::array<Seen, kTongues> seen_;
  int line_ = 0;
  int prose_ = 0;  // lines of sentences
  int headed_ = 0; // lines that end with a colon
  bool certain_ = false;
};

// What the bytes are as a whole, where they are no text of any line-based language: "an image", "JSON".
std::optional<std::string> otherFormat(std::string_view bytes);

} // namespace dotek::project
