#include "frontend/compost/PostRun.h"

#include <algorithm>

namespace dotek::frontend::compost {
namespace {

Truth both(Truth a, Truth b) {
  if ((a && !*a) || (b && !*b)) return false;
  if (!a || !b) return std::nullopt;
  return true;
}

Truth either(Truth a, Truth b) {
  if ((a && *a) || (b && *b)) return true;
  if (!a || !b) return std::nullopt;
  return false;
}

// What `--assume` calls the condition: `Word?`, with an argument `Word?(name)`.
std::string assumed(const Word& boolean) {
  std::string out = boolean.name + "?";
  for (std::size_t i = 0; i < boolean.arguments.size(); ++i)
    out += (i == 0 ? "(" : ",") + boolean.arguments[i].text;
  return boolean.arguments.empty() ? out : out + ")";
}

Truth leftToRight(const std::vector<Truth>& terms, const std::vector<Connective>& connectives) {
  Truth result = terms.front();
  for (std::size_t i = 0; i < connectives.size(); ++i)
    result = connectives[i] == Connective::And ? both(result, terms[i + 1]) : either(result, terms[i + 1]);
  return result;
}

Truth andBeforeOr(const std::vector<Truth>& terms, const std::vector<Connective>& connectives) {
  Truth result = false;
  Truth group = terms.front();
  for (std::size_t i = 0; i < connectives.size(); ++i) {
    if (connectives[i] == Connective::And) {
      group = both(group, terms[i + 1]);
    } else {
      result = either(result, group);
      group = terms[i + 1];
    }
  }
  return either(result, group);
}

} // namespace

bool PostRun::Impl::holds(const Condition& condition) {
  // An operand that decides nothing may stay unknown; one that decides was reported by truth().
  return truth(condition).value_or(false);
}

Truth PostRun::Impl::truth(const Condition& condition) {
  std::vector<Truth> terms;
  terms.reserve(condition.terms.size());
  for (const ConditionTerm& term : condition.terms)
    terms.push_back(truth(term));
  if (terms.empty()) return std::nullopt;
  const Truth plain = leftToRight(terms, condition.connectives);
  const Truth grouped = andBeforeOr(terms, condition.connectives);
  Truth result = plain;
  if (plain != grouped) {
    if (settings.assumptions.contains("and-before-or")) {
      result = grouped;
    } else if (!settings.assumptions.contains("left-to-right")) {
      diagnostics.report<diag::AndOrOrder>(condition.range);
      return std::nullopt;
    }
  }
  if (result) return result;
  for (const ConditionTerm& term : condition.terms) {
    const auto* word = std::get_if<Word>(&term.operand);
    if (word == nullptr || truth(*word)) continue;
    if (word->name == kCycleKeyword || word->name == kFlagKeyword)
      diagnostics.report<diag::FlagNeedsName>(word->range, word->name + "?");
    else if (tell(diag::BooleanUnknown::code, assumed(*word)))
      diagnostics.report<diag::BooleanUnknown>(word->range, assumed(*word), settings.form.origin);
  }
  return std::nullopt;
}

Truth PostRun::Impl::truth(const ConditionTerm& term) {
  Truth result;
  if (const auto* word = std::get_if<Word>(&term.operand)) result = truth(*word);
  if (const auto* inner = std::get_if<std::unique_ptr<Condition>>(&term.operand)) result = truth(**inner);
  if (result && term.nots.size() % 2 == 1) result = !*result;
  return result;
}

Truth PostRun::Impl::truth(const Word& boolean) {
  if (boolean.kind != WordKind::Boolean) return std::nullopt;
  if (boolean.name == kCycleKeyword && boolean.arguments.size() == 1)
    return boolean.arguments.front().text == operation->cycle;
  if (boolean.name == kFlagKeyword && boolean.arguments.size() == 1) {
    // A flag that was never set reads false (compost.md 4.5, inferred).
    const std::string& name = boolean.arguments.front().text;
    const auto flag = flags.find(name);
    if (flag != flags.end()) return flag->second;
    if (const auto setter = flagSetters.find(name); setter != flagSetters.end())
      diagnostics.report<diag::FlagSetElsewhere>(boolean.range, name, setter->second->name);
    return false;
  }
  if (settings.assumptions.contains(assumed(boolean) + "=yes")) return true;
  if (settings.assumptions.contains(assumed(boolean) + "=no")) return false;
  if (!boolean.arguments.empty()) return std::nullopt;
  const auto known = settings.form.booleans.find(boolean.name);
  if (known != settings.form.booleans.end()) return known->second.value;
  return std::nullopt;
}

} // namespace dotek::frontend::compost
