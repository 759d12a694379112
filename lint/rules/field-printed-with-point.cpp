#include "lint/PointedPictures.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace dotek::lint::rule {
namespace {

// Addresses that the control refuses with a point, as in a program.
constexpr std::string_view kWhole = "MST";

// Letters of a call are arguments; codes of the builder call, too.
bool calls(const std::vector<ProgWord>& words) {
  return std::any_of(words.begin(), words.end(), [](const ProgWord& word) {
    return word.address == 'G' && (word.hole != nullptr || word.digits.size() > 2 || word.digits == "65" ||
                                   word.digits == "66" || word.digits == "67");
  });
}

void check(const Project& project, Report& report) {
  eachPointedBlock(project, [&](const std::vector<ProgWord>& words, const std::set<std::string>& pointed) {
    if (calls(words)) return;
    for (const ProgWord& word : words) {
      if (word.hole == nullptr || kWhole.find(word.address) == std::string_view::npos) continue;
      if (!pointed.contains(word.hole->word->name)) continue;
      report.at(
          word.hole->range,
          "`{0}` is printed with a picture that has a decimal point, as `{0}20.`; the control takes whole "
          "numbers alone there, and stops with an alarm; give it a keyword with a picture of its own, such "
          "as `'####;0'`",
          word.address);
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
