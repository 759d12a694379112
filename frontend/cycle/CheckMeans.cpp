// Arithmetic of what was measured that can hardly be meant: means with another divisor than their number of
// values, two limits that no value meets, or that every one does. Warnings.
#include "frontend/cycle/Checker.h"
#include "support/Decimal.h"
#include "support/messages/Cycle.h"

#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace dotek::frontend::cycle {

namespace {

const Expression& within(const Expression& expression) {
  const auto* bracketed = std::get_if<Bracketed>(&expression.node);
  return bracketed == nullptr ? expression : within(*bracketed->inner);
}

// `NAME.at`: a measured coordinate.
bool isPlace(const Expression& expression) {
  const auto* member = std::get_if<Member>(&expression.node);
  return member != nullptr && member->object.text != "start" && member->object.text != "here" &&
         member->member.text == "at";
}

// How many measured coordinates the sum has; 0: it has something else.
int placesIn(const Expression& sum) {
  const Expression& inner = within(sum);
  if (isPlace(inner)) return 1;
  const auto* binary = std::get_if<Binary>(&inner.node);
  if (binary == nullptr || binary->op != BinaryOp::Add) return 0;
  const int left = placesIn(*binary->left), right = placesIn(*binary->right);
  return left == 0 || right == 0 ? 0 : left + right;
}

const Binary* quotient(const Expression& expression) {
  const auto* binary = std::get_if<Binary>(&expression.node);
  return binary != nullptr && binary->op == BinaryOp::Divide ? binary : nullptr;
}

std::string nameUsed(const Expression& expression) {
  const auto* use = std::get_if<NameUse>(&within(expression).node);
  return use == nullptr ? "" : use->name;
}

struct Limit {
  double value = 0;
  bool above = false; // what is compared has to be above it
};

} // namespace

// `(a.at + b.at) / 3`, `a.at + b.at / 2`.
void Checker::meanOf(const Expression& expression) {
  if (const Binary* mean = quotient(expression)) {
    const int count = placesIn(*mean->left);
    const std::optional<double> by = constant(mean->right);
    // (a + b) / 4 is half of a mean; a number of values is a whole one near theirs.
    if (count < 2 || !by || *by != std::floor(*by) || *by < 2 || *by == count) return;
    if (*by != count - 1 && *by != count + 1) return;
    diagnostics_.report<diag::MeanDivisor>(
        expression.range, fmt::format("a sum of {} measured values", count), numberText(*by), count, count,
        fmt::format("{} / {}", text(mean->left->range), count));
    return;
  }
  const auto* sum = std::get_if<Binary>(&expression.node);
  const Binary* last = sum == nullptr || sum->op != BinaryOp::Add ? nullptr : quotient(*sum->right);
  if (last == nullptr || !isPlace(*last->left)) return;
  const int count = placesIn(*sum->left) + 1;
  const std::optional<double> by = constant(last->right);
  if (count < 2 || !by || *by != count) return;
  diagnostics_.report<diag::MeanDivisor>(
      expression.range, fmt::format("`{}` alone", text(last->left->range)), numberText(*by), count, count,
      fmt::format("({} + {}) / {}", text(sum->left->range), text(last->left->range), count));
}

// `error > 0.05 mm and error < -0.05 mm`: none; with `or` and the signs turned: all.
void Checker::bothLimits(const Expression& expression) {
  const auto* join = std::get_if<Binary>(&expression.node);
  if (join == nullptr || (join->op != BinaryOp::And && join->op != BinaryOp::Or)) return;
  std::string of;
  const auto limit = [&](const Expression& side) -> std::optional<Limit> {
    const auto* one = std::get_if<Binary>(&within(side).node);
    if (one == nullptr) return std::nullopt;
    const bool greater = one->op == BinaryOp::Greater || one->op == BinaryOp::GreaterEqual;
    const bool less = one->op == BinaryOp::Less || one->op == BinaryOp::LessEqual;
    const bool turned = constant(one->left).has_value();
    const std::optional<double> value = constant(turned ? one->left : one->right);
    const std::string what = text((turned ? one->right : one->left)->range);
    if ((!greater && !less) || !value || (!of.empty() && of != what)) return std::nullopt;
    of = what;
    return Limit{*value, greater != turned};
  };
  const std::optional<Limit> first = limit(*join->left);
  const std::optional<Limit> second = first ? limit(*join->right) : std::nullopt;
  if (!second || first->above == second->above) return;
  const double above = first->above ? first->value : second->value;
  const double below = first->above ? second->value : first->value;
  const bool all = join->op == BinaryOp::And;
  if (all ? above <= below : above >= below) return;
  diagnostics_.report<diag::ComparedAlways>(
      expression.range, text(expression.range), all ? "false" : "true",
      all ? fmt::format("no `{}` is beyond both limits; write `or`", of)
          : fmt::format("each `{}` is within one of the limits; write `and`", of));
}

// sum = 0, five times sum = sum + .., sum / 4.
void Checker::means(const Block& block) {
  std::map<std::string, int> runs; // by name: how many values its loop adds
  std::set<std::string> other;     // names that get something else
  const auto added = [](const Assign& assign) {
    const auto* sum = std::get_if<Binary>(&within(*assign.value).node);
    return sum != nullptr && sum->op == BinaryOp::Add && nameUsed(*sum->left) == assign.name.text;
  };
  const auto loop = [&](const Block& body, std::optional<double> count) {
    for (const Statement& one : body.statements) {
      const auto* assign = std::get_if<Assign>(&one.node);
      if (assign == nullptr) continue;
      if (!count || !added(*assign) || !runs.emplace(assign->name.text, static_cast<int>(*count)).second)
        other.insert(assign->name.text);
    }
  };
  const auto countOf = [](const For& one) -> std::optional<double> {
    const std::optional<double> from = constant(one.first), to = constant(one.last);
    if (!from || !to || one.step != nullptr || *to < *from) return std::nullopt;
    return *to - *from + 1;
  };
  for (const Statement& one : block.statements) {
    if (const auto* repeat = std::get_if<Repeat>(&one.node)) loop(repeat->body, constant(repeat->count));
    if (const auto* counted = std::get_if<For>(&one.node)) loop(counted->body, countOf(*counted));
    const auto* assign = std::get_if<Assign>(&one.node);
    if (assign == nullptr) continue;
    const std::optional<double> zero = constant(assign->value);
    if (!zero || *zero != 0 || runs.contains(assign->name.text)) other.insert(assign->name.text);
    const Binary* mean = quotient(within(*assign->value));
    const std::string of = mean == nullptr ? "" : nameUsed(*mean->left);
    const auto known = runs.find(of);
    const std::optional<double> by = mean == nullptr ? std::nullopt : constant(mean->right);
    if (known == runs.end() || other.contains(of) || !by || known->second < 2) continue;
    if (*by != known->second - 1 && *by != known->second + 1) continue;
    diagnostics_.report<diag::MeanDivisor>(
        assign->value->range, fmt::format("`{}`, a sum of {} values,", of, known->second), numberText(*by),
        known->second, known->second, fmt::format("{} / {}", of, known->second));
  }
}

} // namespace dotek::frontend::cycle
