// The summary of a run as JSON: what was measured, contacts, events, records.
#include "sim/run/SimReport.h"
#include "sim/run/SimWorld.h"
#include "support/Decimal.h"
#include "support/Printable.h"

#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {
namespace {

std::string pointJson(const Point3& p) {
  return fmt::format("{{\"X\": {}, \"Y\": {}, \"Z\": {}}}", jsonNumber(p.x, 6), jsonNumber(p.y, 6),
                     jsonNumber(p.z, 6));
}

bool hasPoint(Outcome outcome) {
  switch (outcome) {
  case Outcome::Contact:
  case Outcome::EarlyContact:
  case Outcome::NotArmed:
  case Outcome::NoSignal:
  case Outcome::Overtravel:
  case Outcome::RapidIntoPart: return true;
  case Outcome::Miss:
  case Outcome::StartInside:
  case Outcome::StemCollision:
  case Outcome::BodyCollision:
  case Outcome::OutsideTravel:
  case Outcome::SetterMiss:
  case Outcome::NotModelled: break;
  case Outcome::SetterHit: return true;
  }
  return false;
}

} // namespace

std::string SimWorld::placeJson(const SourceRange& range) const {
  if (!range.hasPlace()) return "\"file\": null, \"line\": 0";
  const SourceFile& file = session_.sources().file(range.file);
  return fmt::format("\"file\": {}, \"line\": {}", jsonString(file.name()), file.place(range.begin).line);
}

std::string SimWorld::json(const Kept& kept) const {
  const ProbeEvent& event = kept.event;
  const bool contact = event.outcome == Outcome::Contact;
  std::string out = contact ? "{" : fmt::format("{{\"outcome\": \"{}\", ", outcomeName(event.outcome));
  if (event.used) out += "\"used\": true, ";
  if (kept.unseen) out += "\"seen\": false, ";
  out += placeJson(kept.place.range) + ", \"calls\": [";
  for (auto call = kept.place.calls.rbegin(); call != kept.place.calls.rend(); ++call)
    out += (call == kept.place.calls.rbegin() ? "{" : ", {") + placeJson(*call) + "}";
  out += "], \"centre\": " + pointJson(event.centre);
  if (hasPoint(event.outcome))
    out += ", \"point\": " + pointJson(event.point) + ", \"normal\": " + pointJson(event.normal) +
           ", \"depth\": " + jsonNumber(event.depth, 6);
  return out + "}";
}

// [] where nothing was measured.
std::string SimWorld::measuredJson() const {
  std::string out;
  for (const PictureMeasured& one : log_.entries()) {
    std::string values, offsets;
    for (const MeasuredValue& value : one.found.values)
      values += fmt::format("{}{{\"name\": {}, \"nominal\": {}, \"measured\": {}, \"deviation\": {}}}",
                            values.empty() ? "" : ", ", jsonString(value.name),
                            value.nominal ? fixedText(*value.nominal, 6) : "null",
                            std::isfinite(value.measured) ? fixedText(value.measured, 6) : "null",
                            value.nominal && std::isfinite(value.measured)
                                ? fixedText(value.measured - *value.nominal, 6)
                                : "null");
    for (const OffsetWrite& write : one.offsets)
      offsets += fmt::format("{}{{\"name\": {}, \"before\": {}, \"after\": {}}}", offsets.empty() ? "" : ", ",
                             jsonString(write.name), fixedText(write.before, 6), fixedText(write.after, 6));
    out += fmt::format(
        "{}\n    {{\"feature\": {}, \"program\": {}, \"place\": {}, \"system\": {}, \"values\": [{}], "
        "\"offsets\": [{}]{}{}}}",
        out.empty() ? "" : ",", jsonString(one.found.title), one.found.program, jsonString(one.block.place),
        jsonString(one.system), values, offsets, one.missed ? ", \"missed\": true" : "",
        one.afterMiss ? ", \"afterMiss\": true" : "");
  }
  return out.empty() ? out : out + "\n  ";
}

std::string SimWorld::summary() const {
  const auto list = [&](const std::vector<Kept>& kept) {
    std::string out;
    for (const Kept& one : kept)
      out += (out.empty() ? "\n    " : ",\n    ") + json(one);
    return out.empty() ? out : out + "\n  ";
  };
  std::string out = "  \"measured\": [" + measuredJson() + "],\n  \"contacts\": [" + list(contacts_) +
                    "],\n  \"events\": [" + list(events_) + "],\n";
  if (contactCount_ > contacts_.size() || eventCount_ > events_.size())
    out += fmt::format("  \"contactsLeftOut\": {},\n  \"eventsLeftOut\": {},\n",
                       contactCount_ - contacts_.size(), eventCount_ - events_.size());
  if (stock_) out += "  \"stock\": " + stockJson(*stock_, stockMargin_) + ",\n";
  return out;
}

std::string SimWorld::notes() const {
  const auto text = [](const std::string& bytes) { return jsonString(toUtf8Text(bytes)); };
  std::string records, stops;
  for (const NotedRecord& one : records_)
    records += fmt::format("{}{{\"file\": {}, {}}}", records.empty() ? "" : ", ", text(one.file),
                           one.value ? "\"value\": " + numberText(*one.value)
                                     : "\"position\": " + positionText(one.position, 7));
  for (const std::string& one : stops_)
    stops += (stops.empty() ? "" : ", ") + text(one);
  return "  \"records\": [" + records + "],\n  \"stops\": [" + stops + "],\n";
}

} // namespace dotek::sim
