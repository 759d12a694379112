#include "lint/ProgBlocks.h"

namespace dotek::lint::rule {
namespace {

constexpr std::size_t kLeast = 3;

std::string squeezed(const std::vector<compost::Statement>& body, const Project& project) {
  std::string out;
  for (const compost::Statement& statement : body) {
    for (const char c : project.sources.text(rangeOf(statement)))
      if (c != ' ' && c != '\t' && c != '\r' && c != '\n') out += c;
    out += ' ';
  }
  return out;
}

void checkBody(const std::vector<compost::Statement>& body, const Project& project, Report& report) {
  for (std::size_t at = 0; at < body.size();) {
    const auto* first = std::get_if<std::unique_ptr<compost::If>>(&body[at]);
    if (first == nullptr || !(*first)->elseBody.empty() || (*first)->thenBody.empty()) {
      ++at;
      continue;
    }
    const std::string text = squeezed((*first)->thenBody, project);
    std::size_t end = at + 1;
    for (; end < body.size(); ++end) {
      const auto* next = std::get_if<std::unique_ptr<compost::If>>(&body[end]);
      if (next == nullptr || !(*next)->elseBody.empty() || squeezed((*next)->thenBody, project) != text)
        break;
    }
    if (end - at >= kLeast)
      report.at((*first)->ifRange,
                "{} conditions in a row do the same; a case that is added to one place is easily "
                "forgotten here; one routine can hold the list",
                end - at);
    at = end;
  }
}

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program&, const compost::Routine& routine) {
    checkBody(routine.body, project, report);
    eachStatement(routine.body, [&](const compost::Statement& statement) {
      if (const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement)) {
        checkBody((*branch)->thenBody, project, report);
        checkBody((*branch)->elseBody, project, report);
      }
    });
  });
}

} // namespace

DOTEK_LINT_RULE(repeated_branch){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
