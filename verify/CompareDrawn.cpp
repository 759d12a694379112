// The drawn path beside a program.
#include "verify/Compare.h"
#include "verify/PathPieces.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::verify {

using sim::Point3;

namespace {

// The point of a path as a piece; measures of a program add none.
std::vector<Piece> piecesOf(const DrawnPath& path, const Point3& offset) {
  std::vector<Piece> out;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    Piece piece;
    piece.from = path.points[i - 1] + offset;
    piece.to = path.points[i] + offset;
    piece.range = path.ranges[i];
    out.push_back(piece);
  }
  return out;
}

// Without the paths to touches and back: those are compared as contacts. A path that goes on through the
// starting point of a touch on the far side comes back to it.
std::vector<Piece> withoutTouches(const DrawnPath& path, const Point3& offset) {
  std::vector<Piece> all = piecesOf(path, offset);
  std::vector<Piece> out;
  Point3 at = path.points.front() + offset;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool touch = std::any_of(path.touches.begin(), path.touches.end(),
                                   [&](const DrawnTouch& one) { return one.move == i + 1; });
    if (touch) continue; // the probe measures from `at`
    Piece piece = all[i];
    piece.from = at;
    at = piece.to;
    out.push_back(piece);
  }
  return out;
}

} // namespace

std::vector<Difference> compare(const DrawnPath& path, const Point3& offset, const Record& program,
                                double tolerance) {
  std::vector<Difference> out;
  const auto add = [&](Aspect aspect, std::string text, SourceRange source, SourceRange target) {
    const bool there =
        std::any_of(out.begin(), out.end(), [&](const Difference& one) { return one.aspect == aspect; });
    if (!there) out.push_back({aspect, std::move(text), source, target});
  };
  // Contacts: of one measure in any order.
  std::size_t next = 0;
  for (const Measure& measure : program.measures) {
    std::vector<bool> used(measure.nominal.size(), false);
    for (std::size_t n = 0; n < measure.nominal.size(); ++n, ++next) {
      if (next >= path.touches.size()) {
        add(Aspect::Nominal,
            fmt::format("the path touches nothing more against a surface at {}",
                        textOf(measure.nominal[n].point)),
            path.ranges.empty() ? SourceRange{} : path.ranges.back(), measure.range);
        break;
      }
      const Touch& drawn = path.touches[next].touch;
      const Point3 point = drawn.point + offset;
      const auto fits = [&](std::size_t i) {
        return !used[i] && near(measure.nominal[i].point, point, tolerance) &&
               near(measure.nominal[i].direction, drawn.direction, 1e-9);
      };
      std::size_t i = 0;
      while (i < used.size() && !fits(i))
        ++i;
      if (i == used.size()) {
        add(Aspect::Nominal,
            fmt::format("the path touches a surface at {} against {}", textOf(point),
                        textOf(measure.nominal[n].point)),
            path.touches[next].range, measure.range);
        break;
      }
      used[i] = true;
    }
    if (!out.empty()) break;
  }
  if (out.empty() && program.ending == Ending::Finished && next < path.touches.size())
    add(Aspect::Nominal,
        fmt::format("the path touches a surface at {} against no measure",
                    textOf(path.touches[next].touch.point + offset)),
        path.touches[next].range, {});

  if (program.ending != Ending::Finished) return out;
  const std::vector<Piece> a = straight(withoutTouches(path, offset), false, tolerance);
  std::vector<Piece> moves;
  for (const Piece& piece : program.pieces)
    if (piece.kind != sim::PathKind::Measuring) moves.push_back(piece);
  const std::vector<Piece> b = straight(moves, false, tolerance);
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i < a.size() && i < b.size() && near(a[i].to, b[i].to, tolerance)) continue;
    const std::string one = i < a.size() ? "the path goes to " + textOf(a[i].to) : "the path ends";
    const std::string other = i < b.size() ? textOf(b[i].to) : std::string("the end");
    add(Aspect::Path, one + " against " + other,
        i < a.size()          ? a[i].range
        : path.ranges.empty() ? SourceRange{}
                              : path.ranges.back(),
        i < b.size() ? b[i].range : SourceRange{});
    break;
  }
  if (!path.points.empty() && !near(path.points.back() + offset, program.end, tolerance))
    add(Aspect::End,
        fmt::format("the path ends at {} against {}", textOf(path.points.back() + offset),
                    textOf(program.end)),
        path.ranges.back(), program.pieces.empty() ? SourceRange{} : program.pieces.back().range);
  return out;
}

} // namespace dotek::verify
