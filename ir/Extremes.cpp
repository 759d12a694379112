#include "ir/Extremes.h"

#include "ir/Walk.h"

namespace dotek::ir {
namespace {

constexpr std::size_t kMostStores = 4;

ExpressionPtr plain(ExpressionPtr value) {
  for (const Unary* node = value == nullptr ? nullptr : std::get_if<Unary>(&value->node);
       node != nullptr && node->op == UnaryOp::NullAsZero;
       node = value == nullptr ? nullptr : std::get_if<Unary>(&value->node))
    value = ExpressionPtr(node->operand);
  return value;
}

bool isVariable(const ExpressionPtr& value, const ExpressionPtr& number) {
  const auto* variable = value == nullptr ? nullptr : std::get_if<MachineVariable>(&value->node);
  return variable != nullptr && equal(plain(variable->number), plain(number));
}

bool reads(const ExpressionPtr& tree, const ExpressionPtr& number) {
  bool out = false;
  eachNode(tree, [&](const Expression& node) {
    const auto* variable = std::get_if<MachineVariable>(&node.node);
    out = out || (variable != nullptr && equal(plain(variable->number), plain(number)));
  });
  return out;
}

// They read a variable in common.
bool share(const ExpressionPtr& a, const ExpressionPtr& b) {
  bool out = false;
  eachNode(a, [&](const Expression& node) {
    const auto* variable = std::get_if<MachineVariable>(&node.node);
    out = out || (variable != nullptr && reads(b, variable->number));
  });
  return out;
}

// One side of the comparison is put into the variable that is the other one.
bool keeps(const Store& store, const Comparison& comparison) {
  const ExpressionPtr left = plain(comparison.left), right = plain(comparison.right);
  const ExpressionPtr value = plain(store.value);
  const auto puts = [&](const ExpressionPtr& into, const ExpressionPtr& from) {
    return isVariable(into, store.number) && (equal(value, from) || share(value, from));
  };
  return puts(left, right) || puts(right, left);
}

const Comparison* inequality(const ConditionPtr& condition) {
  const Condition* at = condition.get();
  while (at != nullptr && std::holds_alternative<Not>(at->node))
    at = std::get<Not>(at->node).inner.get();
  const auto* node = at == nullptr ? nullptr : std::get_if<Comparison>(&at->node);
  if (node == nullptr) return nullptr;
  switch (node->relation) {
  case Relation::Less:
  case Relation::Greater:
  case Relation::LessEqual:
  case Relation::GreaterEqual: return node;
  case Relation::Equal:
  case Relation::NotEqual:
  case Relation::Same:
  case Relation::Different: break;
  }
  return nullptr;
}

// From `from` on there are stores alone, up to the label; one of them keeps a side.
bool storesUpTo(const std::vector<ProgramStatement>& body, std::size_t from, LabelId label,
                const Comparison& comparison) {
  bool kept = false;
  std::size_t stores = 0;
  for (std::size_t i = from; i < body.size(); ++i) {
    if (const auto* here = std::get_if<Label>(&body[i].node)) return here->label == label && kept;
    if (std::holds_alternative<Comment>(body[i].node)) continue;
    const auto* store = std::get_if<Store>(&body[i].node);
    if (store == nullptr || ++stores > kMostStores) return false;
    if (keeps(*store, comparison))
      kept = true;
    else if (constantValue(store->value) != nullptr)
      return false;
  }
  return false;
}

} // namespace

bool keepsExtreme(const std::vector<ProgramStatement>& body, std::size_t at) {
  const auto* branch = std::get_if<Branch>(&body[at].node);
  const Comparison* comparison = branch == nullptr ? nullptr : inequality(branch->condition);
  if (comparison == nullptr || at + 2 >= body.size()) return false;
  if (storesUpTo(body, at + 1, branch->target, *comparison)) return true;
  // IF[..]GOTO1, GOTO2, N1 .., N2
  const auto* over = std::get_if<Jump>(&body[at + 1].node);
  const auto* here = std::get_if<Label>(&body[at + 2].node);
  return over != nullptr && here != nullptr && here->label == branch->target &&
         storesUpTo(body, at + 3, over->target, *comparison);
}

} // namespace dotek::ir
