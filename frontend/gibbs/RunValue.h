// Values of a running macro. What the host alone knows is carried as a linear form over named unknowns, so
// that `r - 1 < 4` and `r >= 5` are seen to exclude each other.
#pragma once

#include "frontend/gibbs/Ast.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace dotek::frontend::gibbs {

// constant + sum of factor * symbol. A symbol is a host input or any other text that names one value.
struct Unknown {
  std::map<std::string, double> terms; // never empty, factors never 0
  double constant = 0;
  std::set<std::string> hosts; // host inputs behind it
  std::string reason;          // for messages, where no host input is behind it: GET_TOOL_DATA MTOOL_LENGTH
  bool text = false;           // a text: one term with factor 1
};
using UnknownPtr = std::shared_ptr<const Unknown>;

using Value = std::variant<double, std::string, UnknownPtr>;

const Unknown* unknownIn(const Value& value);
bool isTextValue(const Value& value);
Value hostValue(const std::string& host);
Value opaqueValue(const std::string& symbol, std::set<std::string> hosts, std::string reason, bool text);
// Canonical text: equal texts mean equal values.
std::string canonical(const Value& value);
// a * factorA + b * factorB with at least one unknown; nullopt where it is no short linear form.
std::optional<Value> linear(const Value& a, double factorA, const Value& b, double factorB);
// Hosts of both.
std::set<std::string> hostsOf(const std::vector<Value>& values);
// What a message calls the unknown parts: "tool_radius" or the reason.
std::string unknownText(const Unknown& unknown);

Relation opposite(Relation relation);
bool holds(double left, Relation relation, double right);

// What a path has learnt of one unknown quantity.
class Range {
public:
  // Keeps the part where the quantity stands in `relation` to `bound`; false: nothing is left.
  bool restrict(Relation relation, double bound);
  bool canBe(Relation relation, double bound) const { return Range(*this).restrict(relation, bound); }

private:
  std::optional<double> low_, high_;
  bool lowOpen_ = false, highOpen_ = false;
  std::vector<double> excluded_;
};

// A comparison that hangs on an unknown: `key` stands in `relation` to `bound`, or does not.
struct Question {
  std::string key;
  Relation relation = Relation::Equal;
  double bound = 0;
  std::set<std::string> hosts;
  std::string reason;
  SourceRange range;
};

// `difference` relation 0 as a question of one normalised quantity.
Question questionOf(const Unknown& difference, Relation relation, SourceRange range);

} // namespace dotek::frontend::gibbs
