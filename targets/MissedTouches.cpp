#include "targets/MissedTouches.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::targets {

std::vector<verify::Difference>
compareMissed(const TargetCase& now, const verify::Record& ran,
              const std::function<verify::Record(const verify::Interference&)>& run,
              const std::function<verify::CompareRules(const verify::Record&)>& rules) {
  constexpr std::size_t kMost = 12; // of a loop, the first
  if (now.source == nullptr || now.questions == nullptr || now.source->searches != ran.searches) return {};
  for (std::size_t search = 0; search < std::min(ran.searches, kMost); ++search) {
    const SourceQuestions::Ran meant = now.questions->missing(search);
    if (meant.answer != SourceQuestions::Answer::Runs) continue;
    verify::Interference none;
    none.missing = search;
    std::vector<verify::Difference> found = verify::compare(meant.record, run(none), rules(meant.record));
    for (verify::Difference& one : found)
      one.text = fmt::format("where touch {} finds nothing: {}", search + 1, one.text);
    if (!found.empty()) return found;
  }
  return {};
}

} // namespace dotek::targets
