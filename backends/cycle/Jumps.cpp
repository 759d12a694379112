// Jumps of the source as the language has them: alarms where the jump to them is, loops that count.
#include "backends/cycle/Jumps.h"
#include "backends/cycle/Idioms.h"
#include "ir/Match.h"
#include "ir/Walk.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::backends::cycle {

namespace {

using Statements = std::vector<ir::CycleStatement>;

std::map<ir::LabelId, std::size_t> placesOf(const Statements& list) {
  std::map<ir::LabelId, std::size_t> out;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (const auto* label = std::get_if<ir::Label>(&list[i].node)) out[label->label] = i;
  return out;
}

std::optional<ir::LabelId> targetOf(const ir::CycleStatement& statement) {
  if (const auto* jump = std::get_if<ir::Jump>(&statement.node)) return jump->target;
  if (const auto* branch = std::get_if<ir::Branch>(&statement.node)) return branch->target;
  return std::nullopt;
}

bool endsThere(const ir::CycleStatement& statement) {
  return ir::match(
      statement, [](const ir::OneOf<ir::Jump, ir::Alarm, ir::Return> auto&) { return true; },
      [](const ir::OneOf<ir::Label, ir::Branch, ir::Store, ir::Move, ir::Measure, ir::CallCycle,
                         ir::ProbePower, ir::Comment, ir::Assign, ir::Spindle, ir::Coolant, ir::SetMode,
                         ir::Dwell, ir::Stop, ir::OpaqueBlock, ir::Port, ir::Print> auto&) { return false; });
}

// What no way leads to.
void dropUnreached(Statements& list) {
  for (std::size_t size = list.size() + 1; size != list.size();) {
    size = list.size();
    std::set<ir::LabelId> targets;
    for (const ir::CycleStatement& one : list)
      if (const auto target = targetOf(one)) targets.insert(*target);
    bool reached = true;
    std::erase_if(list, [&](const ir::CycleStatement& one) {
      const auto* label = std::get_if<ir::Label>(&one.node);
      reached = reached || (label != nullptr && targets.contains(label->label));
      const bool drop = !reached;
      if (reached && endsThere(one)) reached = false;
      return drop;
    });
  }
}

// IF A GOTO 1, IF B GOTO 2, N1 ..: one decision, `not A and B`, to go to 2.
void joinBranches(Statements& list) {
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i + 2 < list.size(); ++i) {
      const auto* first = std::get_if<ir::Branch>(&list[i].node);
      auto* second = std::get_if<ir::Branch>(&list[i + 1].node);
      if (first == nullptr || second == nullptr || first->target == second->target) continue;
      bool leads = false;
      for (std::size_t next = i + 2; next < list.size() && !leads; ++next) {
        const auto* label = std::get_if<ir::Label>(&list[next].node);
        if (label == nullptr) break;
        leads = label->label == first->target;
      }
      if (!leads) continue;
      second->condition = ir::join(ir::Connective::And, ir::negate(first->condition), second->condition,
                                   second->condition->range);
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
      again = true;
    }
  }
}

// IF A GOTO 61, .., N61 #3000=..: the alarm where the jump is.
void placeAlarms(State& state) {
  Statements& list = state.cycle.body;
  const auto places = placesOf(list);
  // The comments and the alarm that a jump to the label leads to; empty: it leads elsewhere.
  const auto alarmAt = [&](ir::LabelId label, std::size_t from) {
    Statements out;
    const auto place = places.find(label);
    for (std::size_t i = place == places.end() ? list.size() : place->second; i < list.size(); ++i) {
      if (i <= from) break;
      if (std::holds_alternative<ir::Label>(list[i].node)) continue;
      const bool alarm = std::holds_alternative<ir::Alarm>(list[i].node);
      if (!alarm && !std::holds_alternative<ir::Comment>(list[i].node)) break;
      out.push_back(list[i]);
      if (alarm) return out;
    }
    return Statements();
  };
  Statements placed;
  bool any = false;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto target = targetOf(list[i]);
    Statements alarm = target ? alarmAt(*target, i) : Statements();
    if (alarm.empty()) {
      placed.push_back(list[i]);
      continue;
    }
    any = true;
    const auto* branch = std::get_if<ir::Branch>(&list[i].node);
    const ir::LabelId after = branch == nullptr ? 0 : state.cycle.addLabel({"after_alarm", {}});
    if (branch != nullptr)
      placed.push_back({ir::Branch{ir::negate(branch->condition), after}, list[i].origin});
    std::move(alarm.begin(), alarm.end(), std::back_inserter(placed));
    if (branch != nullptr) placed.push_back({ir::Label{after}, list[i].origin});
  }
  if (!any) return;
  list = std::move(placed);
  dropUnreached(list);
}

// ---- loops

// The value without the operators around it that make 0 of null.
const ir::VariableUse* useOf(const ir::ExpressionPtr& value) {
  return std::get_if<ir::VariableUse>(&bare(value).node);
}

// The step of `variable = variable + step`.
std::optional<double> stepOf(const ir::Assign& set) {
  const auto* sum = std::get_if<ir::Binary>(&bare(set.value).node);
  if (sum == nullptr || (sum->op != ir::BinaryOp::Add && sum->op != ir::BinaryOp::Subtract))
    return std::nullopt;
  const auto* use = useOf(sum->left);
  const double* by = ir::constantValue(sum->right);
  if (use == nullptr || by == nullptr || use->variable != set.variable) return std::nullopt;
  return sum->op == ir::BinaryOp::Add ? *by : -*by;
}

class Counted {
public:
  Counted(const State& state, Loop& loop) : state_(state), list_(state.cycle.body), loop_(loop) {}

