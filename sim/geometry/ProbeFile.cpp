#include "sim/geometry/Probe.h"

#include "stdlib/Toml.h"
#include "support/Decimal.h"
#include "support/Files.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace dotek::sim {

using stdlib::TomlDocument;
using stdlib::TomlTable;
using stdlib::TomlValue;

namespace {

constexpr double kMostLength = 2000; // mm, of a part of the probe

double length(const TomlDocument& document, const TomlTable& table, std::string_view key, double least,
              double most, double fallback) {
  const TomlValue value = table.value(key);
  const double out = value.number(fallback);
  if (value.isNumber() && !(out >= least && out <= most))
    document.fail(value.range(), fmt::format("`{}` is {}; {} to {} mm is expected", key, out, least, most));
  return out;
}

// Two keys that make sense together only.
void both(const TomlDocument& document, const TomlTable& table, std::string_view one,
          std::string_view other) {
  if (table.has(one) != table.has(other))
    document.fail(table.range(),
                  fmt::format("`{}` and `{}` go together; one of them is missing", one, other));
}

void readProbe(const TomlDocument& document, const TomlTable& table, Probe& probe) {
  constexpr double kLeast = 0.01;
  table.require("ball_diameter", "the diameter of the stylus ball in mm");
  probe.ballDiameter = length(document, table, "ball_diameter", kLeast, 100, 6);
  table.require("length", "the length of the probe from the gauge line in mm");
  probe.length = length(document, table, "length", 0, kMostLength, 0);
  probe.lengthToTip = table.require("length_to", "\"tip\" or \"centre\": where that length ends")
                          .choice({"tip", "centre"}, "tip") == "tip";
  probe.effectiveRadius = length(document, table, "effective_radius", kLeast / 2, 50, probe.ballRadius());
  if (probe.effectiveRadius > probe.ballRadius())
    document.fail(table.value("effective_radius").range(),
                  fmt::format("`effective_radius` is {} and half of `ball_diameter` is {}; the ball touches "
                              "before the signal comes, so that it is at most as large",
                              probe.effectiveRadius, probe.ballRadius()));
  both(document, table, "stem_diameter", "stem_length");
  both(document, table, "body_diameter", "body_length");
  probe.stemDiameter = length(document, table, "stem_diameter", kLeast, 100, 0);
  probe.stemLength = length(document, table, "stem_length", kLeast, kMostLength, 0);
  probe.bodyDiameter = length(document, table, "body_diameter", kLeast, 500, 0);
  probe.bodyLength = length(document, table, "body_length", kLeast, kMostLength, 0);
  if (probe.stemDiameter >= probe.ballDiameter)
    document.fail(table.value("stem_diameter").range(),
                  "the stem is not thinner than the ball; it would touch first");
  if (probe.bodyDiameter > 0 && probe.stemDiameter == 0 && !table.has("stem_diameter"))
    document.fail(table.range(),
                  "`body_diameter` needs `stem_diameter` and `stem_length`: the body sits on the stem");
  probe.preTravel = length(document, table, "pre_travel", 0, 5, 0);
  probe.overtravel = length(document, table, "overtravel", 0, 100, 0);
  if (table.has("overtravel") && probe.overtravel <= probe.preTravel)
    document.fail(
        table.value("overtravel").range(),
        "`overtravel` is not more than `pre_travel`; the stylus would break before the signal comes");
  probe.noise = length(document, table, "noise", 0, 0.1, 0);
  probe.seed =
      static_cast<std::uint64_t>(table.value("seed").integer(1, 0, std::numeric_limits<std::int64_t>::max()));
  probe.on =
      table.require("on", "true or false: whether the probe is on before the program turns it on").flag(true);
}

} // namespace

std::optional<MachineFile> readMachine(FileId file, const SourceMap& sources, Diagnostics& diagnostics) {
  const std::optional<TomlDocument> document = TomlDocument::parse(file, sources, diagnostics);
  if (!document) return std::nullopt;
  MachineFile out;
  const TomlTable root = document->root();
  constexpr std::string_view kNames[3] = {"x", "y", "z"};
  const TomlTable start = root.value("start").table();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    constexpr double kFarthest = 20000;
    const TomlValue value = start.value(kNames[axis]);
    out.start[axis] = value.number(0);
    if (value.isNumber() && !(std::abs(out.start[axis]) <= kFarthest))
      document->fail(value.range(), fmt::format("`{}` is beyond {} mm away", kNames[axis], kFarthest));
  }
  const TomlTable travel = root.value("travel").table();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const TomlValue value = travel.value(kNames[axis]);
    if (!value) continue;
    const std::vector<double> ends = value.numbers();
    if (ends.size() == 2 && ends[0] < ends[1])
      out.limits.travel[axis] = MachineLimits::Span{ends[0], ends[1]};
    else if (value.isArray())
      document->fail(value.range(), "two ends of the travel [least, most] are expected");
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const TomlValue value = start.value(kNames[axis]);
    const std::optional<double> end = value ? out.limits.endBefore(axis, out.start[axis]) : std::nullopt;
    const char letter = "XYZ"[axis];
    if (end)
      document->fail(value.range(), fmt::format("{}{} is beyond the travel, which ends at {}{}", letter,
                                                fixedText(out.start[axis], 3), letter, fixedText(*end, 3)));
  }
  // A mill may have none; what pushes a tool setter is a tool or the probe.
  const TomlValue probe = root.has("tool_setter")
                              ? root.require("probe", "a table [probe], as there is a [tool_setter]")
                              : root.value("probe");
  out.hasProbe = bool(probe);
  if (probe) readProbe(*document, probe.table(), out.probe);
  out.devices = readDevices(*document, root);
  if (const TomlValue setup = root.value("setup")) out.setup = readSetup(*document, setup.table());
  if (!document->finish()) return std::nullopt;
  return out;
}

std::optional<MachineFile> loadMachine(const std::string& path, const Limits& limits, SourceMap& sources,
                                       Diagnostics& diagnostics) {
  const std::optional<FileId> id = readText(path, Encoding::Utf8, std::nullopt, limits, sources, diagnostics);
  if (!id) return std::nullopt;
  return readMachine(*id, sources, diagnostics);
}

} // namespace dotek::sim
