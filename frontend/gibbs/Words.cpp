#include "frontend/gibbs/Words.h"

#include "frontend/gibbs/Ast.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dotek::frontend::gibbs {

using Lexer = grammar::GibbsMacroLexer;

namespace {

constexpr std::array<std::pair<std::string_view, std::size_t>, 18> kStatementWords{{
    {"IF", Lexer::KW_IF},
    {"THEN", Lexer::KW_THEN},
    {"ELSE", Lexer::KW_ELSE},
    {"FOR", Lexer::KW_FOR},
    {"TO", Lexer::KW_TO},
    {"STEP", Lexer::KW_STEP},
    {"NEXT", Lexer::KW_NEXT},
    {"CONTINUE", Lexer::KW_CONTINUE},
    {"GOTO", Lexer::KW_GOTO},
    {"CALL", Lexer::KW_CALL},
    {"ARGS", Lexer::KW_ARGS},
    {"GLOBAL", Lexer::KW_GLOBAL},
    {"LOCAL", Lexer::KW_LOCAL},
    {"PERMANENT", Lexer::KW_PERMANENT},
    {"AND", Lexer::KW_AND},
    {"OR", Lexer::KW_OR},
    {"NOT", Lexer::KW_NOT},
    {"ON_ERROR", Lexer::KW_ON_ERROR},
}};

bool equalWithoutCase(std::string_view word, std::string_view upper) {
  return word.size() == upper.size() &&
         std::equal(word.begin(), word.end(), upper.begin(),
                    [](char a, char b) { return (a >= 'a' && a <= 'z' ? a - 'a' + 'A' : a) == b; });
}

bool isEnd(const antlr4::Token& token) {
  return token.getType() == Lexer::EOL || token.getType() == antlr4::Token::EOF;
}

} // namespace

std::size_t wordType(std::string_view word) {
  if (word.ends_with('$')) return Lexer::TEXT_NAME;
  if (word.ends_with('_')) return Lexer::OPEN_NAME;
  for (const auto& [text, type] : kStatementWords)
    if (equalWithoutCase(word, text)) return type;
  return Lexer::ID;
}

bool isNameType(std::size_t type) {
  return type == Lexer::ID || type == Lexer::OPEN_NAME || type == Lexer::TEXT_NAME ||
         (type >= Lexer::KW_ELSE && type <= Lexer::KW_OR);
}

std::size_t typeWithoutRole(std::size_t type, std::string_view text) {
  if (type == Lexer::CONDITION_ROUND) return Lexer::LEFT_ROUND;
  if (type < Lexer::NAME || type > Lexer::LOOSE_TEXT || text.empty()) return type;
  switch (text.front()) {
  case '.': return text.size() > 1 ? Lexer::NUMBER : Lexer::DOT;
  case '\\': return Lexer::BACKSLASH;
  case ':': return Lexer::COLON;
  case '-': return Lexer::MINUS;
  default: break;
  }
  if (text.front() >= '0' && text.front() <= '9') return Lexer::NUMBER;
  // Halves of a word with a stray blank: the last one tells.
  const std::size_t blank = text.find_last_of(" \t\f\v");
  return wordType(blank == std::string_view::npos ? text : text.substr(blank + 1));
}

std::unique_ptr<antlr4::Token> WordReader::nextToken() {
  std::unique_ptr<antlr4::Token> next = GibbsMacroLexer::nextToken();
  if (next->getType() == WORD) static_cast<antlr4::CommonToken&>(*next).setType(wordType(next->getText()));
  return next;
}

std::unique_ptr<antlr4::Token> RoleReader::nextToken() {
  if (line_.empty()) {
    std::vector<antlr4::CommonToken*> visible;
    do {
      line_.push_back(WordReader::nextToken());
      auto& last = static_cast<antlr4::CommonToken&>(*line_.back());
      if (last.getChannel() == antlr4::Token::DEFAULT_CHANNEL && !isEnd(last)) visible.push_back(&last);
    } while (!isEnd(*line_.back()));
    assignRoles(visible, kind_);
  }
  std::unique_ptr<antlr4::Token> next = std::move(line_.front());
  line_.pop_front();
  return next;
}

} // namespace dotek::frontend::gibbs
