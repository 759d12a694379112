#include "posts/CncCycle.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <optional>

namespace dotek::posts::cnc {

namespace {

std::optional<double> numberOf(const std::string* json) {
  double out = 0;
  if (json == nullptr) return std::nullopt;
  const auto read = std::from_chars(json->data(), json->data() + json->size(), out);
  return read.ec == std::errc() && read.ptr == json->data() + json->size() ? std::optional(out)
                                                                           : std::nullopt;
}

} // namespace

std::vector<std::string> CycleOfJob::parameters() {
  std::vector<std::string> out;
  for (const Named& one : given_) {
    if (one.name == "kind") continue;
    std::string json = jsonOf(one);
    if (const auto* placed = std::get_if<Double3>(&one.value)) {
      const Single3& first = points_.front().to;
      for (std::size_t i = 0; i < 2; ++i)
        if (std::abs((*placed)[i] - static_cast<double>(first[i])) > 1e-4)
          throw fmt::format("`{}` of a cycle lies elsewhere than its first point", one.name);
      json = jsonNumber((*placed)[2]);
    }
    values_.set(one.name, json);
    out.push_back(parameterStep(one.name, json));
  }
  for (const Move& point : points_)
    if ((point.flags & (kCompensationLeft | kCompensationRight)) != 0)
      throw std::string("a cycle with radius compensation");
  complete();
  return out;
}

std::string CycleOfJob::record() {
  std::vector<std::string> points;
  for (const Move& point : points_)
    points.push_back(numbers(point.to));
  JsonObject out;
  out.add("record", jsonText("cycle"));
  out.add("type", jsonText(type_));
  out.add("cycle", objectOf(values_));
  out.add("points", jsonList(points));
  return out.text();
}

// What the trace of an engine shows in a cycle beyond the values of its job.
void CycleOfJob::complete() {
  const auto value = [&](const char* name) { return values_.find(name); };
  const auto stock = numberOf(value("stock")), below = numberOf(value("depth"));
  if (!holes_->contains(type_) || !stock || !below) return;
  const std::string depth = *value("depth");
  const auto fill = [&](const char* name, const std::string& json) {
    if (value(name) == nullptr) values_.set(name, json);
  };
  fill("bottom", jsonNumber(*stock - *below));
  if (const std::string* const feed = value("feedrate")) {
    const std::string same = *feed;
    fill("retractFeedrate", same);
    fill("plungeFeedrate", same);
  }
  fill("incrementalDepth", depth);
  fill("plungesPerRetract", "1");
  fill("shiftDirection", jsonNumber(std::numbers::pi));
  for (const char* const name :
       {"dwell", "incrementalDepthReduction", "minimumIncrementalDepth", "shift", "shiftOrientation",
        "compensatedShiftOrientation", "backBoreDistance", "stopSpindle"})
    fill(name, "0");
}

} // namespace dotek::posts::cnc
