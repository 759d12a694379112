// Touches have a way, and those in z lead downward: proved, refused, or an alarm where the values decide.
#include "frontend/cycle/Lowering.h"
#include "ir/Fold.h"
#include "ir/Walk.h"
#include "support/messages/Cycle.h"

#include <algorithm>

namespace dotek::frontend::cycle {
namespace {

constexpr const char* kAlarm = "touch leads upward";

// A sum, with its terms as they are written.
struct Sum {
  struct Term {
    ir::ExpressionPtr value;
    double factor = 0;
  };
  std::vector<Term> terms;
  double constant = 0;

  void add(const ir::ExpressionPtr& value, double factor) {
    const auto same = std::find_if(terms.begin(), terms.end(),
                                   [&](const Term& one) { return ir::equal(one.value, value); });
    if (same == terms.end())
      terms.push_back({value, factor});
    else
      same->factor += factor;
  }
};

} // namespace

// What only the caller gives, and what the cycle computes once of that alone.
bool Lowering::isOfCaller(const ir::ExpressionPtr& expression) const {
  bool out = true;
  ir::eachNode(expression, [&](const ir::Expression& node) {
    if (std::holds_alternative<ir::MeasuredResult>(node.node) ||
        std::holds_alternative<ir::MachineVariable>(node.node))
      out = false;
    if (const auto* use = std::get_if<ir::VariableUse>(&node.node))
      out =
          out && (cycle_.variable(use->variable).role != ir::Role::Local || lasting_.contains(use->variable));
  });
  return out;
}

Lowering::Sign Lowering::signOfDifference(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) const {
  Sum sum;
  const auto take = [&](const auto& self, const ir::ExpressionPtr& value, double factor) -> void {
    if (const double* known = ir::constantValue(value)) {
      sum.constant += factor * *known;
      return;
    }
    if (const auto* use = std::get_if<ir::VariableUse>(&value->node))
      if (const auto once = lasting_.find(use->variable); once != lasting_.end())
        return self(self, once->second, factor);
    if (const auto* one = std::get_if<ir::Unary>(&value->node);
        one != nullptr && one->op == ir::UnaryOp::Negate)
      return self(self, one->operand, -factor);
    if (const auto* both = std::get_if<ir::Binary>(&value->node)) {
      const double* left = ir::constantValue(both->left);
      if (both->op == ir::BinaryOp::Add || both->op == ir::BinaryOp::Subtract) {
        self(self, both->left, factor);
        return self(self, both->right, both->op == ir::BinaryOp::Add ? factor : -factor);
      }
      if (both->op == ir::BinaryOp::Multiply && left != nullptr)
        return self(self, both->right, factor * *left);
    }
    sum.add(value, factor);
  };
  take(take, a, 1);
  take(take, b, -1);
  Sign out{sum.constant >= 0, sum.constant <= 0};
  for (const Sum::Term& term : sum.terms) {
    if (term.factor == 0) continue;
    const Sign sign = signOf(term.value);
    out.above = out.above && (term.factor > 0 ? sign.above : sign.below);
    out.below = out.below && (term.factor > 0 ? sign.below : sign.above);
  }
  return out;
}

bool Lowering::leadsDownward(const Touch& touch, SourceRange range) {
  const auto check = [&](const ir::ExpressionPtr& low, const ir::ExpressionPtr& high) {
    const ir::LabelId fine = label("downward", range);
    emit(ir::Branch{ir::compare(ir::Relation::Less, low, high, range), fine}, range);
    emit(ir::Alarm{kAlarm}, range);
    place(fine, range);
  };
  if (touch.reach == Reach::To) {
    // Where the probe is then is known at the end: guards_ is resolved with the places.
    const ir::ExpressionPtr to = value(*touch.value);
    const ir::VariableId from = local("from_z", ir::Kind::Length, range);
    places_.emplace(from, ir::Axis::Z);
    guards_.insert(from);
    emit(ir::Assign{from, ir::constant(0, range)}, range);
    check(to, ir::variable(from, range));
    return true;
  }
  const std::size_t before = out_->size();
  const ir::ExpressionPtr way = value(*touch.value);
  const Sign sign = signOf(way);
  if (sign.above && !sign.below) {
    refuse<diag::TouchUpward>(range);
    return false;
  }
  if (sign.below || out_->size() != before) {
    if (sign.below)
      out_->resize(before);
    else
      check(way, ir::constant(0, range));
    return true;
  }
  // What the caller gives is asked for before anything moves.
  const bool first = nested_ == 0 && !called_ && isOfCaller(way);
  std::vector<ir::CycleStatement>* const list = out_;
  if (first) out_ = &cycle_.checks;
  check(way, ir::constant(0, range));
  out_ = list;
  if (const auto* use = std::get_if<ir::VariableUse>(&way->node);
      first && use != nullptr && cycle_.variable(use->variable).role == ir::Role::Parameter)
    signs_[use->variable].below = true;
  return true;
}

void Lowering::hasWay(const Touch& touch, SourceRange range) {
  const std::size_t before = out_->size();
  const ir::ExpressionPtr way = value(*touch.value);
  if (signOf(way).apart) {
    out_->resize(before);
    return;
  }
  const bool first = out_->size() == before && nested_ == 0 && !called_ && !scope_.inlined && isOfCaller(way);
  std::vector<ir::CycleStatement>* const list = out_;
  if (first) out_ = &cycle_.checks;
  const ir::LabelId fine = label("way", range);
  emit(ir::Branch{ir::compare(ir::Relation::NotEqual, way, ir::constant(0, range), range), fine}, range);
  emit(ir::Alarm{"touch has no way"}, range);
  place(fine, range);
  out_ = list;
  if (!first) ways_.insert(fine);
  if (const auto* use = std::get_if<ir::VariableUse>(&way->node);
      first && use != nullptr && cycle_.variable(use->variable).role == ir::Role::Parameter)
    signs_[use->variable].apart = true;
}

// The check before a touch to a coordinate, when the place is known from which it leads: four statements
// from `at`.
void Lowering::resolveGuard(std::vector<ir::CycleStatement>& list, std::size_t at,
                            const ir::ExpressionPtr& here, const std::function<void()>& unknown) {
  const SourceRange range = list[at].origin.range();
  if (here == nullptr) return unknown();
  auto& branch = std::get<ir::Branch>(list[at + 1].node);
  const ir::ExpressionPtr to = std::get<ir::Comparison>(branch.condition->node).left;
  const Sign sign = signOfDifference(to, here);
  if (sign.above && !sign.below) refuse<diag::TouchUpward>(range);
  if (sign.below) return;
  branch.condition = ir::compare(ir::Relation::Less, to, here, range);
  for (std::size_t i = at + 1; i <= at + 3; ++i)
    cycle_.body.push_back(std::move(list[i]));
}

} // namespace dotek::frontend::cycle
