#include "stdlib/Lathe.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dotek::stdlib {
namespace {

constexpr std::uint32_t kAxes = ir::addressBits("XYZABC");

bool hasG(const ir::NcWords& block, std::uint32_t tenths) {
  const auto end = block.g.begin() + block.gCount;
  return std::find(block.g.begin(), end, tenths) != end;
}

bool hasAny(const ir::NcWords& block, std::uint32_t letters) {
  return (block.present & letters) != 0;
}

bool hasAll(const ir::NcWords& block, std::uint32_t letters) {
  return (block.present & letters) == letters;
}

// A tool change by M6 or a length by G43.
bool isOfMills(const ir::NcWords& block) {
  const auto end = block.m.begin() + block.mCount;
  return std::find(block.m.begin(), end, 6U) != end || hasG(block, 430);
}

std::string_view certainWork(const ir::NcWords& block) {
  const bool axes = hasAny(block, kAxes);
  const bool turned = hasAny(block, ir::addressBits("UW"));
  if (hasG(block, 500) && block.has('S') && !axes) return "limits the speed of a spindle that turns the part";
  for (const std::uint32_t cycle : {700U, 710U, 720U, 730U})
    if (hasG(block, cycle) && hasAll(block, ir::addressBits("PQ")) && !axes)
      return "turns a contour by its first and its last block";
  if (hasG(block, 280) && turned && !axes)
    return "goes to the reference point by U and W, which are X and Z by increments";
  if (hasG(block, 100) && turned && block.has('P') && !block.has('L'))
    return "adds to the offset of a turning tool";
  return {};
}

// What a mill could hardly have, and does not where there is a Y.
std::string_view likelyWork(const ir::NcWords& block) {
  if (hasG(block, 920) && hasAny(block, ir::addressBits("XZ")) && block.has('F'))
    return "cuts a thread by G92 and its lead";
  if (hasG(block, 760) && hasAll(block, ir::addressBits("PQ")) && !hasAny(block, kAxes))
    return "says how a thread is cut by G76";
  constexpr double kFirst = 101, kLast = 9999, kOffsets = 100;
  const double tool = block.has('T') ? block.of('T') : 0;
  if (tool >= kFirst && tool <= kLast && tool == std::floor(tool) &&
      std::floor(tool / kOffsets) == std::fmod(tool, kOffsets))
    return "takes a tool and its offset by one number";
  return {};
}

} // namespace

void addWord(ir::NcWords& block, char address, std::optional<double> value) {
  if (address < 'A' || address > 'Z') return;
  const bool code = value && *value >= 0 && *value < 1e5;
  if (address == 'G')
    block.addG(code ? static_cast<std::uint32_t>(std::lround(*value * 10)) : ir::NcWords::kNoCode);
  else if (address == 'M')
    block.addM(code ? static_cast<std::uint32_t>(std::lround(*value)) : ir::NcWords::kNoCode);
  else
    block.set(address, value.value_or(std::numeric_limits<double>::quiet_NaN()));
}

void LatheSigns::look(const ir::NcWords& block, std::size_t at) {
  mill_ = mill_ || isOfMills(block);
  y_ = y_ || block.has('Y');
  const auto note = [&](std::optional<Sign>& first, std::string_view what) {
    if (!what.empty() && !first) first = Sign{what, at};
  };
  note(certain_, certainWork(block));
  note(withoutY_, likelyWork(block));
}

std::optional<LatheSigns::Sign> LatheSigns::sign() const {
  if (mill_) return std::nullopt;
  return certain_ || y_ ? certain_ : withoutY_;
}

std::string_view meaningOnLathe(const ir::NcWords& block) {
  const bool axes = hasAny(block, ir::addressBits("XZUW"));
  if (hasG(block, 900) && axes) return "is a turning cycle";
  if (hasG(block, 920) && axes) return "cuts a thread, or sets the coordinates";
  if (hasG(block, 940) && axes) return "is a facing cycle";
  if (hasG(block, 500) && axes) return "sets the coordinates";
  if (hasG(block, 730) || hasG(block, 740) || hasG(block, 760)) return "is a cycle of another meaning";
  if (hasG(block, 100) && !block.has('L')) return "is the offset of a tool";
  if (hasAny(block, ir::addressBits("UW"))) return "is X or Z by an increment";
  return {};
}

} // namespace dotek::stdlib
