#include "lint/ProgBlocks.h"

#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::size_t kLeast = 3; // blocks, and branches that have them

// A suffix automaton over the blocks of all branches, each text a number: says of each run of blocks in how
// many branches it is, in time that grows with the number of blocks alone.
class Runs {
public:
  explicit Runs(const std::vector<std::vector<std::size_t>>& branches) {
    for (const auto& branch : branches) {
      last_ = 0;
      for (const std::size_t block : branch)
        append(block);
    }
    for (std::size_t b = 0; b < branches.size(); ++b) {
      std::size_t at = 0;
      for (const std::size_t block : branches[b]) {
        at = states_[at].next.at(block);
        for (std::size_t up = at; up != 0 && states_[up].seen != b + 1; up = states_[up].link) {
          states_[up].seen = b + 1;
          ++states_[up].branches;
        }
      }
    }
  }

  struct Found {
    std::size_t length = 0;
    std::size_t branches = 0;
  };
  // The longest run from `begin` on that is in `least` branches.
  Found longest(const std::vector<std::size_t>& branch, std::size_t begin, std::size_t least) const {
    Found out;
    std::size_t at = 0;
    for (std::size_t i = begin; i < branch.size(); ++i) {
      at = states_[at].next.at(branch[i]);
      if (states_[at].branches < least) break;
      out = {i + 1 - begin, states_[at].branches};
    }
    return out;
  }

private:
  struct State {
    std::map<std::size_t, std::size_t> next; // by text
    std::size_t link = 0, length = 0;
    std::size_t branches = 0; // that have its runs
    std::size_t seen = 0;     // the branch that was counted last, from 1 on
  };

  void append(std::size_t block) {
    if (const auto known = states_[last_].next.find(block); known != states_[last_].next.end()) {
      last_ = states_[known->second].length == states_[last_].length + 1 ? known->second
                                                                         : split(last_, block, known->second);
      return;
    }
    const std::size_t made = states_.size();
    states_.push_back({{}, 0, states_[last_].length + 1, 0, 0});
    std::size_t at = last_;
    last_ = made;
    while (!states_[at].next.contains(block)) {
      states_[at].next[block] = made;
      if (at == 0) return; // the link is the empty run
      at = states_[at].link;
    }
    const std::size_t after = states_[at].next[block];
    states_[made].link = states_[after].length == states_[at].length + 1 ? after : split(at, block, after);
  }

  // The runs of `after` that are no longer than those of `at` and the block get a state of their own.
  std::size_t split(std::size_t at, std::size_t block, std::size_t after) {
    const std::size_t made = states_.size();
    State copy = states_[after];
    copy.length = states_[at].length + 1;
    states_.push_back(std::move(copy));
    states_[after].link = made;
    for (;; at = states_[at].link) {
      const auto next = states_[at].next.find(block);
      if (next == states_[at].next.end() || next->second != after) break;
      next->second = made;
      if (at == 0) break;
    }
    return made;
  }

  std::vector<State> states_ = std::vector<State>(1); // the first: the empty run
  std::size_t last_ = 0;
};

void checkSiblings(const Siblings& siblings, Report& report) {
  std::map<std::string, std::size_t> numbers; // of texts
  std::vector<std::vector<const ProgBlock*>> blocks;
  std::vector<std::vector<std::size_t>> branches;
  for (const CycleBranch& one : siblings.branches) {
    blocks.emplace_back();
    branches.emplace_back();
    for (const ProgBlock& block : one.blocks) {
      if (block.called || block.conditional) continue;
      blocks.back().push_back(&block);
      branches.back().push_back(numbers.try_emplace(block.text(), numbers.size()).first->second);
    }
  }
  const Runs runs(branches);
  std::set<std::vector<std::size_t>> told;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    for (std::size_t at = 0; at + kLeast <= branches[b].size();) {
      const Runs::Found run = runs.longest(branches[b], at, kLeast);
      if (run.length < kLeast) {
        ++at;
        continue;
      }
      const auto begin = branches[b].begin() + static_cast<std::ptrdiff_t>(at);
      if (told.emplace(begin, begin + static_cast<std::ptrdiff_t>(run.length)).second)
        report.at(blocks[b][at]->range,
                  "these {} blocks are alike in {} branches; a change has to be made in each; a routine can "
                  "hold them once",
                  run.length, run.branches);
      at += run.length;
    }
  }
}

void check(const Project& project, Report& report) {
  for (const Siblings& siblings : siblingsOf(project))
    checkSiblings(siblings, report);
}

} // namespace

DOTEK_LINT_RULE(repeated_run){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
