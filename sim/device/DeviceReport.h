// What a device did in a run, as a page: variables of the program as tables, readings, rows that the device
// took over, and the error of the machine before and after.
#pragma once

#include "sim/device/Device.h"

#include <string>
#include <vector>

namespace dotek::sim {

struct DeviceReportHead {
  std::string program, control, device; // paths, and the title of the control
  std::string ending;                   // "program end", "alarm 3001"
  bool complete = false;                // the program came to its end
  std::string picture;                  // file of devicePicture(), as the page links it
  std::string date;                     // "": none
  std::vector<std::string> findings;    // errors and warnings of the run, with their places
};

// Markdown.
std::string deviceReport(const DeviceReportHead& head, const Device& device, const Machine& machine);
// SVG: errors before and after, and the values that the rules set, over the position. "": nothing to draw.
std::string devicePicture(const Device& device);

// The error of the machine at a position with the initial values, with what a rule sets there, and that.
struct Compared {
  double position = 0, before = 0, after = 0, value = 0;
};
// Where the report's plan says, for a rule and the first error that it corrects; empty: there is none.
std::vector<Compared> compare(const Device& device, const DeviceRule& rule);

} // namespace dotek::sim
