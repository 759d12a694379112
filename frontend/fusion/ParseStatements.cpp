#include "frontend/fusion/Parser.h"

#include "support/Printable.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace dotek::frontend::fusion {

bool Parser::takeSign(std::string_view sign) {
  if (!isSign(sign)) return false;
  ++at_;
  return true;
}

bool Parser::takeWord(std::string_view word) {
  if (!isWord(word)) return false;
  ++at_;
  return true;
}

std::string Parser::found() const {
  if (atEnd()) return "the file ends";
  return "`" + asUtf8(std::string(textOf(here()).substr(0, 40))) + "` follows";
}

void Parser::expectSign(std::string_view sign) {
  if (!takeSign(sign)) fail(fmt::format("`{}` is expected, and {}", sign, found()));
}

void Parser::fail(std::string message) {
  const Token& token = here();
  const bool end = token.type == TokenType::End;
  const std::uint32_t last = lastEnd();
  const SourceRange where = end ? SourceRange{tree_.file, last == 0 ? 0 : last - 1, last}
                                : SourceRange{tree_.file, token.begin, token.end};
  tree_.unread.push_back({where, std::move(message)});
  throw Stop{};
}

// A semicolon, or what ends a statement without one.
void Parser::semicolon() {
  if (takeSign(";") || isSign("}") || atEnd() || here().newLine) return;
  fail(fmt::format("the statement ends here without `;`, and {}", found()));
}

Node* Parser::make(Kind kind, std::uint32_t begin, std::vector<Node*> kids, std::string_view text) {
  Node& node = tree_.nodes.emplace_back();
  node.kind = kind;
  node.begin = begin;
  node.end = std::max(begin, lastEnd());
  node.kids = std::move(kids);
  node.text = text;
  return &node;
}

void Parser::script() {
  while (!atEnd()) {
    statements(tree_.body);
    if (atEnd()) break;
    tree_.unread.push_back({{tree_.file, here().begin, here().end}, "this `}` closes nothing"});
    ++at_;
  }
}

void Parser::statements(std::vector<Node*>& into) {
  for (;;) {
    while (!atEnd() && !isSign("}") && !isWord("case") && !isWord("default"))
      into.push_back(statementOrError());
    if (depth_ != 0 || !(isWord("case") || isWord("default"))) return;
    tree_.unread.push_back(
        {{tree_.file, here().begin, here().end}, fmt::format("`{}` outside of a switch", textOf(here()))});
    ++at_;
    skipUnread();
  }
}

// One defect is one message: reading goes on with the next line that begins a statement.
Node* Parser::statementOrError() {
  const std::size_t first = at_;
  const int depth = depth_;
  try {
    return statement();
  } catch (const Stop&) {
    depth_ = depth;
    if (at_ == first && !atEnd()) ++at_;
    skipUnread();
    return make(Kind::Error, tokens_[first].begin);
  }
}

void Parser::skipUnread() {
  constexpr std::array<std::string_view, 16> kBegins = {
      "break", "case", "const",  "continue", "default", "do",  "for", "function",
      "if",    "let",  "return", "switch",   "throw",   "try", "var", "while"};
  int open = 0;
  while (!atEnd()) {
    if (open == 0 && (isSign("}") || here().newLine) &&
        (isSign("}") || (here().type == TokenType::Name &&
                         std::find(kBegins.begin(), kBegins.end(), textOf(here())) != kBegins.end())))
      return;
    // A function at the margin begins whatever is left open before it.
    if (here().newLine && isWord("function") && (here().begin == 0 || tree_.text[here().begin - 1] == '\n'))
      return;
    if (open == 0 && takeSign(";")) return;
    open += isSign("{") ? 1 : isSign("}") ? -1 : 0;
    ++at_;
    if (open == 0 && tokens_[at_ - 1].type == TokenType::Sign && textOf(tokens_[at_ - 1]) == "}") return;
  }
}

Node* Parser::statement() {
  const Deeper level(*this);
  const Token& token = here();
  if (isSign("{")) return block();
  if (takeSign(";")) return make(Kind::Empty, token.begin);
  if (token.type == TokenType::Name) {
    if (Node* const node = statementOfWord(textOf(token))) return node;
    if (isSign(":", 1) && !isReserved(textOf(token))) {
      Node* const label = name();
      ++at_;
      return make(Kind::Label, token.begin, {label, statement()});
    }
  }
  Node* const value = expression();
  semicolon();
  return make(Kind::Evaluate, token.begin, {value});
}

