#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachSufBlock(project, [&](const mikroprog::Reading&, const mikroprog::Block& block) {
    if (block.does("set-position"))
      report.at(block.line->range, "G92 loses the old coordinate system; only G98 brings it back");
  });
}

} // namespace

DOTEK_LINT_RULE(suf_datum_lasts){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