  // Finds the bound, and whether the counter counts and nothing else.
  void find() {
    const ir::ConditionPtr runs = ir::negate(std::get<ir::Branch>(list_[loop_.branch].node).condition);
    const auto* comparison = std::get_if<ir::Comparison>(&runs->node);
    const auto* use = comparison == nullptr ? nullptr : useOf(comparison->left);
    if (use == nullptr || state_.cycle.variable(use->variable).role != ir::Role::Local) return;
    counter_ = use->variable;
    const auto step = stepIn();
    const auto first = firstValue();
    if (!step || !first || *step == 0) return;
    const bool up = *step > 0;
    const bool less = comparison->relation == ir::Relation::Less;
    const bool lessEqual = comparison->relation == ir::Relation::LessEqual;
    const bool greater = comparison->relation == ir::Relation::Greater;
    const bool greaterEqual = comparison->relation == ir::Relation::GreaterEqual;
    if (up ? !less && !lessEqual : !greater && !greaterEqual) return;
    if (const double* limit = ir::constantValue(comparison->right)) {
      const double runsExactly = (*limit - *first) / *step;
      const double count = less || greater ? std::ceil(runsExactly) : std::floor(runsExactly) + 1;
      if (count < 1 || count > kMost) return;
      loop_.most = fmt::format("{}", static_cast<int>(count));
      if (readElsewhere()) return;
      loop_.onlyCounts = true;
      loop_.dropped = {increment_, *start_};
      return;
    }
    // A parameter says how often.
    const auto* limit = useOf(comparison->right);
    const bool given = limit != nullptr && state_.cycle.variable(limit->variable).role == ir::Role::Parameter;
    if (!given || *step != 1 || *first != std::floor(*first)) return;
    loop_.mostOf = limit->variable;
    loop_.mostPlus = (lessEqual ? 1 : 0) - *first;
  }

private:
  static constexpr double kMost = 10'000;

  bool sets(std::size_t at) const {
    const auto* set = std::get_if<ir::Assign>(&list_[at].node);
    return set != nullptr && set->variable == counter_;
  }

  // The loop sets it once, in each run.
  std::optional<double> stepIn() {
    std::optional<double> out;
    std::set<ir::LabelId> open; // branches that lead past where we are
    for (std::size_t i = loop_.branch + 1; i < loop_.back; ++i) {
      if (const auto* label = std::get_if<ir::Label>(&list_[i].node)) open.erase(label->label);
      if (const auto target = targetOf(list_[i])) open.insert(*target);
      if (!sets(i)) continue;
      if (out || !open.empty()) return std::nullopt;
      out = stepOf(std::get<ir::Assign>(list_[i].node));
      if (!out) return std::nullopt;
      increment_ = i;
    }
    return out;
  }

  // What it is where the loop begins.
  std::optional<double> firstValue() {
    for (std::size_t i = loop_.label; i-- > 0;) {
      if (std::holds_alternative<ir::Label>(list_[i].node) || targetOf(list_[i])) return std::nullopt;
      if (!sets(i)) continue;
      const double* value = ir::constantValue(std::get<ir::Assign>(list_[i].node).value);
      start_ = i;
      return value == nullptr ? std::nullopt : std::optional(*value);
    }
    return std::nullopt;
  }

  bool readElsewhere() const {
    for (std::size_t i = 0; i < list_.size(); ++i) {
      if (i == loop_.branch || i == increment_ || i == *start_) continue;
      bool reads = sets(i);
      ir::eachNode(list_[i], [&](const ir::Expression& node) {
        const auto* use = std::get_if<ir::VariableUse>(&node.node);
        reads = reads || (use != nullptr && use->variable == counter_);
      });
      if (reads) return true;
    }
    return false;
  }

  const State& state_;
  const Statements& list_;
  Loop& loop_;
  ir::VariableId counter_ = 0;
  std::size_t increment_ = 0;
  std::optional<std::size_t> start_;
};

} // namespace

void straightenJumps(State& state) {
  joinBranches(state.cycle.body);
  placeAlarms(state);
}

std::set<ir::LabelId> loopLabels(const std::vector<ir::CycleStatement>& list) {
  const auto places = placesOf(list);
  std::set<ir::LabelId> out;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (const auto target = targetOf(list[i]))
      if (const auto place = places.find(*target); place != places.end() && place->second <= i)
        out.insert(*target);
  return out;
}

std::optional<Loop> loopAt(const State& state, std::size_t label) {
  const Statements& list = state.cycle.body;
  Loop out;
  out.label = label;
  const ir::LabelId id = std::get<ir::Label>(list[label].node).label;
  for (std::size_t i = label + 1; i < list.size(); ++i) {
    const auto target = targetOf(list[i]);
    if (!target || *target != id) continue;
    if (out.back != 0 || !std::holds_alternative<ir::Jump>(list[i].node)) return std::nullopt;
    out.back = i;
  }
  out.branch = label + 1;
  const auto* exit = out.back == 0 ? nullptr : std::get_if<ir::Branch>(&list[out.branch].node);
  if (exit == nullptr) return std::nullopt;
  const auto places = placesOf(list);
  const std::size_t to = places.at(exit->target);
  if (to <= out.back || to > out.back + 1) return std::nullopt;
  // Nothing else leads into the loop, or out of it.
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto target = targetOf(list[i]);
    if (!target || i == out.back || i == out.branch) continue;
    const bool from = i > out.label && i < out.back;
    const std::size_t place = places.at(*target);
    const bool into = place >= out.label && place <= out.back;
    if (from != into) return std::nullopt;
  }
  out.after = to;
  Counted(state, out).find();
  return out;
}

} // namespace dotek::backends::cycle
