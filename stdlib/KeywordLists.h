// All words of a keyword table, for who offers them.
#pragma once

#include "stdlib/ComPostKeywords.h"
#include "stdlib/GibbsKeywords.h"

#include <string>
#include <string_view>
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
// Parameters of a family ("tool_data"), each with what it holds; empty: no such family.
std::vector<ListedWord> parametersOf(const GibbsKeywords& keywords, std::string_view family);
// "number", "text", ..
std::string_view textOf(ParameterKind kind);

} // namespace dotek::stdlib
