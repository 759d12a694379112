// What `--svg` and `--html` draw of a run: the part, the path of the probe, what it touched, what went wrong.
// Points are of the machine; those of moves and errors are the ball's centre, of another tool its end.
#pragma once

#include "sim/geometry/Devices.h"
#include "sim/geometry/Part.h"
#include "sim/geometry/Probe.h"
#include "sim/machine/Measurement.h"

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
  std::size_t frame = 0; // place in Picture::frames; beyond its end: the coordinates are not known
  std::size_t tool = 0;  // in the spindle: place in Picture::tools, from 1; 0: the probe
};

// The work coordinates that a control showed during some moves. Those of a place are the position of the
// spindle's gauge line less `shift`, which holds work offset and tool length, mm; no number: not known.
struct PictureFrame {
  std::string name; // "G54", "G54.1 P3"; UTF-8
  Point3 shift;
  std::uint8_t unknown = 0; // axes, by bits, of which the place in the machine is not known either
  std::optional<double> length =
      std::nullopt; // of the tool, in force; nothing: that of what is in the spindle
};

struct PictureTool : CuttingTool {
  bool listed = true; // false: only the length that the program has in force is known, 0 without one
};

struct PictureContact {
  Point3 point; // of the part
  std::size_t move = 0;
};

struct PictureError {
  Point3 at;
  std::string text; // UTF-8, one line
  std::size_t move = 0;
  std::optional<std::size_t> block = std::nullopt; // place in Picture::blocks; nothing: the block of the move
  // Of a skip move that was to measure and met nothing; of one whose end the program took for the surface.
  enum class Kind : std::uint8_t { Error, Miss, UsedMiss };
  Kind kind = Kind::Error;
  bool fault = false; // what the banner says of a run in which nothing crashed (RunFault)
};
// The kind is that of a mark of its own, with numbers of its own.
inline bool isMiss(const PictureError& error) {
  return error.kind != PictureError::Kind::Error;
}

struct PictureBlock {
  std::string text;         // UTF-8; as the program writes it
  std::string place;        // "probe.nc:12"
  std::string program = {}; // "O1200"; "": it has no number
};

// A row of the report: what was measured, and which offsets were written before the next one.
struct PictureMeasured {
  Measurement found; // without a title: only offsets were written
  std::vector<OffsetWrite> offsets;
  std::string system; // active work offset: "G54"
  PictureBlock block;
  std::size_t move = 0;   // the last one of it
  bool missed = false;    // a skip move that met nothing, and whose end the program took for the surface
  bool afterMiss = false; // so did one before these offsets were written
};

// Lines of text below the table: what the program printed, which variables it left. UTF-8.
struct PictureList {
  std::string id; // of the element
  std::string title;
  std::vector<std::string> lines; // at least one
};

// How a run went: the banner of both pictures.
enum class Verdict : std::uint8_t {
  Pass,
  Doubt, // ended as written, with misses; or inconclusive, or a limit: nothing is proved wrong
  Fail,
};
struct PictureResult {
  Verdict verdict = Verdict::Pass;
  std::string word;                // "PASS", "ALARM 3012", "COLLISION"
  std::string text;                // what it is about, one line; all texts are UTF-8
  std::string place, block;        // "O1200, probe.nc:12" and what is written there; "": nowhere
  std::string position;            // "G54 X1.000 Y2.000 Z3.000; machine X.. Y.. Z..; mm"; "": not known
  std::vector<std::string> counts; // "2 collisions"
  std::optional<std::size_t> error = std::nullopt; // that it names, place in Picture::errors
};

struct Picture {
  std::string title;        // UTF-8
  std::optional<Part> part; // nothing: only the path is drawn
  // Its ball, stem and body. One without a length down to its tip is none: then the points of the path are
  // those of the spindle's gauge line.
  Probe probe;
  bool probeStated = false;         // also where its length is 0, as of a control that counts at the tip
  std::optional<ToolSetter> setter; // of the machine
  std::vector<PictureTool> tools;   // that were in the spindle, the probe aside
  std::vector<PictureMove> moves;   // in the order of the run
  bool still = false; // the run made no move: the only one is of no length, at the place where it stood
  std::vector<PictureContact> contacts;
  std::vector<PictureError> errors;
  std::vector<PictureBlock> blocks;
  std::vector<PictureFrame> frames;
  std::vector<PictureMeasured> measured;
  std::vector<PictureList> lists;
  std::optional<PictureResult> result; // nothing: no banner
  std::string control;                 // that the program ran on, UTF-8; "": none
  std::string date;                    // as the user gives it, UTF-8; "": none
  int decimals = 3;                    // of coordinates, as the control shows them
};

// The gauge line at a point of a move, and in the work coordinates of the move; no number: not known.
Point3 gaugeAt(const Picture& picture, const Point3& point, std::size_t move);
std::optional<Point3> workAt(const Picture& picture, const Point3& point, std::size_t move);

// From the point of a move up to the gauge line: of the probe's ball, or of the tool that is in the spindle;
// 0 without either.
double reachAt(const Picture& picture, std::size_t move);

// The point of probe or tool that a length counts to, during a move: its name ("tip"), and how far it is
// below the gauge line. "": the path is that of the gauge line.
struct ToolPoint {
  std::string_view name;
  double below = 0;
};
ToolPoint toolPointAt(const Picture& picture, std::size_t move);

// What the path is while this tool is in the spindle.
std::string toolNote(const PictureTool& tool, int decimals);

// By error: "E1", "E2", and "M1", "M2" of misses.
std::vector<std::string> errorNames(const Picture& picture);

// The place in Picture::blocks at which an error happened; nothing: it is not known.
std::optional<std::size_t> blockOf(const Picture& picture, const PictureError& error);

// That the run made.
inline std::size_t moveCount(const Picture& picture) {
  return picture.still ? 0 : picture.moves.size();
}

// An SVG that opens with how the run went. Three views, XY, XZ and YZ: sections of the part, the path,
// numbered contacts, errors in red, a legend and a scale. The same picture gives the same bytes.
std::string pictureSvg(const Picture& picture);
// One page that needs no network, and opens with how the run went, at its failure or else its end: a 3D view
// that turns with the mouse, the blocks beside it, a slider that steps through the moves and shows the
// probe's position in work and machine coordinates.
std::string pictureHtml(const Picture& picture);

} // namespace dotek::sim
