// What a run says where the profile of a control ends it, with the remedy.
#pragma once

#include <cstdint>
#include <fmt/format.h>
#include <string>
#include <string_view>

namespace dotek::sim {

// Where a program's number is above those of the profile.
inline constexpr std::string_view kLongProgramNumbers =
    "where the machine is set for longer ones, `[programs] last = 99999999` with `repeat_in_program = false` "
    "says "
    "so, in a file that extends this control (`dotek new control`)";

// "G54.1" of 541
inline std::string codeName(char letter, std::uint32_t tenths) {
  return tenths % 10 == 0 ? fmt::format("{}{}", letter, tenths / 10)
                          : fmt::format("{}{}.{}", letter, tenths / 10, tenths % 10);
}

// A code that the profile lacks. `probe`: it could be one that switches the probe.
inline std::string unlistedText(const std::string& control, const std::string& code, bool probe) {
  const std::string switches =
      fmt::format("where it switches the probe, `--probe-on {0}` or `--probe-off {0}` says so; ", code);
  return fmt::format(
      "`{0}` does not list it; {1}where it moves no axis and changes no mode, `--auxiliary {2}` "
      "lets it pass, and so does \"{2} auxiliary: ..\" in a file that extends the control "
      "(`dotek new control`)",
      control, probe ? switches : "", code);
}

// A program with a sign of a lathe in that line. `what`: what the block of the line does.
inline std::string latheText(std::uint64_t line, std::string_view what) {
  return fmt::format("the program is for a lathe: line {} {}", line, what);
}
// A block of one. `why`: latheText(); `meaning`: what it does there.
inline std::string onLatheText(std::string_view why, std::string_view meaning) {
  return fmt::format("{}; there this {}; `--control fanuc-0i-tf`, or a file that extends it, reads it so",
                     why, meaning);
}

} // namespace dotek::sim
