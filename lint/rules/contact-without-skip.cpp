#include "ir/Dataflow.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dotek::lint::rule {
namespace {

// What can have moved to a contact: a skip move, a call, also by the code of a builder.
bool mayTouch(const ir::ProgramStatement& statement) {
  if (std::holds_alternative<ir::Call>(statement.node)) return true;
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  if (block == nullptr) return false;
  constexpr double kFirstOwn = 30; // M codes up to here call no macro on any machine
  return std::any_of(block->words.begin(), block->words.end(), [](const ir::Word& word) {
    if (word.address != 'G' && word.address != 'M') return false;
    const double* code = ir::constantValue(word.value);
    if (code == nullptr) return true;
    if (word.address == 'M') return *code > kFirstOwn;
    return *code >= 100 || (*code >= 31 && *code < 40 && std::floor(*code) != 33) ||
           (*code >= 65 && *code < 67);
  });
}

// It goes back to a caller, which may have made the skip move.
bool returns(const ir::Program& program) {
  return std::any_of(program.body.begin(), program.body.end(), [](const ir::ProgramStatement& one) {
    return std::holds_alternative<ir::Exit>(one.node);
  });
}

enum class Before : std::uint8_t { Nothing, Moved, MayTouch };

void check(const NcProgram& nc, Report& report) {
  const auto& body = nc.program.body;
  const bool macro = returns(nc.program) || !endsProgram(nc.program);
  // With a G31 in the program contact-of-other-axis says it; a macro that calls another may have touched by
  // it.
  const auto knows = [&](const ir::ProgramStatement& one) {
    return skipOf(one) != nullptr || (macro && mayTouch(one));
  };
  if (std::any_of(body.begin(), body.end(), knows)) return;
  const auto before = ir::factsBefore<Before>(
      body, nc.flow(), Before::Nothing,
      [&](std::size_t at, std::size_t, Before known) {
        if (mayTouch(body[at])) return Before::MayTouch;
        return known == Before::Nothing && isPlainMove(body[at]) ? Before::Moved : known;
      },
      [](Before& into, Before other) {
        // Some path may have touched; a move counts where each path has one.
        const Before both =
            into == Before::MayTouch || other == Before::MayTouch ? Before::MayTouch : std::min(into, other);
        return std::exchange(into, both) != both;
      });
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!before[i] || *before[i] == Before::MayTouch) continue;
    // The caller's contact, which the macro works out.
    if (macro && *before[i] != Before::Moved) continue;
    for (const auto& [number, range] : nc.reads(i)) {
      if (!contactAxis(number)) continue;
      Diagnostic& one =
          macro
              ? report.at(range,
                          "#{} is read after a move, and this macro has no G31 and calls nothing: it holds "
                          "where the last G31 of another program was stopped; write G31 for the move that "
                          "touches",
                          number)
              : report.at(range,
                          "#{} is read, and this program has no G31 and has called no macro before: it holds "
                          "where the last G31 of another program was stopped; write G31 for the move that "
                          "touches",
                          number);
      if (macro) one.severity = Severity::Note;
      return;
    }
  }
}

} // namespace

DOTEK_LINT_RULE(contact_without_skip){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
