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

// What a target's language has. A name that is empty: it has no such thing.
class Notation {
public:
  virtual ~Notation() = default;
  // Name of a function of one argument.
  virtual std::string_view function(ir::UnaryOp op) const = 0;
  virtual Infix infix(ir::BinaryOp op) const = 0;
  virtual char open() const { return '['; }
  virtual char close() const { return ']'; }
};

// Prints one expression. Texts are atoms or sums: an atom needs no bracket anywhere.
class ExpressionPrinter {
public:
  explicit ExpressionPrinter(const Notation& notation) : notation_(notation) {}
  virtual ~ExpressionPrinter() = default;

  // At most `depth` brackets inside one another.
  std::string print(const ir::ExpressionPtr& expression, std::uint32_t depth);

protected:
  // Text of a constant, variable or machine variable; of a negative constant with its sign.
  virtual std::string leaf(const ir::ExpressionPtr& expression, std::uint32_t depth) = 0;
  // Computes the expression elsewhere and gives an atom that holds it: brackets lie too deep, or the notation
  // has no such operator.
  virtual std::string aside(const ir::ExpressionPtr& expression) = 0;

private:
  std::string operand(const ir::ExpressionPtr& expression, std::uint32_t depth, int level, bool right);
  std::string bracketed(const ir::ExpressionPtr& expression, std::uint32_t depth);
  std::string function(const ir::Unary& unary, const ir::ExpressionPtr& whole, std::uint32_t depth);
  std::string sum(const ir::Binary& binary, const ir::ExpressionPtr& whole, std::uint32_t depth);
  int levelOf(const ir::ExpressionPtr& expression) const;

  const Notation& notation_;
};

} // namespace dotek::backends
