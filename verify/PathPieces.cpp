#include "verify/PathPieces.h"

#include "support/Decimal.h"

#include <cmath>
#include <fmt/format.h>

namespace dotek::verify {

using sim::Point3;

namespace {

constexpr int kShown = 6; // decimals

} // namespace

bool between(const Point3& a, const Point3& b, const Point3& c, double tolerance) {
  const Point3 way = c - a, part = b - a;
  const double length = way.length();
  if (!(length > 0)) return false;
  const double share = part.dot(way) / (length * length);
  return share >= 0 && share <= 1 && (part - way * share).length() <= tolerance;
}

std::string textOf(const Point3& p) {
  return fmt::format("X{} Y{} Z{}", fixedText(p.x, kShown), fixedText(p.y, kShown), fixedText(p.z, kShown));
}

bool near(const Point3& a, const Point3& b, double tolerance) {
  return std::abs(a.x - b.x) <= tolerance && std::abs(a.y - b.y) <= tolerance &&
         std::abs(a.z - b.z) <= tolerance;
}

std::vector<Piece> straight(const std::vector<Piece>& pieces, bool kinds, double tolerance) {
  std::vector<Piece> out;
  for (const Piece& piece : pieces) {
    if (piece.kind == sim::PathKind::Measuring && kinds) {
      out.push_back(piece);
      continue;
    }
    if (near(piece.from, piece.to, tolerance)) continue;
    if (!out.empty()) {
      Piece& last = out.back();
      const bool alike = !kinds || (last.kind == piece.kind && last.with == piece.with &&
                                    last.feed == piece.feed && last.goesOn == piece.goesOn);
      const bool joined = near(last.to, piece.from, tolerance);
      if (alike && joined && between(last.from, last.to, piece.to, tolerance)) {
        last.to = piece.to;
        continue;
      }
    }
    out.push_back(piece);
  }
  return out;
}

} // namespace dotek::verify
