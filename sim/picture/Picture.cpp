#include "sim/picture/Picture.h"

namespace dotek::sim {

std::string_view pathKindName(PathKind kind) {
  switch (kind) {
  case PathKind::Rapid: return "rapid";
  case PathKind::Feed: return "feed";
  case PathKind::Protected: return "protected";
  case PathKind::Measuring: return "measuring";
  }
  return "";
}

} // namespace dotek::sim
