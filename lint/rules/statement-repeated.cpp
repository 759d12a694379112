#include "lint/MacroNames.h"
#include "lint/NcProgram.h"
#include "lint/ProgBlocks.h"
#include "lint/Skips.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

// Doing the same once more changes nothing: codes and moves to a place that is written out.
bool isIdle(const ir::ProgramStatement& statement) {
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  if (block == nullptr || block->words.empty() || skipOf(statement) != nullptr) return false;
  return std::all_of(block->words.begin(), block->words.end(), [&](const ir::Word& word) {
    const double* value = ir::constantValue(word.value);
    // A dwell adds up, a code of the builder may count.
    return value != nullptr && word.address != 'M' && word.address != 'T' &&
           !(word.address == 'G' && *value == 4);
  });
}

// Its text without block delete and number.
std::string_view textOf(const ir::ProgramStatement& statement, const SourceMap& sources) {
  std::string_view text = sources.text(statement.origin.range());
  const auto skip = [&](char mark) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    if (text.empty() || text.front() != mark) return;
    text.remove_prefix(1);
    text.remove_prefix(std::min(text.find_first_not_of("0123456789"), text.size()));
  };
  for (const char mark : {'/', 'N', '/', ' '})
    skip(mark);
  return text;
}

void checkProgram(const NcProgram& nc, Report& report) {
  const auto& body = nc.program.body;
  const SourceMap& sources = nc.project.sources;
  bool before = false; // the statement before is idle
  for (std::size_t i = 0; i < body.size(); ++i) {
    const bool idle = isIdle(body[i]);
    const bool both = std::exchange(before, idle) && idle;
    if (!both || !nc.modes()[i]) continue;
    const auto& now = std::get<ir::NcBlock>(body[i].node);
    const bool incremental = *nc.modes()[i] != DistanceMode::Absolute && axesOf(now) != 0;
    if (incremental || body[i].blockDelete != body[i - 1].blockDelete ||
        textOf(body[i], sources) != textOf(body[i - 1], sources))
      continue;
    report.at(body[i].origin.range(), "this block is the same as the one before and changes nothing; one of "
                                      "the two is left over, or was meant to differ");
  }
}

// Distances and waits add up, and a code of the builder may count.
bool addsUp(const ProgWord& word) {
  if (word.address == 'M' || word.address == 'T') return true;
  if (word.address != 'G') return false;
  const std::string_view digits =
      std::string_view(word.digits).substr(std::min(word.digits.find_first_not_of('0'), word.digits.size()));
  return digits == "4" || digits == "91";
}

void checkPosts(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    if (prog.hasErrorNodes || !routine.returnRange) return; // told already
    const std::vector<ProgBlock>& blocks = blocksOf(routine.body, prog, project);
    for (std::size_t i = 1; i < blocks.size(); ++i) {
      const std::string text = blocks[i].text();
      if (blocks[i].called || text != blocks[i - 1].text() ||
          text.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") == std::string::npos || text.front() == '(')
        continue;
      const std::vector<ProgWord> words = wordsOf(blocks[i], nullptr, true);
      if (std::any_of(words.begin(), words.end(), addsUp)) continue;
      if (blocks[i].pieces.front().arm != blocks[i - 1].pieces.front().arm) continue;
      report.at(blocks[i].range,
                "this block is the same as the one before and changes nothing; one of the two is "
                "left over, or was meant to differ");
    }
  });
}

void check(const Project& project, Report& report) {
  checkPosts(project, report);
  for (const gibbs::Macro* macro : project.allMacros()) {
    if (macro->hasErrorNodes) continue;
    for (std::size_t i = 1; i < macro->lines.size(); ++i) {
      const gibbs::Line& line = macro->lines[i];
      const gibbs::Line& before = macro->lines[i - 1];
      if (line.label || !line.statement || !before.statement) continue;
      // v = v + 1 counts.
      if (const auto* assign = std::get_if<gibbs::Assignment>(&line.statement->node))
        if (!assign->value || readsOf(*assign->value).contains(gibbs::foldCase(assign->target.name.text)))
          continue;
      if (std::holds_alternative<gibbs::Next>(line.statement->node) ||
          std::holds_alternative<gibbs::CallMacro>(line.statement->node))
        continue;
      if (project.sources.text(line.statement->range) != project.sources.text(before.statement->range))
        continue;
      report.at(line.statement->range, "this statement is the same as the one before; one of the two is left "
                                       "over, or was meant to differ");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(statement_repeated){
    .severity = Severity::Note,
    .tier = Tier::Syntax,
    .check = check,
    .program = checkProgram,
};

} // namespace dotek::lint::rule
