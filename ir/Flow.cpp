#include "ir/Flow.h"

#include <algorithm>
#include <iterator>

namespace dotek::ir {
namespace {

std::uint8_t blockDeleteOf(const CycleStatement&) {
  return 0;
}
std::uint8_t blockDeleteOf(const ProgramStatement& statement) {
  return statement.blockDelete;
}

bool endsHere(const NcBlock& block) {
  return std::any_of(block.words.begin(), block.words.end(), [](const Word& word) {
    const double* code = word.address == 'M' ? constantValue(word.value) : nullptr;
    return code != nullptr && (*code == 30 || *code == 2);
  });
}

template <AnyStatement Statement> ProgramFlow flowIn(const std::vector<Statement>& list) {
  std::vector<std::size_t> places; // by label; a label is an index and appears once
  for (std::size_t i = 0; i < list.size(); ++i)
    if (const auto* label = std::get_if<Label>(&list[i].node)) {
      if (label->label >= places.size()) places.resize(label->label + std::size_t{1}, list.size());
      if (places[label->label] == list.size()) places[label->label] = i;
    }

  ProgramFlow flow;
  std::vector<Next>& out = flow.next;
  out.resize(list.size());
  if (std::any_of(list.begin(), list.end(), [](const Statement& each) { return isComputedJump(each); })) {
    std::copy_if(places.begin(), places.end(), std::back_inserter(flow.labels),
                 [&](std::size_t place) { return place < list.size(); });
    std::sort(flow.labels.begin(), flow.labels.end());
  }
  const auto jump = [&](std::size_t from, LabelId target) {
    if (target >= places.size() || places[target] == list.size()) return; // verify() tells
    out[from].add(places[target]);
  };
  for (std::size_t i = 0; i < list.size(); ++i) {
    match(
        list[i], [&](const Jump& node) { jump(i, node.target); },
        [&](const Branch& node) {
          out[i].add(i + 1);
          jump(i, node.target);
        },
        [&](const Loop& node) {
          out[i].add(i + 1);
          if (node.condition) jump(i, node.end);
        },
        [&](const LoopEnd& node) { jump(i, node.begin); },
        [&](const OneOf<Return, Exit> auto&) { out[i].add(list.size()); },
        [&](const NcBlock& block) { out[i].add(endsHere(block) ? list.size() : i + 1); },
        [](const OneOf<Alarm, Raise, JumpTo> auto&) {},
        [&](const OneOf<Label, Store, Move, Measure, CallCycle, ProbePower, Comment, Assign, Spindle, Coolant,
                        SetMode, Dwell, Stop, OpaqueBlock, Call, Notice, Port, Print, NameVariables> auto&) {
          out[i].add(i + 1);
        });
    // Block delete leaves a statement out.
    if (blockDeleteOf(list[i]) != 0) out[i].add(i + 1);
  }
  return flow;
}

template <AnyStatement Statement> std::optional<LabelId> targetIn(const Statement& statement) {
  return match(
      statement, [](const OneOf<Jump, Branch> auto& node) { return std::optional(node.target); },
      [](const OneOf<Label, Store, Move, Measure, CallCycle, ProbePower, Comment, Assign, Return, Spindle,
                     Coolant, SetMode, Dwell, Stop, Alarm, OpaqueBlock, NcBlock, JumpTo, Loop, LoopEnd, Call,
                     Exit, Raise, Notice, Port, Print, NameVariables> auto&) {
        return std::optional<LabelId>();
      });
}

template <AnyStatement Statement> bool layoutOnly(const Statement& statement) {
  return match(
      statement, [](const OneOf<Label, Comment> auto&) { return true; },
      [](const OneOf<Jump, Branch, Store, Move, Measure, CallCycle, ProbePower, Assign, Return, Spindle,
                     Coolant, SetMode, Dwell, Stop, Alarm, OpaqueBlock, NcBlock, JumpTo, Loop, LoopEnd, Call,
                     Exit, Raise, Notice, Port, Print, NameVariables> auto&) { return false; });
}

template <AnyStatement Statement>
std::vector<bool> reachableIn(const std::vector<Statement>& list, const ProgramFlow& flow) {
  bool computed = false; // a computed jump was reached
  std::vector<bool> seen(list.size());
  std::vector<std::size_t> open;
  const auto visit = [&](std::size_t at) {
    if (at >= list.size() || seen[at]) return;
    seen[at] = true;
    open.push_back(at);
  };
  visit(0);
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    for (const std::size_t to : flow.next[at])
      visit(to);
    if (computed || !isComputedJump(list[at])) continue;
    computed = true;
    for (const std::size_t label : flow.labels)
      visit(label);
  }
  return seen;
}

} // namespace

std::vector<std::vector<std::size_t>> successors(const std::vector<CycleStatement>& list) {
  const ProgramFlow flow = flowIn(list);
  std::vector<std::vector<std::size_t>> out;
  out.reserve(flow.next.size());
  for (const Next& next : flow.next)
    out.emplace_back(next.begin(), next.end());
  return out;
}

ProgramFlow flowOf(const std::vector<CycleStatement>& list) {
  return flowIn(list);
}

ProgramFlow flowOf(const std::vector<ProgramStatement>& list) {
  return flowIn(list);
}

bool isComputedJump(const CycleStatement&) {
  return false;
}

bool isComputedJump(const ProgramStatement& statement) {
  const auto* jump = std::get_if<JumpTo>(&statement.node);
  return jump != nullptr && jump->number != nullptr;
}

bool endsProgram(const CycleStatement&) {
  return false;
}

bool endsProgram(const ProgramStatement& statement) {
  const auto* block = std::get_if<NcBlock>(&statement.node);
  return block != nullptr && endsHere(*block);
}

std::optional<LabelId> targetOf(const CycleStatement& statement) {
  return targetIn(statement);
}

std::optional<LabelId> targetOf(const ProgramStatement& statement) {
  return targetIn(statement);
}

bool isLayout(const CycleStatement& statement) {
  return layoutOnly(statement);
}

bool isLayout(const ProgramStatement& statement) {
  return layoutOnly(statement);
}

std::vector<bool> reachable(const std::vector<CycleStatement>& list) {
  return reachableIn(list, flowIn(list));
}

std::vector<bool> reachable(const std::vector<ProgramStatement>& list) {
  return reachableIn(list, flowIn(list));
}

std::vector<bool> reachable(const std::vector<ProgramStatement>& list, const ProgramFlow& flow) {
  return reachableIn(list, flow);
}

std::vector<bool> leadingTo(std::vector<bool> goals, const ProgramFlow& flow) {
  std::vector<std::vector<std::size_t>> before(goals.size());
  for (std::size_t i = 0; i < flow.next.size(); ++i)
    for (const std::size_t to : flow.next[i])
      if (to < before.size()) before[to].push_back(i);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < goals.size(); ++i)
    if (goals[i]) open.push_back(i);
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    for (const std::size_t from : before[at]) {
      if (goals[from]) continue;
      goals[from] = true;
      open.push_back(from);
    }
  }
  return goals;
}

} // namespace dotek::ir
