#include "frontend/macrob/Format.h"

#include "frontend/macrob/BlockWords.h"

#include <fmt/format.h>

namespace dotek::frontend::macrob {
namespace {

int levelOf(const std::string& op) {
  return op == "*" || op == "/" || op == "AND" || op == "MOD" ? 2 : 1;
}

std::string operatorText(const std::string& op) {
  return op.size() == 1 ? op : " " + op + " ";
}

// ATAN with one operand at the end: a `/` and a bracket after it would become its second operand.
bool endsWithArcTangent(const Expression& expression) {
  if (expression.brackets > 0) return false;
  if (const auto* operation = std::get_if<nc::Operation>(&expression.node))
    return endsWithArcTangent(*operation->right);
  if (const auto* negated = std::get_if<nc::Negated>(&expression.node))
    return endsWithArcTangent(*negated->operand);
  const auto* call = std::get_if<nc::FunctionCall>(&expression.node);
  return call != nullptr && call->name == "ATAN" && !call->bare && call->arguments.size() == 1;
}

// Brackets around what is appended while it lives.
class Bracketed {
public:
  Bracketed(std::string& out, std::uint32_t count) : out_(out), count_(count) { out_.append(count_, '['); }
  ~Bracketed() { out_.append(count_, ']'); }
  Bracketed(const Bracketed&) = delete;
  Bracketed& operator=(const Bracketed&) = delete;

private:
  std::string& out_;
  std::uint32_t count_;
};

// Its own pairs of brackets, or one where `needed` and there is none.
std::uint32_t bracketsOf(const Expression& expression, bool needed) {
  return expression.brackets > 0 ? expression.brackets : needed ? 1 : 0;
}

bool isOperation(const Expression& expression) {
  return std::holds_alternative<nc::Operation>(expression.node);
}

bool isSum(const Expression& expression) {
  const auto* operation = std::get_if<nc::Operation>(&expression.node);
  return operation != nullptr && levelOf(operation->op) == 1;
}

// Appends, so that a long sum costs its length and not the square of it.
class ExpressionText {
public:
  explicit ExpressionText(std::string& out) : out_(out) {}

  void add(const Expression& expression, bool needed = false) {
    const Bracketed brackets(out_, bracketsOf(expression, needed));
    std::visit([this](const auto& node) { inner(node); }, expression.node);
  }

  // What follows an address or GOTO: a number, a variable, or brackets; a minus before it.
  void addValue(const Expression& expression) {
    if (const auto* negated = std::get_if<nc::Negated>(&expression.node);
        negated != nullptr && expression.brackets == 0) {
      out_ += '-';
      return addValue(*negated->operand);
    }
    const bool plain = std::holds_alternative<nc::Number>(expression.node) ||
                       std::holds_alternative<nc::Hole>(expression.node) ||
                       std::holds_alternative<nc::VariableRef>(expression.node);
    add(expression, !plain);
  }

  void addVariable(const Expression& number) {
    out_ += '#';
    add(number, number.brackets > 0 || !std::holds_alternative<nc::Number>(number.node));
  }

private:
  void inner(const nc::Number& node) { out_ += node.digits; }
  void inner(const nc::Hole& node) { out_ += "{" + node.name + "}"; }
  void inner(const nc::VariableRef& node) { addVariable(*node.number); }
  void inner(const nc::Negated& node) {
    out_ += '-';
    add(*node.operand, isOperation(*node.operand));
  }
  void inner(const nc::Operation& node) {
    const bool product = levelOf(node.op) == 2;
    const bool pair = isOperation(*node.right) && (product || isSum(*node.right));
    const bool takesSlash =
        node.op == "/" && bracketsOf(*node.right, pair) > 0 && endsWithArcTangent(*node.left);
    add(*node.left, (product && isSum(*node.left)) || takesSlash);
    out_ += operatorText(node.op);
    add(*node.right, pair);
  }
  void inner(const nc::FunctionCall& node) {
    out_ += node.name;
    if (node.bare) return add(*node.arguments.front());
    for (std::size_t i = 0; i < node.arguments.size(); ++i) {
      if (i == 0 || !node.comma) out_ += i == 0 ? "[" : "/[";
      if (i > 0 && node.comma) out_ += ',';
      add(*node.arguments[i]);
      if (!node.comma || i + 1 == node.arguments.size()) out_ += ']';
    }
  }

