#include "frontend/fusion/Parser.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace dotek::frontend::fusion {

namespace {

using View = std::string_view;

// How tightly a binary operator binds; 0: it is none.
int levelOf(View sign) {
  struct Level {
    View sign;
    int level;
  };
  constexpr std::array<Level, 26> kLevels = {
      {{"?\?", 1},        {"||", 2},  {"&&", 3},  {"|", 4},   {"^", 5},   {"&", 6},  {"==", 7},
       {"!=", 7},         {"===", 7}, {"!==", 7}, {"<", 8},   {">", 8},   {"<=", 8}, {">=", 8},
       {"instanceof", 8}, {"in", 8},  {"<<", 9},  {">>", 9},  {">>>", 9}, {"+", 10}, {"-", 10},
       {"*", 11},         {"/", 11},  {"%", 11},  {"**", 12}, {"", 0}}};
  for (const Level& one : kLevels)
    if (one.sign == sign) return one.level;
  return 0;
}

bool assigns(View sign) {
  constexpr std::array<View, 16> kSigns = {
      "=", "+=", "-=", "*=", "/=", "%=", "<<=", ">>=", ">>>=", "&=", "|=", "^=", "**=", "&&=", "||=", "?\?="};
  return std::find(kSigns.begin(), kSigns.end(), sign) != kSigns.end();
}

} // namespace

// `#count` of a class.
void Parser::refusePrivate() {
  if (textOf(here()).starts_with('#'))
    fail("private members (`#name`) are not read: no post engine is known to have them");
}

Node* Parser::name(bool any) {
  const Token& token = here();
  refusePrivate();
  if (token.type != TokenType::Name || (!any && isReserved(textOf(token))))
    fail(fmt::format("a name is expected, and {}", found()));
  ++at_;
  return make(Kind::Name, token.begin, {}, textOf(token));
}

Node* Parser::binding() {
  const std::uint32_t begin = here().begin;
  if (!isSign("[") && !isSign("{")) return name();
  Node* const out = isSign("[") ? array() : object();
  toPattern(out);
  out->begin = begin;
  return out;
}

// What was read as a value is where values go.
void Parser::toPattern(Node* node) {
  switch (node->kind) {
  case Kind::Name:
  case Kind::Member:
  case Kind::Index: return;
  case Kind::Brackets: return toPattern(node->kids.front());
  case Kind::Spread:
  case Kind::Default: return toPattern(node->kids.front());
  case Kind::Array:
    node->kind = Kind::ArrayPattern;
    for (Node* const one : node->kids)
      if (one != nullptr) toPattern(one);
    return;
  case Kind::Object:
    node->kind = Kind::ObjectPattern;
    for (Node* const one : node->kids)
      if (one != nullptr && one->is(Kind::Property))
        toPattern(one->kids.back());
      else if (one != nullptr && one->is(Kind::Spread))
        toPattern(one);
      else
        fail("a function cannot be given a value");
    return;
  case Kind::Assign:
    if (node->text != "=") break;
    node->kind = Kind::Default;
    return toPattern(node->kids.front());
  case Kind::ArrayPattern:
  case Kind::ObjectPattern: return;
  default: break;
  }
  tree_.unread.push_back({tree_.range(*node), "a value is given to what is no variable"});
  throw Stop{};
}

Node* Parser::expression(bool in) {
  const std::uint32_t begin = here().begin;
  Node* const first = assignment(in);
  if (!isSign(",")) return first;
  Node* const out = make(Kind::Sequence, begin, {first});
  while (takeSign(","))
    out->kids.push_back(assignment(in));
  return close(out);
}

Node* Parser::assignment(bool in) {
  const Deeper level(*this);
  const std::uint32_t begin = here().begin;
  if (arrowBegins()) return arrow();
  Node* const target = conditional(in);
  if (here().type != TokenType::Sign || !assigns(textOf(here()))) return target;
  const View sign = textOf(here());
  if (sign == "=" && (target->is(Kind::Array) || target->is(Kind::Object)))
    toPattern(target);
  else if (const Node* const of = bare(target);
           !of->is(Kind::Name) && !of->is(Kind::Member) && !of->is(Kind::Index))
    fail("a value is given to what is no variable");
  ++at_;
  Node* const value = assignment(in);
  return make(Kind::Assign, begin, {target, value}, sign);
}

bool Parser::arrowBegins() const {
  if (here().type == TokenType::Name && isSign("=>", 1)) return true;
  if (isWord("async") && (isWord("function", 1) || isSign("=>", 2) || arrows_.contains(at_ + 1))) return true;
  if (!isSign("(")) return false;
  return arrows_.contains(at_);
}

// Round brackets before `=>`.
void Parser::findArrows() {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < tokens_.size(); ++i) {
    if (tokens_[i].type != TokenType::Sign) continue;
    const View sign = textOf(tokens_[i]);
    if (sign == "(" || sign == "[" || sign == "{") {
      open.push_back(i);
    } else if ((sign == ")" || sign == "]" || sign == "}") && !open.empty()) {
      if (sign == ")" && i + 1 < tokens_.size() && tokens_[i + 1].type == TokenType::Sign &&
          textOf(tokens_[i + 1]) == "=>")
        arrows_.insert(open.back());
      open.pop_back();
    }
  }
}

