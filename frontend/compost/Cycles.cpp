// On which cycles a condition depends.
#include "frontend/compost/Summary.h"

#include <algorithm>

namespace dotek::frontend::compost {

const std::string* cycleTested(const ConditionTerm& term) {
  const auto* word = std::get_if<Word>(&term.operand);
  if (word == nullptr || word->kind != WordKind::Boolean || word->name != "CycleType" ||
      word->arguments.size() != 1)
    return nullptr;
  return &word->arguments.front().text;
}

namespace {

std::optional<std::set<std::string>> cyclesOf(const ConditionTerm& term) {
  if (!term.nots.empty()) return std::nullopt;
  if (const auto* inner = std::get_if<std::unique_ptr<Condition>>(&term.operand)) return cyclesOf(**inner);
  if (const std::string* id = cycleTested(term)) return std::set<std::string>{*id};
  return std::nullopt;
}

} // namespace

std::optional<std::set<std::string>> cyclesOf(const Condition& condition) {
  const bool anyOr = std::find(condition.connectives.begin(), condition.connectives.end(), Connective::Or) !=
                     condition.connectives.end();
  std::optional<std::set<std::string>> result;
  for (const ConditionTerm& term : condition.terms) {
    const std::optional<std::set<std::string>> ids = cyclesOf(term);
    if (anyOr && !ids) return std::nullopt;
    if (!ids) continue;
    if (!result)
      result = ids;
    else if (anyOr)
      result->insert(ids->begin(), ids->end());
  }
  return result;
}

} // namespace dotek::frontend::compost
