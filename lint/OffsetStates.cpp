#include "lint/OffsetStates.h"

#include "lint/Skips.h"

#include <algorithm>
#include <cmath>

namespace dotek::lint {
namespace {

constexpr double kLastProgram = 1e8;

struct CallSite {
  std::uint32_t caller = 0, callee = 0;
  Offset offset = Offset::AsBefore;
  SourceRange range;
};

// One caller under G43 is enough: what is wrong under it is wrong there.
Offset joined(Offset a, Offset b) {
  if (a == b || a == Offset::On || b == Offset::On) return a == b ? a : Offset::On;
  return Offset::Either;
}

constexpr double kNoOffset = 49;
bool isOffsetCode(double code) {
  return (code >= 43 && code < 45) || code == kNoOffset;
}

// The variable of a modal group that is not that of lengths, or one of `copies`.
bool readsOtherGroup(const ir::ExpressionPtr& value, const std::set<std::uint32_t>& copies) {
  constexpr std::uint32_t kFirstGroup = 4001, kLastGroup = 4039, kOfLengths = 4008;
  if (!value) return false;
  if (const auto* unary = std::get_if<ir::Unary>(&value->node);
      unary != nullptr && (unary->op == ir::UnaryOp::NullAsZero || unary->op == ir::UnaryOp::Round ||
                           unary->op == ir::UnaryOp::AddPoint))
    return readsOtherGroup(unary->operand, copies);
  const auto number = variableNumber(*value);
  if (!number) return false;
  return copies.contains(*number) ||
         (*number >= kFirstGroup && *number <= kLastGroup && *number != kOfLengths);
}

} // namespace

std::optional<std::uint32_t> calledProgram(const ir::ProgramStatement& statement) {
  const ir::Call* call = callOf(statement);
  const double* number = call == nullptr || !call->program ? nullptr : ir::constantValue(call->program);
  if (number == nullptr || *number < 1 || *number > kLastProgram) return std::nullopt;
  return static_cast<std::uint32_t>(std::lround(*number));
}

std::set<std::uint32_t> codesOfOtherGroups(const ir::Program& program) {
  std::set<std::uint32_t> out, mayBeOffset;
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* store = std::get_if<ir::Store>(&statement.node);
    const auto number = storedNumber(statement);
    if (store == nullptr || !number) continue;
    const double* code = ir::constantValue(store->value);
    const bool other = code != nullptr ? !isOffsetCode(*code) : readsOtherGroup(store->value, {});
    (other ? out : mayBeOffset).insert(*number);
  }
  for (const std::uint32_t number : mayBeOffset)
    out.erase(number);
  return out;
}

std::optional<Offset> statedOffset(const ir::ProgramStatement& statement,
                                   const std::set<std::uint32_t>& others) {
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  if (block == nullptr) return std::nullopt;
  std::optional<Offset> out;
  for (const ir::Word& word : block->words) {
    if (word.address != 'G') continue;
    const double* code = ir::constantValue(word.value);
    if (code == nullptr && !readsOtherGroup(word.value, others)) out = Offset::Either;
    if (code != nullptr && isOffsetCode(*code) && *code != kNoOffset)
      out = wordValue(*block, 'H') == 0.0 ? Offset::Off : Offset::On;
    if (code != nullptr && *code == kNoOffset) out = Offset::Off;
  }
  return out;
}

namespace {

// A G code that is computed, or one of those of the offset: whether it switches is worth asking.
bool maySwitch(const ir::Program& program) {
  return std::any_of(program.body.begin(), program.body.end(), [](const ir::ProgramStatement& statement) {
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    return block != nullptr &&
           std::any_of(block->words.begin(), block->words.end(), [](const ir::Word& word) {
             const double* code = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
             return word.address == 'G' && (code == nullptr || isOffsetCode(*code));
           });
  });
}

} // namespace

std::set<std::uint32_t> switchingPrograms(const Project& project) {
  std::set<std::uint32_t> out;
  for (const NcFile& nc : project.programs)
    if (nc.lowered)
      for (const ir::Program& program : nc.lowered->programs) {
        if (!maySwitch(program)) continue;
        if (const auto others = codesOfOtherGroups(program);
            std::any_of(program.body.begin(), program.body.end(), [&](const ir::ProgramStatement& one) {
              return statedOffset(one, others).has_value();
            }))
          out.insert(static_cast<std::uint32_t>(program.number));
      }
  return out;
}

std::vector<std::optional<Offset>> offsetStates(const ir::Program& program, Offset entry,
                                                const std::set<std::uint32_t>& switching) {
  const auto& body = program.body;
  const auto others = codesOfOtherGroups(program);
  return ir::factsBefore<Offset>(
      body, entry,
      [&](std::size_t at, std::size_t, Offset offset) {
        if (const auto stated = statedOffset(body[at], others)) return *stated;
        const auto called = calledProgram(body[at]);
        return called && switching.contains(*called) ? Offset::Either : offset;
      },
      [](Offset& into, Offset other) {
        if (into == other || into == Offset::Either) return false;
        into = Offset::Either;
        return true;
      });
}

std::map<std::uint32_t, CalledUnder> calledUnder(const Project& project,
                                                 const std::set<std::uint32_t>& switching) {
  std::set<std::uint32_t> own;
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    own.insert(static_cast<std::uint32_t>(program.number));
  });
  std::vector<CallSite> sites;
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    const auto callee = [&](const ir::ProgramStatement& one) {
      const auto called = calledProgram(one);
      return called && own.contains(*called) ? called : std::nullopt;
    };
    if (std::none_of(program.body.begin(), program.body.end(),
                     [&](const ir::ProgramStatement& one) { return callee(one).has_value(); }))
      return;
    const auto states = offsetStates(program, Offset::AsBefore, switching);
    for (std::size_t i = 0; i < program.body.size(); ++i)
      if (const auto called = callee(program.body[i]); called && states[i])
        sites.push_back({static_cast<std::uint32_t>(program.number), *called, *states[i],
                         program.body[i].origin.range()});
  });
  std::map<std::uint32_t, CalledUnder> out;
  // What a caller says nothing of is as its own caller left it: each round goes one call deeper.
  constexpr int kMostRounds = 64; // deeper than any control calls
  bool changed = true;
  for (int round = 0; changed && round < kMostRounds; ++round) {
    changed = false;
    std::map<std::uint32_t, CalledUnder> next;
    for (const CallSite& site : sites) {
      Offset offset = site.offset;
      if (const auto of = out.find(site.caller); offset == Offset::AsBefore && of != out.end())
        offset = of->second.offset;
      const auto [at, added] = next.try_emplace(site.callee, CalledUnder{offset, site.range});
      if (added) continue;
      CalledUnder& all = at->second;
      if (offset == Offset::On && all.offset != Offset::On) all.call = site.range;
      all.offset = joined(all.offset, offset);
    }
    for (const auto& [number, now] : next) {
      const auto before = out.find(number);
      // Only what becomes On goes on: so it ends.
      changed =
          changed || before == out.end() || (now.offset == Offset::On && before->second.offset != Offset::On);
    }
    out = std::move(next);
  }
  return out;
}

} // namespace dotek::lint
