#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

// The next block in the text that does something.
std::size_t nextOf(const mikroprog::Reading& reading, std::size_t at) {
  for (++at; at < reading.blocks.size(); ++at)
    if (!reading.blocks[at].line->words.empty()) break;
  return at;
}

std::optional<std::size_t> targetOf(const mikroprog::Reading& reading, const mikroprog::Block& block) {
  const auto number = mikroprog::wholeOf(block.line->find('L'));
  const auto found = number ? reading.numbers.find(*number) : reading.numbers.end();
  return found == reading.numbers.end() ? std::nullopt : std::optional(found->second);
}

// What the program does first after a contact: the block that moves or leads elsewhere; nothing: none.
const mikroprog::Block* afterContact(const mikroprog::Reading& reading, std::size_t at) {
  for (at = nextOf(reading, at); at < reading.blocks.size(); at = nextOf(reading, at)) {
    const mikroprog::Block& block = reading.blocks[at];
    for (const std::string_view leads :
         {"jump", "jump-if", "call", "return", "end", "leave", "stop", "run-program"})
      if (block.does(leads)) return nullptr;
    if (block.does("set-position")) continue;
    if (block.does("probe-move") || mikroprog::hasAxisWord(block, reading.control)) return &block;
  }
  return nullptr;
}

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  for (std::size_t at = 0; at < reading.blocks.size(); ++at) {
    const mikroprog::Block& block = reading.blocks[at];
    if (block.line->unread || !block.does("probe-move")) continue;
    const auto missed = targetOf(reading, block);
    if (missed && *missed == nextOf(reading, at)) {
      report.at(block.line->range,
                "with and without contact this G31 goes on with the same block; write an L to another, "
                "and after it what a contact means");
      continue;
    }
    const mikroprog::Block* const next = afterContact(reading, at);
    if (next != nullptr && next->does("probe-move"))
      report.at(next->line->range,
                "this G31 begins in contact; what the control does then is not known (Q19): leave the "
                "surface with G0 or G1");
  }
}

} // namespace

DOTEK_LINT_RULE(suf_probe_contact){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
