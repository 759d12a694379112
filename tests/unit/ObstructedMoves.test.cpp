// What protected moves meet where the source is compared with its translation.
#include "targets/MissedTouches.h"

#include <doctest/doctest.h>

namespace dotek::tests {
namespace {

// The source stops half way of a protected move of `length`, the translation goes on.
std::size_t differencesOf(double length) {
  verify::Record undisturbed;
  undisturbed.protectedMoves = 1;
  verify::Record stopped = undisturbed;
  stopped.ending = verify::Ending::Alarm;
  stopped.alarmKind = "path-obstructed";
  verify::Piece& piece = stopped.pieces.emplace_back();
  piece.kind = sim::PathKind::Protected;
  piece.to = {length / 2, 0, 0};
  const targets::DisturbedSides sides{
      [&](const verify::Interference&) -> std::optional<verify::Record> { return stopped; },
      [&](const verify::Interference&) { return undisturbed; },
      [](const verify::Record&) { return verify::CompareRules(); }};
  return targets::compareDisturbed(undisturbed, undisturbed, sides).size();
}

} // namespace

TEST_CASE("verify: a protected move that a control may round to none meets nothing") {
  CHECK(differencesOf(0.0002) == 0);
  CHECK(differencesOf(0.002) == 0);
  CHECK(differencesOf(0.01) > 0);
  CHECK(differencesOf(5) > 0);
}

} // namespace dotek::tests
