#include "lint/PointedPictures.h"

#include <set>
#include <string>
#include <vector>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  eachPointedBlock(project, [&](const std::vector<ProgWord>& words, const std::set<std::string>& pointed) {
    const std::uint32_t program = macroCalled(words);
    for (const stdlib::MacroSet& set : project.macroSets) {
      const auto signatures = set.of(program);
      if (signatures.empty()) continue;
      for (const ProgWord& word : words) {
        if (word.hole == nullptr || !pointed.contains(word.hole->word->name)) continue;
        const stdlib::MacroArgument* argument = signatures.front()->find(word.address);
        if (argument == nullptr || argument->role != stdlib::ArgumentRole::System) continue;
        report.at(
            word.hole->range,
            "the number of a work offset is printed with the picture of lengths, as `{}56.`; macros that "
            "compare it with whole numbers take that, others do not; give it a keyword with a picture of "
            "its own",
            word.address);
      }
      break;
    }
  });
}

} // namespace

DOTEK_LINT_RULE(selector_with_point){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
