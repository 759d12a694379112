#include "ir/Kind.h"

namespace dotek::ir {

std::string_view kindName(Kind kind) {
  static constexpr std::string_view kNames[] = {
#define DOTEK_KIND(id, text, unit) text,
      DOTEK_KINDS(DOTEK_KIND)
#undef DOTEK_KIND
  };
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view kindUnit(Kind kind) {
  static constexpr std::string_view kUnits[] = {
#define DOTEK_KIND(id, text, unit) unit,
      DOTEK_KINDS(DOTEK_KIND)
#undef DOTEK_KIND
  };
  return kUnits[static_cast<std::size_t>(kind)];
}

std::string_view frameName(Frame frame) {
  switch (frame) {
  case Frame::Machine: return "machine";
  case Frame::Work: return "work";
  case Frame::Start: return "start";
  case Frame::Retract: return "retract";
  case Frame::Here: return "here";
  }
  return "";
}

std::string_view pointName(ProbePoint point) {
  switch (point) {
  case ProbePoint::Centre: return "centre";
  case ProbePoint::Lowest: return "lowest";
  case ProbePoint::Contact: return "contact";
  }
  return "";
}

} // namespace dotek::ir
