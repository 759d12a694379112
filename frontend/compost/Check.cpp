#include "frontend/compost/Check.h"

#include <algorithm>
#include <array>

namespace dotek::frontend::compost {

namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

bool defines(const stdlib::Form& form, std::string_view name, WordKind kind) {
  switch (kind) {
  case WordKind::Numeric: return form.numerics.contains(name);
  case WordKind::Boolean: return form.booleans.contains(name);
  case WordKind::Command: return form.commands.contains(name) || form.sequences.contains(name);
  }
  return false;
}

} // namespace

CheckedProg::CheckedProg(const Program& prog, const stdlib::ComPostKeywords& known, const SourceMap& files,
                         const stdlib::Form* form)
    : program(prog), keywords(known), sources(files), form_(form) {
  for (const Item& item : program.items) {
    const auto* routine = std::get_if<Routine>(&item);
    if (routine == nullptr) continue;
    routines.try_emplace(routine->name, routine->nameRange);
    std::string& first = routineCases_.try_emplace(lower(routine->name), routine->name).first->second;
    first = std::min(first, routine->name);
  }
  for (const Item& item : program.items)
    if (const auto* routine = std::get_if<Routine>(&item)) visit(routine->body);
  for (const Word* word : words)
    if (!calls(*word)) spell(word->name, word->kind, word->nameRange);
  for (const Item& item : program.items) {
    const auto* format = std::get_if<FormatDirective>(&item);
    if (format != nullptr && (format->kind != WordKind::Command || !routines.contains(format->name)))
      spell(format->name, format->kind, format->nameRange);
  }
}

void CheckedProg::visit(const std::vector<Statement>& body) {
  bodies.push_back(&body);
  for (const Statement& statement : body) {
    if (const auto* used = std::get_if<Word>(&statement)) {
      words.push_back(used);
    } else if (const auto* branch = std::get_if<std::unique_ptr<If>>(&statement)) {
      visit((*branch)->condition);
      visit((*branch)->thenBody);
      visit((*branch)->elseBody);
    }
  }
}

void CheckedProg::visit(const Condition& condition) {
  conditions.push_back(&condition);
  for (const ConditionTerm& term : condition.terms) {
    if (const auto* inner = std::get_if<std::unique_ptr<Condition>>(&term.operand)) {
      visit(**inner);
    } else if (const auto* operand = std::get_if<Word>(&term.operand)) {
      if (operand->kind == WordKind::Boolean) words.push_back(operand); // else the parser has said it
    }
  }
}

void CheckedProg::spell(std::string_view name, WordKind kind, SourceRange range) {
  const stdlib::ComPostKeyword* keyword = keywords.find(name);
  if (keyword == nullptr && form_ != nullptr && defines(*form_, name, kind)) return;
  // A known keyword with another suffix is wrong each time; what is not known is reported once.
  if (keyword == nullptr &&
      !spelt_.insert(std::string(name) + static_cast<char>('0' + static_cast<int>(kind))).second)
    return;
  spellings.push_back({name, kind, range});
}

std::span<const Check<CheckedProg>* const> progChecks() {
  static constexpr std::array kChecks = {
      &commentBraceCheck,  &duplicateRoutineCheck, &unknownKeywordCheck,      &keywordMisspeltCheck,
      &keywordCaseCheck,   &keywordKindCheck,      &keywordArgumentCheck,     &unverifiedInProgCheck,
      &badPictureCheck,    &duplicatePictureCheck, &duplicateFormatCheck,     &formatWithoutPictureCheck,
      &pictureUnusedCheck, &flagNeverSetCheck,     &routineHidesKeywordCheck, &routineNeverCalledCheck,
  };
  return kChecks;
}

void check(const Program& program, const stdlib::ComPostKeywords& keywords, const SourceMap& sources,
           Diagnostics& diagnostics) {
  runChecks(progChecks(), CheckedProg(program, keywords, sources), diagnostics);
}

} // namespace dotek::frontend::compost
