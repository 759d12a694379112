// Values of a macro that runs or is translated. What the host alone knows is carried as a linear form over
// named unknowns, so that `r - 1 < 4` and `r >= 5` are seen to exclude each other.
#pragma once

#include "frontend/gibbs/Ast.h"
#include "ir/Arithmetic.h"
#include "ir/Expression.h"

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace dotek::frontend::gibbs {

// A quantity that is not known: equal symbols are the same quantity. Forms list them in the order of `kind`,
// `number`, `part` and `name`.
struct Symbol {
  enum class Kind : std::uint8_t {
    Fresh,    // the `number`-th that has no name
    Place,    // what the text at byte `part` of file `number` gives
    Derived,  // the `number`-th expression over others that is no linear form
    Named,    // what only the CAM knows, or a function of it; `name` says which
    Host,     // the host input `name`
    Variable, // the parameter or host input that is the variable `number` of an IR cycle
    Widened,  // what a loop through step `number` has changed too often to be followed
  };
  Kind kind = Kind::Named;
  std::size_t number = 0;
  std::size_t part = 0;
  std::string name;

  static Symbol fresh(std::size_t number) { return {Kind::Fresh, number, 0, {}}; }
  static Symbol place(SourceRange range) { return {Kind::Place, range.file, range.begin, {}}; }
  static Symbol derived(std::size_t number) { return {Kind::Derived, number, 0, {}}; }
  static Symbol named(std::string name) { return {Kind::Named, 0, 0, std::move(name)}; }
  static Symbol host(std::string name) { return {Kind::Host, 0, 0, std::move(name)}; }
  static Symbol variable(std::size_t id) { return {Kind::Variable, id, 0, {}}; }
  static Symbol widened(std::size_t step, std::size_t part) { return {Kind::Widened, step, part, {}}; }

  auto operator<=>(const Symbol&) const = default;
};

// constant + sum of factor * symbol.
struct Unknown {
  std::map<Symbol, double> terms; // never empty, factors never 0
  double constant = 0;
  std::set<Symbol> sources; // host inputs and variables that it is computed from
  std::string reason;       // for messages, where `sources` is empty: GET_TOOL_DATA MTOOL_LENGTH
  bool text = false;        // a text: one term with factor 1
};
using UnknownPtr = std::shared_ptr<const Unknown>;

// An expression of the IR is a number that the translated program computes; only a translation holds one.
using Value = std::variant<double, std::string, UnknownPtr, ir::ExpressionPtr>;

const Unknown* unknownIn(const Value& value);
bool isTextValue(const Value& value);
// The number that is known, as such or as a constant of the IR; nullptr for any other value.
const double* numberIn(const Value& value);
// A source of its own: a host input or a variable.
Value sourceValue(const Symbol& symbol);
Value opaqueValue(const Symbol& symbol, std::set<Symbol> sources, std::string reason, bool text);
// The symbol that the value is; nullptr for a text and for any other form.
const Symbol* symbolIn(const Value& value);
// The factor of the symbol in the form; 0 where it has none.
double factorOf(const Symbol& symbol, const Value& value);
// Canonical text: equal texts mean equal values. An expression of the IR has none.
std::string canonical(const Value& value);
// Appends bytes that are equal where the canonical text is, faster to make and not to be read.
void appendKey(std::string& bytes, const Value& value);
// a * factorA + b * factorB with at least one unknown; nullopt where it is no short linear form.
std::optional<Value> linear(const Value& a, double factorA, const Value& b, double factorB);
// What an operator makes of two numbers, or of one; angles in degrees. Neither value nor error: one of them
// is not known, and the result is no short linear form.
struct Combined {
  std::optional<Value> value;
  ir::ArithmeticError error = ir::ArithmeticError::None;
};
Combined combine(ir::BinaryOp op, const Value& left, const Value& right);
// Sources of all of them.
std::set<Symbol> sourcesOf(const std::vector<Value>& values);
// What a message calls the unknown parts: "tool_radius" or the reason.
const std::string& unknownText(const Unknown& unknown);

Relation opposite(Relation relation);
bool holds(double left, Relation relation, double right);

// What a path has learnt of one unknown quantity.
class Range {
public:
  // Keeps the part where the quantity is in `relation` to `bound`; false: nothing is left.
  bool restrict(Relation relation, double bound);
  // Whether the quantity is in `relation` to `bound`; nothing: it may or may not.
  std::optional<bool> answer(Relation relation, double bound) const;

  const std::optional<double>& low() const { return bounds_.low; }
  const std::optional<double>& high() const { return bounds_.high; }
  bool isLowOpen() const { return bounds_.lowOpen; }
  bool isHighOpen() const { return bounds_.highOpen; }
  // Of the values that are left out, ascending, those that `keep` keeps.
  template <class Keep> void keepExcluded(const Keep& keep) {
    std::erase_if(excluded_, [&](double value) { return !keep(value); });
  }

private:
  // From low to high, where they are known.
  struct Bounds {
    std::optional<double> low, high;
    bool lowOpen = false, highOpen = false;
    void narrow(Relation relation, double bound);
  };
  // Something is left of the bounds without what is excluded, and without `except`.
  bool leaves(const Bounds& bounds, std::optional<double> except) const;
  bool allows(Relation relation, double bound) const;

  Bounds bounds_;
  std::vector<double> excluded_; // ascending
};

// A comparison that depends on an unknown: `key` is in `relation` to `bound`, or does not.
struct Question {
  std::string key;
  Relation relation = Relation::Equal;
  double bound = 0;
  std::set<Symbol> sources;
  std::string reason;
  SourceRange range;
};

// `difference` relation 0 as a question of one normalised quantity.
Question questionOf(const Unknown& difference, Relation relation, SourceRange range);

} // namespace dotek::frontend::gibbs
