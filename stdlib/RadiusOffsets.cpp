#include "stdlib/RadiusOffsets.h"

namespace dotek::stdlib {

RadiusOffsets radiusOffsets(const Control& control) {
  RadiusOffsets out;
  for (const StateRange& range : control.state) {
    if (range.title == kRadiusGeometryTitle) out.geometry = static_cast<int>(range.first) - 1;
    if (range.title == kRadiusWearTitle) out.wear = static_cast<int>(range.first) - 1;
  }
  return out;
}

} // namespace dotek::stdlib
