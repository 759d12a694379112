// Private to Parse*.cpp: one block on its path from text to words.
#pragma once

#include "frontend/nc/Parse.h"
#include "frontend/nc/Reader.h"
#include "support/messages/Common.h"

#include <fmt/format.h>

namespace dotek::frontend::nc {

// What a function gives that has reported an error.
struct Refused {
  operator bool() const { return false; }
  operator ExpressionPtr() const { return nullptr; }
};

class BlockParser {
public:
  BlockParser(const std::vector<Piece>& pieces, const Limits& limits, Diagnostics& diagnostics)
      : in_(pieces), limits_(limits), diagnostics_(diagnostics) {}

  // nullopt: reported.
  std::optional<Block> parse();

private:
  // Each gives false, or a null pointer, where it has reported an error.
  bool item(Block& block);
  bool comment(Block& block);
  bool sequenceNumber(Block& block);
  bool word(Block& block);
  bool assignment(Block& block);
  bool wordValue(Word& word);
  bool statement(Block& block);                   // at its word
  bool port(Block& block, std::string_view word); // at its word
  bool printed(ir::Print& print, std::size_t begin);
  bool printedVariable(ir::Print& print);
  bool take(std::string_view word);
  // The number of a block or a loop; reports one that is computed.
  bool statementNumber(std::string_view after, std::uint64_t& out);
  bool holdsRelation() const;   // at the [
  ConditionPtr conditionHere(); // in its brackets
  ConditionPtr junction();      // OR
  ConditionPtr conjunction();   // AND, the higher one as among numbers
  ConditionPtr joined(std::initializer_list<std::string_view> operators,
                      ConditionPtr (BlockParser::*operand)());
  bool addressesOnce(const Block& block);

  ExpressionPtr expression(); // + - OR XOR
  ExpressionPtr term();       // * / MOD AND
  ExpressionPtr factor();
  ExpressionPtr number();
  ExpressionPtr hole();
  ExpressionPtr variableRef(); // at the #
  ExpressionPtr bracketed();   // at the [
  ExpressionPtr function();
  // The number after a #: digits, a hole or brackets.
  ExpressionPtr variableNumber();
  std::string_view operatorHere(std::initializer_list<std::string_view> operators);
  ExpressionPtr make(std::size_t begin, decltype(Expression::node) node) const;

  bool enter(); // one level deeper; leave() undoes it
  void leave() { --depth_; }
  bool count(); // one operator more
  // The sign before a hole: a negative value brings a second one.
  void warnOfSign(char sign, std::size_t at);
  std::string shown(std::size_t begin, std::size_t end) const;
  Refused unexpected();
  template <class... Args>
  Refused syntax(SourceRange range, fmt::format_string<Args...> text, Args&&... args) {
    diagnostics_.report<diag::SyntaxError>(range, fmt::format(text, std::forward<Args>(args)...));
    return {};
  }

  Reader in_;
  const Limits& limits_;
  Diagnostics& diagnostics_;
  std::uint32_t depth_ = 0;
  std::uint32_t operators_ = 0;
};

} // namespace dotek::frontend::nc
