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

std::optional<std::size_t> blockOf(const Picture& picture, const PictureError& error) {
  const std::size_t block = error.block                         ? *error.block
                            : error.move < picture.moves.size() ? picture.moves[error.move].block
                                                                : picture.blocks.size();
  return block < picture.blocks.size() ? std::optional(block) : std::nullopt;
}

} // namespace dotek::sim
