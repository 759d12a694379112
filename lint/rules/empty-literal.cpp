#include "lint/ProgBlocks.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    const std::string& bytes = project.sources.file(prog.file).bytes();
    eachStatement(routine.body, [&](const compost::Statement& statement) {
      const auto* literal = std::get_if<compost::Literal>(&statement);
      if (literal == nullptr || !literal->text.empty()) return;
      const SourceRange range = literal->range;
      // Two words that would run into one keep a blank between them.
      const auto blank = [&](std::size_t at) {
        return at >= bytes.size() || std::string_view(" \t\r\n").find(bytes[at]) != std::string_view::npos;
      };
      const bool apart = range.begin == 0 || blank(range.begin - 1) || blank(range.end);
      report.at(range, "the literal `''` prints nothing; leave it out").fix =
          Fix{Fix::Applicability::Safe, "leave out the empty literal", {{range, apart ? "" : " "}}};
    });
  });
}

} // namespace

DOTEK_LINT_RULE(empty_literal){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
