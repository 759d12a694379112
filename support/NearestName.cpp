#include "support/NearestName.h"

#include "support/Ascii.h"

#include <algorithm>
#include <vector>

namespace dotek {

namespace {
// So many letters of a name and nothing wrong with them: the rest is left out.
constexpr std::size_t kBeginning = 5;
} // namespace

std::size_t nameDistance(std::string_view a, std::string_view b, std::size_t limit) {
  const std::size_t gap = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
  if (gap > limit) return limit + 1;
  // Rows of the distances of all beginnings. What is more than `limit` off the diagonal is above it anyway.
  const std::size_t far = limit + 1;
  std::vector<std::size_t> rows(3 * (b.size() + 1), far);
  std::size_t* before = rows.data();
  std::size_t* last = before + b.size() + 1;
  std::size_t* row = last + b.size() + 1;
  for (std::size_t j = 0; j <= std::min(b.size(), limit); ++j)
    last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    const std::size_t first = i > limit ? i - limit : 1;
    const std::size_t end = std::min(b.size(), i + limit);
    std::size_t least = row[first - 1] = first == 1 ? std::min(i, far) : far;
    const char own = lowerCase(a[i - 1]);
    for (std::size_t j = first; j <= end; ++j) {
      const char other = lowerCase(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (own == other ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && own == lowerCase(b[j - 2]) && lowerCase(a[i - 2]) == other;
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
      least = std::min(least, row[j]);
    }
    if (end < b.size()) row[end + 1] = far; // the next row looks one farther
    if (least > limit) return far;
    std::size_t* free = before;
    before = last;
    last = row;
    row = free;
  }
  return std::min(last[b.size()], far);
}

LetterCounts countLetters(std::string_view name) {
  LetterCounts out{};
  for (const char c : name) {
    std::uint8_t& count = out[static_cast<unsigned char>(c) % out.size()];
    if (count < UINT8_MAX) ++count;
  }
  return out;
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

// Each change of a letter takes away one letter at most and adds one at most.
bool NearestName::mayBeNear(std::string_view other) const {
  const std::size_t gap = std::max(name_.size(), other.size()) - std::min(name_.size(), other.size());
  if (gap > limit_) return false;
  if (name_.size() > UINT8_MAX || other.size() > UINT8_MAX) return true;
  const LetterCounts its = countLetters(other);
  std::size_t lost = 0; // what is added is as much, but for the lengths
  for (std::size_t i = 0; i < its.size(); ++i)
    lost += static_cast<std::size_t>(std::max(letters_[i], its[i]) - its[i]);
  return std::max(lost, lost + other.size() - name_.size()) <= limit_;
}

void NearestName::offer(std::string_view candidate) {
  if (++offers_ > kMostOffers) return;
  const bool begun = name_.size() >= kBeginning && candidate.size() > name_.size() &&
                     nameDistance(name_, candidate.substr(0, name_.size()), 0) == 0;
  if (!begun && !mayBeNear(candidate)) return;
  const std::size_t distance =
      begun ? std::min<std::size_t>(1, limit_) : nameDistance(name_, candidate, limit_);
  if (distance > limit_) return;
  // From the first hit on, limit_ is the distance of best_.
  const bool nearer = best_.empty() || distance < limit_;
  if (!nearer && rank(candidate) >= rank(best_)) return;
  best_ = candidate;
  limit_ = distance;
}

} // namespace dotek
