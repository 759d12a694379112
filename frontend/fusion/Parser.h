// Private to frontend/fusion: recursive descent, by hand (docs/architecture.md says why).
#pragma once

#include "frontend/fusion/Parse.h"

#include <algorithm>
#include <initializer_list>
#include <unordered_set>

namespace dotek::frontend::fusion {

class Parser {
public:
  explicit Parser(Tree& tree) : tree_(tree), tokens_(tree.tokens.tokens) { findArrows(); }
  void script();

private:
  static constexpr int kMostDepth = 250;
  static constexpr int kMostOperators = 3000; // of one level, side by side
  struct Stop {};                             // this statement cannot be read on

  const Token& here(std::size_t ahead = 0) const {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
  }
  std::string_view textOf(const Token& token) const {
    return tree_.text.substr(token.begin, token.end - token.begin);
  }
  bool atEnd() const { return here().type == TokenType::End; }
  bool isSign(std::string_view sign, std::size_t ahead = 0) const {
    return here(ahead).type == TokenType::Sign && textOf(here(ahead)) == sign;
  }
  bool isWord(std::string_view word, std::size_t ahead = 0) const {
    return here(ahead).type == TokenType::Name && textOf(here(ahead)) == word;
  }
  bool takeSign(std::string_view sign);
  bool takeWord(std::string_view word);
  void expectSign(std::string_view sign);
  std::uint32_t lastEnd() const { return at_ == 0 ? 0 : tokens_[at_ - 1].end; }
  [[noreturn]] void fail(std::string message);
  std::string found() const;
  void refusePrivate();
  void semicolon();

  Node* make(Kind kind, std::uint32_t begin, std::vector<Node*> kids = {}, std::string_view text = {});
  // What is empty ends where it begins: the word before it may end farther left.
  Node* close(Node* node) {
    node->end = std::max(node->begin, lastEnd());
    return node;
  }

  // Statements
  Node* statement();
  Node* statementOrError();
  void skipUnread();
  Node* statementOfWord(std::string_view word);
  Node* block();
  void statements(std::vector<Node*>& into);
  Node* variables();
  Node* declarators(Node* list, bool inFor);
  Node* ifStatement();
  Node* forStatement();
  Node* tryStatement();
  Node* switchStatement();
  Node* classNode();
  Node* method(bool ofClass);
  Node* function();
  Node* parameters();
  Node* functionBody();
  Node* body(); // of a loop or a branch

  // Expressions
  Node* expression(bool in = true);
  Node* assignment(bool in = true);
  Node* conditional(bool in);
  Node* binary(int level, bool in);
  Node* unary();
  Node* postfix();
  Node* call(Node* of, std::uint32_t begin, bool calls);
  Node* newExpression();
  void arguments(std::vector<Node*>& into);
  Node* primary();
  Node* name(bool any = false);
  Node* array();
  Node* object();
  Node* key();
  Node* templateNode();
  Node* arrow();
  bool arrowBegins() const;
  void findArrows();
  Node* binding(); // a name or a pattern
  Node* parameter();
  void toPattern(Node* node);

  struct Deeper;
  Tree& tree_;
  const std::vector<Token>& tokens_;
  std::size_t at_ = 0;
  std::unordered_set<std::size_t> arrows_; // round brackets of parameters of an arrow function
  int depth_ = 0;
};

// One level of nesting; throws where there are too many.
struct Parser::Deeper {
  explicit Deeper(Parser& parser) : parser_(parser) {
    if (++parser_.depth_ > kMostDepth) {
      --parser_.depth_;
      parser_.fail("brackets and blocks are nested too deep");
    }
  }
  ~Deeper() { --parser_.depth_; }
  Deeper(const Deeper&) = delete;
  Deeper& operator=(const Deeper&) = delete;
  Parser& parser_;
};

} // namespace dotek::frontend::fusion
