#include "lint/ProgBlocks.h"

#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

struct Leaf {
  SourceRange range; // of its first statement
  std::set<std::string> moves;
};

class Check {
public:
  Check(const Project& project, Report& report) : project_(project), report_(report) {}

  void body(const std::vector<compost::Statement>& statements) {
    for (const compost::Statement& statement : statements) {
      const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement);
      if (branch == nullptr || (*branch)->elseBody.empty()) continue;
      std::vector<Leaf> leaves;
      collect((*branch)->thenBody, leaves);
      collect((*branch)->elseBody, leaves);
      judge(leaves);
    }
  }

private:
  static const compost::If* onlyChoice(const std::vector<compost::Statement>& statements) {
    if (statements.size() != 1) return nullptr;
    const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statements.front());
    return branch != nullptr && !(*branch)->elseBody.empty() ? branch->get() : nullptr;
  }

  void collect(const std::vector<compost::Statement>& statements, std::vector<Leaf>& leaves) {
    if (const compost::If* inner = onlyChoice(statements)) {
      collect(inner->thenBody, leaves);
      collect(inner->elseBody, leaves);
      return;
    }
    if (statements.empty()) return;
    Leaf leaf{rangeOf(statements.front()), {}};
    bool prints = false;
    for (const compost::Statement& statement : statements) {
      if (std::holds_alternative<compost::Literal>(statement)) prints = true;
      const auto* word = std::get_if<compost::Word>(&statement);
      if (word != nullptr && movesAxis(word->name)) leaf.moves.insert(word->name);
    }
    if (prints || !leaf.moves.empty()) leaves.push_back(std::move(leaf));
  }

  bool movesAxis(const std::string& name) const {
    const auto entry = project_.form->commands.find(name);
    if (entry == project_.form->commands.end() || entry->second.value.empty()) return false;
    const std::size_t letter = entry->second.text.find_first_not_of(' ');
    return letter != std::string::npos &&
           std::string_view("XYZ").find(entry->second.text[letter]) != std::string_view::npos;
  }

  void judge(const std::vector<Leaf>& leaves) {
    if (leaves.size() < 3) return;
    std::map<std::string, std::size_t> counts;
    for (const Leaf& leaf : leaves)
      for (const std::string& move : leaf.moves)
        ++counts[move];
    for (const auto& [move, count] : counts) {
      if (count + 1 != leaves.size()) continue;
      for (const Leaf& leaf : leaves)
        if (!leaf.moves.contains(move))
          report_.at(leaf.range,
                     "this branch has no `{}`, the {} others have; the tool stays where it is here", move,
                     count);
    }
  }

  const Project& project_;
  Report& report_;
};

void check(const Project& project, Report& report) {
  if (!project.form) return;
  eachRoutine(project, [&](const compost::Program&, const compost::Routine& routine) {
    Check(project, report).body(routine.body);
  });
}

} // namespace

DOTEK_LINT_RULE(branch_without_move){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
