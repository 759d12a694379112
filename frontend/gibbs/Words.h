// Tokens of the macro files: words told apart by a table, then given the role that their place on the line
// decides. Included by builder sources only, because it pulls in the ANTLR runtime.
#pragma once

#include "frontend/common/ParseSession.h"
#include "frontend/gibbs/Explain.h"

#include "GibbsMacroLexer.h"

#include <cstddef>
#include <deque>
#include <memory>
#include <string_view>

namespace dotek::frontend::gibbs {

// The token type of a word: a statement word, a name, a name of a text, a name that ends in `_`.
std::size_t wordType(std::string_view word);
// What the lexer made of a token that got a role: `text` is its text.
std::size_t typeWithoutRole(std::size_t type, std::string_view text);
// ID, OPEN_NAME, TEXT_NAME, or a statement word that may be a name elsewhere.
bool isNameType(std::size_t type);

// Tokens as `dump --stage tokens` shows them.
class WordReader : public grammar::GibbsMacroLexer {
public:
  using GibbsMacroLexer::GibbsMacroLexer;
  std::unique_ptr<antlr4::Token> nextToken() override;
};

// Tokens as the parser wants them: line by line, each word with its role.
class RoleReader final : public WordReader {
public:
  RoleReader(antlr4::CharStream* input, FileKind kind) : WordReader(input), kind_(kind) {}
  std::unique_ptr<antlr4::Token> nextToken() override;

private:
  FileKind kind_;
  std::deque<std::unique_ptr<antlr4::Token>> line_;
};

// Sets the roles on one line: `line` holds its visible tokens, without its end.
void assignRoles(const std::vector<antlr4::CommonToken*>& line, FileKind kind);

} // namespace dotek::frontend::gibbs
