// All words of a keyword table, for who offers them.
#pragma once

#include "stdlib/ComPostKeywords.h"
#include "stdlib/GibbsKeywords.h"

#include <string>
#include <vector>

namespace dotek::stdlib {

struct ListedWord {
  enum class Kind : std::uint8_t { Keyword, Function, Variable, Control };
  std::string name; // as it is written, a suffix of ComPost included
  std::string detail;
  Kind kind = Kind::Keyword;
  bool argument = false; // of ComPost: ('x') follows
};

// "POSITION axis, [value]"
std::string textOf(const CommandSignature& signature);

// By name.
std::vector<ListedWord> listOf(const ComPostKeywords& keywords);
std::vector<ListedWord> listOf(const GibbsKeywords& keywords);

} // namespace dotek::stdlib
