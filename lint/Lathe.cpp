#include "lint/Lathe.h"

#include "frontend/macrob/BlockWords.h"
#include "frontend/macrob/Calls.h"

#include <algorithm>
#include <array>

namespace dotek::lint {
namespace {

using macrob::findAnyOf;
using macrob::findCode;
using macrob::findWord;

// A tool change by M6 or a length by G43: a mill.
bool isOfMill(const macrob::Words& words) {
  return findCode(words, 'M', 6) != nullptr || findCode(words, 'G', 43) != nullptr;
}

std::string_view latheWork(const macrob::Words& words) {
  const bool axes = findAnyOf(words, "XYZABC") != nullptr;
  const bool turned = findAnyOf(words, "UW") != nullptr;
  if (findCode(words, 'G', 50) != nullptr && findWord(words, 'S') != nullptr && !axes)
    return "limits the speed of a spindle that turns the part";
  for (const double cycle : {70.0, 71.0, 72.0, 73.0})
    if (findCode(words, 'G', cycle) != nullptr && findWord(words, 'P') != nullptr &&
        findWord(words, 'Q') != nullptr && !axes)
      return "turns a contour by its first and its last block";
  if (findCode(words, 'G', 28) != nullptr && turned && !axes)
    return "goes to the reference point by U and W, which are X and Z by increments";
  if (findCode(words, 'G', 10) != nullptr && turned && findWord(words, 'P') != nullptr &&
      findAnyOf(words, "L") == nullptr)
    return "adds to the offset of a turning tool";
  return {};
}

} // namespace

std::optional<LatheMark> latheMark(const macrob::File& file) {
  std::optional<LatheMark> out;
  for (const macrob::Program& program : file.programs)
    for (const macrob::Block& block : program.blocks) {
      const auto* words = std::get_if<macrob::Words>(&block.body);
      if (words == nullptr) continue;
      if (isOfMill(*words)) return std::nullopt;
      if (out) continue;
      if (const std::string_view what = latheWork(*words); !what.empty()) out = LatheMark{block.range, what};
    }
  return out;
}

bool isOfMills(std::string_view rule) {
  static constexpr std::array<std::string_view, 22> kRules = {
      "arc-geometry",          "arc-without-centre",     "codes-exclude",
      "compensation-start",    "cycle-levels",           "cycle-words",
      "data-input-words",      "feed-missing",           "length-offset-number",
      "length-offset-off",     "mode-forbids-code",      "mode-left-on",
      "offset-overwritten",    "reference-through-zero", "rotation-words",
      "spindle-off-at-cut",    "spindle-speed-missing",  "tool-length-in-target",
      "tool-not-changed",      "wear-in-geometry",       "word-not-taken",
      "work-offset-not-chosen"};
  return std::find(kRules.begin(), kRules.end(), rule) != kRules.end();
}

} // namespace dotek::lint
