#include "ir/Walk.h"
#include "lint/AfterSkip.h"
#include "lint/NcProgram.h"
#include "lint/Probing.h"

#include <array>
#include <functional>
#include <optional>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kLastLocal = 33;
constexpr std::uint32_t kFirstSystem = 1000;
constexpr double kMostTolerance = 1.0; // mm; a larger literal may be a limit of its own

bool isSystem(const ir::ExpressionPtr& expression) {
  const auto number = expression ? variableNumber(*expression) : std::nullopt;
  return number && *number >= kFirstSystem;
}

const ir::ExpressionPtr& bare(const ir::ExpressionPtr& expression) {
  const auto* unary = expression ? std::get_if<ir::Unary>(&expression->node) : nullptr;
  return unary != nullptr && unary->op == ir::UnaryOp::NullAsZero ? bare(unary->operand) : expression;
}

void eachComparison(const ir::ConditionPtr& condition,
                    const std::function<void(const ir::Comparison&, SourceRange)>& visit) {
  if (!condition) return;
  if (const auto* one = std::get_if<ir::Not>(&condition->node)) eachComparison(one->inner, visit);
  if (const auto* both = std::get_if<ir::Junction>(&condition->node)) {
    eachComparison(both->left, visit);
    eachComparison(both->right, visit);
  }
  if (const auto* comparison = std::get_if<ir::Comparison>(&condition->node))
    visit(*comparison, condition->range);
}

// What one program says of its variables.
struct Uses {
  std::set<std::uint32_t> measured; // hold a position that was read after a G31, or what is computed from one
  std::array<bool, kLastLocal + 1> computing{}; // are read elsewhere than in a comparison: no tolerance
  std::map<std::uint32_t, std::vector<const ir::Store*>> stores;
  std::vector<ir::ExpressionPtr> targets; // of G31
};

// A position is in it, or a variable that holds one.
bool isMeasured(const ir::ExpressionPtr& value, const Uses& uses) {
  bool out = false;
  ir::eachNode(value, [&](const ir::Expression& node) {
    const auto number =
        std::holds_alternative<ir::MachineVariable>(node.node) ? variableNumber(node) : std::nullopt;
    out = out || (number && (positionAxis(*number) || uses.measured.contains(*number)));
  });
  return out;
}

Uses usesOf(const NcProgram& nc) {
  Uses out;
  const auto& body = nc.program.body;
  bool skipped = false;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (const ir::NcBlock* skip = skipOf(body[i])) {
      skipped = true;
      for (const ir::Word& word : skip->words)
        if (word.address >= 'X' && word.address <= 'Z') out.targets.push_back(word.value);
    }
    const auto* store = std::get_if<ir::Store>(&body[i].node);
    const auto stored = storedNumber(body[i]);
    if (store != nullptr && stored && *stored < kFirstSystem) {
      out.stores[*stored].push_back(store);
      if (skipped && isMeasured(store->value, out)) out.measured.insert(*stored);
    }
    if (ir::conditionOf(body[i]) != nullptr) continue;
    for (const VariableRead& read : nc.reads(i))
      if (read.number <= kLastLocal) out.computing[read.number] = true;
  }
  return out;
}

// A difference of which one side was measured and the other is none of the control's own.
const ir::Binary* deviation(const ir::ExpressionPtr& value, const Uses& uses) {
  const auto* difference = value ? std::get_if<ir::Binary>(&value->node) : nullptr;
  if (difference == nullptr || difference->op != ir::BinaryOp::Subtract) return nullptr;
  const ir::ExpressionPtr &left = bare(difference->left), &right = bare(difference->right);
  if (ir::constantValue(left) != nullptr || ir::constantValue(right) != nullptr || isSystem(left) ||
      isSystem(right))
    return nullptr;
  for (const ir::ExpressionPtr& target : uses.targets) // whether the move came to its end
    if (target && (ir::equal(target, left) || ir::equal(target, right))) return nullptr;
  return isMeasured(left, uses) != isMeasured(right, uses) ? difference : nullptr;
}

// The value as a difference, or a variable that this program sets to one and to nothing else.
const ir::Binary* deviationOf(const ir::ExpressionPtr& value, const Uses& uses) {
  if (const ir::Binary* one = deviation(value, uses)) return one;
  const auto number = value ? variableNumber(*value) : std::nullopt;
  const auto found = number ? uses.stores.find(*number) : uses.stores.end();
  return found == uses.stores.end() || found->second.size() != 1
             ? nullptr
             : deviation(found->second.front()->value, uses);
}

bool isTolerance(const ir::ExpressionPtr& bound, const Uses& uses) {
  if (const double* value = ir::constantValue(bound)) return *value > 0 && *value <= kMostTolerance;
  const auto number = bound ? variableNumber(*bound) : std::nullopt;
  if (!number || *number == 0 || *number > kLastLocal || uses.computing[*number]) return false;
  const auto stores = uses.stores.find(*number);
  return stores == uses.stores.end() ||
         std::all_of(stores->second.begin(), stores->second.end(), [](const ir::Store* store) {
           const double* value = ir::constantValue(store->value);
           return value != nullptr && *value > 0;
         });
}

