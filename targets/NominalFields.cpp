#include "targets/NominalFields.h"

#include <algorithm>
#include <cmath>

namespace dotek::targets {

namespace {

constexpr double kSame = 1e-7;   // mm
constexpr double kStarts = 1000; // of a mm, that start points have

} // namespace

void NominalFields::roundStart(verify::Case& drawn) const {
  int places = 3;
  for (const verify::DrawField& field : fields_)
    if (field.kind != ir::Kind::WorkOffset) places = std::min(places, field.decimals);
  const double unit = std::pow(10.0, places);
  for (const char* name : {"start_x", "start_y"})
    if (const auto host = drawn.hosts.find(name); host != drawn.hosts.end())
      host->second = std::round(host->second * unit) / unit;
}

std::optional<verify::Case>
NominalFields::settle(verify::Case drawn, const std::vector<const char*>& starts,
                      const std::function<std::optional<std::vector<double>>(const verify::Case&)>& misses) {
  std::optional<std::vector<double>> now = misses(drawn);
  // The case misses this zero no more, and the others as before.
  const auto takes = [&](verify::Case other, std::size_t i) {
    auto then = misses(other);
    if (!then || then->size() != now->size()) return false;
    for (std::size_t n = 0; n < now->size(); ++n)
      if (std::abs((*then)[n] - (n == i ? 0 : (*now)[n])) > kSame) return false;
    drawn = std::move(other);
    now = std::move(then);
    return true;
  };
  for (std::size_t i = 0; now && i < now->size(); ++i) {
    const double miss = (*now)[i];
    if (std::abs(miss) < kSame) continue;
    const auto attempt = [&](const verify::DrawField& field) {
      const auto value = drawn.values.find(field.name);
      if (field.fixed || field.kind == ir::Kind::WorkOffset || value == drawn.values.end()) return false;
      verify::Case other = drawn;
      const double unit = std::pow(10.0, field.decimals);
      // A zero lies where the surface is, less its coordinate.
      other.values[field.name] = std::round((value->second + miss) * unit) / unit;
      if (!takes(std::move(other), i)) return false;
      known_[i] = field.name;
      return true;
    };
    // The nominal is written in the branch: the part lies where it is that.
    const auto move = [&](const char* start) {
      const auto host = drawn.hosts.find(start);
      if (host == drawn.hosts.end()) return false;
      for (const double by : {miss, -miss}) {
        verify::Case other = drawn;
        other.hosts[start] = std::round((host->second + by) * kStarts) / kStarts;
        if (takes(std::move(other), i)) return true;
      }
      return false;
    };
    const auto known = std::find_if(fields_.begin(), fields_.end(), [&](const verify::DrawField& field) {
      return known_.contains(i) && field.name == known_.at(i);
    });
    if (known != fields_.end() && attempt(*known)) continue;
    if (std::none_of(fields_.begin(), fields_.end(), attempt) &&
        std::none_of(starts.begin(), starts.end(), move))
      return std::nullopt;
  }
  if (!now) return std::nullopt;
  return drawn;
}

} // namespace dotek::targets
