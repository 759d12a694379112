// Host inputs: values that the CAM knows and the macro does not (`--host NAME=VALUE`, `host` of a job).
// Numbers are mm, degrees, mm/min.
#pragma once

#include <algorithm>
#include <iterator>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

struct HostInput {
  std::string_view name;
  std::string_view meaning;   // with unit and frame
  bool ofCyclesAlone = false; // of the cycle language, never of a folder and its post
};

inline constexpr HostInput kHostInputs[] = {
    {"clearance", "Z of clearance plane 1 (the CP1 of a Prog), mm, active work system"},
    {"retract", "Z of the retract plane of the operation, mm; Z of a GibbsCAM path counts from it"},
    {"start_x", "X of the operation's point, mm, active work system"},
    {"start_y", "Y of the operation's point, mm, active work system"},
    {"start_z", "Z where the cycle begins, mm, active work system"},
    {"tool_radius", "radius of the stylus ball, mm"},
    {"tool_number", "number of the tool"},
    {"tool_offset", "number of the tool offset"},
    {"overtravel", "distance that a measuring move goes on after the expected surface, mm"},
    {"return_feed", "feed of the path back after a contact, mm/min"},
    {"approach_feed", "feed of the protected moves of a cycle that state none, mm/min", true},
    {"measuring_feed", "feed of the second touch of a cycle, mm/min", true},
};

// The names alone, in the order of the table.
inline std::vector<std::string_view> hostInputNames() {
  std::vector<std::string_view> out;
  for (const HostInput& host : kHostInputs)
    out.push_back(host.name);
  return out;
}

constexpr bool isHostInput(std::string_view name) {
  return std::any_of(std::begin(kHostInputs), std::end(kHostInputs),
                     [&](const HostInput& host) { return host.name == name; });
}

// What a host input has to be where `value` cannot be meant ("a number above 0"); "" for a value that can.
constexpr std::string_view hostInputRefuses(std::string_view name, double value) {
  if (name == "tool_radius" || name == "return_feed" || name == "approach_feed" || name == "measuring_feed")
    return value > 0 ? "" : "a number above 0";
  if (name == "overtravel") return value >= 0 ? "" : "0 or more";
  if (name == "tool_number" || name == "tool_offset") {
    const bool whole =
        value >= 0 && value <= 99999999 && value == static_cast<double>(static_cast<long>(value));
    return whole ? "" : "a whole number, 0 or more";
  }
  return "";
}

} // namespace dotek::stdlib
