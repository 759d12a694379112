#include "frontend/macrob/Format.h"

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

std::string bracketed(std::string text, std::uint32_t count) {
  return std::string(count, '[') + std::move(text) + std::string(count, ']');
}

std::string inner(const Expression& expression);

// With its own brackets, and one more pair where `needed` and there is none.
std::string text(const Expression& expression, bool needed = false) {
  const std::uint32_t count = expression.brackets > 0 ? expression.brackets : needed ? 1 : 0;
  return bracketed(inner(expression), count);
}

bool isSum(const Expression& expression) {
  const auto* operation = std::get_if<nc::Operation>(&expression.node);
  return operation != nullptr && levelOf(operation->op) == 1;
}

std::string inner(const Expression& expression) {
  return std::visit(
      [](const auto& node) -> std::string {
        using T = std::decay_t<decltype(node)>;
        if constexpr (std::is_same_v<T, nc::Number>) {
          return node.digits;
        } else if constexpr (std::is_same_v<T, nc::Hole>) {
          return "{" + node.name + "}";
        } else if constexpr (std::is_same_v<T, nc::VariableRef>) {
          const bool plain =
              std::holds_alternative<nc::Number>(node.number->node) && node.number->brackets == 0;
          return "#" + text(*node.number, !plain);
        } else if constexpr (std::is_same_v<T, nc::Negated>) {
          return "-" + text(*node.operand, std::holds_alternative<nc::Operation>(node.operand->node));
        } else if constexpr (std::is_same_v<T, nc::Operation>) {
          const bool product = levelOf(node.op) == 2;
          std::string right = text(*node.right, std::holds_alternative<nc::Operation>(node.right->node) &&
                                                    (product || isSum(*node.right)));
          const bool takesSlash = node.op == "/" && right.starts_with('[') && endsWithArcTangent(*node.left);
          std::string left = text(*node.left, (product && isSum(*node.left)) || takesSlash);
          return left + operatorText(node.op) + right;
        } else {
          if (node.bare) return node.name + text(*node.arguments.front());
          std::string out = node.name;
          if (node.comma) return out + "[" + text(*node.arguments[0]) + "," + text(*node.arguments[1]) + "]";
          for (std::size_t i = 0; i < node.arguments.size(); ++i)
            out += (i == 0 ? "[" : "/[") + text(*node.arguments[i]) + "]";
          return out;
        }
      },
      expression.node);
}

// What follows an address or GOTO: a number, a variable, or brackets; a minus before it.
std::string value(const Expression& expression) {
  if (const auto* negated = std::get_if<nc::Negated>(&expression.node);
      negated != nullptr && expression.brackets == 0)
    return "-" + value(*negated->operand);
  const bool plain = std::holds_alternative<nc::Number>(expression.node) ||
                     std::holds_alternative<nc::Hole>(expression.node) ||
                     std::holds_alternative<nc::VariableRef>(expression.node);
  return text(expression, !plain);
}

std::string conditionText(const Condition& condition, bool needed) {
  std::string out;
  if (const auto* comparison = std::get_if<Comparison>(&condition.node)) {
    out = text(*comparison->left) + " " + comparison->op + " " + text(*comparison->right);
  } else {
    const auto& joined = std::get<JoinedConditions>(condition.node);
    // Each comparison is in brackets; a join where the levels of AND and OR demand them.
    const auto side = [&](const Condition& one, int least) {
      const auto* join = std::get_if<JoinedConditions>(&one.node);
      return conditionText(one, join == nullptr || levelOf(join->op) < least);
    };
    const int level = levelOf(joined.op);
    out = side(*joined.left, level) + " " + joined.op + " " + side(*joined.right, level + 1);
  }
  return bracketed(std::move(out), condition.brackets > 0 ? condition.brackets : needed ? 1 : 0);
}

struct StatementText {
  std::string operator()(const std::monostate&) const { return ""; }
  std::string operator()(const Words&) const { return ""; } // printed word by word
  std::string operator()(const nc::Assignment& one) const {
    const bool plain = std::holds_alternative<nc::Number>(one.variable->node) && one.variable->brackets == 0;
    return "#" + text(*one.variable, !plain) + "=" + text(*one.value);
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
      add(word.address + (word.value == nullptr ? std::string() : value(*word.value)));
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
