#include "frontend/gibbs/LowerAsked.h"

#include "frontend/gibbs/LowerTerms.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

void AskedBounds::finish() {
  std::sort(asked_.begin(), asked_.end());
  // Of equal bounds the last one has the last step.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < asked_.size(); ++i)
    if (i + 1 == asked_.size() || asked_[i].first != asked_[i + 1].first) asked_[kept++] = asked_[i];
  asked_.resize(kept);
  while (leaves_ < kept)
    leaves_ *= 2;
  latest_.assign(2 * leaves_, 0);
  for (std::size_t i = 0; i < kept; ++i)
    latest_[leaves_ + i] = asked_[i].second + 1;
  for (std::size_t i = leaves_; i-- > 1;)
    latest_[i] = std::max(latest_[2 * i], latest_[2 * i + 1]);
}

std::size_t AskedBounds::below(double value, bool itself) const {
  const auto less = [](const auto& asked, double bound) { return asked.first < bound; };
  auto at = std::lower_bound(asked_.begin(), asked_.end(), value, less);
  if (itself && at != asked_.end() && at->first == value) ++at;
  return static_cast<std::size_t>(at - asked_.begin());
}

// 0 below all bounds; of the bound i itself 2 i + 1, above it 2 i + 2.
std::uint32_t AskedBounds::part(std::size_t count, std::optional<double> value, std::size_t from) const {
  if (count == 0) return 0;
  // The last of the first `count` leaves that is above `from`: up as long as there is none, then down.
  std::size_t at = leaves_ + count - 1;
  while (latest_[at] <= from) {
    while (at > 1 && at % 2 == 0)
      at /= 2;
    if (at <= 1) return 0;
    --at;
  }
  while (at < leaves_)
    at = latest_[2 * at + 1] > from ? 2 * at + 1 : 2 * at;
  const std::size_t found = at - leaves_;
  const bool itself = value && asked_[found].first == *value;
  return static_cast<std::uint32_t>(2 * found + (itself ? 1 : 2));
}

std::uint32_t AskedBounds::lowestOf(const Range& range, std::size_t from) const {
  if (!range.low()) return 0;
  return range.isLowOpen() ? part(below(*range.low(), true), std::nullopt, from) : partOf(*range.low(), from);
}

std::uint32_t AskedBounds::highestOf(const Range& range, std::size_t from) const {
  if (!range.high()) return last(from);
  return range.isHighOpen() ? part(below(*range.high(), false), std::nullopt, from)
                            : partOf(*range.high(), from);
}

bool AskedBounds::isAsked(double bound, std::size_t from) const {
  const std::size_t at = below(bound, false);
  return at < asked_.size() && asked_[at].first == bound && asked_[at].second >= from;
}

// ---- all of them ----------------------------------------------------------------------------------------

Asked::Asked(const Flat& flat, const std::vector<bool>& constant, const QuestionOf& questionOf)
    : constant_(constant), otherwise_(constant.size(), 0), variables_(constant.size()) {
  findFrom(flat);
  for (std::size_t at = 0; at < flat.steps.size(); ++at) {
    const auto& step = flat.steps[at].step;
    if (const auto* branch = std::get_if<FlatBranch>(&step)) condition(branch->condition, at, questionOf);
    if (const auto* assign = std::get_if<FlatAssign>(&step)) others(assign->value, at);
    if (const auto* end = std::get_if<FlatReturn>(&step)) variables_[end->code].add(0, at);
    if (const auto* move = std::get_if<FlatMove>(&step)) {
      for (const ir::ExpressionPtr& axis : move->axes)
        others(axis, at);
    }
  }
  for (AskedBounds& bounds : variables_)
    bounds.finish();
  for (auto& [key, bounds] : quantities_)
    bounds.finish();
}

// Only a jump upwards leads to an earlier step.
void Asked::findFrom(const Flat& flat) {
  const std::size_t size = flat.steps.size();
  std::vector<std::pair<std::size_t, std::size_t>> circles; // first and last step
  for (std::size_t at = 0; at < size; ++at) {
    const auto* jump = std::get_if<FlatJump>(&flat.steps[at].step);
    const auto* branch = std::get_if<FlatBranch>(&flat.steps[at].step);
    if (jump == nullptr && branch == nullptr) continue;
    const std::size_t target = jump != nullptr ? jump->target : branch->target;
    if (target <= at) circles.emplace_back(target, at);
  }
  std::sort(circles.begin(), circles.end());
  std::size_t first = 0, end = 0; // of circles that overlap
  auto next = circles.begin();
  for (std::size_t at = 0; at < size; ++at) {
    for (; next != circles.end() && next->first == at; ++next) {
      if (at >= end) first = at;
      end = std::max(end, next->second + 1);
    }
    from_.push_back(at < end ? first : at);
  }
}

template <class Node> void Asked::others(const Node& node, std::size_t step) {
  std::set<ir::VariableId> read;
  collectVariables(node, read);
  for (const ir::VariableId id : read)
    otherwise_[id] = step + 1;
}

void Asked::condition(const ir::ConditionPtr& condition, std::size_t step, const QuestionOf& questionOf) {
  if (const auto* one = std::get_if<ir::Comparison>(&condition->node)) comparison(*one, step, questionOf);
  if (const auto* inverted = std::get_if<ir::Not>(&condition->node))
    this->condition(inverted->inner, step, questionOf);
  if (const auto* junction = std::get_if<ir::Junction>(&condition->node)) {
    this->condition(junction->left, step, questionOf);
    this->condition(junction->right, step, questionOf);
  }
}

void Asked::comparison(const ir::Comparison& comparison, std::size_t step, const QuestionOf& questionOf) {
  const auto* left = std::get_if<ir::VariableUse>(&comparison.left->node);
  const auto* right = std::get_if<ir::VariableUse>(&comparison.right->node);
  const double* before = ir::constantValue(comparison.left);
  const double* after = ir::constantValue(comparison.right);
  if (left != nullptr && after != nullptr && !constant_[left->variable])
    return variables_[left->variable].add(*after, step);
  if (right != nullptr && before != nullptr && !constant_[right->variable])
    return variables_[right->variable].add(*before, step);
  if (const auto question = questionOf(comparison)) {
    quantities_[question->key].add(question->bound, step);
    return;
  }
  others(comparison.left, step);
  others(comparison.right, step);
}

const AskedBounds* Asked::ofVariable(ir::VariableId variable, std::size_t from) const {
  return otherwise_[variable] > from ? nullptr : &variables_[variable];
}

const AskedBounds& Asked::ofQuantity(const std::string& key) const {
  static const AskedBounds kNone = [] {
    AskedBounds none;
    none.finish();
    return none;
  }();
  const auto found = quantities_.find(key);
  return found == quantities_.end() ? kNone : found->second;
}

} // namespace dotek::frontend::gibbs
