#include "lint/ProgBlocks.h"

#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

// The blocks that lead to one measurement.
struct Approach {
  SourceRange measure;
  std::set<std::string> steps; // commands that the form prints as an axis
};

bool movesAxis(const Project& project, const std::string& name) {
  const auto entry = project.form->commands.find(name);
  if (entry == project.form->commands.end() || entry->second.value.empty()) return false;
  const std::size_t letter = entry->second.text.find_first_not_of(' ');
  return letter != std::string::npos &&
         std::string_view("XYZ").find(entry->second.text[letter]) != std::string_view::npos;
}

void check(const Project& project, Report& report) {
  if (!project.form) return;
  for (const Siblings& siblings : siblingsOf(project)) {
    std::vector<Approach> all;
    for (const CycleBranch& branch : siblings.branches) {
      Approach approach;
      for (const ProgBlock& block : branch.blocks) {
        if (!block.called)
          for (const ProgPiece& piece : block.pieces)
            if (piece.kind == ProgPiece::Kind::Command && movesAxis(project, piece.word->name))
              approach.steps.insert(piece.word->name);
        if (!meaningOf(project, macroCalled(wordsOf(block, project.form))).measures()) continue;
        approach.measure = block.range;
        all.push_back(std::move(approach));
        approach = {};
      }
    }
    std::map<std::string, std::size_t> counts;
    for (const Approach& approach : all)
      for (const std::string& step : approach.steps)
        ++counts[step];
    for (const auto& [step, count] : counts) {
      if (all.size() < 3 || count * 2 <= all.size()) continue;
      for (const Approach& approach : all) {
        if (approach.steps.contains(step)) continue;
        report.at(
            approach.measure,
            "the path to this measurement has no `{}`, the path to {} of {} others has; the probe goes down "
            "in one move; add the step if the part may be in the way",
            step, count, all.size() - 1);
      }
    }
  }
}

} // namespace

DOTEK_LINT_RULE(approach_step_missing){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
