#include "lint/ProgBlocks.h"

#include <map>
#include <set>
#include <tuple>

namespace dotek::lint::rule {
namespace {

constexpr std::string_view kAddresses = "XYZABCIJKRDQF";

struct Place {
  std::size_t branch = 0;
  std::string digits;
  const ProgPiece* hole = nullptr;
  SourceRange range;
};

// Chains of words by numbers: equal chains have the same one.
class Chains {
public:
  // The number of the chain `before` (0: none) with a word more.
  std::size_t number(std::size_t before, const ProgWord& word) {
    std::string text(1, word.address);
    text += word.hole != nullptr ? "{}" : word.digits;
    return numbers_.try_emplace({before, std::move(text)}, numbers_.size() + 1).first->second;
  }

private:
  std::map<std::pair<std::size_t, std::string>, std::size_t> numbers_;
};

// A block with the value of one word left open: what is before the word, its address, what is after it.
using Pattern = std::tuple<std::size_t, char, std::size_t>;

std::vector<Pattern> patterns(const std::vector<ProgWord>& words, Chains& chains) {
  std::vector<Pattern> out;
  std::size_t chain = 0;
  for (const ProgWord& word : words) {
    out.emplace_back(chain, word.address, 0);
    chain = chains.number(chain, word);
  }
  chain = 0;
  for (std::size_t i = words.size(); i > 0; --i) {
    std::get<2>(out[i - 1]) = chain;
    chain = chains.number(chain, words[i - 1]);
  }
  return out;
}

void checkSiblings(const Siblings& siblings, const Project& project, Report& report) {
  std::map<Pattern, std::vector<Place>> places;
  Chains chains;
  const stdlib::Form* form = project.form;
  for (std::size_t b = 0; b < siblings.branches.size(); ++b) {
    for (const ProgBlock& block : siblings.branches[b].blocks) {
      if (block.called) continue;
      const std::vector<ProgWord> words = wordsOf(block, form);
      if (words.size() < 2) continue;
      const std::vector<Pattern> keys = patterns(words, chains);
      for (std::size_t i = 0; i < words.size(); ++i) {
        if (kAddresses.find(words[i].address) == std::string_view::npos) continue;
        places[keys[i]].push_back({b, words[i].digits, words[i].hole, words[i].range});
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
              std::get<char>(key), place.digits, open.size())
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
