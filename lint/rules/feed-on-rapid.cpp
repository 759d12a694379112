#include "lint/NcProgram.h"
#include "lint/ProgBlocks.h"
#include "lint/Skips.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    for (const ProgBlock* block : ownBlocks(routine, prog, project)) {
      const std::vector<ProgWord> words = wordsOf(*block, nullptr);
      const ProgWord* rapid = nullptr;
      const ProgWord* feed = nullptr;
      bool other = false;
      for (const ProgWord& word : words) {
        if (word.address == 'G' && (word.digits == "0" || word.digits == "00")) rapid = &word;
        if (word.address == 'G' && word.digits == "65") other = true;
        if (word.address == 'F') feed = &word;
      }
      if (rapid == nullptr || feed == nullptr || other) continue;
      report.at(feed->range,
                "a feed is in a rapid block; the control moves at its rapid rate and keeps the feed "
                "for the next G1; leave it out, or write G1");
    }
  });
}

void checkProgram(const NcProgram& nc, Report& report) {
  for (const ir::ProgramStatement& statement : nc.program.body) {
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr || !isPlainMove(statement) || !hasCode(*block, 'G', 0) || hasCode(*block, 'G', 1))
      continue;
    for (const ir::Word& word : block->words)
      if (word.address == 'F')
        report.at(word.range, "a feed is in a rapid block; the control moves at its rapid rate and keeps "
                              "the feed for the next G1; leave it out, or write G1");
  }
}

} // namespace

DOTEK_LINT_RULE(feed_on_rapid){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
    .program = checkProgram,
};

} // namespace dotek::lint::rule
