#include "sim/picture/PictureProbe.h"

#include "sim/picture/PictureText.h"

#include <fmt/format.h>

namespace dotek::sim {
namespace {

std::string px(double value) {
  return shortNumber(value, 2);
}

// A cylinder with a round lower end at `low` px, up to `high`.
std::string upright(double x, double low, double high, double radius) {
  if (low - high < radius) high = low - radius;
  return fmt::format("<path d=\"M{0} {1}V{2}A{3} {3} 0 0 0 {4} {2}V{1}z\"/>", px(x - radius), px(high),
                     px(low - radius), px(radius), px(x + radius));
}

} // namespace

std::string probeOutline(const Probe& probe, std::size_t across, const PlanePoint& centre, double scale) {
  constexpr double kMost = 1e5; // px
  const double stem = probe.stemDiameter / 2 * scale, body = probe.bodyDiameter / 2 * scale;
  const double stemUp = probe.stemLength * scale, bodyUp = probe.bodyLength * scale;
  if (!(stem > 0) || !(stem < kMost) || !(stemUp >= 0) || !(stemUp < kMost)) return "";
  const bool hasBody = body > 0 && body < kMost && bodyUp >= 0 && bodyUp < kMost;
  std::string out;
  if (across == 2) {
    for (const double radius : {stem, hasBody ? body : 0})
      if (radius > 0)
        out +=
            fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>", px(centre[0]), px(centre[1]), px(radius));
    return out;
  }
  const double top = centre[1] - stemUp;
  out = upright(centre[0], centre[1] + stem, top, stem);
  if (hasBody) out += upright(centre[0], top, top - bodyUp, body);
  return out;
}

} // namespace dotek::sim
