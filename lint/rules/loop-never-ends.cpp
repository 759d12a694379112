#include "ir/Evaluate.h"
#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/Probing.h"

#include <cmath>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kFirstSystem = 1000; // the control changes these itself

// What a vendor's macro writes is known; not what a program of the files does that has its number.
bool mayWrite(const ir::Call& call, const std::set<std::uint32_t>& read, const Project& project) {
  const double* number = call.program ? ir::constantValue(call.program) : nullptr;
  if (number == nullptr || call.kind != ir::CallKind::Macro || *number < 1 || *number >= 1e8) return true;
  const auto called = static_cast<std::uint32_t>(std::lround(*number));
  for (const NcFile& file : project.programs)
    for (const macrob::Program& program : file.file->programs)
      if (program.name && program.name->number == called) return true;
  bool known = false;
  for (const stdlib::MacroSet& set : project.macroSets) {
    if (!set.calls(called)) continue;
    known = true;
    for (const auto& [first, last] : set.overwritten)
      if (const auto at = read.lower_bound(first); at != read.end() && *at <= last) return true;
    for (const stdlib::MacroSignature& one : set.signatures)
      for (const stdlib::MacroResult& result : one.results)
        if (read.contains(result.variable)) return true;
  }
  return !known;
}

void checkProgram(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const auto& body = program.body;
  for (std::size_t at = 0; at < body.size(); ++at) {
    const auto* loop = std::get_if<ir::Loop>(&body[at].node);
    if (loop == nullptr) continue;
    std::set<std::uint32_t> read;
    bool known = true;
    const auto note = [&](const ir::Expression& node) {
      if (!std::holds_alternative<ir::MachineVariable>(node.node)) return;
      const auto number = variableNumber(node);
      if (number && *number < kFirstSystem)
        read.insert(*number);
      else
        known = false;
    };
    if (loop->condition) ir::eachNode(loop->condition, note);
    // `WHILE[1EQ1]DO1`, or DO alone: meant to turn until something leads out.
    const bool always = !loop->condition || ir::holds(*loop->condition, {}) == true;
    if (!known || (read.empty() && !always)) continue;
    bool may = false; // something may change the condition, or lead out
    for (std::size_t i = at + 1; i < body.size() && !may; ++i) {
      const auto* end = std::get_if<ir::LoopEnd>(&body[i].node);
      if (end != nullptr && end->number == loop->number) break;
      may = endsProgram(body[i]) ||
            match(
                body[i], [&](const ir::Call& call) { return mayWrite(call, read, nc.project); },
                [](const ir::OneOf<ir::Exit, ir::Raise, ir::JumpTo, ir::Jump> auto&) { return true; },
                [&](const ir::Store&) {
                  const auto number = storedNumber(body[i]);
                  return !number || read.contains(*number);
                },
                // A label with a number is one that a GOTO of the text names.
                [&](const ir::Branch& branch) { return program.labels[branch.target].number != 0; },
                // A code of the builder may call a macro.
                [](const ir::NcBlock& block) { return hasWord(block, 'M'); },
                [](const ir::OneOf<ir::Label, ir::Comment, ir::Loop, ir::LoopEnd, ir::Notice, ir::Port,
                                   ir::Print, ir::NameVariables> auto&) { return false; });
    }
    if (may) continue;
    if (read.empty()) {
      report.at(body[at].origin.range(),
                "the loop turns for ever, and no jump, call, M code or alarm leads out of it; write the GOTO "
                "that does, or a condition");
      continue;
    }
    report.at(body[at].origin.range(),
              "nothing in this loop changes what its condition looks at, #{}; once in it the "
              "control does not come out; count it in the loop",
              *read.begin());
  }
}

void check(const NcProgram& nc, Report& report) {
  checkProgram(nc, report);
}

} // namespace

DOTEK_LINT_RULE(loop_never_ends){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
