#include "lint/PointedPictures.h"
#include "lint/ProgBlocks.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace dotek::lint::rule {
namespace {

// Addresses that the control refuses with a point, as in a program.
constexpr std::string_view kWhole = "MST";

void check(const Project& project, Report& report) {
  const compost::Program* last = nullptr;
  std::set<std::string> pointed;
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    if (last != &prog) pointed = printedWithPoint(prog);
    last = &prog;
    for (const ProgBlock& block : blocksOf(routine.body, prog, project)) {
      if (block.called) continue;
      const std::vector<ProgWord> words = wordsOf(block, nullptr);
      // Letters of a call are arguments; codes of the builder call, too.
      const bool calls = std::any_of(words.begin(), words.end(), [](const ProgWord& word) {
        return word.address == 'G' && (word.hole != nullptr || word.digits.size() > 2 ||
                                       word.digits == "65" || word.digits == "66" || word.digits == "67");
      });
      if (calls) continue;
      for (const ProgWord& word : words) {
        if (word.hole == nullptr || kWhole.find(word.address) == std::string_view::npos) continue;
        const std::string& name = word.hole->word->name;
        if (!pointed.contains(name)) continue;
        report.at(
            word.hole->range,
            "`{0}` is printed with a picture that has a decimal point, as `{0}20.`; the control takes whole "
            "numbers alone there, and stops with an alarm; give it a keyword with a picture of its own, such "
            "as `'####;0'`",
            word.address);
      }
    }
  });
}

} // namespace

DOTEK_LINT_RULE(field_printed_with_point){
    .severity = Severity::Error,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
