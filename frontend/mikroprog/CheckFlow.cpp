// Paths through a program that lead nowhere.
#include "frontend/mikroprog/Check.h"

#include <algorithm>

namespace dotek::frontend::mikroprog {

namespace {

// Where a program may go from each block. What is not certain counts as a path to the end, so that what has
// none ends for certain never.
class Flow {
public:
  explicit Flow(const Reading& reading)
      : reading_(reading), next_(reading.blocks.size() + 1), ends_(next_.size()) {
    for (std::size_t at = 0; at < reading_.blocks.size(); ++at)
      follow(at);
  }

  // Blocks that may run, and of which no path leads to an end.
  std::vector<bool> trapped() const {
    std::vector<std::vector<std::size_t>> before(next_.size());
    for (std::size_t at = 0; at < next_.size(); ++at)
      for (const std::size_t to : next_[at])
        before[to].push_back(at);
    std::vector<std::size_t> ends;
    for (std::size_t at = 0; at < next_.size(); ++at)
      if (ends_[at]) ends.push_back(at);
    const std::vector<bool> leaves = from(std::move(ends), before);
    std::vector<bool> out = from({0}, next_);
    out.pop_back();
    for (std::size_t at = 0; at < out.size(); ++at)
      out[at] = out[at] && !leaves[at];
    return out;
  }

  std::vector<bool> reachedFrom(std::size_t at) const { return from({at}, next_); }

  // Blocks that run outside of any subprogram. A call comes back to the block after it; G23 is left out,
  // since it may store a return (Q7).
  std::vector<bool> outside() const {
    std::vector<std::vector<std::size_t>> edges(next_.size());
    for (std::size_t at = 0; at < reading_.blocks.size(); ++at) {
      const Block& block = reading_.blocks[at];
      const auto to = target(at);
      if (to && !block.does("call") && !block.does("jump-if")) edges[at].push_back(*to);
      if (!block.does("jump") && !block.does("return") && !block.does("end") && !block.does("leave"))
        edges[at].push_back(at + 1);
    }
    return from({0}, edges);
  }

  // The block that its L names, where it goes there.
  std::optional<std::size_t> target(std::size_t at) const {
    const Block& block = reading_.blocks[at];
    const Word* word = block.line->find('L');
    if (word == nullptr || block.does("run-program")) return std::nullopt;
    const auto number = wholeOf(word);
    const auto found = number ? reading_.numbers.find(*number) : reading_.numbers.end();
    return found == reading_.numbers.end() ? std::nullopt : std::optional(found->second);
  }

private:
  void follow(std::size_t at) {
    const Block& block = reading_.blocks[at];
    const bool last = at + 1 == reading_.blocks.size();
    if (block.line->unread || block.hasUnknownCode() || last) ends_[at] = true;
    // An operator may end a program that waits; M60 and the macros do what is not known.
    for (const char* one : {"end", "leave", "stop", "stop-if", "run-program", "run-macro"})
      ends_[at] = ends_[at] || block.does(one);
    if (std::any_of(block.codes.begin(), block.codes.end(), [](const Code& code) {
          return code.function != nullptr && code.function->function.empty();
        }))
      ends_[at] = true;
    const bool jump = block.does("jump"), call = block.does("call");
    const bool branch = block.does("jump-if") || block.does("probe-move") || block.does("wait");
    if (block.does("return")) {
      next_[at].push_back(reading_.blocks.size());
      return;
    }
    if (jump || call || branch) {
      const auto to = target(at);
      if (to)
        next_[at].push_back(*to);
      else
        ends_[at] =
            true; // without L a missed contact and a timeout end it; where a wrong L leads is not known
    }
    if (last || jump) return;
    (call ? next_.back() : next_[at]).push_back(at + 1);
  }

  static std::vector<bool> from(std::vector<std::size_t> open,
                                const std::vector<std::vector<std::size_t>>& edges) {
    std::vector<bool> out(edges.size());
    for (const std::size_t one : open)
      if (one < out.size()) out[one] = true;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      if (at >= edges.size()) continue;
      for (const std::size_t to : edges[at]) {
        if (out[to]) continue;
        out[to] = true;
        open.push_back(to);
      }
    }
    return out;
  }

  const Reading& reading_;
  std::vector<std::vector<std::size_t>> next_; // the last: from any return to the block after any call
  std::vector<bool> ends_;
};

} // namespace

Findings endlessLoops(const Reading& reading) {
  Findings out;
  const Flow flow(reading);
  const std::vector<bool> trapped = flow.trapped();
  std::vector<bool> told(trapped.size());
  for (std::size_t at = 0; at < trapped.size(); ++at) {
    const Block& block = reading.blocks[at];
    const auto to = trapped[at] && !told[at] ? flow.target(at) : std::nullopt;
    if (!to || *to > at) continue;
    const std::vector<bool> loop = flow.reachedFrom(*to);
    if (!loop[at]) continue;
    for (std::size_t i = 0; i < told.size(); ++i)
      told[i] = told[i] || loop[i];
    const std::uint64_t number = reading.program.lines[*to].number.value_or(0);
    out.push_back(
        {block.line->find('L')->range,
         block.does("call")
             ? fmt::format("the subprogram N{} calls itself whatever happens, and no path leads to its M17; "
                           "the control nests calls only so deep; write the G23 that ends it",
                           number)
             : fmt::format("the program goes back to N{0}, and no G23, G31, G5, stop or end leads out of the "
                           "loop: it runs for ever; write the condition, or correct L{0}",
                           number)});
  }
  return out;
}

Findings strayReturns(const Reading& reading) {
  Findings out;
  if (std::none_of(reading.blocks.begin(), reading.blocks.end(),
                   [](const Block& block) { return block.does("return"); }))
    return out;
  const std::vector<bool> outside = Flow(reading).outside();
  for (std::size_t at = 0; at < reading.blocks.size(); ++at)
    if (outside[at] && reading.blocks[at].does("return"))
      out.push_back({reading.blocks[at].line->range,
                     "the program gets to this M17 without a G26; the control stops with an error there; the "
                     "end of a program is M30"});
  return out;
}

} // namespace dotek::frontend::mikroprog
