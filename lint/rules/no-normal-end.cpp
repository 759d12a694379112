#include "ir/Flow.h"
#include "lint/NcProgram.h"
#include "lint/OffsetStates.h"
#include "lint/Skips.h"
#include "lint/Turning.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

// M30, M2, M99, or a code that is computed.
bool endsNormally(const ir::ProgramStatement& statement) {
  return endsProgram(statement) ||
         match(
             statement, [](const ir::OneOf<ir::Exit, ir::JumpTo> auto&) { return true; },
             [](const ir::NcBlock& block) {
               return std::any_of(block.words.begin(), block.words.end(), [](const ir::Word& word) {
                 return word.address == 'M' && ir::constantValue(word.value) == nullptr;
               });
             },
             [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Comment, ir::Loop,
                                ir::LoopEnd, ir::Call, ir::Raise, ir::Notice, ir::Port, ir::Print,
                                ir::NameVariables> auto&) { return false; });
}

// M99 with P, which goes on elsewhere in the caller, is in the called program, or may be: it is in no file.
bool mayReturnElsewhere(const ir::ProgramStatement& statement, const Project& project) {
  if (callOf(statement) == nullptr) return false;
  const auto called = calledProgram(statement);
  bool found = false, elsewhere = false;
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    if (!called || program.number != *called) return;
    found = true;
    elsewhere = elsewhere || std::any_of(program.body.begin(), program.body.end(), [](const auto& one) {
                  const auto* exit = std::get_if<ir::Exit>(&one.node);
                  return exit != nullptr && exit->block != nullptr;
                });
  });
  return elsewhere || !found;
}

// A call of a program that ends the run and never comes back, as each one of that number in the files does.
bool endsRun(const ir::ProgramStatement& statement, const Project& project) {
  if (callOf(statement) == nullptr) return false;
  const auto called = calledProgram(statement);
  bool found = false, returns = false;
  if (called)
    eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
      if (program.number != *called) return;
      const std::vector<bool> reached = ir::reachable(program.body, ir::flowOf(program.body));
      bool ends = false;
      for (std::size_t i = 0; i < program.body.size(); ++i) {
        if (!reached[i]) continue;
        ends = ends || endsProgram(program.body[i]);
        returns = returns || std::holds_alternative<ir::Exit>(program.body[i].node);
      }
      found = found || ends;
      returns = returns || !ends;
    });
  return found && !returns;
}

// The text ends with it.
bool isLast(const NcProgram& nc) {
  const auto& programs = nc.file.programs;
  return !programs.empty() && programs.back().name && programs.back().name->number == nc.program.number;
}

// It changes a tool and starts and stops the spindle: no excerpt, which has one or the other.
bool machines(const ir::Program& program) {
  bool tool = false, turns = false;
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    tool = tool || hasCode(*block, 'M', 6);
    turns = turns || hasCode(*block, 'M', 3) || hasCode(*block, 'M', 4);
  }
  return tool && turns;
}

// The spindle or the coolant is switched off last.
bool stops(const ir::ProgramStatement& statement) {
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  return block != nullptr && (hasCode(*block, 'M', 5) || hasCode(*block, 'M', 9));
}

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  if (program.nameKind == ir::Program::NameKind::None || program.body.empty()) return;
  const auto& body = program.body;
  const auto& next = nc.flow().next;
  const std::vector<bool> reached = ir::reachable(body, nc.flow());
  bool ends = false;
  bool alarms = false;
  bool otherEnd = false;
  const ir::ProgramStatement* past = nullptr;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!reached[i]) {
      otherEnd = otherEnd || endsNormally(body[i]);
      continue;
    }
    ends = ends || endsNormally(body[i]);
    alarms = alarms || std::holds_alternative<ir::Raise>(body[i].node);
    if (!endsNormally(body[i]) && std::find(next[i].begin(), next[i].end(), body.size()) != next[i].end())
      past = &body[i];
  }
  // A called program may come back at a number that no jump of this one leads to. All programs are looked at
  // for it, so only where it decides.
  const auto mayComeElsewhere = [&] {
    for (std::size_t i = 0; i < body.size(); ++i)
      if (reached[i] && mayReturnElsewhere(body[i], nc.project)) return true;
    return false;
  };
  const auto callsEnd = [&] {
    for (std::size_t i = 0; i < body.size(); ++i)
      if (reached[i] && endsRun(body[i], nc.project)) return true;
    return false;
  };
  if (past != nullptr && endsRun(*past, nc.project)) return;
  if (past != nullptr && (ends || alarms || nc.file.markLast))
    report.at(
        past->origin.range(),
        "the program goes on past its last block; the control stops with an alarm, or begins again from "
        "the top; end it with M30, a macro with M99");
  else if (past != nullptr && nc.file.markFirst && isLast(nc))
    report.at(
        past->origin.range(),
        "the text ends after this block, without M30, M2 or M99 and without the `%` that closes what a `%` "
        "has "
        "opened: a transfer that broke off leaves this; the control waits for more, or stops with an alarm, "
        "with the spindle and the modes as they are; send the program again");
  else if (past != nullptr && isLast(nc) && !nc.file.markFirst && (machines(program) || stops(*past)) &&
           !isForLathe(nc.project))
    report.at(past->origin.range(),
              "the text ends after this block, without M30, M2 or M99; the control stops with an alarm, or "
              "waits for more with the modes as they are; end it with M30, a subprogram with M99");
  // One that its own file calls is there as a whole.
  else if (past != nullptr &&
           calledIn(nc.file, nc.project).contains(static_cast<std::uint32_t>(nc.program.number)))
    report.at(past->origin.range(),
              "O{} is called in this file and goes on past its last block; the control does not come back to "
              "the caller, or stops with an alarm; end it with M99",
              nc.program.number);
  else if (!ends && alarms && !(otherEnd && mayComeElsewhere()) && !callsEnd())
    report.at(
        program.range,
        "each path through the program ends in an alarm, none in M30 or M99; the end before the alarms is "
        "missing; write it");
}

} // namespace

DOTEK_LINT_RULE(no_normal_end){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
