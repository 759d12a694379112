#include "posts/PostJob.h"

#include "posts/Cnc.h"
#include "posts/CncJob.h"
#include "posts/JobJson.h"
#include "posts/PostRun.h"
#include "stdlib/Toml.h"
#include "support/Files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>

namespace dotek::posts {

using stdlib::TomlDocument;
using stdlib::TomlEntry;
using stdlib::TomlTable;
using stdlib::TomlValue;

namespace {

using Values = std::vector<std::pair<std::string, std::string>>; // JSON by name

constexpr std::string_view kPerRevolution = "per-revolution";
constexpr std::size_t kCncHead = 256; // tells a `.cnc` file

std::string jsonOf(const TomlValue& value) {
  if (value.isText()) return jsonText(value.text());
  if (value.isFlag()) return value.flag() ? "true" : "false";
  if (value.isArray()) {
    std::vector<std::string> items;
    for (const TomlValue& one : value.items())
      items.push_back(jsonOf(one));
    return jsonList(items);
  }
  return jsonNumber(value.number());
}

std::string jsonOf(const TomlTable& table) {
  JsonObject out;
  for (const TomlEntry& entry : table.entries())
    out.add(entry.key, jsonOf(entry.value));
  return out.text();
}

std::string point(const TomlDocument& document, const TomlValue& value, std::size_t least = 3) {
  const std::vector<double> numbers = value.numbers();
  if (value && (numbers.size() < least || numbers.size() > 3))
    document.fail(value.range(), "a point is [x, y, z]");
  std::vector<std::string> items;
  for (const double one : numbers)
    items.push_back(jsonNumber(one));
  return jsonList(items);
}

// One key says what a step is; what it needs beside is in others.
struct StepKind {
  std::string_view key, record, member;
  bool isPoint = false;
};
constexpr std::array<StepKind, 16> kSteps = {{{"rapid", "rapid", "to", true},
                                              {"linear", "linear", "to", true},
                                              {"arc", "circular", "to", true},
                                              {"rapid5", "rapid5", "to", true},
                                              {"linear5", "linear5", "to", true},
                                              {"cycle", "cycle", "type"},
                                              {"dwell", "dwell", "seconds"},
                                              {"spindle", "spindle", "rpm"},
                                              {"command", "command", "command"},
                                              {"manual", "manual", "command"},
                                              {"comment", "comment", "text"},
                                              {"pass", "passthrough", "text"},
                                              {"movement", "movement", "movement"},
                                              {"compensation", "compensation", "side"},
                                              {"power", "power", "on"},
                                              {"parameter", "parameter", "name"}}};

std::string stepOf(const TomlDocument& document, const TomlTable& table) {
  JsonObject out;
  int count = 0;
  for (const StepKind& kind : kSteps) {
    if (kind.record.empty() || !table.has(kind.key)) continue;
    ++count;
    const TomlValue value = table.value(kind.key);
    out.add("record", jsonText(kind.record));
    out.add(kind.member, kind.isPoint ? point(document, value) : jsonOf(value));
    if (kind.record == "circular") {
      out.add("center", point(document, table.require("center", "the centre of the arc")));
      out.add("clockwise", table.value("clockwise").flag() ? "true" : "false");
      out.add("full", table.value("full").flag() ? "true" : "false");
      out.add("plane", jsonText(table.value("plane").choice({"XY", "ZX", "YZ"}, "XY")));
    }
    if (kind.record == "rapid5" || kind.record == "linear5")
      out.add("axis",
              point(document, table.require("axis", "the direction of the tool, or angles in radians")));
    if (kind.record == "linear" || kind.record == "circular" || kind.record == "linear5")
      out.add("feed", jsonOf(table.require("feed", "the feed")));
    if (kind.record == "cycle") {
      out.add("cycle", jsonOf(table.value("with").table()));
      std::vector<std::string> points;
      for (const TomlValue& one : table.require("points", "the points of the cycle, [[x, y, z], ..]").items())
        points.push_back(point(document, one));
      out.add("points", jsonList(points));
    }
    if (kind.record == "manual" && table.has("value")) out.add("value", jsonOf(table.value("value")));
    if (kind.record == "parameter") out.add("value", jsonOf(table.require("value", "the value")));
  }
  if (count != 1)
    document.fail(table.range(),
                  "a step has one of `rapid`, `linear`, `arc`, `rapid5`, `linear5`, `cycle`, `dwell`, "
                  "`spindle`, `command`, `manual`, `comment`, `pass`, `movement`, `compensation`, "
                  "`power`, `parameter`");
  return out.text();
}

std::string stepsOf(const TomlDocument& document, const TomlValue& value) {
  std::vector<std::string> out;
  for (const TomlTable& one : value.tables())
    out.push_back(stepOf(document, one));
  return jsonList(out);
}

// What the CAM says of the tool of every turning operation, beside the tool itself.
void addTurning(const TomlTable& section, const TomlTable& tool, Values& parameters) {
  const auto flag = [](bool on) { return std::string(on ? "1" : "0"); };
  parameters.emplace_back("operation:tool_isTurning", "1");
  parameters.emplace_back("operation:tool_useConstantSurfaceSpeed",
                          flag(tool.value("spindleMode").text() == "SPINDLE_CONSTANT_SURFACE_SPEED"));
  parameters.emplace_back("operation:tool_useFeedPerRevolution",
                          flag(section.value("feed_mode").text() == kPerRevolution));
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kSpeeds = {
      {{"operation:tool_spindleSpeed", "spindleRPM"},
       {"operation:tool_surfaceSpeed", "surfaceSpeed"},
       {"operation:tool_maximumSpindleSpeed", "maximumSpindleSpeed"}}};
  for (const auto& [name, member] : kSpeeds)
    if (tool.has(member)) parameters.emplace_back(name, jsonOf(tool.value(member)));
}

} // namespace

std::string sectionOf(const TomlDocument& document, const TomlTable& table) {
  JsonObject out;
  constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kMembers = {
      {{"strategy", "strategy"},
       {"work_offset", "workOffset"},
       {"probe_work_offset", "probeWorkOffset"},
       {"wcs", "wcs"},
       {"type", "type"},
       {"optional", "optional"},
       {"force_tool_change", "forceToolChange"},
       {"multi_axis", "multiAxis"},
       {"tailstock", "tailstock"},
       {"part_catcher", "partCatcher"}}};
  for (const auto& [key, member] : kMembers)
    if (table.has(key)) out.add(member, jsonOf(table.value(key)));
  if (table.has("initial")) out.add("initial", point(document, table.value("initial")));
  if (table.has("work_origin")) out.add("workOrigin", point(document, table.value("work_origin")));
  if (table.has("work_plane")) out.add("workPlane", jsonOf(table.value("work_plane")));
  if (table.has("feed_mode"))
    out.add("feedMode",
            jsonText(table.value("feed_mode").choice({"per-minute", kPerRevolution}, "") == kPerRevolution
                         ? "FEED_PER_REVOLUTION"
                         : "FEED_PER_MINUTE"));
  if (table.has("spindle"))
    out.add("spindle", jsonText(table.value("spindle").choice({"primary", "secondary"}, "") == "primary"
                                    ? "SPINDLE_PRIMARY"
                                    : "SPINDLE_SECONDARY"));
  const TomlTable tool = table.value("tool").table();
  out.add("tool", jsonOf(tool));
  out.add("properties", jsonOf(table.value("properties").table()));
  JsonObject parameters;
  const auto own = table.value("parameters").table().entries();
  const auto given = [&](std::string_view name) {
    return std::any_of(own.begin(), own.end(), [&](const TomlEntry& one) { return one.key == name; });
  };
  // What every operation has.
  if (table.has("strategy") && !given("operation-strategy"))
    parameters.add("operation-strategy", jsonText(table.value("strategy").text()));
  Values more;
  if (table.value("type").text() == "TYPE_TURNING") addTurning(table, tool, more);
  for (const auto& [name, json] : more)
    if (!given(name)) parameters.add(name, json);
  for (const TomlEntry& entry : own)
    parameters.add(entry.key, jsonOf(entry.value));
  out.add("parameters", parameters.text());
  out.add("before", stepsOf(document, table.value("before")));
  out.add("records", stepsOf(document, table.value("step")));
  return out.text();
}

std::string jsonOfArgument(const std::string& text) {
  double number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (!text.empty() && read.ec == std::errc() && read.ptr == text.data() + text.size())
    return jsonNumber(number);
  return text == "true" || text == "false" ? text : jsonText(text);
}

void addCommon(const JobOptions& options, JsonObject& out) {
  out.add("most", std::to_string(options.most));
  out.add("map", options.map ? "true" : "false");
}

std::optional<PostJob> readPostJob(const std::string& path, const JobOptions& options,
                                   project::Session& session) {
  if (path != "-" && !isStream(path)) {
    const auto head = readBeginning(path, kCncHead, session.diagnostics());
    if (!head) return std::nullopt;
    if (cnc::isCnc(*head)) {
      const auto bytes = readBytes(path, session.limits(), session.diagnostics());
      return bytes ? readCncJob(path, *bytes, options, session) : std::nullopt;
    }
  }
  const std::optional<FileId> file = session.read(path, Encoding::Utf8);
  if (!file) return std::nullopt;
  const auto document = TomlDocument::parse(*file, session.sources(), session.diagnostics());
  if (!document) return std::nullopt;
  const TomlTable root = document->root();
  PostJob out;
  out.inch = root.value("unit").choice({"mm", "in"}, "mm") == "in";
  JsonObject job;
  addCommon(options, job);
  const TomlTable program = root.value("program").table();
  if (program.has("name")) job.add("programName", jsonText(program.value("name").text()));
  if (program.has("comment")) job.add("programComment", jsonText(program.value("comment").text()));
  job.add("parameters", jsonOf(root.value("parameters").table()));
  JsonObject properties;
  for (const TomlEntry& entry : root.value("properties").table().entries()) {
    const bool replaced = std::any_of(options.properties.begin(), options.properties.end(),
                                      [&](const auto& one) { return one.first == entry.key; });
    if (!replaced) properties.add(entry.key, jsonOf(entry.value));
  }
  for (const auto& [name, value] : options.properties)
    properties.add(name, jsonOfArgument(value));
  job.add("properties", properties.text());
  if (root.has("workpiece")) job.add("workpiece", jsonOf(root.value("workpiece")));
  std::vector<std::string> sections;
  for (const TomlTable& table : root.require("section", "the operations, [[section]]").tables())
    sections.push_back(sectionOf(*document, table));
  job.add("sections", jsonList(sections));
  job.add("after", stepsOf(*document, root.value("after")));
  if (!document->finish()) return std::nullopt;
  out.json = job.text();
  return out;
}

} // namespace dotek::posts
