#include "frontend/macrob/Calls.h"
#include "lint/Lathe.h"
#include "lint/Project.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

namespace dotek::lint::rule {
namespace {

using Code = std::pair<char, std::uint32_t>; // letter, ten times the number

bool lists(const stdlib::Control& control, const Code& code) {
  const char letter = code.first;
  const std::uint32_t tenths = code.second;
  return control.find(letter, tenths) != nullptr ||
         std::any_of(control.callCodes.begin(), control.callCodes.end(), [&](const stdlib::CallCode& call) {
           return call.letter == letter && tenths % 10 == 0 && tenths / 10 >= call.first &&
                  tenths / 10 < call.first + call.count;
         });
}

std::string text(const Code& code) {
  return fmt::format("{}{}", code.first, code.second / 10) +
         (code.second % 10 != 0 ? fmt::format(".{}", code.second % 10) : "");
}

// M32 for M23 where a profile lists it.
std::optional<Code> listedSwapped(const Code& code, const Project& project) {
  const std::uint32_t number = code.second / 10;
  if (code.second % 10 != 0 || number < 10 || number > 99 || number % 10 == number / 10) return std::nullopt;
  const Code swapped{code.first, (number % 10 * 10 + number / 10) * 10};
  const bool known =
      std::any_of(project.controls.begin(), project.controls.end(), [&](const stdlib::Control& control) {
        return number % 10 != 0 && lists(control, swapped);
      });
  return known ? std::optional(swapped) : std::nullopt;
}

// Of one file: what another one has, or suppresses, changes nothing.
void checkFile(const macrob::File& file, const Project& project, Report& report) {
  const bool named = project.control != nullptr && project.control->turning;
  if (!named && lathesOf(project).contains(&file)) return;
  std::vector<std::pair<Code, SourceRange>> unlisted; // in the order of the text, each code once
  for (const macrob::Program& program : file.programs)
    for (const macrob::Block& block : program.blocks) {
      const auto* words = std::get_if<macrob::Words>(&block.body);
      if (words == nullptr) continue;
      for (const frontend::nc::Word& word : words->words) {
        if (word.address != 'G' && word.address != 'M') continue;
        const auto value = macrob::literal(word);
        if (!value || *value < 0 || *value > 99999) continue;
        const Code code{word.address, static_cast<std::uint32_t>(std::lround(*value * 10))};
        const auto listed = [&](const stdlib::Control& control) { return lists(control, code); };
        if (project.control != nullptr
                ? listed(*project.control)
                : std::any_of(project.controls.begin(), project.controls.end(), listed))
          continue;
        // M codes are the builder's: without a machine's profile nobody can list them, and only what looks
        // like another one is reported.
        if (word.address == 'M' && project.control == nullptr && !listedSwapped(code, project)) continue;
        if (std::none_of(unlisted.begin(), unlisted.end(),
                         [&](const auto& one) { return one.first == code; }))
          unlisted.emplace_back(code, word.range);
      }
    }
  if (unlisted.empty()) return;
  if (project.control != nullptr) {
    for (const auto& [code, range] : unlisted)
      report.at(range,
                "`{}` does not list {}; a run ends here, and the machine stops with an alarm where it does "
                "not have "
                "the code either; correct it, or describe it in the control's file",
                project.control->name, text(code));
    return;
  }
  // Nobody has said which control it is: one note for all codes.
  std::string names;
  for (const auto& [code, range] : unlisted) {
    names += (names.empty() ? "" : ", ") + text(code);
    if (const auto other = code.first == 'M' ? listedSwapped(code, project) : std::nullopt)
      names += fmt::format(" (one lists {}, which has these digits the other way round)", text(*other));
  }
  Diagnostic& found =
      report.at(unlisted.front().second,
                "no profile of Dotek lists {}; where the machine has no such code it stops with an "
                "alarm, and a run ends there; `--control` names the control, whose file can list it",
                names);
  found.severity = Severity::Note;
  for (std::size_t i = 1; i < unlisted.size(); ++i)
    found.note(unlisted[i].second, text(unlisted[i].first) + " first appears here");
}

void check(const Project& project, Report& report) {
  for (const NcFile& nc : project.programs)
    checkFile(*nc.file, project, report);
}

} // namespace

DOTEK_LINT_RULE(code_not_listed){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
