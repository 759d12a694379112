#include "backends/cycle/TargetMeasures.h"

#include <algorithm>
#include <cmath>

namespace dotek::targets {

namespace {

constexpr double kSame = 1e-3; // mm: of places that both reach

bool near(const sim::Point3& a, const sim::Point3& b) {
  return (a - b).length() <= kSame;
}

bool measures(const verify::Piece& piece) {
  return piece.kind == sim::PathKind::Measuring;
}

double along(const sim::Point3& point, const sim::Point3& direction) {
  return point.x * direction.x + point.y * direction.y + point.z * direction.z;
}

// Both expect a surface across one direction at one height of it, wherever beside: where the macro goes
// through the middle that it has found is said by the contacts.
void takeExpected(const verify::Measure& source, verify::Measure& own) {
  if (source.nominal.size() != own.nominal.size()) return;
  for (std::size_t i = 0; i < own.nominal.size(); ++i) {
    const verify::Touch &one = source.nominal[i], &other = own.nominal[i];
    if (near(one.direction, other.direction) &&
        std::abs(along(one.point, one.direction) - along(other.point, one.direction)) <= kSame)
      own.nominal[i] = one;
  }
}

// How far beside the feature the first touch begins, where the source's call says so, as that counts it.
std::optional<double> clearanceOf(const verify::Measure& source, const verify::Measure& first,
                                  double ballRadius) {
  const auto stated = source.options.find(stdlib::ArgumentRole::Clearance);
  if (stated == source.options.end() || first.nominal.empty()) return std::nullopt;
  const verify::Touch& touch = first.nominal.front();
  const double apart = std::abs(along(touch.point - first.start, touch.direction)) - ballRadius;
  if (std::abs(apart - std::abs(stated->second)) <= kSame) return stated->second;
  return stated->second < 0 ? -apart : apart;
}

} // namespace

verify::Record joinedMeasures(const verify::Record& source, const verify::Record& ran, double ballRadius) {
  const bool several = std::any_of(source.measures.begin(), source.measures.end(),
                                   [](const verify::Measure& one) { return one.nominal.size() > 1; });
  if (!several) return ran;
  verify::Record out = ran;
  out.pieces.clear();
  out.measures.clear();
  std::size_t piece = 0, measure = 0; // of `ran`, the next ones
  const auto copy = [&] {
    if (measures(ran.pieces[piece])) {
      if (measure >= ran.measures.size()) return false;
      out.measures.push_back(ran.measures[measure++]);
    }
    out.pieces.push_back(ran.pieces[piece++]);
    return true;
  };
  std::size_t next = 0; // measure of the source
  for (const verify::Piece& there : source.pieces) {
    if (piece >= ran.pieces.size()) break;
    if (!measures(there) || next >= source.measures.size()) {
      if (!copy()) return ran;
      continue;
    }
    const verify::Measure& call = source.measures[next++];
    if (call.nominal.size() < 2) {
      if (!copy()) return ran;
      continue;
    }
    verify::Piece whole = ran.pieces[piece];
    whole.kind = there.kind;
    whole.to = whole.from;
    verify::Measure joined;
    joined.start = whole.from;
    sim::Point3 at = whole.from;
    std::size_t touches = 0;
    while (piece < ran.pieces.size() && (touches < call.nominal.size() || !near(at, joined.start))) {
      const verify::Piece& inside = ran.pieces[piece];
      if (measures(inside)) {
        if (measure >= ran.measures.size() || touches == call.nominal.size()) return ran;
        const verify::Measure& one = ran.measures[measure++];
        if (touches++ == 0) {
          joined.with = one.with, joined.range = one.range, joined.options = one.options;
          joined.travels = one.travels, joined.aim = one.aim;
          if (const std::optional<double> clearance = clearanceOf(call, one, ballRadius))
            joined.options[stdlib::ArgumentRole::Clearance] = *clearance;
          whole.with = inside.with, whole.range = inside.range, whole.feed = inside.feed;
          whole.modes = inside.modes, whole.frame = inside.frame;
        }
        joined.nominal.insert(joined.nominal.end(), one.nominal.begin(), one.nominal.end());
        joined.contacts.insert(joined.contacts.end(), one.contacts.begin(), one.contacts.end());
        joined.datums.insert(one.datums.begin(), one.datums.end());
        at = one.end;
      } else {
        if (inside.kind != sim::PathKind::Protected) return ran;
        at = inside.to;
      }
      ++piece;
    }
    // The way back from a middle that is all but the place where it began.
    while (piece < ran.pieces.size() && ran.pieces[piece].kind == sim::PathKind::Protected &&
           near(ran.pieces[piece].from, joined.start) && near(ran.pieces[piece].to, joined.start))
      at = ran.pieces[piece++].to;
    joined.end = at;
    takeExpected(call, joined);
    out.pieces.push_back(whole);
    out.measures.push_back(std::move(joined));
  }
  while (piece < ran.pieces.size())
    if (!copy()) return ran;
  return out;
}

} // namespace dotek::targets
