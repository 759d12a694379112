#include "posts/CncNames.h"

#include <array>
#include <utility>

namespace dotek::posts::cnc {

namespace {

using Number = std::pair<std::uint32_t, std::string_view>;

template <std::size_t N> std::string_view nameIn(const std::array<Number, N>& all, std::uint32_t number) {
  for (const auto& [value, name] : all)
    if (value == number) return name;
  return {};
}

} // namespace

// The parameters `movement:..` of each operation come in this order, and hold the feeds of these moves.
std::string_view movementName(std::uint32_t number) {
  constexpr std::array<std::string_view, 16> kNames = {
      "MOVEMENT_RAPID",           "MOVEMENT_LEAD_IN",     "MOVEMENT_CUTTING",        "MOVEMENT_LEAD_OUT",
      "MOVEMENT_LINK_TRANSITION", "MOVEMENT_LINK_DIRECT", "MOVEMENT_RAMP_HELIX",     "MOVEMENT_RAMP_PROFILE",
      "MOVEMENT_RAMP_ZIG_ZAG",    "MOVEMENT_RAMP",        "MOVEMENT_PLUNGE",         "MOVEMENT_PREDRILL",
      "MOVEMENT_EXTENDED",        "MOVEMENT_REDUCED",     "MOVEMENT_FINISH_CUTTING", "MOVEMENT_HIGH_FEED"};
  return number < kNames.size() ? kNames[number] : std::string_view();
}

std::string_view commandName(std::uint32_t number) {
  constexpr std::array<Number, 19> kNames = {{{1, "COMMAND_STOP"},
                                              {2, "COMMAND_OPTIONAL_STOP"},
                                              {12, "COMMAND_ACTIVATE_SPEED_FEED_SYNCHRONIZATION"},
                                              {13, "COMMAND_DEACTIVATE_SPEED_FEED_SYNCHRONIZATION"},
                                              {17, "COMMAND_START_CHIP_TRANSPORT"},
                                              {18, "COMMAND_STOP_CHIP_TRANSPORT"},
                                              {19, "COMMAND_OPEN_DOOR"},
                                              {20, "COMMAND_CLOSE_DOOR"},
                                              {21, "COMMAND_BREAK_CONTROL"},
                                              {22, "COMMAND_TOOL_MEASURE"},
                                              {23, "COMMAND_CALIBRATE"},
                                              {24, "COMMAND_VERIFY"},
                                              {25, "COMMAND_CLEAN"},
                                              {26, "COMMAND_ALARM"},
                                              {27, "COMMAND_ALERT"},
                                              {29, "COMMAND_POWER_ON"},
                                              {30, "COMMAND_POWER_OFF"},
                                              {38, "COMMAND_PROBE_ON"},
                                              {39, "COMMAND_PROBE_OFF"}}};
  return nameIn(kNames, number);
}

std::string_view coolantName(std::uint32_t number) {
  constexpr std::array<std::string_view, 9> kNames = {
      "COOLANT_OFF",          "COOLANT_FLOOD",      "COOLANT_MIST",
      "COOLANT_THROUGH_TOOL", "COOLANT_AIR",        "COOLANT_AIR_THROUGH_TOOL",
      "COOLANT_SUCTION",      "COOLANT_FLOOD_MIST", "COOLANT_FLOOD_THROUGH_TOOL"};
  return number < kNames.size() ? kNames[number] : std::string_view();
}

std::string_view sectionTypeName(std::uint32_t number) {
  constexpr std::array<Number, 3> kNames = {{{0, "TYPE_MILLING"}, {1, "TYPE_TURNING"}, {3, "TYPE_JET"}}};
  return nameIn(kNames, number);
}

std::string_view toolTypeName(std::uint32_t number, std::string_view text) {
  constexpr std::array<Number, 16> kNames = {{{1, "TOOL_DRILL"},
                                              {3, "TOOL_DRILL_SPOT"},
                                              {5, "TOOL_MILLING_END_FLAT"},
                                              {6, "TOOL_MILLING_END_BALL"},
                                              {8, "TOOL_MILLING_CHAMFER"},
                                              {9, "TOOL_MILLING_FACE"},
                                              {15, "TOOL_TAP_RIGHT_HAND"},
                                              {16, "TOOL_TAP_LEFT_HAND"},
                                              {17, "TOOL_REAMER"},
                                              {22, "TOOL_TURNING_GENERAL"},
                                              {23, "TOOL_TURNING_THREADING"},
                                              {24, "TOOL_TURNING_GROOVING"},
                                              {27, "TOOL_PROBE"},
                                              {29, "TOOL_WATER_JET"},
                                              {30, "TOOL_LASER_CUTTER"},
                                              {36, "TOOL_PLASMA_CUTTER"}}};
  if (const std::string_view known = nameIn(kNames, number); !known.empty()) return known;
  constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kTexts = {
      {{"center drill", "TOOL_DRILL_CENTER"},
       {"bull nose end mill", "TOOL_MILLING_END_BULLNOSE"},
       {"slot mill", "TOOL_MILLING_SLOT"},
       {"radius mill", "TOOL_MILLING_RADIUS"},
       {"dovetail mill", "TOOL_MILLING_DOVETAIL"},
       {"tapered mill", "TOOL_MILLING_TAPERED"},
       {"lollipop mill", "TOOL_MILLING_LOLLIPOP"},
       {"thread mill", "TOOL_MILLING_THREAD"},
       {"form mill", "TOOL_MILLING_FORM"},
       {"boring bar", "TOOL_BORING_BAR"},
       {"counter bore", "TOOL_COUNTER_BORE"},
       {"counter sink", "TOOL_COUNTER_SINK"},
       {"turning boring", "TOOL_TURNING_BORING"},
       {"holder only", "TOOL_HOLDER_ONLY"}}};
  for (const auto& [name, constant] : kTexts)
    if (name == text) return constant;
  return {};
}

} // namespace dotek::posts::cnc
