#include "lint/AskedVariables.h"

#include "ir/Extremes.h"
#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/OffsetStates.h"
#include "lint/Probing.h"

#include <algorithm>
#include <cmath>

namespace dotek::lint {
namespace {

constexpr double kFirstOfBuilder = 100; // G codes from here on may call a program

// The number of the program that the word calls on this control; 0: none.
std::uint32_t calledByCode(const ir::Word& word, const stdlib::Control* control) {
  const double* code = ir::constantValue(word.value);
  if (control == nullptr || code == nullptr) return 0;
  for (const stdlib::CallCode& call : control->callCodes)
    if (call.letter == word.address &&
        (call.letter == 'T' || (*code >= call.first && *code < call.first + call.count)))
      return call.letter == 'T' ? call.program
                                : call.program + static_cast<std::uint32_t>(*code) - call.first;
  return 0;
}

// A code that is in no profile: a builder's, which may call any program.
bool mayCallAny(const ir::Word& word, const Project& project) {
  const double* code = ir::constantValue(word.value);
  if (word.address != 'G' || (code != nullptr && !(*code >= kFirstOfBuilder && *code < 1e6))) return false;
  const auto known = [&](const stdlib::Control& control) {
    return control.find('G', static_cast<std::uint32_t>(std::lround(*code * 10))) != nullptr;
  };
  if (code != nullptr && project.control != nullptr) return !known(*project.control);
  return code == nullptr || std::none_of(project.controls.begin(), project.controls.end(), known);
}

struct Calls {
  std::set<std::uint32_t> numbers;
  bool any = false; // by a number that is computed, or a builder's code
};

Calls callsIn(const ir::Program& program, const Project& project) {
  Calls out;
  for (const ir::ProgramStatement& statement : program.body) {
    const auto called = calledProgram(statement);
    if (called) out.numbers.insert(*called);
    out.any = out.any || (callOf(statement) != nullptr && !called);
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    for (const ir::Word& word : block->words) {
      if (const std::uint32_t number = calledByCode(word, project.control); number != 0)
        out.numbers.insert(number);
      else
        out.any = out.any || mayCallAny(word, project);
    }
  }
  return out;
}

} // namespace

std::set<std::uint32_t> askedIn(const ir::Program& program) {
  std::set<std::uint32_t> out;
  const auto take = [&](const ir::Expression& node) {
    if (!std::holds_alternative<ir::MachineVariable>(node.node)) return;
    if (const auto number = variableNumber(node)) out.insert(*number);
  };
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    const ir::ProgramStatement& statement = program.body[i];
    const ir::ConditionPtr* condition = ir::conditionOf(statement);
    if (condition != nullptr && *condition && !ir::keepsExtreme(program.body, i))
      ir::eachNode(*condition, take);
    if (callOf(statement) != nullptr) ir::eachNode(statement, take);
  }
  return out;
}

Askers::Askers(const Project& project) {
  std::vector<const ir::Program*> all;
  std::vector<Calls> calls;
  std::map<std::uint64_t, std::vector<std::size_t>> numbered; // files may have programs of one number
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    numbered[program.number].push_back(all.size());
    all.push_back(&program);
    calls.push_back(callsIn(program, project));
  });
  std::vector<std::size_t> above(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    above[i] = i;
  const auto top = [&](std::size_t at) {
    for (; above[at] != at; at = above[at])
      above[at] = above[above[at]];
    return at;
  };
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const std::uint32_t number : calls[i].numbers)
      if (const auto found = numbered.find(number); found != numbered.end())
        for (const std::size_t callee : found->second)
          above[top(callee)] = top(i);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (calls[i].any) open_.insert(top(i));
  for (std::size_t i = 0; i < all.size(); ++i) {
    group_.emplace(all[i], top(i));
    for (const std::uint32_t number : askedIn(*all[i])) {
      Asked& asked = asked_[number];
      asked.all.add(*all[i]);
      asked.byGroup[top(i)].add(*all[i]);
      if (open_.contains(top(i))) asked.anywhere.add(*all[i]);
    }
  }
}

bool Askers::othersAsk(const ir::Program& program, std::uint32_t variable) const {
  const auto found = asked_.find(variable);
  if (found == asked_.end()) return false;
  const Asked& asked = found->second;
  if (asked.anywhere.hasOther(program)) return true;
  const auto group = group_.find(&program);
  if (group == group_.end()) return false;
  if (open_.contains(group->second)) return asked.all.hasOther(program);
  const auto here = asked.byGroup.find(group->second);
  return here != asked.byGroup.end() && here->second.hasOther(program);
}

} // namespace dotek::lint
