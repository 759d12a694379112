#include "lint/ProgBlocks.h"

#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::string_view kAddresses = "XYZABCIJKRDQF";

struct Place {
  std::size_t branch = 0;
  std::string digits;
  const ProgPiece* hole = nullptr;
  SourceRange range;
};

// The block with the value of one word left open: the others as they are written.
std::string pattern(const std::vector<ProgWord>& words, std::size_t open) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    out += words[i].address;
    if (i == open)
      out += "?";
    else
      out += words[i].hole != nullptr ? "{}" : words[i].digits;
    out += ' ';
  }
  return out;
}

void checkSiblings(const Siblings& siblings, const Project& project, Report& report) {
  std::map<std::string, std::vector<Place>> places;
  const stdlib::Form* form = project.form;
  for (std::size_t b = 0; b < siblings.branches.size(); ++b) {
    for (const ProgBlock& block : siblings.branches[b].blocks) {
      if (block.called) continue;
      const std::vector<ProgWord> words = wordsOf(block, form);
      if (words.size() < 2) continue;
      for (std::size_t i = 0; i < words.size(); ++i) {
        if (kAddresses.find(words[i].address) == std::string_view::npos) continue;
        places[pattern(words, i)].push_back({b, words[i].digits, words[i].hole, words[i].range});
      }
    }
  }
  for (const auto& [key, found] : places) {
    std::set<std::size_t> open;
    std::set<std::size_t> fixed;
    const ProgPiece* field = nullptr;
    for (const Place& place : found) {
      (place.hole != nullptr ? open : fixed).insert(place.branch);
      if (place.hole != nullptr && !place.hole->field.empty()) field = place.hole;
    }
    if (field == nullptr || open.size() < 2 || fixed.size() >= open.size()) continue;
    for (const Place& place : found) {
      if (place.hole != nullptr || place.digits.empty()) continue;
      report
          .at(place.range,
              "`{}{}` is fixed, and {} branches beside this one print a field here; the user's value is not "
              "used; print the field",
              key[key.find('?') - 1], place.digits, open.size())
          .note(field->range, fmt::format("the field `{}` is printed here", field->field));
    }
  }
}

void check(const Project& project, Report& report) {
  for (const Siblings& siblings : siblingsOf(project))
    checkSiblings(siblings, project, report);
}

} // namespace

DOTEK_LINT_RULE(hardcoded_value){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
