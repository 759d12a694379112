#include "lint/ProgBlocks.h"

#include <algorithm>
#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

// All places are `#` and nothing is given for 0: it prints nothing then.
bool printsNothingForZero(const std::string& picture) {
  return picture.find('#') != std::string::npos && picture.find_first_not_of("#.") == std::string::npos &&
         std::count(picture.begin(), picture.end(), '.') <= 1;
}

void check(const Project& project, Report& report) {
  for (const compost::Program* prog : project.progs) {
    std::map<std::uint32_t, const compost::PictureDefinition*> silent;
    std::map<std::string, const compost::PictureDefinition*> keywords;
    for (const compost::Item& item : prog->items)
      if (const auto* picture = std::get_if<compost::PictureDefinition>(&item))
        if (printsNothingForZero(picture->picture.text)) silent.emplace(picture->number, picture);
    for (const compost::Item& item : prog->items)
      if (const auto* format = std::get_if<compost::FormatDirective>(&item))
        if (const auto at = silent.find(format->number); at != silent.end())
          keywords.emplace(format->name, at->second);
    if (keywords.empty()) continue;
    std::set<std::string> told;
    for (const compost::Item& item : prog->items) {
      const auto* routine = std::get_if<compost::Routine>(&item);
      if (routine == nullptr) continue;
      for (const ProgBlock& block : blocksOf(routine->body, *prog, project)) {
        for (const ProgWord& word : wordsOf(block, nullptr)) {
          if (word.hole == nullptr) continue;
          const auto at = keywords.find(word.hole->word->name);
          if (at == keywords.end() || !told.insert(at->first).second) continue;
          report
              .at(at->second->picture.range,
                  "this picture prints nothing for 0, and `{}#` follows the address `{}`; the control "
                  "gets a "
                  "bare address and stops with an alarm, or reads 0; write `{};0`",
                  at->first, word.address, at->second->picture.text)
              .note(word.hole->range, "printed here");
        }
      }
    }
  }
}

} // namespace

DOTEK_LINT_RULE(picture_without_zero){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
