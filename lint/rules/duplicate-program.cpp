#include "lint/Project.h"

#include <map>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const NcFile& nc : project.programs) {
    std::map<std::string, SourceRange> seen;
    for (const macrob::Program& program : nc.file->programs) {
      if (!program.name) continue;
      const bool numbered = program.name->kind != macrob::ProgramName::Kind::Name;
      const std::string key =
          numbered ? "O" + std::to_string(program.name->number) : "<" + program.name->text + ">";
      const auto [at, added] = seen.try_emplace(key, program.name->range);
      if (added) continue;
      report
          .at(program.name->range,
              "the file has the program {} twice; the control stops reading with an alarm, or keeps "
              "the later one; give it another number",
              key)
          .note(at->second, "the first one");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(duplicate_program){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
