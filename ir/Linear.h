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

// Symbol of a variable: its name as print() writes it; of a subtree that is not linear: its text, so that
// equal subtrees cancel. nullopt where arithmetic fails or a coefficient is no exact decimal: numbers count
// as the decimals that people write (0.1 + 0.2 is 0.3), and a proof never holds by rounding.
std::optional<LinearForm> linear(const ExpressionPtr& expression, const Cycle& cycle);
// a + factorOfB * b; nullopt where that rounds.
std::optional<LinearForm> add(const LinearForm& a, const LinearForm& b, double factorOfB = 1);
// Equal for all values of the variables, if it has a value at all, in exact arithmetic: a control that adds a
// large number and takes it away again rounds. false: not proved.
bool provenEqual(const ExpressionPtr& a, const ExpressionPtr& b, const Cycle& cycle);

// Sum and product of the shortest decimals of both; nullopt where a double does not hold it.
std::optional<double> exactSum(double a, double b);
std::optional<double> exactProduct(double a, double b);

} // namespace dotek::ir
