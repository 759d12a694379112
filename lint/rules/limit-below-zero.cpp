#include "lint/Probing.h"
#include "lint/ProgBlocks.h"
#include "stdlib/MacroLimits.h"

#include <cstdlib>

namespace dotek::lint::rule {
namespace {

// A letter of a call with the number that it has.
struct Given {
  char letter = 0;
  double value = 0;
  SourceRange range;
};

// `letters`: all of the call, those without a known number too.
void checkCall(std::uint32_t program, const std::string& letters, const std::vector<Given>& given,
               const Project& project, Report& report) {
  for (const stdlib::MacroSet& set : project.macroSets) {
    if (!set.calls(program)) continue;
    if (!mayBeOf(set, program, letters)) return;
    const stdlib::MacroSignature* const read = readKnown(set, program, letters).signature;
    for (const Given& one : given) {
      if (!(one.value < 0)) continue;
      const stdlib::MacroArgument* argument = read != nullptr ? read->find(one.letter) : nullptr;
      if (argument == nullptr || !stdlib::isLimit(argument->role)) continue;
      report.at(one.range,
                "{} of P{} is a limit ({}), and no source says what one below 0 does: the macro may take its "
                "size, or find every error too large, or none; write it without the sign",
                one.letter, program, stdlib::roleName(argument->role));
    }
    return;
  }
}

void checkProgram(const ir::Program& program, const Project& project, Report& report) {
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* call = std::get_if<ir::Call>(&statement.node);
    const double* number = call != nullptr && call->program ? ir::constantValue(call->program) : nullptr;
    if (number == nullptr || *number < 1 || *number > 99999999 || call->kind != ir::CallKind::Macro) continue;
    std::string letters;
    std::vector<Given> given;
    for (const ir::CallArgument& argument : call->arguments) {
      letters += argument.letter;
      const double* value = argument.value ? ir::constantValue(argument.value) : nullptr;
      if (value != nullptr) given.push_back({argument.letter, *value, argument.range});
    }
    checkCall(static_cast<std::uint32_t>(*number), letters, given, project, report);
  }
}

void checkBlock(const ProgBlock& block, const Project& project, Report& report) {
  const std::vector<ProgWord> words = wordsOf(block, project.form);
  const std::uint32_t program = macroCalled(words);
  if (program == 0) return;
  std::string letters;
  std::vector<Given> given;
  for (const ProgWord& word : words) {
    if (word.address == 'G' || word.address == 'P' || word.address == 'N') continue;
    letters += word.address;
    if (!word.digits.empty())
      given.push_back({word.address, std::strtod(word.digits.c_str(), nullptr), word.range});
  }
  checkCall(program, letters, given, project, report);
}

void check(const Project& project, Report& report) {
  for (const NcFile& nc : project.programs)
    if (nc.lowered != nullptr)
      for (const ir::Program& program : nc.lowered->programs)
        checkProgram(program, project, report);
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    for (const ProgBlock* block : ownBlocks(routine, prog, project))
      checkBlock(*block, project, report);
  });
}

} // namespace

DOTEK_LINT_RULE(limit_below_zero){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
