#include "lint/SufPrograms.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <vector>

namespace dotek::lint::rule {
namespace {

constexpr std::size_t kLevels = 2; // that the screen shows (Q17)

std::optional<std::size_t> targetOf(const mikroprog::Reading& reading, const mikroprog::Block& block) {
  const auto number = block.line->unread ? std::nullopt : mikroprog::wholeOf(block.line->find('L'));
  const auto found = number ? reading.numbers.find(*number) : reading.numbers.end();
  return found == reading.numbers.end() ? std::nullopt : std::optional(found->second);
}

// Subprograms: the first block of each and its M17, or the last block of the text.
using Bodies = std::map<std::size_t, std::size_t>;

Bodies bodiesOf(const mikroprog::Reading& reading) {
  std::vector<std::size_t> ends(reading.blocks.size());
  for (std::size_t at = ends.size(); at-- > 0;)
    ends[at] = at + 1 == ends.size() || reading.blocks[at].does("return") ? at : ends[at + 1];
  Bodies out;
  for (const mikroprog::Block& block : reading.blocks) {
    const auto first = block.does("call") ? targetOf(reading, block) : std::nullopt;
    if (first && (!reading.end || *first >= *reading.end)) out.emplace(*first, ends[*first]);
  }
  return out;
}

// The subprogram that the block is in, the innermost: its first block.
std::optional<std::size_t> bodyAt(const Bodies& bodies, std::size_t at) {
  const auto after = bodies.upper_bound(at);
  if (after == bodies.begin() || std::prev(after)->second < at) return std::nullopt;
  return std::prev(after)->first;
}

// By block: a jump from a subprogram to it leaves no return that could be wrong. It is after the end of the
// main program, so a part of the subprogram beyond its first M17; or the program comes to its end from there.
std::vector<bool> harmless(const mikroprog::Reading& reading) {
  std::vector<bool> out(reading.blocks.size());
  for (std::size_t at = out.size(); at-- > 0;) {
    const mikroprog::Block& block = reading.blocks[at];
    const bool stops = block.line->unread || block.line->find('L') != nullptr || block.does("return");
    out[at] = (reading.end && at > *reading.end) || block.does("end") || block.does("leave") ||
              (!stops && at + 1 < out.size() && (!reading.end || at + 1 <= *reading.end) && out[at + 1]);
  }
  return out;
}

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  const Bodies bodies = bodiesOf(reading);
  if (bodies.empty()) return;
  const std::vector<bool> leavesNone = harmless(reading);
  std::map<std::size_t, std::size_t> level; // of subprograms, the deepest
  for (std::size_t round = 0; round <= kLevels; ++round)
    for (std::size_t at = 0; at < reading.blocks.size(); ++at) {
      const mikroprog::Block& block = reading.blocks[at];
      const auto to = targetOf(reading, block);
      if (!to) continue;
      const auto from = bodyAt(bodies, at);
      if (block.does("call")) {
        const std::size_t deep = (from ? level[*from] : 0) + 1;
        level[*to] = std::max(level[*to], std::min(deep, kLevels + 1));
        if (round == kLevels && deep > kLevels)
          report.at(block.line->range,
                    "this call is number {} within calls; the screen of the control shows {}, and more "
                    "are not known to work (Q17)",
                    deep, kLevels);
      } else if (const auto into = bodyAt(bodies, *to); round == 0 && !block.does("run-program") &&
                                                        from != into && (into || !from || !leavesNone[*to])) {
        report.at(block.line->range,
                  "a jump {} a subprogram; what becomes of its return is not known (Q7): write G26, or "
                  "leave by M17",
                  from ? "out of" : "into");
      }
    }
}

} // namespace

DOTEK_LINT_RULE(suf_call_nesting){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