Node* Parser::arrow() {
  const std::uint32_t begin = here().begin;
  if (isWord("async") && !isSign("=>", 1)) fail("`async` is not read: no post engine is known to have it");
  Node* list = nullptr;
  if (isSign("(")) {
    list = parameters();
  } else {
    Node* const one = name();
    list = make(Kind::Parameters, begin, {one});
  }
  expectSign("=>");
  Node* const inner = isSign("{") ? functionBody() : assignment();
  return make(Kind::Arrow, begin, {list, inner});
}

Node* Parser::conditional(bool in) {
  const std::uint32_t begin = here().begin;
  Node* const condition = binary(1, in);
  if (!takeSign("?")) return condition;
  Node* const yes = assignment();
  expectSign(":");
  Node* const no = assignment(in);
  return make(Kind::Conditional, begin, {condition, yes, no}, "?");
}

Node* Parser::binary(int level, bool in) {
  const std::uint32_t begin = here().begin;
  Node* left = unary();
  int operators = 0;
  while (here().type == TokenType::Sign || here().type == TokenType::Name) {
    const View sign = textOf(here());
    const int own = levelOf(sign);
    if (own == 0 || own < level || (!in && sign == "in")) break;
    if (++operators > kMostOperators) fail("more than 3000 operators side by side");
    ++at_;
    Node* right = nullptr;
    {
      const Deeper deeper(*this);
      right = binary(sign == "**" ? own : own + 1, in);
    }
    left = make(Kind::Binary, begin, {left, right}, sign);
  }
  return left;
}

Node* Parser::unary() {
  const Deeper level(*this);
  const Token& token = here();
  const View text = textOf(token);
  if (token.type == TokenType::Sign && (text == "++" || text == "--")) {
    ++at_;
    Node* const of = unary();
    Node* const out = make(Kind::Update, token.begin, {of}, text);
    out->flag = true;
    return out;
  }
  const bool sign =
      token.type == TokenType::Sign && (text == "!" || text == "-" || text == "+" || text == "~");
  const bool word = token.type == TokenType::Name && (text == "typeof" || text == "void" || text == "delete");
  if (!sign && !word) {
    if (token.type == TokenType::Name && (text == "await" || text == "yield") &&
        here(1).type == TokenType::Name && !here(1).newLine)
      fail(fmt::format("`{}` is not read: no post engine is known to have it", text));
    return postfix();
  }
  ++at_;
  Node* const of = unary();
  return make(Kind::Unary, token.begin, {of}, text);
}

Node* Parser::postfix() {
  const std::uint32_t begin = here().begin;
  Node* const of = isWord("new") ? newExpression() : primary();
  Node* const out = call(of, begin, true);
  if ((isSign("++") || isSign("--")) && !here().newLine) {
    const View sign = textOf(here());
    ++at_;
    return make(Kind::Update, begin, {out}, sign);
  }
  return out;
}

Node* Parser::newExpression() {
  const Deeper level(*this);
  const std::uint32_t begin = here().begin;
  ++at_;
  const std::uint32_t from = here().begin;
  Node* const of = call(isWord("new") ? newExpression() : primary(), from, false);
  Node* const out = make(Kind::New, begin, {of});
  if (isSign("(")) arguments(out->kids);
  return close(out);
}

void Parser::arguments(std::vector<Node*>& into) {
  expectSign("(");
  while (!isSign(")")) {
    const std::uint32_t begin = here().begin;
    if (takeSign("...")) {
      Node* const of = assignment();
      into.push_back(make(Kind::Spread, begin, {of}));
    } else {
      into.push_back(assignment());
    }
    if (!takeSign(",")) break;
  }
  if (!isSign(")")) fail(fmt::format("`,` or `)` is expected, and {}", found()));
  ++at_;
}

Node* Parser::call(Node* of, std::uint32_t begin, bool calls) {
  for (int count = 0;; ++count) {
    if (count > kMostOperators) fail("more than 3000 operators side by side");
    const bool optional = isSign("?.");
    if (isSign(".") || (optional && here(1).type == TokenType::Name)) {
      ++at_;
      Node* const member = name(true);
      of = make(Kind::Member, begin, {of, member});
    } else if (isSign("[") || (optional && isSign("[", 1))) {
      at_ += optional ? 2 : 1;
      Node* const index = expression();
      expectSign("]");
      of = make(Kind::Index, begin, {of, index});
    } else if (calls && (isSign("(") || (optional && isSign("(", 1)))) {
      if (optional) ++at_;
      Node* const out = make(Kind::Call, begin, {of});
      arguments(out->kids);
      of = close(out);
    } else if (here().type == TokenType::Template && textOf(here()).starts_with('`')) {
      Node* const text = templateNode();
      of = make(Kind::Tagged, begin, {of, text});
    } else {
      return of;
    }
    of->flag = optional;
  }
}

