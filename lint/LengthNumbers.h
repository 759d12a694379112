// Numbers of the variables by which a program knows where the tool is and how long it is.
#pragma once

#include "lint/Project.h"

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

namespace dotek::lint {

// Of the profiles that a program may be for.
struct LengthNumbers {
  static constexpr std::uint32_t kZ = 2; // axes after X

  // An offset table whose entries are the wear alone, since the geometry has numbers of its own.
  struct Wear {
    stdlib::VariableRange wear;    // of offset 1 and up
    std::uint32_t geometry = 0;    // of offset 0
    std::string_view control = ""; // the name of its profile, which outlives this
  };

  explicit LengthNumbers(const Project& project);

  bool isToolOffset(std::uint32_t number) const;
  // nullptr: it is no wear. Where nobody names the control, that of controls which have one.
  const Wear* wearOf(std::uint32_t number) const;

  std::set<std::uint32_t> positions; // that hold the length
  std::set<std::uint32_t> machine, length;
  std::set<std::uint32_t> zeroes; // Z of work systems
  std::vector<stdlib::VariableRange> toolOffsets;
  std::vector<Wear> wears;

private:
  void add(const stdlib::Control& control);
  void drop(const stdlib::Control& control);
};

} // namespace dotek::lint
