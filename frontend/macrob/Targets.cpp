#include "frontend/macrob/Targets.h"

#include "frontend/macrob/BlockWords.h"
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Walk.h"

#include <cmath>
#include <unordered_set>

namespace dotek::frontend::macrob {
namespace {

class Numbers {
public:
  void add(std::optional<double> value) {
    if (!value)
      all = true;
    else if (*value >= 0 && *value < 1e15)
      named_.insert(static_cast<std::uint64_t>(std::llround(*value)));
  }
  void add(const nc::Word* word) {
    if (word != nullptr) add(literal(*word));
  }
  bool has(std::uint64_t number) const { return all || named_.contains(number); }
  bool empty() const { return !all && named_.empty(); }

  bool all = false;

private:
  std::unordered_set<std::uint64_t> named_;
};

bool isContourCycle(const Words& words) {
  for (const double code : {70, 71, 72, 73})
    if (findCode(words, 'G', code) != nullptr) return true;
  return false;
}

// Where the block goes to: within its own program, and within those of the file.
void collect(const Block& block, Numbers& own, Numbers& shared) {
  if (const Goto* jump = gotoOf(block)) own.add(literal(*jump->target));
  if (const auto* unread = std::get_if<Unread>(&block.body))
    own.all = own.all || unread->text.find("GOTO") != std::string::npos;
  const auto* words = std::get_if<Words>(&block.body);
  if (words == nullptr) return;
  if (findCode(*words, 'M', 99) != nullptr) shared.add(findWord(*words, 'P'));
  if (findCode(*words, 'M', 98) != nullptr) shared.add(findWord(*words, 'Q'));
  if (findCode(*words, 'M', 97) != nullptr) own.add(findWord(*words, 'P'));
  const nc::Word* first = findWord(*words, 'P');
  const nc::Word* last = findWord(*words, 'Q');
  if (first == nullptr || last == nullptr || !isContourCycle(*words)) return;
  own.add(first);
  own.add(last);
}

} // namespace

void markTargets(File& file) {
  Numbers shared;
  std::vector<Numbers> own(file.programs.size());
  for (std::size_t i = 0; i < file.programs.size(); ++i)
    for (const Block& block : file.programs[i].blocks)
      collect(block, own[i], shared);
  for (std::size_t i = 0; i < file.programs.size(); ++i) {
    if (own[i].empty() && shared.empty()) continue;
    for (Block& block : file.programs[i].blocks)
      block.target = block.sequenceNumber &&
                     (own[i].has(block.sequenceNumber->value) || shared.has(block.sequenceNumber->value));
  }
}

} // namespace dotek::frontend::macrob
