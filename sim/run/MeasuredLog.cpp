#include "sim/run/MeasuredLog.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace dotek::sim {

PictureMeasured MeasuredLog::entry(Measurement found, PictureBlock block, std::string system) const {
  PictureMeasured out{std::move(found), {}, std::move(system), std::move(block), now_.move()};
  out.afterMiss = missedAt_.has_value();
  return out;
}

void MeasuredLog::add(PictureMeasured one) {
  if (entries_.size() < kMost)
    entries_.push_back(std::move(one));
  else
    ++leftOut_;
}

void MeasuredLog::callBegins(std::uint32_t /*program*/, std::span<const double> locals) {
  if (!now_.block) return;
  if (missedAt_ && calls_.size() < *missedAt_) missedAt_.reset();
  touch_ = {}; // a touch of this call is no second one of a call before it
  calls_.push_back(
      {{locals.begin(), locals.end()}, now_.block(), now_.system(), entries_.size(), std::nullopt});
}

void MeasuredLog::callEnded(std::uint32_t program) {
  if (calls_.empty()) return;
  Call call = std::move(calls_.back());
  calls_.pop_back();
  if (!call.found && reader_) call.found = reader_(program, call.locals);
  close(std::move(call));
}

// The touches within the call are those of what it found; its offsets stay.
void MeasuredLog::close(Call call) {
  if (!call.found) return;
  PictureMeasured one = entry(std::move(*call.found), std::move(call.block), std::move(call.system));
  for (std::size_t i = call.first; i < entries_.size(); ++i) {
    one.afterMiss = one.afterMiss || entries_[i].afterMiss;
    std::move(entries_[i].offsets.begin(), entries_[i].offsets.end(), std::back_inserter(one.offsets));
  }
  if (call.first < entries_.size())
    entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(call.first), entries_.end());
  add(std::move(one));
}

void MeasuredLog::measured(const Measurement& found) {
  if (!calls_.empty()) calls_.back().found = found;
}

void MeasuredLog::offsetWritten(const OffsetWrite& write) {
  if (!now_.block) return;
  const bool within = !calls_.empty() && calls_.back().first == entries_.size();
  if (entries_.empty() || within) add(entry({0, "", {}}, now_.block(), now_.system()));
  if (entries_.empty()) return;
  PictureMeasured& last = entries_.back();
  last.offsets.push_back(write);
  last.afterMiss = last.afterMiss || missedAt_;
}

void MeasuredLog::writtenAfterMiss() {
  if (!entries_.empty()) entries_.back().afterMiss = true;
}

// "" as its title: it went nowhere.
Measurement MeasuredLog::measurementOf(const Point3& position, const Point3& way, std::string_view what) {
  Measurement found;
  const double ways[] = {way.x, way.y, way.z}, positions[] = {position.x, position.y, position.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(ways[axis]) < 1e-6) continue;
    const char letter = "XYZ"[axis];
    found.title += (found.title.empty() ? std::string(what) + " along " : " ");
    found.title += letter;
    found.title += ways[axis] > 0 ? '+' : '-';
    found.values.push_back({std::string(1, letter), std::nullopt, positions[axis]});
  }
  return found;
}

PictureMeasured* MeasuredLog::sameTouch(const Point3& position, const Point3& way, std::string_view system) {
  constexpr double kAlong = 0.5, kAcross = 0.01; // mm; a fast touch stops a little later than a slow one
  constexpr double kSameWay = 0.9999;            // of the cosine
  if (touch_.rows == 0 || touch_.rows != entries_.size() || touch_.calls != calls_.size()) return nullptr;
  PictureMeasured& last = entries_.back();
  const double lengths = way.length() * touch_.way.length();
  if (!last.offsets.empty() || last.system != system || lengths <= 0 ||
      way.dot(touch_.way) < kSameWay * lengths)
    return nullptr;
  const Point3 apart = position - touch_.position;
  const double along = apart.dot(way) / way.length();
  const double across = std::sqrt(std::max(0.0, apart.dot(apart) - along * along));
  return std::abs(along) <= kAlong && across <= kAcross ? &last : nullptr;
}

void MeasuredLog::touched(const Point3& position, const Point3& way) {
  if (!now_.block) return;
  Measurement found = measurementOf(position, way, "touch");
  if (found.values.empty()) return;
  PictureMeasured one = entry(std::move(found), now_.block(), now_.system());
  PictureMeasured* const same = sameTouch(position, way, one.system);
  if (same != nullptr && touch_.read) one.found.title += " again";
  if (same != nullptr && !touch_.read)
    *same = std::move(one);
  else
    add(std::move(one));
  touch_ = {entries_.size(), calls_.size(), position, way, false};
}

void MeasuredLog::missed(PictureMeasured one) {
  if (!now_.block) return;
  missedAt_ = calls_.size();
  one.missed = one.afterMiss = true;
  add(std::move(one));
}

void MeasuredLog::finish() {
  for (; !calls_.empty(); calls_.pop_back())
    close(std::move(calls_.back()));
}

} // namespace dotek::sim
