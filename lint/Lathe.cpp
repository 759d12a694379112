#include "lint/Lathe.h"

#include "frontend/macrob/BlockWords.h"
#include "frontend/macrob/Calls.h"
#include "stdlib/Lathe.h"

#include <algorithm>
#include <array>
#include <optional>

namespace dotek::lint {
namespace {

ir::NcWords numbersOf(const macrob::Words& words) {
  ir::NcWords out;
  for (const frontend::nc::Word& word : words.words)
    if (!macrob::isCommaAddress(word.address)) stdlib::addWord(out, word.address, macrob::literal(word));
  return out;
}

std::optional<LatheMark> latheMark(const macrob::File& file) {
  stdlib::LatheSigns signs;
  std::vector<const macrob::Block*> blocks;
  for (const macrob::Program& program : file.programs)
    for (const macrob::Block& block : program.blocks) {
      const auto* words = std::get_if<macrob::Words>(&block.body);
      if (words == nullptr) continue;
      signs.look(numbersOf(*words), blocks.size());
      if (signs.isOfMill()) return std::nullopt;
      blocks.push_back(&block);
    }
  const auto sign = signs.sign();
  if (!sign) return std::nullopt;
  return LatheMark{blocks[sign->at]->range, sign->what};
}

} // namespace

Lathes findLathes(const Project& project) {
  Lathes out;
  const bool all = project.control != nullptr && project.control->turning;
  for (const NcFile& nc : project.programs)
    if (const auto mark = latheMark(*nc.file); mark || all) out.emplace(nc.file, mark.value_or(LatheMark()));
  return out;
}

bool isOfMills(std::string_view rule) {
  static constexpr std::array<std::string_view, 21> kRules = {
      "arc-geometry",           "codes-exclude",         "compensation-start",
      "cycle-levels",           "cycle-words",           "data-input-words",
      "feed-missing",           "length-offset-number",  "length-offset-off",
      "mode-forbids-code",      "mode-left-on",          "offset-overwritten",
      "reference-through-zero", "rotation-words",        "spindle-off-at-cut",
      "spindle-speed-missing",  "tool-length-in-target", "tool-not-changed",
      "wear-in-geometry",       "word-not-taken",        "work-offset-not-chosen"};
  return std::find(kRules.begin(), kRules.end(), rule) != kRules.end();
}

} // namespace dotek::lint
