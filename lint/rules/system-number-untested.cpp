#include "ir/Walk.h"
#include "lint/AfterSkip.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kLastArgument = 26;
constexpr std::uint32_t kLastLocal = 33;
constexpr double kFirstSystem = 1000;
constexpr std::uint32_t kExternal = 5201; // and the following axes

// The value with all variables empty, which count as 0; nullopt: more than sums, products and negations.
std::optional<double> valueWhenEmpty(const ir::ExpressionPtr& value) {
  if (const double* constant = ir::constantValue(value)) return *constant;
  if (std::holds_alternative<ir::MachineVariable>(value->node)) return 0.0;
  if (const auto* unary = std::get_if<ir::Unary>(&value->node)) {
    const auto operand = valueWhenEmpty(unary->operand);
    if (!operand) return std::nullopt;
    if (unary->op == ir::UnaryOp::Negate) return -*operand;
    if (unary->op == ir::UnaryOp::NullAsZero || unary->op == ir::UnaryOp::AddPoint) return operand;
    if (unary->op == ir::UnaryOp::Truncate) return std::trunc(*operand);
    if (unary->op == ir::UnaryOp::Round) return std::round(*operand);
    return std::nullopt;
  }
  const auto* binary = std::get_if<ir::Binary>(&value->node);
  if (binary == nullptr) return std::nullopt;
  const auto left = valueWhenEmpty(binary->left), right = valueWhenEmpty(binary->right);
  if (!left || !right) return std::nullopt;
  if (binary->op == ir::BinaryOp::Add) return *left + *right;
  if (binary->op == ir::BinaryOp::Subtract) return *left - *right;
  if (binary->op == ir::BinaryOp::Multiply) return *left * *right;
  return std::nullopt;
}

// A number that the program computes: the arguments that it comes from, and what it is without them.
struct Number {
  std::set<std::uint32_t> arguments;
  std::optional<double> empty;
};

class Search {
public:
  Search(const NcProgram& nc, Report& report) : nc_(nc), report_(report) {}

  void run() {
    if (endsProgram(nc_.program)) return; // it gets no arguments
    // What decides anything has been looked at, wherever that is: loops and jumps run the text in other
    // orders.
    for (const ir::ProgramStatement& statement : nc_.program.body)
      if (const ir::ConditionPtr* condition = ir::conditionOf(statement); condition != nullptr && *condition)
        ir::eachNode(*condition, [&](const ir::Expression& node) {
          if (const auto number = variableNumber(node)) tested_.insert(*number);
        });
    for (const ir::ProgramStatement& statement : nc_.program.body)
      step(statement);
  }

private:
  Number numberOf(const ir::ExpressionPtr& value) const {
    Number out;
    out.empty = valueWhenEmpty(value);
    ir::eachNode(value, [&](const ir::Expression& node) {
      if (!std::holds_alternative<ir::MachineVariable>(node.node)) return;
      const auto number = variableNumber(node);
      if (!number || *number > kLastLocal || tested_.contains(*number)) {
        out.empty.reset();
        return;
      }
      if (const auto found = computed_.find(*number); found != computed_.end()) {
        out.arguments.insert(found->second.arguments.begin(), found->second.arguments.end());
        const auto* asZero = std::get_if<ir::Unary>(&value->node);
        const ir::Expression& root = asZero != nullptr ? *asZero->operand : *value;
        const bool alone = std::holds_alternative<ir::MachineVariable>(root.node);
        out.empty = alone ? found->second.empty : std::nullopt;
      } else if (*number <= kLastArgument) {
        out.arguments.insert(*number);
      }
    });
    return out;
  }

  void step(const ir::ProgramStatement& statement) {
    if (const auto* store = std::get_if<ir::Store>(&statement.node)) {
      if (const auto number = storedNumber(statement)) {
        if (*number <= kLastLocal) computed_[*number] = numberOf(store->value);
      } else if (store->number != nullptr)
        judge(statement, numberOf(store->number), store->number->range, false);
    }
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr || !hasCode(*block, 'G', 10)) return;
    for (const ir::Word& word : block->words)
      if (word.address == 'P' && word.value != nullptr)
        judge(statement, numberOf(word.value), word.range, wordValue(*block, 'L') == 2.0);
  }

  void judge(const ir::ProgramStatement& statement, const Number& number, SourceRange range, bool system) {
    const bool data = std::holds_alternative<ir::NcBlock>(statement.node);
    if (number.arguments.empty()) return;
    // `#[100+#1]` fills a list of the program's own.
    if (!data && !(number.empty && *number.empty >= kFirstSystem)) return;
    const std::uint32_t argument = *number.arguments.begin();
    if (!told_.insert(argument).second) return;
    std::string then = "which entry is written is chance";
    const bool external =
        system ? number.empty == 0.0
               : !data && number.empty && *number.empty >= kExternal && *number.empty < kExternal + 6;
    if (external)
      then = "it writes the external offset, which moves all work systems";
    else if (!data)
      then = fmt::format("it writes #{}", static_cast<long long>(std::llround(*number.empty)));
    report_.at(range.hasPlace() ? range : statement.origin.range(),
               "which offset is written here comes from #{}, and nothing asks whether it was given or is in "
               "range; an empty one counts as 0, and {}; test it first and end in an alarm",
               argument, then);
  }

  const NcProgram& nc_;
  Report& report_;
  std::set<std::uint32_t> tested_;
  std::map<std::uint32_t, Number> computed_; // locals that the program has set
  std::set<std::uint32_t> told_;
};

void check(const NcProgram& nc, Report& report) {
  Search(nc, report).run();
}

} // namespace

DOTEK_LINT_RULE(system_number_untested){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
