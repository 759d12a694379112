#include "frontend/macrob/Check.h"

#include "frontend/macrob/CheckFlow.h"
#include "frontend/macrob/Walk.h"

#include <array>

namespace dotek::frontend::macrob {

CheckedProgram::CheckedProgram(const Program& parsed, const stdlib::Control* machine, const SourceMap& files,
                               std::span<const stdlib::Control> profiles)
    : program(parsed), control(machine), machines(machine != nullptr ? std::span(machine, 1) : profiles),
      sources(files), flow(flowOf(parsed, files)) {
  // A program of a CAM is numbers for the most part; no check looks at a short one by itself.
  constexpr std::size_t kShort = 8;
  constexpr std::size_t kUsual = 4; // of a block
  parts.reserve(program.blocks.size() * kUsual);
  for (const Block& block : program.blocks) {
    walk(block, [&](const Expression& expression, bool subscript) {
      const auto* number = std::get_if<nc::Number>(&expression.node);
      if (number == nullptr || number->digits.size() > kShort) parts.push_back({&expression, subscript});
    });
    if (const Condition* condition = conditionOf(block)) conditions.push_back(condition);
    const auto* words = std::get_if<Words>(&block.body);
    if (words == nullptr) continue;
    std::optional<Call> call = callOf(*words);
    if (call && call->kind <= CallKind::EachBlock) {
      calls.push_back(std::move(*call));
      continue;
    }
    plain.push_back(words);
    if (call && call->kind == CallKind::Subprogram) subprograms.push_back(std::move(*call));
  }
}

std::string CheckedProgram::machineText() const {
  if (control != nullptr) return control->title;
  std::string names;
  for (const stdlib::Control& one : machines)
    names += (names.empty() ? "" : ", ") + one.name;
  return "each control of which Dotek has a profile (" + names + ")";
}

const std::vector<std::optional<Modes>>& CheckedProgram::modes() const {
  if (!modes_) modes_ = modesBefore(program, control);
  return *modes_;
}

std::span<const Check<CheckedProgram>* const> programChecks() {
  static constexpr std::array kChecks = {
      &doWithoutNumberCheck,
      &endWithoutNumberCheck,
      &loopNumberRangeCheck,
      &loopNumberInUseCheck,
      &loopsCrossCheck,
      &endWithoutDoCheck,
      &doWithoutEndCheck,
      &gotoTargetMissingCheck,
      &duplicateTargetCheck,
      &jumpIntoLoopCheck,
      &blockNeverRunsCheck,
      &variableOutOfRangeCheck,
      &nullWrittenCheck,
      &readOnlyWrittenCheck,
      &subscriptAsValueCheck,
      &tableBaseReadCheck,
      &hashMissingCheck,
      &offsetOverwrittenCheck,
      &bracketsTooDeepCheck,
      &numberDigitsCheck,
      &functionUnknownHereCheck,
      &functionWithoutBracketsCheck,
      &fixOfComputedCheck,
      &joinedUnknownHereCheck,
      &constantConditionCheck,
      &equalityOfComputedCheck,
      &thenUnknownHereCheck,
      &thenGotoCheck,
      &codeWithPointCheck,
      &wordWithoutPointCheck,
      &argumentWithoutPointCheck,
      &argumentBeforeCallCheck,
      &noArgumentCheck,
      &argumentOrderCheck,
      &argumentOverwrittenCheck,
      &positionReadEarlyCheck,
      &callWordsAloneCheck,
      &callWithoutProgramCheck,
      &alarmNumberRangeCheck,
      &alarmWithoutTextCheck,
      &messageTooLongCheck,
      &printedFormatCheck,
      &blockDeleteOfLoopCheck,
      &returnRepeatedCheck,
      &atanDivisorCheck,
      &wordOutOfRangeCheck,
      &wordRepeatedCheck,
      &wordNotTakenCheck,
      &codesExcludeCheck,
      &arcWithoutCentreCheck,
      &modeAfterAxisCheck,
      &wearInGeometryCheck,
      &systemVariableUnknownCheck,
      &pointLostCheck,
      &absMissingCheck,
      &feedMissingCheck,
      &cycleWordsCheck,
      &modeForbidsCodeCheck,
      &arcGeometryCheck,
      &rotationWordsCheck,
      &callsItselfCheck,
      &dataInputWordsCheck,
      &dwellWordsCheck,
      &signalValueCheck,
      &calculationStopsCheck,
  };
  return kChecks;
}

void checkFile(const File& file, const stdlib::Control* control, const SourceMap& sources,
               Diagnostics& diagnostics) {
  for (const Program& program : file.programs)
    runChecks(programChecks(), CheckedProgram(program, control, sources), diagnostics);
}

} // namespace dotek::frontend::macrob
