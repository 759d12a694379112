// The options of `sim` for a device beside the control.
#pragma once

#include <optional>
#include <string>

namespace dotek::sim {

struct DeviceOptions {
  std::optional<std::string> device; // --device: path
  bool report = false;               // its report as files "report" and "report-picture"
  std::string picture;               // name of the picture, as the report links it; "": none is made
};

} // namespace dotek::sim
