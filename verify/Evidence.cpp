// What a run of the source says of its translation.
#include "verify/Compare.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::verify {

std::string endText(const Record& record) {
  switch (record.ending) {
  case Ending::Finished: return "it ends";
  case Ending::Alarm: {
    const bool unarmed = !record.measures.empty() && record.measures.back().range == record.endedAt &&
                         record.endedAt.hasPlace() && record.measures.back().with.probe != Switch::On;
    return fmt::format("{} ({}){}", record.alarm == 0 ? "an alarm" : "alarm " + std::to_string(record.alarm),
                       record.text, unarmed ? ", the probe is off at this measuring move" : "");
  }
  case Ending::Inconclusive: return "what it does is not known: " + record.text;
  }
  return "";
}

bool findsAll(const Record& record) {
  return record.ending == Ending::Finished &&
         std::none_of(record.measures.begin(), record.measures.end(),
                      [](const Measure& one) { return one.contacts.empty(); });
}

ProbeOff probeOffIn(const Record& record) {
  ProbeOff out;
  for (const Piece& piece : record.pieces) {
    if (piece.with.probe == Switch::On) continue;
    if (piece.kind == sim::PathKind::Protected && !out.protectedMove) out.protectedMove = piece.range;
    if (piece.kind == sim::PathKind::Measuring && !out.measuring) out.measuring = piece.range;
  }
  for (const Measure& measure : record.measures)
    if (measure.with.probe != Switch::On && !out.measuring) out.measuring = measure.range;
  return out;
}

std::string whyNoEvidence(const Record& record, SourceRange& at) {
  at = record.endedAt;
  if (record.ending == Ending::Inconclusive) return record.text;
  for (const Measure& measure : record.measures) {
    if (measure.with.probe == Switch::On) continue;
    at = measure.range;
    return "the probe is off at a measuring move";
  }
  if (record.ending == Ending::Alarm) return "alarm: " + record.text;
  if (!record.events.empty()) {
    at = record.events.front().second;
    return "the probe, its stem or its body meets what it should not";
  }
  for (const Measure& measure : record.measures) {
    at = measure.range;
    if (!measure.unstated.empty() && measure.contacts.empty()) continue;
    if (measure.options.contains(stdlib::ArgumentRole::FlagOnly) && measure.contacts.empty()) continue;
    if (measure.contacts.empty() || measure.contacts.size() < measure.nominal.size())
      return "a measuring move makes no contact";
  }
  // A protected move that goes on where it meets something is a question: whether a part is there.
  const bool asks = std::any_of(record.pieces.begin(), record.pieces.end(), [](const Piece& one) {
    return one.kind == sim::PathKind::Protected && one.goesOn;
  });
  if (record.measures.empty() && !asks) return "nothing is measured";
  return "";
}

} // namespace dotek::verify
