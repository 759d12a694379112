// Numbers of variables, what is written, and places where a `#` is missing or stands at the wrong place.
#include "frontend/macrob/CheckParts.h"
#include "frontend/macrob/Format.h"
#include "frontend/macrob/Walk.h"
#include "support/messages/MacroB.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace dotek::frontend::macrob {
namespace {

constexpr std::uint32_t kLastLocal = 33;
constexpr std::uint32_t kFirstSystem = 1000;

// Bases of tables of tool offsets: they are read by `#[2000+#7]`, and hold nothing themselves.
bool isTableBase(std::uint32_t number) {
  return number == 2000 || number == 10000 || number == 11000 || number == 12000 || number == 13000;
}

// Zero points of work systems, on any control.
bool isWorkOffset(std::uint32_t number) {
  return (number >= 2500 && number <= 2899) || (number >= 5201 && number <= 5340) ||
         (number >= 7001 && number <= 7960) || (number >= 14001 && number <= 20000);
}

class VariableCheck {
public:
  VariableCheck(const Program& program, const CheckContext& context) : program_(program), context_(context) {}

  void run() {
    for (const Block& block : program_.blocks)
      collect(block);
    for (const Block& block : program_.blocks) {
      walk(block, [&](const Expression& expression, bool subscript) { expressionAt(expression, subscript); });
      if (const nc::Assignment* assignment = assignmentOf(block)) written(*assignment);
      if (const auto* words = std::get_if<Words>(&block.body)) wordsAt(*words);
    }
    overwritten();
  }

private:
  void collect(const Block& block) {
    walk(block, [&](const Expression& expression, bool) {
      if (const auto* variable = std::get_if<nc::VariableRef>(&expression.node)) {
        if (std::holds_alternative<nc::Operation>(variable->number->node))
          subscripts_.insert(printWithoutBrackets(*variable->number));
        if (const auto number = variableNumber(expression)) used_.insert(*number);
      }
      if (std::holds_alternative<nc::Operation>(expression.node))
        operations_.insert(printWithoutBrackets(expression));
    });
    if (const nc::Assignment* assignment = assignmentOf(block))
      if (std::holds_alternative<nc::Operation>(assignment->variable->node))
        subscripts_.insert(printWithoutBrackets(*assignment->variable));
    if (const auto* words = std::get_if<Words>(&block.body))
      for (const nc::Word& word : words->words)
        if (word.value != nullptr)
          if (const auto number = variableNumber(*word.value)) variableWords_.emplace(word.address, *number);
  }

  static std::string printWithoutBrackets(const Expression& expression) {
    std::string text = print(expression);
    return text.substr(expression.brackets, text.size() - 2 * expression.brackets);
  }

  void expressionAt(const Expression& expression, bool subscript) {
    if (const auto number = variableNumber(expression)) inRange(*number, expression.range);
    if (const auto* call = std::get_if<nc::FunctionCall>(&expression.node)) subscriptValue(*call);
    if (const auto* operation = std::get_if<nc::Operation>(&expression.node)) {
      tableBase(expression, *operation);
      if (!subscript) {
        missingHash(*operation, true);
        missingHash(*operation, false);
      }
    }
  }

  // ---- numbers

  void inRange(std::uint32_t number, SourceRange range) {
    const std::uint32_t locals = context_.control != nullptr ? context_.control->locals : kLastLocal;
    if (number <= locals || number >= kFirstSystem) return;
    const bool known = context_.control != nullptr
                           ? context_.control->isCommon(number)
                           : (number >= 100 && number <= 199) || (number >= 500 && number <= 999);
    if (known || !outOfRange_.insert(number).second) return;
    context_.report<diag::VariableOutOfRange>(
        range, number, context_.control != nullptr ? "this control" : "a Fanuc control");
  }

  void written(const nc::Assignment& assignment) {
    const auto* number = std::get_if<nc::Number>(&assignment.variable->node);
    if (number == nullptr) return;
    const SourceRange range{assignment.range.file, assignment.range.begin, assignment.variable->range.end};
    const auto n = static_cast<std::uint32_t>(number->value > 999999 ? 999999 : number->value);
    inRange(n, range);
    if (n == 0)
      context_.report<diag::NullWritten>(range);
    else if (context_.control != nullptr && context_.control->isReadOnly(n))
      context_.report<diag::ReadOnlyWritten>(range, n);
  }

  // ---- `#` at the wrong place

  // ABS[#13+#12] where the program has #[#13+#12]: the sum of two numbers of variables has no meaning.
  void subscriptValue(const nc::FunctionCall& call) {
    if (call.arguments.size() != 1 || call.bare) return;
    const Expression& argument = *call.arguments.front();
    const auto* sum = std::get_if<nc::Operation>(&argument.node);
    if (sum == nullptr || (sum->op != "+" && sum->op != "-") || !variableNumber(*sum->left) ||
        !variableNumber(*sum->right))
      return;
    const std::string text = printWithoutBrackets(argument);
    if (!subscripts_.contains(text)) return;
    const SourceRange range = argument.range;
    context_.report<diag::SubscriptAsValue>(range, text).fix =
        Fix{Fix::Applicability::Display,
            "write `#[" + text + "]`",
            {{{range.file, range.begin, range.begin}, "#["}, {{range.file, range.end, range.end}, "]"}}};
  }