  std::string& out_;
};

std::string text(const Expression& expression) {
  std::string out;
  ExpressionText(out).add(expression);
  return out;
}

void addCondition(std::string& out, const Condition& condition, bool needed) {
  const Bracketed brackets(out, condition.brackets > 0 ? condition.brackets : needed ? 1 : 0);
  if (const auto* comparison = std::get_if<Comparison>(&condition.node)) {
    ExpressionText(out).add(*comparison->left);
    out += " " + comparison->op + " ";
    return ExpressionText(out).add(*comparison->right);
  }
  const auto& joined = std::get<JoinedConditions>(condition.node);
  // Each comparison is in brackets; a join where the levels of AND and OR demand them.
  const auto side = [&](const Condition& one, int least) {
    const auto* join = std::get_if<JoinedConditions>(&one.node);
    addCondition(out, one, join == nullptr || levelOf(join->op) < least);
  };
  const int level = levelOf(joined.op);
  side(*joined.left, level);
  out += " " + joined.op + " ";
  side(*joined.right, level + 1);
}

std::string conditionText(const Condition& condition, bool needed) {
  std::string out;
  addCondition(out, condition, needed);
  return out;
}

std::string value(const Expression& expression) {
  std::string out;
  ExpressionText(out).addValue(expression);
  return out;
}

struct StatementText {
  std::string operator()(const std::monostate&) const { return ""; }
  std::string operator()(const Words&) const { return ""; } // printed word by word
  std::string operator()(const nc::Assignment& one) const {
    std::string out;
    ExpressionText(out).addVariable(*one.variable);
    out += '=';
    ExpressionText(out).add(*one.value);
    return out;
  }
  std::string operator()(const Goto& one) const { return "GOTO " + value(*one.target); }
  std::string operator()(const If& one) const {
    const std::string then = std::visit(*this, one.statement);
    return "IF" + conditionText(*one.condition, true) + (one.then ? "THEN " : "") + then;
  }
  std::string operator()(const Do& one) const {
    const std::string loop = "DO" + (one.loop ? one.loop->digits : "");
    return one.condition ? "WHILE" + conditionText(*one.condition, true) + loop : loop;
  }
  std::string operator()(const End& one) const { return "END" + (one.loop ? one.loop->digits : ""); }
  std::string operator()(const Port& one) const { return one.open ? "POPEN" : "PCLOS"; }
  std::string operator()(const Print& one) const {
    std::string out = one.binary ? "BPRNT[" : "DPRNT[";
    for (const auto& piece : one.pieces) {
      if (const auto* plain = std::get_if<PrintedText>(&piece)) out += plain->text;
      if (const auto* variable = std::get_if<PrintedVariable>(&piece))
        out += fmt::format("#{}[{}]", variable->variable, variable->format);
    }
    return out + "]";
  }
  std::string operator()(const SetNames& one) const {
    std::string out = fmt::format("SETVN {}[", one.first);
    for (std::size_t i = 0; i < one.names.size(); ++i)
      out += (i == 0 ? "" : ",") + one.names[i];
    return out + "]";
  }
  std::string operator()(const Unread& one) const { return one.text; }
};

} // namespace

std::string print(const Expression& expression) {
  return text(expression);
}

std::string print(const Condition& condition) {
  return conditionText(condition, false);
}

std::string print(const Block& block) {
  std::string out;
  const auto add = [&](const std::string& part) {
    if (!out.empty() && out != "/") out += ' ';
    out += part;
  };
  if (block.blockDelete)
    out = block.blockDelete->number ? fmt::format("/{}", *block.blockDelete->number) : "/";
  if (block.sequenceNumber) add("N" + block.sequenceNumber->digits);
  std::size_t next = 0; // comment
  const auto comments = [&](std::uint32_t upTo) {
    for (; next < block.comments.size() && block.comments[next].place <= upTo; ++next)
      out += "(" + block.comments[next].text + ")";
  };
  comments(0);
  if (const auto* words = std::get_if<Words>(&block.body)) {
    std::uint32_t printed = 0;
    for (const nc::Word& word : words->words) {
      add(addressText(word.address) + (word.value == nullptr ? std::string() : value(*word.value)));
      comments(++printed);
    }
  } else if (!std::holds_alternative<std::monostate>(block.body)) {
    add(std::visit(StatementText{}, block.body));
  }
  comments(UINT32_MAX);
  return out;
}

std::optional<std::string> format(const File& file, const SourceMap& sources) {
  if (file.hasErrors || !file.legends.empty()) return std::nullopt;
  std::string out;
  if (file.leader.begin < file.leader.end) out = std::string(sources.text(file.leader)) + "\n";
  if (file.markFirst) out += "%\n";
  for (const Program& program : file.programs) {
    if (program.name) {
      switch (program.name->kind) {
      case ProgramName::Kind::Number: out += "O" + program.name->text; break;
      case ProgramName::Kind::Colon: out += ":" + program.name->text; break;
      case ProgramName::Kind::Name: out += "<" + program.name->text + ">"; break;
      }
      for (const Comment& comment : program.comments)
        out += "(" + comment.text + ")";
      out += "\n";
    }
    for (const Block& block : program.blocks)
      out += print(block) + "\n";
  }
  if (file.markLast) out += "%\n";
  return out;
}

} // namespace dotek::frontend::macrob
