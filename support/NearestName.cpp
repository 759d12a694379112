#include "support/NearestName.h"

#include "support/Ascii.h"

#include <algorithm>
#include <vector>

namespace dotek {

std::size_t nameDistance(std::string_view a, std::string_view b, std::size_t limit) {
  const std::size_t gap = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
  if (gap > limit) return limit + 1;
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
    last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lowerCase(a[i - 1]) == lowerCase(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lowerCase(a[i - 1]) == lowerCase(b[j - 2]) &&
                           lowerCase(a[i - 2]) == lowerCase(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    if (*std::min_element(row.begin(), row.end()) > limit) return limit + 1;
    before.swap(last);
    last.swap(row);
  }
  return std::min(last[b.size()], limit + 1);
}

std::tuple<std::size_t, std::size_t, std::string_view> NearestName::rank(std::string_view other) const {
  const std::size_t most = std::min(name_.size(), other.size());
  std::size_t head = 0;
  while (head < most && lowerCase(name_[head]) == lowerCase(other[head]))
    ++head;
  std::size_t tail = 0;
  while (head + tail < most &&
         lowerCase(name_[name_.size() - 1 - tail]) == lowerCase(other[other.size() - 1 - tail]))
    ++tail;
  const std::size_t gap = std::max(name_.size(), other.size()) - std::min(name_.size(), other.size());
  return {name_.size() - head - tail, gap, other};
}

void NearestName::offer(std::string_view candidate) {
  if (++offers_ > kMostOffers) return;
  const std::size_t distance = nameDistance(name_, candidate, limit_);
  if (distance > limit_) return;
  // From the first hit on, limit_ is the distance of best_.
  const bool nearer = best_.empty() || distance < limit_;
  if (!nearer && rank(candidate) >= rank(best_)) return;
  best_ = candidate;
  limit_ = distance;
}

} // namespace dotek
