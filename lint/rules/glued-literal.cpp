#include "lint/ProgBlocks.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    const std::string& bytes = project.sources.file(prog.file).bytes();
    eachStatement(routine.body, [&](const compost::Statement& statement) {
      const auto* word = std::get_if<compost::Word>(&statement);
      if (word == nullptr || word->kind != compost::WordKind::Command || !word->arguments.empty()) return;
      const std::uint32_t end = word->nameRange.end;
      if (end >= bytes.size() || bytes[end] != '\'') return;
      report
          .at(word->nameRange,
              "a literal follows `{}` without a blank; the compiler takes it; write a blank "
              "between them",
              word->name)
          .fix = Fix{Fix::Applicability::Safe, "write a blank", {{{prog.file, end, end}, " "}}};
    });
  });
}

} // namespace

DOTEK_LINT_RULE(glued_literal){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
