#include "lint/LeastValues.h"
#include "lint/MacroNames.h"
#include "lint/ProgBlocks.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace dotek::lint::rule {
namespace {

// The dialogs of all cycles that this value is printed for keep it from being negative.
bool isGuarded(const ProgPiece& value, const compost::Program& prog, const Project& project) {
  if (value.field.empty()) return false;
  bool any = false;
  for (const Joined& joined : project.joined) {
    if (joined.prog != &prog) continue;
    for (const compost::BranchRef& branch : compost::branchesOf(prog, joined.cycle->name)) {
      SourceRange range = branch.branch->range;
      if (const auto& other = branch.branch->elseRange)
        (branch.elsePart ? range.begin : range.end) = other->begin;
      if (range.file != value.range.file || value.range.begin < range.begin || value.range.end > range.end)
        continue;
      const std::string field = printedFor(project, fieldsOf(*joined.cycle), value.field);
      if (!(LeastValues(*joined.cycle, project).of(field) >= 0)) return false;
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
