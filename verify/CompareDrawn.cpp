// The drawn path beside a program.
#include "verify/Compare.h"
#include "verify/PathPieces.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

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

// Moves of the path that a call makes by itself, which touches several surfaces: from the last point before
// its first touch at which it begins to the first one after its last touch at which it ends. Where the path
// never is at one of these, its moves on that side stay. `from`, `to`: the call's touches, the path's next
// one after them excluded.
void addMovesOfCall(const DrawnPath& path, const Point3& offset, const Measure& measure, std::size_t from,
                    std::size_t to, double tolerance, std::set<std::size_t>& moves) {
  const std::size_t first = path.touches[from].move, last = path.touches[to - 1].move;
  const std::size_t least = from == 0 ? 0 : path.touches[from - 1].move;
  const std::size_t most = to < path.touches.size() ? path.touches[to].move : path.points.size();
  const auto at = [&](std::size_t point, const Point3& wanted) {
    return near(path.points[point] + offset, wanted, tolerance);
  };
  std::size_t begin = first;
  for (std::size_t point = first; point-- > least;)
    if (at(point, measure.start)) {
      begin = point + 1;
      break;
    }
  std::size_t end = last;
  for (std::size_t point = last + 1; point < most; ++point)
    if (at(point, measure.end)) {
      end = point;
      break;
    }
  for (std::size_t move = begin; move <= end; ++move)
    moves.insert(move);
}

// Without the paths to touches and back: those are compared as contacts. A path that goes on through the
// starting point of a touch on the far side comes back to it. `ofCalls`: moves that are left out, too.
std::vector<Piece> withoutTouches(const DrawnPath& path, const Point3& offset,
                                  const std::set<std::size_t>& ofCalls) {
  std::vector<Piece> all = piecesOf(path, offset);
  std::vector<Piece> out;
  Point3 at = path.points.front() + offset;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (ofCalls.contains(i + 1)) {
      at = all[i].to;
      continue;
    }
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

// Of the ball, as the touches along X and Y show it.
double radiusOf(const DrawnPath& path) {
  for (const DrawnTouch& one : path.touches)
    if (one.touch.direction.z == 0) return one.touch.point.z - path.points[one.move].z;
  return 0;
}

// A bare skip move expects its surface where it ends.
std::vector<Touch> nominalOf(const Measure& measure, double radius) {
  if (!measure.nominal.empty() || !measure.aim) return measure.nominal;
  const Point3 way = *measure.aim - measure.start;
  if (!(way.length() > 0)) return {};
  Touch out{*measure.aim, way * (1 / way.length())};
  if (out.direction.z == 0) out.point = out.point + out.direction * radius + Point3{0, 0, radius};
  return {out};
}

// A travel that goes on beyond the surface finds it, however far it would go. `start`: of the ball's lowest
// point.
bool isOnTheWay(const Touch& wanted, const Point3& surface, const Point3& start, double tolerance) {
  const Point3 beyond = wanted.point - surface;
  const double along = beyond.dot(wanted.direction), whole = (wanted.point - start).dot(wanted.direction);
  return along >= -tolerance && along <= whole && near(beyond, wanted.direction * along, tolerance);
}

// A program that loads its tool comes from the place where it changes it, and may go back there: of that,
// what lies above where the drawn path begins and ends is not drawn. The moves stay as they are where they
// do not lead through these places from above.
void trimToolChange(const Point3& first, const Point3& last, double tolerance, std::vector<Piece>& moves) {
  for (std::size_t i = 0; i < moves.size() && moves[i].from.z >= first.z - tolerance; ++i) {
    const bool through = near(moves[i].from, first, tolerance) || near(moves[i].to, first, tolerance) ||
                         between(moves[i].from, first, moves[i].to, tolerance);
    if (!through) continue;
    Piece approach = moves[i];
    approach.to = first;
    approach.from = first + Point3{1, 2, 3}; // aslant: no piece after it goes on in one line with it
    moves[i].from = first;
    moves.erase(moves.begin(), moves.begin() + static_cast<std::ptrdiff_t>(i));
    moves.insert(moves.begin(), approach);
    break;
  }
  while (!moves.empty()) {
    Piece& up = moves.back();
    const bool vertical = std::abs(up.from.x - up.to.x) <= tolerance &&
                          std::abs(up.from.y - up.to.y) <= tolerance && up.to.z >= up.from.z - tolerance;
    if (!vertical || up.to.z <= last.z + tolerance ||
        !between(up.from, {up.to.x, up.to.y, last.z}, up.to, tolerance)) {
      if (!vertical || up.from.z < last.z - tolerance) break;
      if (near(up.to, last, tolerance)) break;
      moves.pop_back();
      continue;
    }
    up.to.z = last.z;
    break;
  }
}

} // namespace

