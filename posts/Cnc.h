// The intermediate file of Autodesk's CAM, `.cnc`: its records as they are stored. What of them is known, and
// how, is listed in docs/fusion-kernel.md, "Jobs of Autodesk".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace dotek::posts::cnc {

enum class Code : std::uint32_t {
  Version = 1,
  Text = 10,
  WideText = 11,
  Integer = 12,
  Stock = 14,
  Real = 15,
  Comment = 16,
  PlacedReal = 18, // a height with the point of its cycle
  AdditiveContext = 29,
  Section = 30,
  SectionEnd = 31,
  Linear = 100,
  Rapid = 101,
  Dwell = 102,
  SpindleSpeed = 103,
  ArcCounterclockwise = 110,
  ArcClockwise = 111,
  Linear5 = 120,
  Rapid5 = 121,
  Command = 130,
  Extrusion = 140,
  PassThrough = 200,
  Cycle = 300,
  CycleEnd = 301,
  Frame = 500,
  ShortTool = 1033, // up to version 2.1
  Context = 1034,
  Tool = 1035,
  TurningTool = 1038,
  JetTool = 1040,
  GaugeLengths = 1041,
  ToolLength1 = 1045, // of version 2.4; their meaning is not known
  ToolLength2 = 1046,
};

using Single3 = std::array<float, 3>;
using Double3 = std::array<double, 3>;

struct Named {
  std::string name; // UTF-8, without the namespace
  std::variant<std::string, std::int32_t, double, Double3> value;
};

struct Box {
  Single3 lower{}, upper{};
};

struct Move {
  Single3 to{}, center{}, normal{}, axis{}; // the last three where the code has them
  float feed = 0;
  std::uint16_t flags = 0, movement = 0;
};
// Of Move::flags.
constexpr std::uint16_t kPathBegins = 1, kPathEnds = 2, kUnknownFlag = 8, kCompensationLeft = 128,
                        kCompensationRight = 256;

// What a section lies in: the third to the fourth member are of the work plane, then those of the setup.
struct Context {
  std::uint32_t unit = 0;
  Single3 origin{}, wcsOrigin{};
  std::array<float, 9> plane{}, wcsPlane{}; // row by row; a column is an axis
  std::uint32_t workOffset = 0, type = 0, spindle = 0, quality = 0, jetMode = 0;
};

struct Tool {
  std::uint32_t type = 0, number = 0, clockwise = 0, diameterOffset = 0, lengthOffset = 0,
                compensationOffset = 0, coolant = 0, flutes = 0, unit = 0;
  double diameter = 0, tipDiameter = 0, cornerRadius = 0, taperAngle = 0, fluteLength = 0, shoulderLength = 0,
         shaftDiameter = 0, bodyLength = 0, spindleSpeed = 0, rampSpindleSpeed = 0, threadPitch = 0;
  double maximumSpindleSpeed = 0, surfaceSpeed = 0, noseRadius = 0;          // turning
  double kerfWidth = 0, nozzleDiameter = 0, cutHeight = 0, pierceHeight = 0, // jets
      pressure = 0, cutPower = 0, piercePower = 0;
  std::string assistGas;
  std::vector<std::pair<float, float>> holder; // height and diameter
};

using Value = std::variant<std::monostate, Named, Box, Move, std::string, double, std::uint32_t,
                           std::size_t>; // the last: a tool or a context of the file

struct Record {
  std::size_t offset = 0;
  Code code = Code::Version;
  Value value;
};

struct File {
  std::array<std::uint8_t, 3> version{};
  std::vector<Record> records;
  std::vector<Tool> tools;
  std::vector<Context> contexts;
};

// Why reading stops, and where.
struct Fault {
  std::size_t offset = 0;
  std::string text;
};

// Whether the bytes begin as such a file does.
bool isCnc(std::string_view bytes);
// Any bytes are read in bounded memory.
std::variant<File, Fault> read(std::string_view bytes);

} // namespace dotek::posts::cnc
