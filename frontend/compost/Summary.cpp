#include "frontend/compost/Summary.h"

#include <algorithm>
#include <functional>
#include <set>

namespace dotek::frontend::compost {

namespace {

// Calls `visit(id, negated)` for each test of a cycle.
void eachCycleTest(const Condition& condition, bool negated,
                   const std::function<void(const std::string&, bool)>& visit) {
  for (const ConditionTerm& term : condition.terms) {
    const bool here = negated != (term.nots.size() % 2 == 1);
    if (const std::string* id = cycleTested(term)) visit(*id, here);
    if (const auto* inner = std::get_if<std::unique_ptr<Condition>>(&term.operand))
      eachCycleTest(**inner, here, visit);
  }
}

void eachIf(const std::vector<Statement>& statements, const std::function<void(const If&)>& visit) {
  for (const Statement& statement : statements) {
    const auto* branch = std::get_if<std::unique_ptr<If>>(&statement);
    if (branch == nullptr) continue;
    visit(**branch);
    eachIf((*branch)->thenBody, visit);
    eachIf((*branch)->elseBody, visit);
  }
}

// Routines that were entered: calls may be recursive.
using Seen = std::set<const Routine*>;

bool prints(const std::vector<Statement>& statements, const Program& program,
            const stdlib::ComPostKeywords& keywords, Seen& seen) {
  const auto one = [&](const Statement& statement) {
    if (const auto* literal = std::get_if<Literal>(&statement)) return !literal->text.empty();
    if (std::holds_alternative<EndOfLine>(statement)) return true;
    if (const auto* branch = std::get_if<std::unique_ptr<If>>(&statement))
      return prints((*branch)->thenBody, program, keywords, seen) ||
             prints((*branch)->elseBody, program, keywords, seen);
    const auto* word = std::get_if<Word>(&statement);
    if (word == nullptr || word->kind == WordKind::Boolean) return false;
    if (word->kind == WordKind::Numeric) return true;
    if (const Routine* routine = findRoutine(program, word->name))
      return seen.insert(routine).second && prints(routine->body, program, keywords, seen);
    const stdlib::ComPostKeyword* keyword = keywords.find(word->name);
    return keyword == nullptr || keyword->prints != stdlib::Prints::No;
  };
  return std::any_of(statements.begin(), statements.end(), one);
}

void collectFields(const std::vector<Statement>& statements, const Program& program, std::string_view cycleId,
                   Seen& seen, std::vector<FieldRef>& fields) {
  for (const Statement& statement : statements) {
    if (const auto* branch = std::get_if<std::unique_ptr<If>>(&statement)) {
      const auto cycles = cyclesOf((*branch)->condition);
      const bool never = cycles && !cycles->contains(std::string(cycleId));
      const bool always = cycles && !never && (*branch)->condition.terms.size() == 1;
      if (!never) collectFields((*branch)->thenBody, program, cycleId, seen, fields);
      if (!always) collectFields((*branch)->elseBody, program, cycleId, seen, fields);
      continue;
    }
    const auto* word = std::get_if<Word>(&statement);
    if (word == nullptr) continue;
    if (word->kind == WordKind::Numeric && word->name == "OpFieldData") {
      for (const Literal& argument : word->arguments)
        fields.push_back({argument.text, argument.range});
    } else if (word->kind == WordKind::Command) {
      const Routine* routine = findRoutine(program, word->name);
      if (routine == nullptr || !seen.insert(routine).second) continue;
      collectFields(routine->body, program, cycleId, seen, fields);
    }
  }
}

} // namespace

const Routine* findRoutine(const Program& program, std::string_view name) {
  const auto found = program.routines.find(name);
  return found == program.routines.end() ? nullptr : &std::get<Routine>(program.items[found->second]);
}

std::vector<std::string> cycleIds(const Program& program) {
  std::vector<std::string> ids;
  std::set<std::string> known;
  for (const Item& item : program.items) {
    const auto* routine = std::get_if<Routine>(&item);
    if (routine == nullptr) continue;
    eachIf(routine->body, [&](const If& branch) {
      eachCycleTest(branch.condition, false, [&](const std::string& id, bool) {
        if (known.insert(id).second) ids.push_back(id);
      });
    });
  }
  return ids;
}

std::vector<BranchRef> branchesOf(const Program& program, std::string_view cycleId) {
  std::vector<BranchRef> branches;
  for (const Item& item : program.items) {
    const auto* routine = std::get_if<Routine>(&item);
    if (routine == nullptr) continue;
    eachIf(routine->body, [&](const If& branch) {
      bool positive = false;
      bool negative = false;
      eachCycleTest(branch.condition, false, [&](const std::string& id, bool negated) {
        if (id == cycleId) (negated ? negative : positive) = true;
      });
      if (positive) branches.push_back({&branch, routine, false});
      if (negative) branches.push_back({&branch, routine, true});
    });
  }
  return branches;
}

bool prints(const std::vector<Statement>& statements, const Program& program,
            const stdlib::ComPostKeywords& keywords) {
  Seen seen;
  return prints(statements, program, keywords, seen);
}

namespace {

// Prints by itself or calls a routine that may.
bool acts(const std::vector<Statement>& statements, const stdlib::ComPostKeywords& keywords) {
  return std::any_of(statements.begin(), statements.end(), [&](const Statement& statement) {
    if (const auto* literal = std::get_if<Literal>(&statement)) return !literal->text.empty();
    if (const auto* branch = std::get_if<std::unique_ptr<If>>(&statement))
      return acts((*branch)->thenBody, keywords) || acts((*branch)->elseBody, keywords);
    const auto* word = std::get_if<Word>(&statement);
    if (word == nullptr) return std::holds_alternative<EndOfLine>(statement);
    if (word->kind != WordKind::Command) return word->kind == WordKind::Numeric;
    const stdlib::ComPostKeyword* keyword = keywords.find(word->name);
    return keyword == nullptr || keyword->prints != stdlib::Prints::No;
  });
}

} // namespace

std::vector<const Routine*> cycleRoutines(const Program& program, const stdlib::ComPostKeywords& keywords) {
  std::vector<const Routine*> found;
  for (const Item& item : program.items) {
    const auto* routine = std::get_if<Routine>(&item);
    if (routine == nullptr) continue;
    bool runs = false;
    eachIf(routine->body, [&](const If& branch) {
      if (runs) return;
      bool tested = false;
      eachCycleTest(branch.condition, false, [&](const std::string&, bool) { tested = true; });
      runs = tested && (acts(branch.thenBody, keywords) || acts(branch.elseBody, keywords));
    });
    if (runs) found.push_back(routine);
  }
  return found;
}

std::vector<const Routine*> printingRoutines(const Program& program, const stdlib::ComPostKeywords& keywords,
                                             std::string_view cycleId) {
  std::vector<const Routine*> routines;
  for (const BranchRef& branch : branchesOf(program, cycleId)) {
    if (std::find(routines.begin(), routines.end(), branch.routine) != routines.end()) continue;
    if (prints(branch.body(), program, keywords)) routines.push_back(branch.routine);
  }
  if (!routines.empty()) return routines;
  // Its branch only sets a flag, and what prints for it is the ELSE of the others, or asks for the flag.
  for (const BranchRef& branch : branchesOf(program, cycleId))
    if (std::find(routines.begin(), routines.end(), branch.routine) == routines.end() &&
        prints(branch.routine->body, program, keywords))
      routines.push_back(branch.routine);
  return routines;
}

std::vector<FieldRef> fieldsPrinted(const Program& program, const Routine& routine,
                                    std::string_view cycleId) {
  Seen seen{&routine};
  std::vector<FieldRef> fields;
  collectFields(routine.body, program, cycleId, seen, fields);
  return fields;
}

std::vector<FieldRef> fieldsPrinted(const Program& program, const BranchRef& branch,
                                    std::string_view cycleId) {
  Seen seen{branch.routine};
  std::vector<FieldRef> fields;
  collectFields(branch.body(), program, cycleId, seen, fields);
  return fields;
}

} // namespace dotek::frontend::compost
