#include "lint/LeastValues.h"
#include "lint/MacroNames.h"
#include "lint/ProgBlocks.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string_view>

namespace dotek::lint::rule {
namespace {

// The dialogs of all cycles that this value is printed for keep it from being negative.
bool isGuarded(const ProgPiece& value, const compost::Program& prog, const Project& project) {
  if (value.field.empty()) return false;
  const auto isThis = [&](const compost::FieldRef& field) {
    return field.range.file == value.range.file && field.range.begin >= value.range.begin &&
           field.range.end <= value.range.end;
  };
  bool any = false;
  for (const Joined& joined : project.joined) {
    if (joined.prog != &prog) continue;
    const std::string& id = joined.cycle->name;
    const auto routines = compost::printingRoutines(prog, project.compostKeywords, id);
    const bool printed = std::any_of(routines.begin(), routines.end(), [&](const compost::Routine* one) {
      const auto fields = compost::fieldsPrinted(prog, *one, id);
      return std::any_of(fields.begin(), fields.end(), isThis);
    });
    if (!printed) continue;
    const std::string field = printedFor(project, fieldsOf(*joined.cycle), value.field);
    if (!(LeastValues(*joined.cycle, project).of(field) >= 0)) return false;
    any = true;
  }
  return any;
}

// A work offset, a tool, an offset of a tool, a program: the number of something has no sign.
bool isSelector(char letter) {
  return std::string_view("GHLMNOPST").find(letter) != std::string_view::npos;
}

// `LT` of `IF[#624LT-`: an operator of a condition is no address.
bool endsInOperator(std::string_view text) {
  constexpr std::string_view kOperators[] = {"EQ", "NE", "GT", "LT", "GE", "LE"};
  return std::any_of(std::begin(kOperators), std::end(kOperators), [&](std::string_view one) {
    const std::string_view before = text.substr(0, text.size() - std::min(text.size(), one.size()));
    return text.ends_with(one) && !before.empty() &&
           std::isalpha(static_cast<unsigned char>(before.back())) == 0;
  });
}

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    if (prog.hasErrorNodes || !routine.returnRange) return; // told already
    for (const ProgBlock* block : ownBlocks(routine, prog, project)) {
      for (std::size_t i = 1; i < block->pieces.size(); ++i) {
        const ProgPiece& value = block->pieces[i];
        const ProgPiece& text = block->pieces[i - 1];
        if (value.kind != ProgPiece::Kind::Number || text.kind != ProgPiece::Kind::Text) continue;
        const std::string& before = text.literal->text;
        if (before.size() < 2 || (before.back() != '-' && before.back() != '+')) continue;
        if (std::isalpha(static_cast<unsigned char>(before[before.size() - 2])) == 0) continue;
        const char letter = before[before.size() - 2];
        const bool guarded = isGuarded(value, prog, project);
        const bool compared = endsInOperator(std::string_view(before).substr(0, before.size() - 1));
        if (guarded && before.back() == '-' && !compared && isSelector(letter)) {
          report
              .at(value.range,
                  "the text before this value ends in `{}-`, and the number of an offset, a tool or a "
                  "program has no "
                  "sign; take it out",
                  letter)
              .note(text.range, "the sign");
          continue;
        }
        if (guarded) continue;
        const std::string shown = before.substr(before.size() - (compared ? 3 : 2));
        report
            .at(value.range,
                "the text before this value ends in `{0}`, and a negative value prints its own sign; "
                "`{0}-5.` is "
                "no number, and the control stops with an alarm; turn the sign in the macro, take it out, or "
                "reject values below 0 in the dialog",
                shown)
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
