#include "lint/Probing.h"
#include "lint/ProgBlocks.h"

namespace dotek::lint::rule {
namespace {

void checkBlock(const ProgBlock& block, const Project& project, Report& report) {
  const std::vector<ProgWord> words = wordsOf(block, project.form, true);
  const std::uint32_t program = macroCalled(words);
  if (program == 0) return;
  for (const stdlib::MacroSet& set : project.macroSets) {
    if (!set.calls(program)) continue;
    std::string known;
    for (const ProgWord& word : words) {
      if (word.address == 'G' || word.address == 'P' || word.address == 'N') continue;
      if (stdlib::takesLetter(set, program, word.address)) {
        // A letter that is printed twice is another finding.
        if (known.find(word.address) != std::string::npos) return;
        known += word.address;
      } else if (!mayBeOf(set, program, {&word.address, 1})) {
        report.at(
            word.range,
            "P{} of {} takes no `{}` that is known; the macro leaves the value aside, or stops for want of "
            "another letter",
            program, set.title, word.address);
        return;
      }
    }
    const ProgWord* call = findWord(words, 'P');
    if (call == nullptr) return;
    const stdlib::CallReading reading = stdlib::readCall(set, program, known);
    using stdlib::CallRefusal;
    if (reading.refusal == CallRefusal::Excluded && reading.excluded != nullptr)
      report.at(call->range, "{}; the macro stops with an alarm{}; print one of them",
                stdlib::refusalText(reading),
                reading.excluded->text.empty() ? "" : fmt::format(" ({})", reading.excluded->text));
    else if (reading.refusal == CallRefusal::Ambiguous || reading.refusal == CallRefusal::Excluded)
      report.at(
          call->range,
          "P{} measures one thing at a time, and the letters {} of this call belong to several; the macro "
          "stops with an alarm; print a call for each",
          program, known);
    else if (reading.refusal == CallRefusal::Missing && !printsUnknown(block, project.form))
      report.at(call->range,
                "P{} needs {}, which this call does not print; the macro stops with an alarm; print it",
                program, reading.missing);
    return;
  }
}

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    if (prog.hasErrorNodes || !routine.returnRange) return; // told already
    for (const ProgBlock* block : ownBlocks(routine, prog, project))
      checkBlock(*block, project, report);
  });
}

} // namespace

DOTEK_LINT_RULE(post_call_arguments){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
