#include "lint/MacroNames.h"
#include "lint/ProgBlocks.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace dotek::lint::rule {
namespace {

// `if DEPTH < 0 then ..`: the rest of the macro sees no value below 0.
bool turnsAwayNegative(const gibbs::Comparison& comparison, const std::string& field) {
  using gibbs::Relation;
  if (!comparison.nots.empty() || !comparison.left || !comparison.right) return false;
  const auto is = [&](const gibbs::Expression& side) {
    const gibbs::Name* name = plainName(side);
    return name != nullptr && gibbs::foldCase(name->text) == field;
  };
  const auto from = [](const gibbs::Expression& side) {
    const std::optional<double> number = plainNumber(side);
    return number && *number >= 0;
  };
  if (is(*comparison.left) && from(*comparison.right))
    return comparison.relation == Relation::Less || comparison.relation == Relation::LessEqual;
  return is(*comparison.right) && from(*comparison.left) &&
         (comparison.relation == Relation::Greater || comparison.relation == Relation::GreaterEqual);
}

// What follows a check: an error that is counted, a message, the dialog again.
bool isRejection(const gibbs::Statement& statement) {
  return std::holds_alternative<gibbs::Assignment>(statement.node) ||
         std::holds_alternative<gibbs::Goto>(statement.node) || commandName(statement) == "MESSAGE";
}

bool isGuarded(const gibbs::Cycle& cycle, const std::string& field) {
  bool out = false;
  if (!cycle.cycleData || cycle.cycleData->hasErrorNodes) return false;
  eachStatement(*cycle.cycleData, [&](const gibbs::Statement& statement) {
    const auto* branch = std::get_if<gibbs::If>(&statement.node);
    if (branch == nullptr || !branch->then || !isRejection(*branch->then)) return;
    // Of several comparisons each alone rejects the value where OR joins them.
    const auto& all = branch->condition.connectives;
    if (std::any_of(all.begin(), all.end(),
                    [](gibbs::Connective one) { return one != gibbs::Connective::Or; }))
      return;
    for (const gibbs::Comparison& comparison : branch->condition.comparisons)
      out = out || turnsAwayNegative(comparison, field);
  });
  return out;
}

// The dialogs of all cycles that this value is printed for keep it from being negative.
bool isGuarded(const ProgPiece& value, const compost::Program& prog, const Project& project) {
  if (value.field.empty()) return false;
  bool any = false;
  for (const Joined& joined : project.joined) {
    if (joined.prog != &prog) continue;
    for (const compost::BranchRef& branch : compost::branchesOf(prog, joined.cycle->name)) {
      const SourceRange range = branch.branch->range;
      if (range.file != value.range.file || value.range.begin < range.begin || value.range.end > range.end)
        continue;
      if (!isGuarded(*joined.cycle, printedFor(project, fieldsOf(*joined.cycle), value.field))) return false;
      any = true;
    }
  }
  return any;
}

// A work offset, a tool, an offset of a tool, a program: the number of something has no sign.
bool isSelector(char letter) {
  return std::string_view("GHLMNOPST").find(letter) != std::string_view::npos;
}

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    if (prog.hasErrorNodes || !routine.returnRange) return; // told already
    for (const ProgBlock& block : blocksOf(routine.body, prog, project)) {
      if (block.called) continue;
      for (std::size_t i = 1; i < block.pieces.size(); ++i) {
        const ProgPiece& value = block.pieces[i];
        const ProgPiece& text = block.pieces[i - 1];
        if (value.kind != ProgPiece::Kind::Number || text.kind != ProgPiece::Kind::Text) continue;
        const std::string& before = text.literal->text;
        if (before.size() < 2 || (before.back() != '-' && before.back() != '+')) continue;
        if (std::isalpha(static_cast<unsigned char>(before[before.size() - 2])) == 0) continue;
        const char letter = before[before.size() - 2];
        if (before.back() == '-' && isSelector(letter) && isGuarded(value, prog, project)) {
          report
              .at(value.range,
                  "the text before this value ends in `{}-`, and the number of an offset, a tool or a "
                  "program has no "
                  "sign; take it out",
                  letter)
              .note(text.range, "the sign");
          continue;
        }
        if (isGuarded(value, prog, project)) continue;
        report
            .at(value.range,
                "the text before this value ends in `{}`, and a negative value prints its own sign; `{}--5.` "
                "is "
                "no number, and the control stops with an alarm; turn the sign in the macro, take it out, or "
                "reject values below 0 in the dialog",
                before.substr(before.size() - 2), before[before.size() - 2])
            .note(text.range, "the sign");
      }
    }
  });
}

} // namespace

DOTEK_LINT_RULE(sign_before_field){
    .severity = Severity::Warning,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
