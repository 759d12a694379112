#include "lint/SufPrograms.h"

#include <algorithm>
#include <map>
#include <optional>

namespace dotek::lint::rule {
namespace {

constexpr std::size_t kLevels = 2; // that the screen shows (Q17)

std::optional<std::size_t> targetOf(const mikroprog::Reading& reading, const mikroprog::Block& block) {
  const auto number = block.line->unread ? std::nullopt : mikroprog::wholeOf(block.line->find('L'));
  const auto found = number ? reading.numbers.find(*number) : reading.numbers.end();
  return found == reading.numbers.end() ? std::nullopt : std::optional(found->second);
}

// Subprograms: the first block of each and its M17.
using Bodies = std::map<std::size_t, std::size_t>;

Bodies bodiesOf(const mikroprog::Reading& reading) {
  Bodies out;
  for (const mikroprog::Block& block : reading.blocks) {
    const auto first = block.does("call") ? targetOf(reading, block) : std::nullopt;
    if (!first || out.contains(*first) || (reading.end && *first < *reading.end)) continue;
    std::size_t last = *first;
    while (last + 1 < reading.blocks.size() && !reading.blocks[last].does("return"))
      ++last;
    out.emplace(*first, last);
  }
  return out;
}

// The subprogram that the block is in: its first block.
std::optional<std::size_t> bodyAt(const Bodies& bodies, std::size_t at) {
  for (const auto& [first, last] : bodies)
    if (at >= first && at <= last) return first;
  return std::nullopt;
}

// A jump from within `from` to a block of no subprogram: one after the first M17 of its own, or one from
// which the program comes to its end, where no return is left to be wrong.
bool isHarmless(const mikroprog::Reading& reading, std::optional<std::size_t> from, std::size_t to) {
  if (!from) return false;
  if (reading.end && to > *reading.end) return true;
  for (std::size_t at = to; at < reading.blocks.size(); ++at) {
    const mikroprog::Block& block = reading.blocks[at];
    if (block.does("end") || block.does("leave")) return true;
    if (block.line->unread || block.line->find('L') != nullptr || block.does("return")) return false;
  }
  return false;
}

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  const Bodies bodies = bodiesOf(reading);
  if (bodies.empty()) return;
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
                                                        from != into &&
                                                        (into || !isHarmless(reading, from, *to))) {
        report.at(block.line->range,
                  "a jump {} a subprogram; what becomes of its return is not known (Q7): write G26, or "
                  "leave by M17",
                  from ? "out of" : "into");
      }
    }
}

void check(const Project& project, Report& report) {
  for (const mikroprog::Reading* reading : project.sufPrograms)
    checkProgram(*reading, report);
}

} // namespace

DOTEK_LINT_RULE(suf_call_nesting){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
