// What an operator sets before a program runs: tools, work offsets, where the spindle is. From flags, or from
// [setup] of a machine's or a job's file; docs/part.md. Lengths in mm.
#pragma once

#include "stdlib/Toml.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::stdlib {

struct Setup {
  struct Zero {
    std::uint32_t system = 0;      // 0: G54, 5: G59
    bool ofPart = false;           // where the part is meant to be
    std::array<double, 3> place{}; // else in coordinates of the machine
  };
  std::optional<std::uint32_t> tool;                   // in the spindle; its offset has the same number
  std::optional<double> length;                        // of that tool, as its offset says
  std::vector<std::pair<std::uint32_t, double>> tools; // lengths of others, by offset
  std::optional<double> ballDiameter;                  // of a stylus that no machine's file describes
  std::vector<Zero> zeros;                             // each system once
  std::optional<std::array<double, 3>> at;             // the tool's end, in G54
  std::string call;                                    // arguments of G65, "": the program runs as it is

  // "--tool": of what is set the first; "" where nothing is.
  std::string_view firstFlag() const;
  // What `other` says goes first.
  void override(const Setup& other);
};

// 0 to 5 for G54 to G59; nothing: it is none of them.
std::optional<std::uint32_t> systemByName(std::string_view name);

// A table [setup]; defects are reported by the document.
Setup readSetup(const TomlDocument& document, const TomlTable& table);

} // namespace dotek::stdlib
