// Linear forms: sums of multiples of variables, for proofs that two lengths are equal whatever the values
// are.
#pragma once

#include "ir/Cycle.h"

#include <map>
#include <optional>
#include <string>

namespace dotek::ir {

struct LinearForm {
  double constant = 0;
  std::map<std::string, double> terms; // by symbol; no zero
  bool operator==(const LinearForm&) const = default;
};

// Symbol of a subtree that is not linear: its text, so that equal subtrees cancel. nullopt where arithmetic
// fails. Coefficients are compared exactly: a proof never holds by rounding.
std::optional<LinearForm> linear(const ExpressionPtr& expression, const Cycle& cycle);
LinearForm add(const LinearForm& a, const LinearForm& b, double factorOfB = 1);
// Equal for all values of the variables. false: not proved.
bool provenEqual(const ExpressionPtr& a, const ExpressionPtr& b, const Cycle& cycle);

} // namespace dotek::ir
