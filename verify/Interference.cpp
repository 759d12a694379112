#include "verify/Interference.h"

namespace dotek::verify {

std::string whyNotCaught(const Record& record, std::string_view alarmKind, SourceRange& at) {
  at = record.endedAt;
  if (!record.disturbed) return "the program does not come to it";
  const auto [pieces, marks] = *record.disturbed;
  if (pieces < record.pieces.size()) {
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
