#include "frontend/macrob/Calls.h"
#include "lint/Probing.h"

#include <set>

namespace dotek::lint::rule {
namespace {

// Without one of its letters the call says all that a reading needs: R of a pocket, which a web takes with Z.
bool readsWithoutOne(const stdlib::MacroSet& set, std::uint32_t program, const std::string& letters) {
  for (std::size_t i = 0; i < letters.size(); ++i) {
    std::string others = letters;
    others.erase(i, 1);
    if (readKnown(set, program, others).refusal == stdlib::CallRefusal::None) return true;
  }
  return false;
}

// Numbers of the programs of the files: one of these runs, whatever a vendor has under its number.
std::set<std::uint64_t> ownPrograms(const Project& project) {
  std::set<std::uint64_t> out;
  for (const NcFile& nc : project.programs)
    for (const macrob::Program& program : nc.file->programs)
      if (program.name && program.name->number > 0) out.insert(program.name->number);
  return out;
}

void checkCall(const macrob::Words& words, const Project& project, const std::set<std::uint64_t>& own,
               Report& report) {
  const auto call = macrob::callOf(words);
  if (!call || call->kind != macrob::CallKind::Simple) return;
  // Words that are no arguments are reported already, and are what is missing here.
  if (!call->before.empty() || !call->refused.empty()) return;
  const auto number = macrob::calledProgram(*call);
  if (!number || own.contains(*number)) return;
  const std::uint32_t program = *number;
  for (const stdlib::MacroSet& set : project.macroSets) {
    if (!set.calls(program)) continue;
    std::string letters;
    for (const macrob::CallArgument& argument : call->arguments)
      letters += argument.word->address;
    if (!mayBeOf(set, program, letters)) return;
    const stdlib::CallReading reading = readKnown(set, program, letters);
    using stdlib::CallRefusal;
    if (reading.refusal == CallRefusal::Excluded)
      report.at(call->program->range, "{}; the macro stops with an alarm{}; take one of them out of the call",
                stdlib::refusalText(reading),
                reading.excluded->text.empty() ? "" : fmt::format(" ({})", reading.excluded->text));
    else if (reading.refusal == CallRefusal::Ambiguous)
      report.at(call->program->range,
                "`{}` measures one thing at a time, and the letters {} of this call belong to "
                "several; the macro stops with an alarm; write a call for each",
                project.sources.textUtf8(call->program->range), reading.letters);
    else if (reading.refusal == CallRefusal::Missing && !readsWithoutOne(set, program, letters))
      report.at(call->program->range,
                "`{}` needs {}, which this call does not have; the macro stops with an alarm; "
                "write it",
                project.sources.textUtf8(call->program->range), reading.missing);
    return;
  }
}

void check(const Project& project, Report& report) {
  const std::set<std::uint64_t> own = ownPrograms(project);
  for (const NcFile& nc : project.programs)
    for (const macrob::Program& program : nc.file->programs)
      for (const macrob::Block& block : program.blocks)
        if (const auto* words = std::get_if<macrob::Words>(&block.body))
          checkCall(*words, project, own, report);
}

} // namespace

DOTEK_LINT_RULE(macro_call_arguments){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
