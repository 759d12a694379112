// What `--svg` and `--html` draw of a run: the part, the path of the probe, what it touched, what went wrong.
// Points are of the machine; those of moves and errors are the ball's centre.
#pragma once

#include "sim/geometry/Part.h"
#include "sim/geometry/Probe.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::sim {

enum class PathKind : std::uint8_t {
  Rapid,
  Feed,
  Protected, // a move that stops at a contact it does not want
  Measuring, // a move that wants a contact
};
std::string_view pathKindName(PathKind kind); // "rapid", "feed", "protected", "measuring"

struct PictureMove {
  PathKind kind = PathKind::Feed;
  Point3 from, to;
  bool probeOn = true;
  std::size_t block = 0; // place in Picture::blocks
};

struct PictureContact {
  Point3 point; // of the part
  std::size_t move = 0;
};

struct PictureError {
  Point3 at;
  std::string text; // UTF-8, one line
  std::size_t move = 0;
};

struct PictureBlock {
  std::string text;  // UTF-8; as the program writes it
  std::string place; // "probe.nc:12"
};

struct Picture {
  std::string title;        // UTF-8
  std::optional<Part> part; // nothing: only the path is drawn
  // Its ball, stem and body. One without a length down to its tip is none: then the points of the path are
  // those of the spindle's gauge line.
  Probe probe;
  std::vector<PictureMove> moves; // in the order of the run
  std::vector<PictureContact> contacts;
  std::vector<PictureError> errors;
  std::vector<PictureBlock> blocks;
};

// An SVG with three views, XY, XZ and YZ: sections of the part, the path, numbered contacts, errors in red, a
// legend and a scale. The same picture gives the same bytes.
std::string pictureSvg(const Picture& picture);
// One page that needs no network: a 3D view that turns with the mouse, the blocks beside it, a slider that
// steps through the moves and shows the probe's position in numbers (mm, six decimals).
std::string pictureHtml(const Picture& picture);

} // namespace dotek::sim
