#include "lint/NcProgram.h"
#include "lint/Probing.h"
#include "lint/ProgBlocks.h"

#include <algorithm>
#include <charconv>
#include <map>

namespace dotek::lint::rule {
namespace {

// n of `#n=`, a number of the block before it or none; nothing: another block.
std::optional<std::uint32_t> storedIn(const ProgBlock& block) {
  std::string text = block.text();
  if (!text.empty() && text.front() == 'N')
    text.erase(0, std::min(text.find_first_not_of("0123456789 ", 1), text.size()));
  if (text.empty() || text.front() != '#') return std::nullopt;
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), number);
  const std::size_t equals = text.find_first_not_of(' ', static_cast<std::size_t>(end - text.data()));
  if (error != std::errc() || equals == std::string::npos || text[equals] != '=') return std::nullopt;
  return number;
}

void check(const Project& project, Report& report) {
  for (const compost::Program* prog : project.progs) {
    // The sets that this post calls.
    std::map<const stdlib::MacroSet*, SourceRange> called;
    std::vector<std::pair<std::uint32_t, SourceRange>> stores;
    for (const compost::Item& item : prog->items) {
      const auto* routine = std::get_if<compost::Routine>(&item);
      if (routine == nullptr) continue;
      for (const ProgBlock& block : blocksOf(routine->body, *prog, project)) {
        if (block.called) continue;
        if (const auto number = storedIn(block)) stores.emplace_back(*number, block.range);
        const std::uint32_t program = macroCalled(wordsOf(block, project.form));
        for (const stdlib::MacroSet& set : project.macroSets)
          if (program != 0 && set.calls(program)) called.try_emplace(&set, block.range);
      }
    }
    for (const auto& [number, range] : stores)
      for (const auto& [set, call] : called) {
        if (!set->keepsCalibration(number)) continue;
        report
            .at(range,
                "#{} is one of the variables in which {} keeps the calibration of the stylus; after this "
                "every "
                "measurement is wrong; keep the value in another variable",
                number, set->title)
            .note(call, "the post calls its macros");
        break;
      }
  }
}

// A set whose macros calibrate here on purpose: of a program of the vendor, or one beside it in its numbers.
bool calibrates(const stdlib::MacroSet& set, std::uint32_t program) {
  return std::any_of(set.signatures.begin(), set.signatures.end(), [&](const stdlib::MacroSignature& one) {
    return one.intent == stdlib::Intent::Calibration && one.program / 10 == program / 10;
  });
}

const stdlib::MacroSet* setOf(const Project& project, std::uint32_t program) {
  if (program == 0 || probingOf(project).isOwn(program)) return nullptr; // its text says what it reads
  for (const stdlib::MacroSet& set : project.macroSets)
    if (set.calls(program) || calibrates(set, program)) return &set;
  return nullptr;
}

void checkProgram(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const stdlib::MacroSet* called = nullptr;
  SourceRange call;
  for (const ir::ProgramStatement& statement : program.body) {
    const std::uint32_t number = probingOf(nc.project).step(statement).program;
    const stdlib::MacroSet* const set = setOf(nc.project, number);
    if (set == nullptr) continue;
    if (calibrates(*set, number)) return;
    if (called == nullptr) called = set, call = statement.origin.range();
  }
  if (called == nullptr) return;
  if (program.number <= UINT32_MAX) {
    const auto own = static_cast<std::uint32_t>(program.number);
    if (called->calls(own) || calibrates(*called, own)) return;
  }
  for (const ir::ProgramStatement& statement : program.body) {
    const auto number = storedNumber(statement);
    if (!number || !called->keepsCalibration(*number)) continue;
    report
        .at(statement.origin.range(),
            "#{} is one of the variables in which {} keeps the calibration of the stylus; after this every "
            "measurement is wrong; keep the value in another variable",
            *number, called->title)
        .note(call, "the program calls its macros");
  }
}

} // namespace

DOTEK_LINT_RULE(calibration_overwritten){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
    .program = checkProgram,
};

} // namespace dotek::lint::rule
