// ES5 text: names, literals, lines.
#pragma once

#include "backends/fusion/Emit.h"

#include <set>

namespace dotek::backends::fusion {

// A string literal, ASCII: everything else is escaped.
std::string quoted(std::string_view utf8);
// Shortest text of the number; a negative one in brackets where `operand`.
std::string numberLiteral(double value, bool operand = false);
// A word of the language, or a value that has a name of its own: no variable may be called so.
bool isReserved(std::string_view name);

// Names of the variables of one function.
class LocalNames {
public:
  // Names that the fragment itself uses are taken from the beginning.
  LocalNames();
  // A name like `wanted`, not given out before: characters that no name has become `_`, a reserved or taken
  // word gets `_` after it.
  std::string take(std::string_view wanted);

private:
  std::set<std::string, std::less<>> taken_;
};

class Script {
public:
  void add(std::string text, const ir::Origin& origin = {});
  // As add(); the lines up to close() are indented.
  void open(std::string text, const ir::Origin& origin = {});
  void close(std::string text = "}");
  // One level deeper from here on.
  void indent() { ++depth_; }
  void append(const std::vector<EmittedLine>& lines) {
    lines_.insert(lines_.end(), lines.begin(), lines.end());
  }
  void append(const Script& other) { append(other.lines_); }
  // The lines that follow belong to what close() ended last: `} else {`.
  void reopen() { ++depth_; }
  void blank() { lines_.push_back({"", {}, ""}); }
  // A comment, one line for each of at most 100 characters; ASCII.
  void comment(std::string_view utf8);
  // Several lines as they are, each indented.
  void text(std::string_view lines);
  const std::vector<EmittedLine>& lines() const { return lines_; }

private:
  std::vector<EmittedLine> lines_;
  std::size_t depth_ = 0;
};

} // namespace dotek::backends::fusion