Node* Parser::primary() {
  const Token& token = here();
  const View text = textOf(token);
  switch (token.type) {
  case TokenType::Number:
  case TokenType::String:
  case TokenType::Regex:
    ++at_;
    return make(token.type == TokenType::Number   ? Kind::Number
                : token.type == TokenType::String ? Kind::String
                                                  : Kind::Regex,
                token.begin, {}, text);
  case TokenType::Template:
    if (text.starts_with('`')) return templateNode();
    break;
  case TokenType::Name:
    if (text == "function") return function();
    if (text == "class") return classNode();
    if (text == "true" || text == "false" || text == "null" || text == "this" || text == "super") {
      ++at_;
      return make(text == "this"    ? Kind::This
                  : text == "super" ? Kind::Super
                                    : Kind::Literal,
                  token.begin, {}, text);
    }
    if (isReserved(text)) fail(fmt::format("a value is expected, and {}", found()));
    return name();
  case TokenType::Sign:
    if (text == "[") return array();
    if (text == "{") return object();
    if (text == "(") {
      ++at_;
      Node* const inner = expression();
      expectSign(")");
      return make(Kind::Brackets, token.begin, {inner});
    }
    break;
  case TokenType::Bad:
    if (text.starts_with('"') || text.starts_with('\'')) fail("the text does not end on its line");
    if (text.starts_with('`') || text.starts_with('}')) fail("the template literal does not end");
    if (text.starts_with("/*")) fail("the comment does not end");
    break;
  case TokenType::End: break;
  }
  fail(fmt::format("a value is expected, and {}", found()));
}

Node* Parser::templateNode() {
  Node* const out = make(Kind::Template, here().begin);
  while (true) {
    const View text = textOf(here());
    if (here().type != TokenType::Template) fail(fmt::format("`}}` is expected, and {}", found()));
    ++at_;
    if (!text.ends_with("${")) break;
    out->kids.push_back(expression());
  }
  return close(out);
}

Node* Parser::array() {
  const Deeper level(*this);
  Node* const out = make(Kind::Array, here().begin);
  expectSign("[");
  while (!isSign("]")) {
    const std::uint32_t begin = here().begin;
    if (isSign(",")) {
      out->kids.push_back(nullptr);
    } else if (takeSign("...")) {
      Node* const of = assignment();
      out->kids.push_back(make(Kind::Spread, begin, {of}));
    } else {
      out->kids.push_back(assignment());
    }
    if (!takeSign(",")) break;
  }
  expectSign("]");
  return close(out);
}

Node* Parser::key() {
  const Token& token = here();
  const std::uint32_t begin = token.begin;
  if (takeSign("[")) {
    Node* const value = assignment();
    expectSign("]");
    return make(Kind::Computed, begin, {value});
  }
  if (token.type == TokenType::Name) return name(true);
  if (token.type == TokenType::String || token.type == TokenType::Number) return primary();
  refusePrivate();
  fail(fmt::format("a name is expected, and {}", found()));
}

Node* Parser::object() {
  const Deeper level(*this);
  Node* const out = make(Kind::Object, here().begin);
  expectSign("{");
  while (!isSign("}")) {
    const std::uint32_t begin = here().begin;
    if (takeSign("...")) {
      Node* const of = assignment();
      out->kids.push_back(make(Kind::Spread, begin, {of}));
    } else if (here().type == TokenType::Name && (isSign(",", 1) || isSign("}", 1) || isSign("=", 1))) {
      Node* const called = name();
      Node* value = called;
      if (takeSign("=")) {
        Node* const otherwise = assignment();
        value = make(Kind::Default, begin, {called, otherwise});
      }
      Node* const one = make(Kind::Property, begin, {called, value});
      one->flag = true;
      out->kids.push_back(one);
    } else {
      const std::size_t first = at_;
      const bool word = isWord("get") || isWord("set") || isWord("async") || isSign("*");
      if (!word || isSign(":", 1)) {
        Node* const called = key();
        if (takeSign(":")) {
          Node* const value = assignment();
          out->kids.push_back(make(Kind::Property, begin, {called, value}));
        } else {
          at_ = first;
          out->kids.push_back(method(false));
        }
      } else {
        out->kids.push_back(method(false));
      }
    }
    if (!takeSign(",")) break;
  }
  if (!isSign("}")) fail(fmt::format("`,` or `}}` is expected, and {}", found()));
  ++at_;
  return close(out);
}

std::string dotted(const Node* node) {
  if (node == nullptr) return "";
  if (node->is(Kind::Name)) return std::string(node->text);
  if (!node->is(Kind::Member)) return "";
  const std::string object = dotted(node->kids[0]);
  return object.empty() ? "" : object + "." + std::string(node->kids[1]->text);
}

View stringText(const Node& node) {
  return node.text.size() < 2 ? View() : node.text.substr(1, node.text.size() - 2);
}

const Node* bare(const Node* node) {
  while (node != nullptr && node->is(Kind::Brackets))
    node = node->kids.front();
  return node;
}

} // namespace dotek::frontend::fusion
