#include "verify/SameWay.h"

#include <algorithm>

namespace dotek::verify {

bool sameWay(const Record& a, const Record& b) {
  const auto sameDeed = [](const Deed& one, const Deed& other) {
    return one.kind == other.kind && one.text == other.text && one.range.begin == other.range.begin;
  };
  const auto sameNumber = [](const auto& one, const auto& other) { return one.first == other.first; };
  return a.ending == b.ending && a.alarm == b.alarm && a.text == b.text &&
         a.endedAt.begin == b.endedAt.begin && a.lastBlock.begin == b.lastBlock.begin &&
         a.pieces.size() == b.pieces.size() && a.measures.size() == b.measures.size() &&
         std::equal(a.deeds.begin(), a.deeds.end(), b.deeds.begin(), b.deeds.end(), sameDeed) &&
         std::equal(a.stores.begin(), a.stores.end(), b.stores.begin(), b.stores.end(), sameNumber);
}

} // namespace dotek::verify
