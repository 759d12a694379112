#include "frontend/compost/Conditions.h"
#include "frontend/compost/Slips.h"
#include "support/NearestName.h"
#include "support/messages/ComPost.h"

#include <algorithm>

namespace dotek::frontend::compost {
namespace {

void collectSetters(const std::vector<Statement>& body, const Routine& routine,
                    std::map<std::string, const Routine*, std::less<>>& setters) {
  for (const Statement& statement : body) {
    if (const auto* word = std::get_if<Word>(&statement)) {
      if (word->name == kSetFlagKeyword && word->arguments.size() == 1)
        setters.emplace(word->arguments.front().text, &routine);
    } else if (const auto* branch = std::get_if<std::unique_ptr<If>>(&statement)) {
      collectSetters((*branch)->thenBody, routine, setters);
      collectSetters((*branch)->elseBody, routine, setters);
    }
  }
}

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

// "; or did you mean .." with a condition that the form or the language knows; "": none is near.
std::string meantBoolean(const std::string& name, const stdlib::Form& form) {
  NearestName nearest(name);
  nearest.offer(kCycleKeyword);
  nearest.offer(kFlagKeyword);
  for (const auto& [known, entry] : form.booleans)
    nearest.offer(known);
  return isSlip(name, nearest.result()) ? "; or did you mean `" + nearest.result() + "?`?" : "";
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

Conditions::Conditions(const Program& program, const stdlib::Form& form,
                       const std::set<std::string>& assumptions)
    : form_(&form), assumptions_(&assumptions) {
  auto setters = std::make_shared<std::map<std::string, const Routine*, std::less<>>>();
  for (const Item& item : program.items) {
    if (const auto* routine = std::get_if<Routine>(&item)) collectSetters(routine->body, *routine, *setters);
  }
  setters_ = std::move(setters);
}

void Conditions::setFlag(const Word& word, Diagnostics& diagnostics) {
  if (word.arguments.size() == 1)
    flags_[word.arguments.front().text] = word.name == kSetFlagKeyword;
  else
    diagnostics.report<diag::FlagNeedsName>(word.range, word.name);
}

Truth Conditions::truth(const Condition& condition, Diagnostics& diagnostics) {
  std::vector<Truth> terms;
  terms.reserve(condition.terms.size());
  for (const ConditionTerm& term : condition.terms)
    terms.push_back(truth(term, diagnostics));
  if (terms.empty()) return std::nullopt;
  const Truth plain = leftToRight(terms, condition.connectives);
  const Truth grouped = andBeforeOr(terms, condition.connectives);
  Truth result = plain;
  if (plain != grouped) {
    if (assumptions_->contains("and-before-or")) {
      result = grouped;
    } else if (!assumptions_->contains("left-to-right")) {
      diagnostics.report<diag::AndOrOrder>(condition.range);
      return std::nullopt;
    }
  }
  if (result) return result;
  for (const ConditionTerm& term : condition.terms) {
    const auto* word = std::get_if<Word>(&term.operand);
    if (word == nullptr || truth(*word, diagnostics)) continue;
    if (word->name == kCycleKeyword || word->name == kFlagKeyword)
      diagnostics.report<diag::FlagNeedsName>(word->range, word->name + "?");
    else if (told_.insert(assumed(*word)).second)
      diagnostics.report<diag::BooleanUnknown>(word->range, assumed(*word), form_->origin,
                                               meantBoolean(word->name, *form_));
  }
  return std::nullopt;
}

Truth Conditions::truth(const ConditionTerm& term, Diagnostics& diagnostics) {
  Truth result;
  if (const auto* word = std::get_if<Word>(&term.operand)) result = truth(*word, diagnostics);
  if (const auto* inner = std::get_if<std::unique_ptr<Condition>>(&term.operand))
    result = truth(**inner, diagnostics);
  if (result && term.nots.size() % 2 == 1) result = !*result;
  return result;
}

Truth Conditions::truth(const Word& boolean, Diagnostics& diagnostics) {
  if (boolean.kind != WordKind::Boolean) return std::nullopt;
  if (boolean.name == kCycleKeyword && boolean.arguments.size() == 1)
    return boolean.arguments.front().text == cycle;
  if (boolean.name == kFlagKeyword && boolean.arguments.size() == 1) {
    // A flag that was never set reads false (compost.md 4.5, inferred).
    const std::string& name = boolean.arguments.front().text;
    const auto flag = flags_.find(name);
    if (flag != flags_.end()) return flag->second;
    if (const auto setter = setters_->find(name); setter != setters_->end())
      diagnostics.report<diag::FlagSetElsewhere>(boolean.range, name, setter->second->name);
    return false;
  }
  if (assumptions_->contains(assumed(boolean) + "=yes")) return true;
  if (assumptions_->contains(assumed(boolean) + "=no")) return false;
  if (!boolean.arguments.empty()) return std::nullopt;
  const auto known = form_->booleans.find(boolean.name);
  if (known != form_->booleans.end()) {
    const bool value = known->second.value;
    if (!known->second.observed && told_.insert(boolean.name).second)
      diagnostics.report<diag::FormAssumed>(boolean.range, boolean.name + "?", form_->name,
                                            "that `" + boolean.name + "?` is " + (value ? "true" : "false"),
                                            form_->origin);
    return value;
  }
  return std::nullopt;
}

} // namespace dotek::frontend::compost