std::vector<Difference> compare(const DrawnPath& path, const Point3& offset, const Record& program,
                                double tolerance, bool loops) {
  std::vector<Difference> out;
  const auto add = [&](Aspect aspect, std::string text, SourceRange source, SourceRange target) {
    const bool there =
        std::any_of(out.begin(), out.end(), [&](const Difference& one) { return one.aspect == aspect; });
    if (!there) out.push_back({aspect, std::move(text), source, target});
  };
  // Contacts: of one measure in any order.
  const double radius = radiusOf(path);
  std::size_t next = 0;
  bool unstated = false;
  std::set<std::size_t> ofCalls; // moves of the path
  std::set<std::size_t> again;   // measures of the surface that the one before has found
  for (std::size_t m = 0; m < program.measures.size(); ++m) {
    const Measure& measure = program.measures[m];
    if (!measure.unstated.empty() && measure.nominal.empty()) {
      unstated = true; // what it touches of what is drawn is not known
      break;
    }
    const std::vector<Touch> nominal = nominalOf(measure, radius);
    const auto meets = [&](const Touch& wanted, const Touch& drawn) {
      return near(wanted.direction, drawn.direction, 1e-9) &&
             (near(wanted.point, drawn.point + offset, tolerance) ||
              (measure.travels && isOnTheWay(wanted, drawn.point + offset, measure.start, tolerance)));
    };
    if (measure.travels && nominal.size() == 1 && next > 0 &&
        !(next < path.touches.size() && meets(nominal[0], path.touches[next].touch)) &&
        meets(nominal[0], path.touches[next - 1].touch)) {
      again.insert(m);
      continue;
    }
    // The same block once more, in a loop that goes on until it is content: the path draws one round.
    const bool repeated =
        next >= path.touches.size() &&
        std::any_of(program.measures.begin(), program.measures.begin() + static_cast<std::ptrdiff_t>(m),
                    [&](const Measure& one) { return one.range == measure.range; });
    const auto isDrawn = [&](const Touch& wanted) {
      return std::any_of(path.touches.begin(), path.touches.end(),
                         [&](const DrawnTouch& one) { return meets(wanted, one.touch); });
    };
    if (repeated && std::all_of(nominal.begin(), nominal.end(), isDrawn)) {
      again.insert(m);
      continue;
    }
    std::vector<bool> used(nominal.size(), false);
    const std::size_t firstTouch = next;
    for (std::size_t n = 0; n < nominal.size(); ++n, ++next) {
      if (next >= path.touches.size()) {
        add(Aspect::Nominal,
            fmt::format("the path touches nothing more against a surface at {}", textOf(nominal[n].point)),
            path.ranges.empty() ? SourceRange{} : path.ranges.back(), measure.range);
        break;
      }
      const Touch& drawn = path.touches[next].touch;
      std::size_t i = 0;
      while (i < used.size() && (used[i] || !meets(nominal[i], drawn)))
        ++i;
      if (i == used.size()) {
        add(Aspect::Nominal,
            fmt::format("the path touches a surface at {} against {}", textOf(drawn.point + offset),
                        textOf(nominal[n].point)),
            path.touches[next].range, measure.range);
        break;
      }
      used[i] = true;
    }
    if (!out.empty()) break;
    if (nominal.size() > 1) addMovesOfCall(path, offset, measure, firstTouch, next, tolerance, ofCalls);
  }
  // Rounds that are drawn and were not needed touch what was touched.
  const auto isAgain = [&](const DrawnTouch& one) {
    return std::any_of(path.touches.begin(), path.touches.begin() + static_cast<std::ptrdiff_t>(next),
                       [&](const DrawnTouch& other) {
                         return near(one.touch.direction, other.touch.direction, 1e-9) &&
                                near(one.touch.point, other.touch.point, tolerance);
                       });
  };
  while (loops && out.empty() && next < path.touches.size() && isAgain(path.touches[next]))
    ++next;
  if (out.empty() && !unstated && program.ending == Ending::Finished && next < path.touches.size())
    add(Aspect::Nominal,
        fmt::format("the path touches a surface at {} against no measure",
                    textOf(path.touches[next].touch.point + offset)),
        path.touches[next].range, {});

  if (program.ending != Ending::Finished) return out;
  const std::vector<Piece> a = straight(withoutTouches(path, offset, ofCalls), false, tolerance);
  std::vector<Piece> moves;
  std::size_t found = 0; // moves before the last measure
  std::size_t measures = 0;
  std::optional<Point3> before; // where a bare skip move has begun that the last piece was
  for (const Piece& piece : program.pieces) {
    if (piece.kind != sim::PathKind::Measuring) {
      moves.push_back(piece);
      if (before) moves.back().from = *before; // the path back is that of the touch, as in the drawn one
      before.reset();
      continue;
    }
    if (!before && piece.from != piece.to) before = piece.from;
    if (again.contains(measures++)) moves.resize(found); // what lies between two touches of one surface
    found = moves.size();
  }
  const bool loads = std::any_of(program.deeds.begin(), program.deeds.end(),
                                 [](const Deed& one) { return one.kind == Deed::Kind::ToolChange; });
  if (loads && !a.empty()) trimToolChange(a.front().to, a.back().to, tolerance, moves);
  const std::vector<Piece> b = straight(moves, false, tolerance);
  const Point3 end = loads && !b.empty() ? b.back().to : program.end;
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
  if (!path.points.empty() && !near(path.points.back() + offset, end, tolerance))
    add(Aspect::End,
        fmt::format("the path ends at {} against {}", textOf(path.points.back() + offset), textOf(end)),
        path.ranges.back(), program.pieces.empty() ? SourceRange{} : program.pieces.back().range);
  return out;
}

} // namespace dotek::verify
