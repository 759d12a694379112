#include "lint/MacroNames.h"
#include "lint/ProgBlocks.h"

namespace dotek::lint::rule {
namespace {

struct PathMove {
  SourceRange range;
  const gibbs::Expression* z = nullptr;
  bool movesXY = false; // a move to a point that is computed
  bool homeXY = false;  // a move to 0, 0
};

std::vector<PathMove> movesOf(const gibbs::Macro& toolPath) {
  std::vector<PathMove> out;
  eachStatement(toolPath, [&](const gibbs::Statement& statement) {
    const auto* command = std::get_if<gibbs::Command>(&statement.node);
    if (command == nullptr || gibbs::foldCase(command->name.text) != "ADD_CUSTOM_DRILL_CYCLE_PATH") return;
    if (command->arguments.empty()) return;
    const gibbs::Name* kind = plainName(*command->arguments.front());
    const std::string word = kind == nullptr ? "" : gibbs::foldCase(kind->text);
    PathMove move;
    move.range = statement.range;
    if (word == "FEED_Z" && command->arguments.size() == 2) {
      move.z = command->arguments[1].get();
    } else if (word == "FEED" && command->arguments.size() == 4) {
      move.z = command->arguments[3].get();
      const auto x = plainNumber(*command->arguments[1]);
      const auto y = plainNumber(*command->arguments[2]);
      move.homeXY = x && y && *x == 0 && *y == 0;
      move.movesXY = !move.homeXY;
    }
    out.push_back(move);
  });
  return out;
}

void check(const Project& project, Report& report) {
  for (const Joined& joined : project.joined) {
    const gibbs::Cycle& cycle = *joined.cycle;
    if (!cycle.toolPath || cycle.toolPath->hasErrorNodes || joined.routine == nullptr) continue;
    const std::vector<PathMove> path = movesOf(*cycle.toolPath);
    const std::set<std::string> fields = fieldsOf(cycle);
    std::vector<ProgBlock> blocks;
    for (const compost::BranchRef& branch : compost::branchesOf(*joined.prog, cycle.name)) {
      if (branch.routine != joined.routine || !blocks.empty()) continue;
      blocks = blocksOf(branch.body(), *joined.prog, project);
    }
    // Levels along Z that are a field: the first of each.
    const PathMove* first = nullptr;
    std::string pathField;
    for (const PathMove& move : path) {
      if (move.z == nullptr || first != nullptr) continue;
      for (const std::string& name : readsOf(*move.z))
        if (fields.contains(name)) pathField = pathField.empty() ? name : "?";
      first = &move;
    }
    const ProgPiece* firstHole = nullptr;
    SourceRange measured;
    bool movesXY = false;
    bool movesBehind = false; // X or Y after the last measurement
    for (const ProgBlock& block : blocks) {
      const std::vector<ProgWord> words = wordsOf(block, project.form);
      const MacroMeaning meaning = meaningOf(project, macroCalled(words));
      if (meaning.measures()) {
        measured = block.range;
        movesBehind = false;
        continue;
      }
      const ProgWord* z = findWord(words, 'Z');
      if (z != nullptr && z->hole != nullptr && !z->hole->field.empty() && firstHole == nullptr)
        firstHole = z->hole;
      if (findWord(words, 'X') != nullptr || findWord(words, 'Y') != nullptr) {
        movesXY = movesXY || measured.hasPlace();
        movesBehind = true;
      }
    }
    if (first != nullptr && firstHole != nullptr && pathField.size() > 0 && pathField != "?" &&
        gibbs::foldCase(firstHole->field) != pathField && fields.contains(gibbs::foldCase(firstHole->field)))
      report
          .at(first->range,
              "the path begins at the height `{}`, the post at `{}`; the simulation does not show the "
              "first move of the machine",
              pathField, firstHole->field)
          .note(firstHole->range, "the first height of the post");
    const bool back = !path.empty() && path.back().homeXY;
    bool away = false;
    for (const PathMove& move : path)
      away = away || move.movesXY;
    if (back && away && movesXY && measured.hasPlace() && !movesBehind)
      report
          .at(path.back().range, "the path ends above the start point, the post leaves the probe at its last "
                                 "measurement; the next move begins elsewhere than the simulation shows")
          .note(measured, "the last measurement of the post");
  }
}

} // namespace

DOTEK_LINT_RULE(path_and_post_differ){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
