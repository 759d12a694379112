// Tokens of a cycle and what the ANTLR shell needs to know of the language. Included by builder sources only.
#pragma once

#include "frontend/common/ParseSession.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"
#include "support/Source.h"

#include <CycleLexer.h>

#include <deque>
#include <memory>
#include <string_view>
#include <vector>

namespace dotek::frontend::cycle {

// Words of a statement over several lines.
inline constexpr size_t kStatementTokens = 2000;

// Words of other languages for `end`, for `else if`, and for one of several cases.
bool isForeignEnd(std::string_view word);
bool isForeignElseIf(std::string_view word);
bool isForeignCase(std::string_view word);

// Names the words and ends the statements: a line end within brackets, after a comma or after an operator is
// hidden, unless a new statement begins on the next line. The last line gets an end, too.
class TokenReader final : public grammar::CycleLexer {
public:
  using CycleLexer::CycleLexer;
  std::unique_ptr<antlr4::Token> nextToken() override;

  // Words of the language in capitals; each is taken for the word.
  const std::vector<std::pair<size_t, size_t>>& capitals() const { return capitals_; } // first and last byte
  // Line ends that end a statement because it goes on for too long.
  const std::vector<size_t>& tooLong() const { return tooLong_; }

private:
  std::unique_ptr<antlr4::Token> read();
  void classify(antlr4::CommonToken& token);
  bool goesOn() const;
  bool givesValue(std::size_t before);
  bool operandEnded() const;

  std::deque<std::unique_ptr<antlr4::Token>> queue_;
  std::vector<std::pair<size_t, size_t>> capitals_;
  size_t previous_ = NEWLINE; // type of the last token of the default channel
  size_t depth_ = 0;          // of brackets
  size_t tokens_ = 0;         // of the statement so far
  std::vector<size_t> tooLong_;
};

Language language();

} // namespace dotek::frontend::cycle
