#include "verify/SameWay.h"

#include <algorithm>
#include <cmath>

namespace dotek::verify {

bool sameWay(const Record& a, const Record& b, bool sameText) {
  const auto samePlace = [&](SourceRange one, SourceRange other) {
    return !sameText || one.begin == other.begin;
  };
  const auto sameDeed = [&](const Deed& one, const Deed& other) {
    return one.kind == other.kind && one.text == other.text && samePlace(one.range, other.range);
  };
  // A whole number is what the program has chosen, any other what it has measured.
  const auto sameStore = [](const auto& one, const auto& other) {
    return one.first == other.first && (one.second == other.second || one.second != std::trunc(one.second) ||
                                        other.second != std::trunc(other.second));
  };
  return a.ending == b.ending && a.alarm == b.alarm && a.text == b.text && samePlace(a.endedAt, b.endedAt) &&
         samePlace(a.lastBlock, b.lastBlock) && a.pieces.size() == b.pieces.size() &&
         a.measures.size() == b.measures.size() &&
         std::equal(a.deeds.begin(), a.deeds.end(), b.deeds.begin(), b.deeds.end(), sameDeed) &&
         std::equal(a.stores.begin(), a.stores.end(), b.stores.begin(), b.stores.end(), sameStore);
}

bool meetsEach(const Record& record) {
  return record.alarmKind.empty() &&
         std::all_of(record.measures.begin(), record.measures.end(),
                     [](const Measure& one) { return !one.contacts.empty() || !one.unstated.empty(); });
}

} // namespace dotek::verify
