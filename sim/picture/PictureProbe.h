// The probe as it stood where a run failed: outlines of stem and body in a view.
#pragma once

#include "sim/geometry/Probe.h"
#include "sim/picture/Sections.h"

#include <cstddef>
#include <string>

namespace dotek::sim {

// Elements without colours of their own; "": a bare ball. `centre`: of the ball on the sheet, px; `scale`: px
// per mm; `across`: the axis that is not seen.
std::string probeOutline(const Probe& probe, std::size_t across, const PlanePoint& centre, double scale);

} // namespace dotek::sim
