// Constructs of a tree that no source proves, by the assumption that running them needs.
#pragma once

#include "frontend/gibbs/Assumptions.h"
#include "frontend/gibbs/Ast.h"
#include "stdlib/GibbsKeywords.h"

#include <vector>

namespace dotek::frontend::gibbs {

struct Unverified {
  std::string_view assumption; // id in kAssumptions
  SourceRange range;
};

enum class ValueType : std::uint8_t { Number, Text };
ValueType typeOf(const Expression& expression, const stdlib::GibbsKeywords& keywords);

// Those of one statement or expression, in the order of the text; statements inside an IF are not its own.
std::vector<Unverified> unverifiedIn(const Statement& statement, const stdlib::GibbsKeywords& keywords);
std::vector<Unverified> unverifiedIn(const Expression& expression, const stdlib::GibbsKeywords& keywords);

} // namespace dotek::frontend::gibbs