// nullptr: no statement begins with the word.
Node* Parser::statementOfWord(std::string_view word) {
  const std::uint32_t begin = here().begin;
  const bool lets = word == "let" && (here(1).type == TokenType::Name || isSign("[", 1) || isSign("{", 1));
  if (word == "var" || word == "const" || lets) {
    Node* const list = variables();
    semicolon();
    return close(list);
  }
  if (word == "function") return function();
  if (word == "class") return classNode();
  if (word == "if") return ifStatement();
  if (word == "for") return forStatement();
  if (word == "try") return tryStatement();
  if (word == "switch") return switchStatement();
  if (word == "while") {
    ++at_;
    expectSign("(");
    Node* const condition = expression();
    expectSign(")");
    Node* const inner = body();
    return make(Kind::While, begin, {condition, inner});
  }
  if (word == "do") {
    ++at_;
    Node* const inner = body();
    if (!takeWord("while")) fail(fmt::format("`while` of `do` is expected, and {}", found()));
    expectSign("(");
    Node* const condition = expression();
    expectSign(")");
    takeSign(";");
    return make(Kind::DoWhile, begin, {inner, condition});
  }
  if (word == "return" || word == "throw") {
    ++at_;
    Node* value = nullptr;
    if (!isSign(";") && !isSign("}") && !atEnd() && !here().newLine) value = expression();
    if (word == "throw" && value == nullptr) fail("`throw` without a value");
    semicolon();
    return make(word == "return" ? Kind::Return : Kind::Throw, begin, {value});
  }
  if (word == "break" || word == "continue") {
    ++at_;
    Node* const label = here().type == TokenType::Name && !here().newLine ? name() : nullptr;
    semicolon();
    return make(word == "break" ? Kind::Break : Kind::Continue, begin, {label});
  }
  if (word == "debugger") {
    ++at_;
    semicolon();
    return make(Kind::Empty, begin);
  }
  if (word == "import" || word == "export" || word == "with")
    fail(fmt::format("`{}` is not read: posts have no modules and no `with`", word));
  return nullptr;
}

Node* Parser::block() {
  const std::uint32_t begin = here().begin;
  expectSign("{");
  Node* const out = make(Kind::Block, begin);
  statements(out->kids);
  if (!isSign("}")) {
    // Where a brace is missing, the function after it begins at the margin.
    fail(fmt::format("the block of line {} is not closed: {}",
                     1 + std::count(tree_.text.begin(), tree_.text.begin() + begin, '\n'), found()));
  }
  ++at_;
  return close(out);
}

Node* Parser::body() {
  return statement();
}

Node* Parser::variables() {
  const Token& word = here();
  ++at_;
  return declarators(make(Kind::Variables, word.begin, {}, textOf(word)), false);
}

Node* Parser::declarators(Node* list, bool inFor) {
  do {
    const std::uint32_t begin = here().begin;
    Node* const target = binding();
    Node* value = nullptr;
    if (takeSign("=")) value = assignment(!inFor);
    list->kids.push_back(make(Kind::Declarator, begin, {target, value}));
  } while (takeSign(","));
  return close(list);
}

Node* Parser::ifStatement() {
  const std::uint32_t begin = here().begin;
  ++at_;
  expectSign("(");
  Node* const condition = expression();
  expectSign(")");
  Node* const then = body();
  Node* const out = make(Kind::If, begin, {condition, then, nullptr});
  // Chains of else if are no nesting.
  Node* last = out;
  while (takeWord("else")) {
    if (!isWord("if")) {
      last->kids[2] = body();
      break;
    }
    const std::uint32_t next = here().begin;
    ++at_;
    expectSign("(");
    Node* const other = expression();
    expectSign(")");
    Node* const inner = body();
    Node* const one = make(Kind::If, next, {other, inner, nullptr});
    last->kids[2] = one;
    last = one;
  }
  for (Node* one = out; one != nullptr && one->is(Kind::If); one = one->kids[2])
    close(one);
  return out;
}

Node* Parser::forStatement() {
  const std::uint32_t begin = here().begin;
  ++at_;
  expectSign("(");
  Node* first = nullptr;
  const bool lets = isWord("let") && here(1).type == TokenType::Name && !isWord("in", 1) && !isWord("of", 1);
  if (isWord("var") || isWord("const") || lets || (isWord("let") && (isSign("[", 1) || isSign("{", 1)))) {
    const Token& word = here();
    ++at_;
    first = declarators(make(Kind::Variables, word.begin, {}, textOf(word)), true);
  } else if (!isSign(";")) {
    first = expression(false);
  }
  if (isWord("in") || isWord("of")) {
    const bool of = isWord("of");
    if (first != nullptr && !first->is(Kind::Variables)) toPattern(first);
    ++at_;
    Node* const value = of ? assignment() : expression();
    expectSign(")");
    Node* const inner = body();
    return make(of ? Kind::ForOf : Kind::ForIn, begin, {first, value, inner});
  }
  expectSign(";");
  Node* const condition = isSign(";") ? nullptr : expression();
  expectSign(";");
  Node* const step = isSign(")") ? nullptr : expression();
  expectSign(")");
  Node* const inner = body();
  return make(Kind::For, begin, {first, condition, step, inner});
}

