#include "frontend/macrob/Calls.h"
#include "lint/Project.h"

namespace dotek::lint::rule {
namespace {

bool ends(const macrob::Words& words) {
  return macrob::findCode(words, 'M', 30) != nullptr || macrob::findCode(words, 'M', 2) != nullptr ||
         macrob::findCode(words, 'M', 99) != nullptr;
}

// A block whose number something goes to is reached; what follows the
// END of a loop is reached when its condition no longer holds.
void checkProgram(const macrob::Program& program, const SourceMap& sources, Report& report) {
  const macrob::Block* end = nullptr;
  for (const macrob::Block& block : program.blocks) {
    if (block.target || std::holds_alternative<macrob::End>(block.body)) end = nullptr;
    const auto* words = std::get_if<macrob::Words>(&block.body);
    if (words != nullptr && ends(*words)) {
      if (!block.blockDelete && !block.repaired && end == nullptr) end = &block;
      continue;
    }
    if (end == nullptr || std::holds_alternative<std::monostate>(block.body) ||
        std::holds_alternative<macrob::Unread>(block.body))
      continue;
    // `%0.285`: what a longer program left after the end of this one.
    const std::string_view between =
        sources.file(block.range.file).bytes().substr(end->range.end, block.range.begin - end->range.end);
    if (between.find('%') != std::string_view::npos) return;
    report
        .at(block.range, "the program ends before this block, to which nothing goes; the control "
                         "never runs it; take the block out, or write the end after it")
        .note(end->range, "the end is here");
    return;
  }
}

void check(const Project& project, Report& report) {
  for (const NcFile& nc : project.programs)
    for (const macrob::Program& program : nc.file->programs)
      checkProgram(program, project.sources, report);
}

} // namespace

DOTEK_LINT_RULE(blocks_past_end){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
