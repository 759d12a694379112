#include "ir/Walk.h"
#include "lint/NcProgram.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dotek::lint::rule {
namespace {

// Common variables that each program of the files sets.
std::map<std::uint32_t, std::set<std::uint32_t>> results(const Project& project) {
  std::map<std::uint32_t, std::set<std::uint32_t>> out;
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    for (const ir::ProgramStatement& statement : program.body)
      if (const auto number = storedNumber(statement); number && *number >= 100 && *number <= 999)
        out[static_cast<std::uint32_t>(program.number)].insert(*number);
  });
  return out;
}

// Programs of the files that do something that lasts beside their results: set an offset, print.
std::set<std::uint32_t> lasting(const Project& project) {
  constexpr std::uint32_t kFirstSystem = 1000;
  std::set<std::uint32_t> out;
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    for (const ir::ProgramStatement& statement : program.body) {
      const auto* store = std::get_if<ir::Store>(&statement.node);
      const auto* block = std::get_if<ir::NcBlock>(&statement.node);
      const auto number = storedNumber(statement);
      if (std::holds_alternative<ir::Print>(statement.node) ||
          (block != nullptr && hasCode(*block, 'G', 10)) ||
          (store != nullptr && (!number || *number >= kFirstSystem)))
        out.insert(static_cast<std::uint32_t>(program.number));
    }
  });
  return out;
}

std::string lettersOf(const ir::ProgramStatement& call) {
  std::string out;
  for (const ir::CallArgument& argument : callOf(call)->arguments)
    out += argument.letter;
  return out;
}

struct Use {
  const ir::ProgramStatement* call = nullptr;
  std::size_t at = 0; // its place among the statements
  bool read = false;
  bool again = false; // the next statement calls the same: a fast touch and a slow one
};

// What a call does beside its result shows in a letter that calls whose result is read do not have.
bool madeForAnother(const Use& use, const std::vector<Use>& all) {
  const std::string letters = lettersOf(*use.call);
  return std::any_of(letters.begin(), letters.end(), [&](char letter) {
    return std::none_of(all.begin(), all.end(), [&](const Use& one) {
      return one.read && lettersOf(*one.call).find(letter) != std::string::npos;
    });
  });
}

void checkProgram(const NcProgram& nc, const std::map<std::uint32_t, std::set<std::uint32_t>>& sets,
                  const std::set<std::uint32_t>& works, Report& report) {
  const ir::Program& program = nc.program;
  if (std::none_of(program.body.begin(), program.body.end(),
                   [](const auto& one) { return callOf(one) != nullptr; }))
    return;
  std::map<std::uint32_t, std::vector<Use>> uses;
  std::map<std::uint32_t, std::size_t> lastRead; // of each variable: after which statements, from 1 on
  const auto judge = [&](std::uint32_t called, Use& use) { // nothing follows before the next call
    for (const std::uint32_t number : sets.at(called))
      if (const auto last = lastRead.find(number); last != lastRead.end() && last->second > use.at)
        use.read = true;
  };
  std::size_t place = 0;
  const ir::ProgramStatement* before = nullptr;
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    const ir::ProgramStatement& statement = program.body[i];
    if (ir::isLayout(statement)) continue;
    const ir::ProgramStatement* const previous = std::exchange(before, &statement);
    ++place;
    for (const VariableRead& read : nc.reads(i))
      lastRead[read.number] = place;
    const ir::Call* call = callOf(statement);
    const double* number = call == nullptr || !call->program ? nullptr : ir::constantValue(call->program);
    if (number == nullptr || *number < 1 || *number > 1e8) continue;
    const auto called = static_cast<std::uint32_t>(std::lround(*number));
    if (!sets.contains(called) || called == program.number) continue;
    std::vector<Use>& list = uses[called];
    if (!list.empty()) {
      judge(called, list.back());
      list.back().again = list.back().call == previous;
    }
    list.push_back({&statement, place, false, false});
  }
  for (auto& [called, list] : uses)
    judge(called, list.back());
  // A loop may read after its END what precedes in the text.
  const bool loops = std::any_of(program.body.begin(), program.body.end(), [](const ir::ProgramStatement& s) {
    return std::holds_alternative<ir::Loop>(s.node);
  });
  for (const auto& [called, list] : uses) {
    const auto read = std::count_if(list.begin(), list.end(), [](const Use& use) { return use.read; });
    // A call that is mostly made for what it does, not for a result.
    const auto unread =
        std::count_if(list.begin(), list.end(), [](const Use& use) { return !use.read && !use.again; });
    if (read == 0 || loops || unread > read) continue;
    // After its last call the result stays where it is: for the caller of a macro, or for the operator.
    const bool stays = works.contains(called) || !endsProgram(program);
    for (const Use& use : list)
      if (!use.read && !use.again && !madeForAnother(use, list) && !(stays && &use == &list.back()))
        report.at(use.call->origin.range(),
                  "nothing reads a result of O{} between this call and the next one, or the end, as after "
                  "its other "
                  "calls; the value is lost; read it after the call",
                  called);
  }
}

void check(const Project& project, Report& report) {
  const auto sets = results(project);
  const auto last = lasting(project);
  for (const auto& nc : programsOf(project))
    checkProgram(*nc, sets, last, report);
}

} // namespace

DOTEK_LINT_RULE(result_of_call_unread){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
