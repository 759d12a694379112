#include "sim/picture/Picture.h"

#include "sim/picture/PictureRegion.h"

#include "support/Decimal.h"

#include <cmath>
#include <fmt/format.h>

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

std::vector<std::string> errorNames(const Picture& picture) {
  std::vector<std::string> out;
  std::size_t errors = 0, misses = 0;
  for (const PictureError& error : picture.errors)
    out.push_back(isMiss(error) ? fmt::format("M{}", ++misses) : fmt::format("E{}", ++errors));
  return out;
}

double reachAt(const Picture& picture, std::size_t move) {
  const std::size_t tool = move < picture.moves.size() ? picture.moves[move].tool : 0;
  if (tool > 0 && tool <= picture.tools.size()) return picture.tools[tool - 1].length;
  return hasProbe(picture) ? picture.probe.centreLength() : 0;
}

ToolPoint toolPointAt(const Picture& picture, std::size_t move) {
  const double reach = reachAt(picture, move);
  if (move < picture.moves.size() && picture.moves[move].tool > 0)
    return {reach > 0 ? "tool's end" : "", reach};
  if (!hasProbe(picture)) return {};
  return picture.probe.lengthToTip ? ToolPoint{"tip", reach + picture.probe.ballRadius()}
                                   : ToolPoint{"ball's centre", reach};
}

std::string toolNote(const PictureTool& tool, int decimals) {
  const std::string path = fmt::format("with tool {} it is that of the", tool.number);
  if (tool.listed) return path + " tool's end";
  return fmt::format("{} {}: no list has the tool, so neither its size nor what it meets is shown", path,
                     tool.length > 0
                         ? fmt::format("end by the length in force, {}", fixedText(tool.length, decimals))
                         : std::string("spindle's gauge line"));
}

Point3 gaugeAt(const Picture& picture, const Point3& point, std::size_t move) {
  Point3 out = point;
  out.z += reachAt(picture, move);
  const std::size_t frame = move < picture.moves.size() ? picture.moves[move].frame : picture.frames.size();
  if (frame >= picture.frames.size()) return out;
  double* const axes[] = {&out.x, &out.y, &out.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if ((picture.frames[frame].unknown >> axis & 1) != 0) *axes[axis] = std::nan("");
  return out;
}

std::optional<Point3> workAt(const Picture& picture, const Point3& point, std::size_t move) {
  const std::size_t frame = move < picture.moves.size() ? picture.moves[move].frame : picture.frames.size();
  if (frame >= picture.frames.size()) return std::nullopt;
  return gaugeAt(picture, point, move) - picture.frames[frame].shift;
}

} // namespace dotek::sim
