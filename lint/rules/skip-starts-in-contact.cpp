#include "ir/Dataflow.h"
#include "ir/Match.h"
#include "ir/Walk.h"
#include "lint/AfterSkip.h"

#include <algorithm>
#include <set>

namespace dotek::lint::rule {
namespace {

// What happened since the last move away: nothing, a skip move, and its contact was read.
enum class Contact : std::uint8_t { Free, Skipped, Used };

// The statement that follows takes the stylus elsewhere, or what follows in the text does not run after it.
bool endsPair(const ir::ProgramStatement& statement) {
  return ir::match(
      statement, [&](const ir::NcBlock& block) { return axesOf(block) != 0 || ir::endsProgram(statement); },
      [&](const ir::Call&) { return callOf(statement) != nullptr; },
      [](const ir::OneOf<ir::Jump, ir::JumpTo, ir::Exit, ir::Raise, ir::LoopEnd> auto&) { return true; },
      [](const ir::OneOf<ir::Label, ir::Branch, ir::Comment, ir::Loop, ir::Store, ir::Notice, ir::Port,
                         ir::Print, ir::NameVariables> auto&) { return false; });
}

bool reads(const NcProgram& nc, std::size_t at, std::uint32_t variable) {
  const auto all = nc.reads(at);
  return std::any_of(all.begin(), all.end(), [&](const VariableRead& one) { return one.number == variable; });
}

// The first G31 that goes to the same target as this one with nothing between that moves: fast and slow at
// one place. Either it touched, or there is nothing to touch. Distances of G91 are another target each time.
std::optional<std::size_t> sameBefore(const NcProgram& nc, std::size_t at) {
  const auto& body = nc.program.body;
  if (nc.modes()[at] == DistanceMode::Incremental || nc.modes()[at] == DistanceMode::Both)
    return std::nullopt;
  for (std::size_t i = at; i-- > 0;) {
    if (const ir::NcBlock* skip = skipOf(body[i]))
      return !hasCode(*skip, 'G', 91) && sameTarget(*skip, *skipOf(body[at])) ? std::optional(i)
                                                                              : std::nullopt;
    if (endsPair(body[i])) return std::nullopt;
    if (const auto* store = std::get_if<ir::Store>(&body[i].node)) {
      const auto number = storedNumber(body[i]);
      if (!number || reads(nc, at, *number) || store->value == nullptr) return std::nullopt;
    }
  }
  return std::nullopt;
}

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const auto& body = program.body;
  if (nc.skips().empty()) return;
  const auto readsContact = [&](std::size_t at) {
    const auto all = nc.reads(at);
    return std::any_of(all.begin(), all.end(),
                       [](const VariableRead& one) { return contactAxis(one.number).has_value(); });
  };
  const auto states = ir::factsBefore<Contact>(
      body, nc.flow(), Contact::Free,
      [&](std::size_t at, std::size_t, Contact state) {
        if (skipOf(body[at]) != nullptr) return Contact::Skipped;
        if (callOf(body[at]) != nullptr) return Contact::Free;
        if (const auto* block = std::get_if<ir::NcBlock>(&body[at].node))
          if (axesOf(*block) != 0) return Contact::Free;
        if (state != Contact::Skipped) return state;
        return std::holds_alternative<ir::Store>(body[at].node) && readsContact(at) && !askedAlone(nc, at)
                   ? Contact::Used
                   : state;
      },
      [](Contact& into, Contact other) {
        // A path on which the stylus is free is one on which all is well.
        if (into == other || into == Contact::Free) return false;
        const Contact merged = other == Contact::Used ? into : other;
        const bool changed = merged != into;
        into = merged;
        return changed;
      });
  for (const std::size_t i : nc.skips()) {
    if (!states[i]) continue;
    if (const auto before = sameBefore(nc, i)) {
      report
          .at(body[i].origin.range(),
              "this G31 goes to the same place as the one before it, which stopped at the surface; it begins "
              "in contact and stops at once, or with an alarm, and its result is that of the fast one; go "
              "back with G1 between them")
          .note(body[*before].origin.range(), "the G31 before it");
      continue;
    }
    if (*states[i] != Contact::Used) continue;
    report.at(
        body[i].origin.range(),
        "the G31 before this one stopped at a surface, and nothing takes the stylus away from it; this one "
        "begins in contact and stops at once, or with an alarm; go back with G1 first");
  }
}

} // namespace

DOTEK_LINT_RULE(skip_starts_in_contact){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
