// Prints expressions for targets whose languages have infix operators, brackets and functions. What a target
// calls them is a table; leaves and what it has to compute aside are asked of the caller.
#pragma once

#include "ir/Expression.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dotek::backends {

// An infix operator; those of higher `level` bind first, equal ones from left to right.
struct Infix {
  std::string_view text;
  int level = 0;
};
inline constexpr int kAdditive = 1;
inline constexpr int kMultiplicative = 2;
inline constexpr int kAtom = 100; // needs no bracket anywhere

// What a target's language has. A name that is empty: it has no such thing.
class Notation {
public:
  virtual ~Notation() = default;
  // Name of a function of one argument.
  virtual std::string_view function(ir::UnaryOp op) const = 0;
  virtual Infix infix(ir::BinaryOp op) const = 0;
  // The left operand, printed, would be read together with the operator.
  virtual bool bracketsLeft(ir::BinaryOp /*op*/, std::string_view /*left*/) const { return false; }
  virtual char open() const { return '['; }
  virtual char close() const { return ']'; }
};

// Prints one expression with the fewest brackets.
class ExpressionPrinter {
public:
  explicit ExpressionPrinter(const Notation& notation) : notation_(notation) {}
  virtual ~ExpressionPrinter() = default;

  // At most `depth` brackets inside one another.
  std::string print(const ir::ExpressionPtr& expression, std::uint32_t depth) {
    return text(expression, depth, true);
  }

protected:
  // Text of a constant, variable or machine variable; of a negative constant with its sign.
  virtual std::string leaf(const ir::ExpressionPtr& expression, std::uint32_t depth) = 0;
  // Computes the expression elsewhere and gives an atom that holds it: brackets lie too deep, or the notation
  // has no such operator.
  virtual std::string aside(const ir::ExpressionPtr& expression) = 0;

  // What is printed for the expression. Here: x - 5 for x + (-5), a sum with 0 for what null makes 0 and for
  // a minus before anything but a variable.
  virtual ir::ExpressionPtr shown(const ir::ExpressionPtr& expression) const;
  // Of shown(): its text begins with a sign.
  virtual bool isSigned(const ir::ExpressionPtr& expression) const;
  // The left operand may begin with a sign; `first`: nothing is before it in its brackets.
  virtual bool leftTakesSign(const Infix& infix, bool /*first*/) const { return infix.level == kAdditive; }
  // A minus that shown() keeps.
  virtual std::string negated(const ir::ExpressionPtr& operand, std::uint32_t depth);
  // An operator that is no infix in the notation.
  virtual std::string operation(const ir::Binary& /*binary*/, const ir::ExpressionPtr& whole,
                                std::uint32_t /*depth*/) {
    return aside(whole);
  }
  // How tightly what shown() gives holds together.
  virtual int levelOf(const ir::ExpressionPtr& expression) const;

private:
  std::string text(const ir::ExpressionPtr& expression, std::uint32_t depth, bool first);
  std::string operand(const ir::ExpressionPtr& expression, std::uint32_t depth, const Infix& infix,
                      bool right, bool first);
  std::string bracketed(const ir::ExpressionPtr& expression, std::uint32_t depth);

  const Notation& notation_;
};

} // namespace dotek::backends
