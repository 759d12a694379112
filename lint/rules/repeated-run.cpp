#include "lint/ProgBlocks.h"

#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::size_t kLeast = 3; // blocks, and branches that have them

using Texts = std::vector<std::string>;

struct Branch {
  std::vector<const ProgBlock*> blocks;
  Texts texts;
};

std::vector<std::size_t> holders(const std::vector<Branch>& branches, const Texts& run) {
  std::vector<std::size_t> out;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const Texts& texts = branches[b].texts;
    for (std::size_t at = 0; at + run.size() <= texts.size(); ++at) {
      if (std::equal(run.begin(), run.end(), texts.begin() + static_cast<std::ptrdiff_t>(at))) {
        out.push_back(b);
        break;
      }
    }
  }
  return out;
}

void checkSiblings(const Siblings& siblings, Report& report) {
  std::vector<Branch> branches;
  for (const CycleBranch& one : siblings.branches) {
    Branch branch;
    for (const ProgBlock& block : one.blocks) {
      if (block.called || block.conditional) continue;
      branch.blocks.push_back(&block);
      branch.texts.push_back(block.text());
    }
    branches.push_back(std::move(branch));
  }
  // In how many branches each run of the least length is.
  std::map<Texts, std::set<std::size_t>> least;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const Texts& texts = branches[b].texts;
    for (auto at = texts.begin(); texts.end() - at >= std::ptrdiff_t{kLeast}; ++at)
      least[Texts(at, at + std::ptrdiff_t{kLeast})].insert(b);
  }
  std::set<Texts> told;
  for (const Branch& branch : branches) {
    for (std::size_t at = 0; at + kLeast <= branch.texts.size();) {
      const auto begin = branch.texts.begin() + static_cast<std::ptrdiff_t>(at);
      if (least.at(Texts(begin, begin + std::ptrdiff_t{kLeast})).size() < kLeast) {
        ++at;
        continue;
      }
      Texts run;
      std::vector<std::size_t> with;
      for (std::size_t end = at; end < branch.texts.size(); ++end) {
        run.push_back(branch.texts[end]);
        if (run.size() < kLeast) continue;
        auto found = holders(branches, run);
        if (found.size() < kLeast) {
          run.pop_back();
          break;
        }
        with = std::move(found);
      }
      if (with.size() < kLeast) {
        ++at;
        continue;
      }
      if (told.insert(run).second)
        report.at(branch.blocks[at]->range,
                  "these {} blocks are alike in {} branches; a change has to be made in each; a routine can "
                  "hold them once",
                  run.size(), with.size());
      at += run.size();
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
