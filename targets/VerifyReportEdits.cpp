// What the report of verify says of lines that were edited by hand.
#include "support/messages/Verify.h"
#include "targets/EditedLines.h"
#include "targets/VerifyReport.h"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace dotek::targets {

namespace {

constexpr std::size_t kMostTold = 8;
constexpr std::size_t kShare = 5; // more than one line of so many is no edit

std::string whatDiffers(const EditedLine& one) {
  if (one.now.empty())
    return fmt::format("`{}`, which convert writes before this line, is missing", one.converted);
  if (one.converted.empty()) return fmt::format("convert does not write `{}`", one.now);
  return fmt::format("convert writes `{}` here, not `{}`", one.converted, one.now);
}

} // namespace

void VerifyReport::tellEdits() {
  const bool edited = plan_.translation && !plan_.translation->converted.empty();
  if (!edited || cases_.differ + edges_.differ > 0) return;
  const Translation& translation = *plan_.translation;
  const std::vector<EditedLine> edits = editedLines(translation.converted, translation.text);
  const auto lines =
      static_cast<std::size_t>(std::count(translation.converted.begin(), translation.converted.end(), '\n'));
  if (edits.size() > std::max(kMostTold, lines / kShare)) {
    Diagnostic& found = told_.report<diag::VerifyOtherText>({}, translation.name, edits.size());
    if (options_.allowEdits) found.severity = Severity::Warning;
    return;
  }
  for (std::size_t i = 0; i < std::min(edits.size(), kMostTold); ++i) {
    Diagnostic& found = told_.report<diag::VerifyEdited>(
        targetRange(edits[i].line), whatDiffers(edits[i]),
        edits[i].comment ? "a comment does not run, so no case shows which is right"
                         : "no case shows a difference, so it is not decided");
    if (options_.allowEdits) found.severity = Severity::Warning;
    if (i + 1 == kMostTold && edits.size() > kMostTold)
      found.note({}, fmt::format("{} more lines are not as convert writes them", edits.size() - kMostTold));
  }
}

} // namespace dotek::targets
