// Tokens of macro statements and what the ANTLR shell needs to know. Included by builder sources only.
#pragma once

#include "frontend/common/ParseSession.h"
#include "support/Source.h"

#include <MacroBLexer.h>

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::frontend::macrob {

// Takes runs of letters apart, and the text of DPRNT as one token.
class TokenReader final : public grammar::MacroBLexer {
public:
  // `text`: what `input` reads.
  TokenReader(antlr4::CharStream* input, std::string_view text) : MacroBLexer(input), text_(text) {}
  std::unique_ptr<antlr4::Token> nextToken() override;

private:
  std::unique_ptr<antlr4::Token> make(std::size_t kind, std::size_t begin, std::size_t end);
  void skipBlanks();
  void takeApart(const antlr4::Token& run);
  std::unique_ptr<antlr4::Token> printText(const antlr4::Token& bracket);

  std::string_view text_;
  std::deque<std::unique_ptr<antlr4::Token>> waiting_;
  bool expectText_ = false; // after DPRNT, BPRNT, SETVN
};

// A token of one block, before it goes to the parser. Repairs change these.
struct Tok {
  std::size_t type = 0;
  std::uint32_t begin = 0, end = 0; // bytes of the file; empty for a token that a repair put in
  std::string text;                 // without blanks; what a repair made of it
};

// Visible tokens as they are read, with their text.
Tok tokOf(const antlr4::Token& token, std::string_view source);

// The kind of the token at `i`; that of the end after the last one.
std::size_t typeAt(const std::vector<Tok>& tokens, std::size_t i);
bool isOperator(std::size_t type); // of two values; comparisons are none
bool isAddress(std::size_t type);
bool expectsValue(std::size_t type); // a value may follow

Language language();

} // namespace dotek::frontend::macrob