Node* Parser::tryStatement() {
  const std::uint32_t begin = here().begin;
  ++at_;
  Node* const out = make(Kind::Try, begin, {block(), nullptr, nullptr});
  if (isWord("catch")) {
    const std::uint32_t from = here().begin;
    ++at_;
    Node* what = nullptr;
    if (takeSign("(")) {
      what = binding();
      expectSign(")");
    }
    Node* const inner = block();
    out->kids[1] = make(Kind::Catch, from, {what, inner});
  }
  if (takeWord("finally")) out->kids[2] = block();
  if (out->kids[1] == nullptr && out->kids[2] == nullptr) fail("`try` without `catch` and `finally`");
  return close(out);
}

Node* Parser::switchStatement() {
  const std::uint32_t begin = here().begin;
  ++at_;
  expectSign("(");
  Node* const out = make(Kind::Switch, begin, {expression()});
  expectSign(")");
  expectSign("{");
  while (isWord("case") || isWord("default")) {
    Node* const one = make(Kind::Case, here().begin, {nullptr});
    const bool other = isWord("default");
    ++at_;
    if (!other) one->kids[0] = expression();
    expectSign(":");
    statements(one->kids);
    out->kids.push_back(close(one));
  }
  expectSign("}");
  return close(out);
}

Node* Parser::function() {
  const std::uint32_t begin = here().begin;
  ++at_;
  if (isSign("*")) fail("generators (`function*`) are not read: no post engine is known to have them");
  Node* const called = here().type == TokenType::Name ? name() : nullptr;
  Node* const list = parameters();
  Node* const inner = functionBody();
  return make(Kind::Function, begin, {called, list, inner});
}

Node* Parser::parameters() {
  Node* const out = make(Kind::Parameters, here().begin);
  out->brackets = true;
  expectSign("(");
  while (!isSign(")")) {
    out->kids.push_back(parameter());
    if (!takeSign(",")) break;
  }
  expectSign(")");
  return close(out);
}

Node* Parser::parameter() {
  const std::uint32_t begin = here().begin;
  if (takeSign("...")) return make(Kind::Spread, begin, {binding()});
  Node* const target = binding();
  if (!takeSign("=")) return target;
  Node* const value = assignment();
  return make(Kind::Default, begin, {target, value});
}

// What is wrong in a function stays in it.
Node* Parser::functionBody() {
  return block();
}

Node* Parser::classNode() {
  const std::uint32_t begin = here().begin;
  ++at_;
  Node* const called = here().type == TokenType::Name && !isWord("extends") ? name() : nullptr;
  Node* const base = takeWord("extends") ? postfix() : nullptr;
  Node* const out = make(Kind::Class, begin, {called, base});
  expectSign("{");
  while (!isSign("}") && !atEnd()) {
    if (takeSign(";")) continue;
    out->kids.push_back(method(true));
  }
  expectSign("}");
  return close(out);
}

// A method, or of a class a field. The words get, set and static may be names as well.
Node* Parser::method(bool ofClass) {
  const std::uint32_t begin = here().begin;
  const auto names = [&](std::string_view word) {
    return isWord(word) && !isSign("(", 1) && !isSign("=", 1) && !isSign(";", 1) && !isSign("}", 1) &&
           !isSign(",", 1) && !isSign(":", 1);
  };
  bool isStatic = false;
  if (ofClass && names("static")) {
    ++at_;
    isStatic = true;
  }
  if (isSign("*") || names("async"))
    fail("generators and `async` are not read: no post engine is known to have them");
  std::string_view what;
  if (names("get") || names("set")) {
    what = textOf(here());
    ++at_;
  }
  Node* const called = key();
  Node* out = nullptr;
  if (isSign("(")) {
    const std::uint32_t from = here().begin;
    Node* const list = parameters();
    Node* const inner = functionBody();
    Node* const of = make(Kind::Function, from, {nullptr, list, inner});
    out = make(Kind::Method, begin, {called, of}, what);
  } else {
    if (!ofClass) fail(fmt::format("`:` is expected, and {}", found()));
    Node* value = nullptr;
    if (takeSign("=")) value = assignment();
    semicolon();
    out = make(Kind::Field, begin, {called, value});
  }
  out->flag = isStatic;
  return out;
}

Tree parseText(std::string_view text, FileId file) {
  Tree out;
  out.file = file;
  out.text = text;
  out.tokens = tokenize(file, text);
  Parser(out).script();
  return out;
}

Tree parse(FileId file, const SourceMap& sources) {
  return parseText(sources.file(file).bytes(), file);
}

} // namespace dotek::frontend::fusion
