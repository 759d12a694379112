// What values hold of the length of the tool, and what is known of them before a statement (ToolLength.h).
#pragma once

#include "ir/SharedMap.h"
#include "lint/LengthNumbers.h"
#include "lint/OffsetStates.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace dotek::lint {

inline constexpr std::uint32_t kLastLocal = 33;
inline constexpr std::uint32_t kFirstSystem = 1000;

struct PositionRead {
  std::uint32_t number = 0;
  SourceRange range;
  SourceRange passed = {}; // the call by which the program got it, in whose caller the range is
};

// What a value holds of the length of the tool.
struct Held {
  double lengths = 0;
  bool unknown = false;
  bool maybeAdded = false, maybeTaken = false; // a value that may be the length is a term, with + or with -
  std::optional<PositionRead> read;            // where the length comes from
  std::optional<PositionRead> length;          // #5083 itself is a term
  const LengthNumbers::Wear* wear = nullptr;   // the wear of a tool is a term
  bool off = false;                            // a position that was read under G49 is a term

  // Nothing in it has to do with lengths, whether one is in force or not.
  bool plain() const { return lengths == 0 && !unknown && !read && !length && !off; }
  bool none() const { return lengths == 0 && !unknown; }
  bool free() const { return maybeAdded || maybeTaken; }
  bool operator==(const Held& other) const {
    return lengths == other.lengths && unknown == other.unknown && maybeAdded == other.maybeAdded &&
           maybeTaken == other.maybeTaken && wear == other.wear && off == other.off &&
           read.has_value() == other.read.has_value() && length.has_value() == other.length.has_value();
  }
};

inline Held unknownHeld() {
  Held out;
  out.unknown = true;
  return out;
}

inline Held sum(const Held& a, const Held& b, bool subtract) {
  Held out;
  out.lengths = a.lengths + (subtract ? -b.lengths : b.lengths);
  out.unknown = a.unknown || b.unknown;
  out.maybeAdded = a.maybeAdded || (subtract ? b.maybeTaken : b.maybeAdded);
  out.maybeTaken = a.maybeTaken || (subtract ? b.maybeAdded : b.maybeTaken);
  out.read = a.read ? a.read : b.read;
  out.length = a.length ? a.length : b.length;
  out.wear = a.wear != nullptr ? a.wear : b.wear;
  out.off = a.off || b.off;
  return out;
}

inline Held times(const Held& a, double factor) {
  Held out = a;
  out.lengths = a.lengths * factor;
  if (factor < 0) std::swap(out.maybeAdded, out.maybeTaken);
  return out;
}

// Of a value that neither a sum nor a multiple is.
inline Held mixed(const Held& a, const Held& b) {
  if (!a.none() || !b.none()) return unknownHeld();
  Held out;
  out.maybeAdded = a.free() || b.free();
  out.wear = a.wear != nullptr ? a.wear : b.wear;
  out.off = a.off || b.off;
  return out;
}

struct Fact {
  ir::SharedMap<Held> values; // of variables that the program has set
  // A computed number may have set any of the locals, of the common variables below #500, of those from
  // there.
  std::uint8_t lost = 0;
  Offset offset = Offset::AsBefore;
};

// An argument is no length of a tool; what is left in a common variable may be.
inline Held entryValue(std::uint32_t number) {
  Held out;
  out.maybeAdded = number > kLastLocal;
  return out;
}

// A position on one path, and on the other a value that no length is in: it is wrong on the first. Where both
// come from positions, the paths may differ by whether a length is in force.
inline Held merged(Held into, const Held& other) {
  const auto holds = [](const Held& one) { return one.lengths != 0 && one.read && !one.length; };
  if (into.plain() && holds(other))
    into.lengths = other.lengths;
  else if (into.lengths != other.lengths && !(holds(into) && other.plain()))
    into.unknown = true;
  if (into.unknown) into.lengths = 0;
  into.unknown = into.unknown || other.unknown;
  into.maybeAdded = into.maybeAdded || other.maybeAdded;
  into.maybeTaken = into.maybeTaken || other.maybeTaken;
  if (!into.read) into.read = other.read;
  if (!into.length) into.length = other.length;
  if (into.wear == nullptr) into.wear = other.wear;
  into.off = into.off || other.off;
  return into;
}

inline bool merge(Fact& into, const Fact& other) {
  // A variable that only one of the two has set is what it was at the entry for the other.
  bool changed = into.values.unite(other.values, merged, [](std::uint32_t number, const Held& held) {
    return merged(held, entryValue(number));
  });
  if ((other.lost & ~into.lost) != 0) {
    into.lost = static_cast<std::uint8_t>(into.lost | other.lost);
    changed = true;
  }
  if (into.offset != other.offset && into.offset != Offset::Either) {
    into.offset = Offset::Either;
    changed = true;
  }
  return changed;
}

inline std::uint8_t kindOf(std::uint32_t number) {
  return number < 100 ? 1 : number < 500 ? 2 : 4;
}
inline constexpr std::uint8_t kEachKind = 7;

} // namespace dotek::lint
