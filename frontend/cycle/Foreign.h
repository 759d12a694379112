// What newcomers write in a cycle, from G code and from other languages, and what to write in its place.
#pragma once

#include <antlr4-runtime.h>

#include <string>
#include <string_view>
#include <vector>

namespace dotek::frontend::cycle {

// One line of a cycle, of which the grammar takes the words before `at`.
class Line {
public:
  Line(const antlr4::Token& offending, antlr4::TokenStream& input, size_t first);

  size_t size() const { return words_.size(); } // without the end of the line
  size_t at() const { return at_; }             // size(): the line ends too early
  size_t type(size_t i) const;                  // EOF beyond the line
  std::string word(size_t i) const;             // "" beyond the line
  std::string text(size_t from, size_t end) const;
  std::string rest(size_t from) const { return text(from, size()); }
  // The first word of the type from there on; size(): none.
  size_t find(size_t type, size_t from = 0) const;
  bool joins(size_t i) const; // no blank between it and the next word

private:
  std::vector<const antlr4::Token*> words_;
  size_t at_ = 0;
};

// The word that the line begins with is what is wrong.
bool beginsForeign(const Line& line);
// The message; "" for what is nothing known.
std::string foreignForm(const Line& line);
// Of a part that is known wherever it is, and of parts in a wrong place; see foreignForm().
std::string foreignPart(const Line& line);
std::string foreignOrder(const Line& line);
// Of a value or a coordinate as drawings and G code have it.
std::string foreignValue(const Line& line);
// `cm`, `inch`, `ms`, ..
bool isForeignUnit(std::string_view word);

} // namespace dotek::frontend::cycle