  // [#2000+#7] for #[2000+#7]
  void tableBase(const Expression& expression, const nc::Operation& operation) {
    if (operation.op != "+" || expression.brackets == 0) return;
    const auto base = variableNumber(*operation.left);
    if (!base || !isTableBase(*base) || !std::holds_alternative<nc::VariableRef>(operation.right->node))
      return;
    const SourceRange hash{expression.range.file, operation.left->range.begin,
                           operation.left->range.begin + 1};
    const SourceRange open{expression.range.file, expression.range.begin, expression.range.begin};
    context_.report<diag::TableBaseRead>(operation.left->range, *base, print(*operation.right)).fix =
        Fix{Fix::Applicability::Display,
            fmt::format("write `#[{}+{}]`", *base, print(*operation.right)),
            {{open, "#"}, {hash, ""}}};
  }

  // 100*COS[#2] where the program has #100*COS[#2]
  void missingHash(const nc::Operation& operation, bool onLeft) {
    const Expression& side = onLeft ? *operation.left : *operation.right;
    const auto* number = std::get_if<nc::Number>(&side.node);
    if (number == nullptr || number->point || side.brackets > 0) return;
    if (!(number->value < 1e6) || !used_.contains(static_cast<std::uint32_t>(number->value))) return;
    const std::string variable = "#" + number->digits;
    const std::string op = operation.op.size() == 1 ? operation.op : " " + operation.op + " ";
    const std::string text =
        onLeft ? variable + op + print(*operation.right) : print(*operation.left) + op + variable;
    if (operations_.contains(text)) context_.report<diag::HashMissing>(side.range, number->digits, text);
  }

  // F9 where the program has F#9
  void wordsAt(const Words& words) {
    for (const nc::Word& word : words.words) {
      if (word.value == nullptr || ir::isAddressIn(ir::kWholeAddresses, word.address)) continue;
      const auto* number = std::get_if<nc::Number>(&word.value->node);
      if (number == nullptr || number->point || number->value < 1 || number->value > 999) continue;
      if (variableWords_.contains({word.address, static_cast<std::uint32_t>(number->value)}))
        context_.report<diag::HashMissing>(word.range, number->digits,
                                           fmt::format("{}#{}", word.address, number->digits));
    }
  }

  // ---- offsets

  // Two values for one zero point with nothing but assignments between them: the first is lost.
  void overwritten() {
    for (std::size_t i = 0; i < program_.blocks.size(); ++i) {
      const auto first = offsetWritten(program_.blocks[i]);
      if (!first) continue;
      for (std::size_t j = i + 1; j < program_.blocks.size() && j < i + 50; ++j) {
        const Block& block = program_.blocks[j];
        const bool comment = std::holds_alternative<std::monostate>(block.body) && !block.sequenceNumber;
        if (comment) continue;
        if (block.sequenceNumber || block.blockDelete || !std::holds_alternative<nc::Assignment>(block.body))
          break;
        const auto& assignment = std::get<nc::Assignment>(block.body);
        bool reads = false;
        walk(*assignment.value, [&](const Expression& expression, bool) {
          const auto* variable = std::get_if<nc::VariableRef>(&expression.node);
          reads = reads || variableNumber(expression) == first ||
                  (variable != nullptr && !std::holds_alternative<nc::Number>(variable->number->node));
        });
        if (reads) break;
        if (offsetWritten(block) != first) continue;
        const SourceRange range{assignment.range.file, assignment.range.begin,
                                assignment.variable->range.end};
        context_.report<diag::OffsetOverwritten>(range, *first)
            .note(std::get<nc::Assignment>(program_.blocks[i].body).range, "the value that is lost");
        break;
      }
    }
  }

  static std::optional<std::uint32_t> offsetWritten(const Block& block) {
    const auto* assignment = std::get_if<nc::Assignment>(&block.body);
    const auto* number =
        assignment == nullptr ? nullptr : std::get_if<nc::Number>(&assignment->variable->node);
    if (number == nullptr || number->value > 20000) return std::nullopt;
    const auto n = static_cast<std::uint32_t>(number->value);
    return isWorkOffset(n) ? std::optional(n) : std::nullopt;
  }

  const Program& program_;
  const CheckContext& context_;
  std::set<std::string> subscripts_; // expressions in #[..]
  std::set<std::string> operations_;
  std::set<std::uint32_t> used_;
  std::set<std::uint32_t> outOfRange_;
  std::set<std::pair<char, std::uint32_t>> variableWords_; // F#9
};

} // namespace

void checkVariables(const Program& program, const CheckContext& context) {
  VariableCheck(program, context).run();
}

} // namespace dotek::frontend::macrob