bool isDirected(ir::Relation relation) {
  return relation == ir::Relation::Less || relation == ir::Relation::LessEqual ||
         relation == ir::Relation::Greater || relation == ir::Relation::GreaterEqual;
}

// What runs from there on, without going two ways, ends in an alarm.
bool raisesFrom(const NcProgram& nc, std::size_t at) {
  constexpr int kMostSteps = 12;
  const auto& body = nc.program.body;
  for (int steps = 0; steps < kMostSteps && at < body.size(); ++steps) {
    if (std::holds_alternative<ir::Raise>(body[at].node)) return true;
    const ir::Next& next = nc.flow().next[at];
    if (next.size() != 1 || ir::isComputedJump(body[at])) return false;
    at = next[0];
  }
  return false;
}

// Whether the condition of the branch leads to an alarm where it holds; nothing: neither side is one.
std::optional<bool> raisesWhereTrue(const NcProgram& nc, std::size_t at) {
  const auto* branch = std::get_if<ir::Branch>(&nc.program.body[at].node);
  if (branch == nullptr) return std::nullopt;
  for (const std::size_t to : nc.flow().next[at])
    if (raisesFrom(nc, to)) return to != at + 1;
  return std::nullopt;
}

struct Test {
  const ir::Binary* of = nullptr;
  SourceRange range;
};

void check(const NcProgram& nc, Report& report) {
  const auto& body = nc.program.body;
  if (nc.skips().empty()) return;
  const Uses uses = usesOf(nc);
  std::vector<Test> tests;              // one side each
  std::vector<const ir::Binary*> other; // compared in another way: both sides, the other one
  // `atLeast`: the alarm comes where the value is below the bound, which is no tolerance then.
  const auto look = [&](const ir::ExpressionPtr& value, const ir::ExpressionPtr& bound, bool atLeast,
                        const SourceRange& range) {
    const ir::ExpressionPtr& one = bare(value);
    if (const ir::Binary* of = deviationOf(one, uses)) {
      if (!atLeast && isTolerance(bare(bound), uses))
        tests.push_back({of, range});
      else
        other.push_back(of);
      return;
    }
    ir::eachNode(one, [&](const ir::Expression& node) {
      const auto* unary = std::get_if<ir::Unary>(&node.node);
      if (unary == nullptr) return;
      if (const ir::Binary* of = deviationOf(bare(unary->operand), uses)) other.push_back(of);
    });
  };
  for (std::size_t i = 0; i < body.size(); ++i) {
    const ir::ConditionPtr* condition = ir::conditionOf(body[i]);
    if (condition == nullptr) continue;
    // Of a condition with AND or OR the side of one comparison is not looked for.
    const ir::Condition* alone = condition->get();
    bool turned = false;
    for (const ir::Not* inner = nullptr; alone != nullptr && (inner = std::get_if<ir::Not>(&alone->node));) {
      alone = inner->inner.get();
      turned = !turned;
    }
    std::optional<bool> raises;
    if (alone != nullptr && std::holds_alternative<ir::Comparison>(alone->node))
      raises = raisesWhereTrue(nc, i);
    if (raises && turned) raises = !*raises;
    eachComparison(*condition, [&](const ir::Comparison& comparison, SourceRange range) {
      if (!isDirected(comparison.relation)) return;
      const SourceRange place = range.hasPlace() ? range : body[i].origin.range();
      const ir::Relation alarm = raises == false ? ir::opposite(comparison.relation) : comparison.relation;
      const bool less = alarm == ir::Relation::Less || alarm == ir::Relation::LessEqual;
      look(comparison.left, comparison.right, raises && less, place);
      look(comparison.right, comparison.left, raises && !less, place);
    });
  }
  const auto same = [](const ir::Binary& a, const ir::Binary& b) {
    return (ir::equal(a.left, b.left) && ir::equal(a.right, b.right)) ||
           (ir::equal(a.left, b.right) && ir::equal(a.right, b.left));
  };
  for (std::size_t i = 0; i < tests.size(); ++i) {
    bool both = std::any_of(other.begin(), other.end(),
                            [&](const ir::Binary* one) { return same(*one, *tests[i].of); });
    for (std::size_t j = 0; j < tests.size(); ++j)
      both = both || (j != i && same(*tests[j].of, *tests[i].of));
    if (!both)
      report.at(tests[i].range,
                "only one side of this tolerance is tested: what was measured less what is expected has a "
                "sign, and each value below it passes, however far off; compare ABS[..], or test the other "
                "side too");
  }
}

} // namespace

DOTEK_LINT_RULE(tolerance_one_sided){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
