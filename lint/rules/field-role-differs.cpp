#include "lint/ProgBlocks.h"

#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

struct Use {
  stdlib::ArgumentRole role = stdlib::ArgumentRole::Target;
  char letter = 0;
  std::string cycle;
  SourceRange range;
};

void check(const Project& project, Report& report) {
  for (const Siblings& siblings : siblingsOf(project)) {
    std::map<std::string, std::vector<Use>> uses; // by field
    for (const CycleBranch& branch : siblings.branches) {
      for (const ProgBlock& block : branch.blocks) {
        const std::vector<ProgWord> words = wordsOf(block, nullptr);
        const std::uint32_t program = macroCalled(words);
        const MacroMeaning meaning = meaningOf(project, program);
        if (!meaning.measures()) continue;
        for (const ProgWord& word : words) {
          if (word.hole == nullptr || word.hole->field.empty()) continue;
          for (const stdlib::MacroSignature* signature : meaning.set->of(program)) {
            const stdlib::MacroArgument* argument = signature->find(word.address);
            if (argument == nullptr) continue;
            uses[word.hole->field].push_back({argument->role, word.address, branch.id, word.hole->range});
            break;
          }
        }
      }
    }
    for (const auto& [field, found] : uses) {
      const Use* target = nullptr;
      for (const Use& use : found)
        if (use.role == stdlib::ArgumentRole::Target && target == nullptr) target = &use;
      if (target == nullptr) continue;
      for (const Use& use : found) {
        if (use.role != stdlib::ArgumentRole::Nominal || use.cycle == target->cycle) continue;
        report
            .at(target->range,
                "the field `{}` is the path to the surface here (`{}`), and the coordinate of the surface "
                "for "
                "`{}` "
                "(`{}`); one name with two meanings is easily filled in wrong",
                field, target->letter, use.cycle, use.letter)
            .note(use.range, "the coordinate");
        break;
      }
    }
  }
}

} // namespace

DOTEK_LINT_RULE(field_role_differs){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
