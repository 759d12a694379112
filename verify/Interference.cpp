#include "verify/Interference.h"

#include <cmath>

namespace dotek::verify {

std::size_t retractsAtEnd(const Record& record) {
  if (record.marks.empty() || record.marks.back().kind != Mark::Kind::Stop) return 0;
  constexpr double kSame = 1e-9;
  const std::size_t first = record.marks.back().pieces;
  for (std::size_t i = first; i < record.pieces.size(); ++i) {
    const Piece& piece = record.pieces[i];
    const sim::Point3 way = piece.to - piece.from;
    if (piece.kind != sim::PathKind::Feed || std::abs(way.x) > kSame || std::abs(way.y) > kSame || way.z < 0)
      return 0;
  }
  return record.pieces.size() - first;
}

std::string whyNotCaught(const Record& record, std::string_view alarmKind, SourceRange& at) {
  at = record.endedAt;
  if (!record.disturbed) return "the program does not come to it";
  const auto [pieces, marks] = *record.disturbed;
  if (pieces < record.pieces.size() - retractsAtEnd(record)) {
    at = record.pieces[pieces].range;
    return "the program moves on";
  }
  for (std::size_t i = marks; i < record.marks.size(); ++i) {
    const Mark& mark = record.marks[i];
    if (mark.kind == Mark::Kind::Stop) continue;
    at = mark.range;
    return mark.kind == Mark::Kind::Datum ? "a datum is set" : "it is recorded";
  }
  if (record.ending == Ending::Alarm && record.alarmKind == alarmKind) return "";
  switch (record.ending) {
  case Ending::Finished: return "the program ends as if nothing had happened";
  case Ending::Alarm: return "it ends with another message: " + record.text;
  case Ending::Inconclusive: break;
  }
  return record.text;
}

} // namespace dotek::verify
