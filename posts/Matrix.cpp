#include "posts/Json.h"
#include "posts/PostJob.h"
#include "posts/PostRun.h"
#include "stdlib/Toml.h"
#include "support/Printable.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>

namespace dotek::posts {

using stdlib::TomlDocument;
using stdlib::TomlEntry;
using stdlib::TomlTable;
using stdlib::TomlValue;

namespace {

using Values = std::map<std::string, std::string>; // JSON by name

struct CycleKind {
  std::string name, strategy;
  Values tool, values;
  std::vector<std::string> types;
};

struct CycleTable {
  std::vector<CycleKind> kinds;
  std::map<std::string, std::pair<Values, Values>> own; // tool and values, by type
};

Values valuesOf(const TomlTable& table) {
  Values out;
  for (const TomlEntry& entry : table.entries())
    out[entry.key] = entry.value.isText()   ? jsonText(entry.value.text())
                     : entry.value.isFlag() ? (entry.value.flag() ? "true" : "false")
                                            : jsonNumber(entry.value.number());
  return out;
}

CycleTable tableOf(const project::Session& session) {
  CycleTable out;
  const stdlib::DataFile* const file = session.data().find("fusion", "cycles");
  if (file == nullptr) throw stdlib::DataError("fusion/cycles.toml is not there");
  const TomlDocument document = TomlDocument::parse(*file);
  const TomlTable root = document.root();
  static_cast<void>(root.value("grade").text());
  static_cast<void>(root.value("source").text());
  for (const TomlTable& table : root.value("kind").tables())
    out.kinds.push_back({table.value("name").text(), table.value("strategy").text(),
                         valuesOf(table.value("tool").table()), valuesOf(table.value("values").table()),
                         table.value("types").texts()});
  for (const TomlTable& table : root.value("own").tables()) {
    const Values tool = valuesOf(table.value("tool").table());
    const Values values = valuesOf(table.value("values").table());
    for (const std::string& type : table.value("types").texts())
      out.own[type] = {tool, values};
  }
  static_cast<void>(document.finish());
  return out;
}

Values merged(Values base, const Values& more) {
  for (const auto& [name, value] : more)
    base[name] = value;
  return base;
}

std::string jsonOf(const Values& values) {
  JsonObject out;
  for (const auto& [name, value] : values)
    out.add(name, value);
  return out.text();
}

std::string jsonOfArgument(const std::string& text) {
  const bool plain = text == "true" || text == "false" ||
                     (!text.empty() && text.find_first_not_of("0123456789.-") == std::string::npos);
  return plain ? text : jsonText(text);
}

} // namespace

std::vector<std::string> matrixKinds(const project::Session& session) {
  std::vector<std::string> out;
  for (const CycleKind& kind : tableOf(session).kinds)
    out.push_back(kind.name);
  return out;
}

std::vector<MatrixJob> matrixJobs(const std::string& kind, const JobOptions& options,
                                  const project::Session& session) {
  std::vector<MatrixJob> out;
  const CycleTable table = tableOf(session);
  for (const CycleKind& one : table.kinds) {
    if (one.name != kind) continue;
    for (const std::string& type : one.types) {
      const auto own = table.own.find(type);
      const Values tool = own == table.own.end() ? one.tool : merged(one.tool, own->second.first);
      const Values values = own == table.own.end() ? one.values : merged(one.values, own->second.second);
      JsonObject section;
      section.add("tool", jsonOf(tool));
      section.add("strategy", jsonText(one.strategy));
      section.add("initial", "[100, 50, 20]");
      JsonObject parameters;
      parameters.add("operation-strategy", jsonText(one.strategy));
      parameters.add("operation-comment", jsonText(type));
      for (const char* const feed : {"operation:tool_feedCutting", "operation:tool_feedProbeLink",
                                     "operation:tool_feedProbeMeasure", "operation:tool_feedEntry"})
        parameters.add(feed, values.at("feedrate"));
      section.add("parameters", parameters.text());
      section.add(
          "records",
          jsonList({R"({"record": "rapid", "to": [100, 50, 20]})",
                    fmt::format(R"({{"record": "cycle", "type": {}, "cycle": {}, "points": [[100, 50, 0]]}})",
                                jsonText(type), jsonOf(values))}));
      JsonObject job;
      job.add("most", std::to_string(options.most));
      job.add("map", "true");
      JsonObject properties;
      for (const auto& [name, value] : options.properties)
        properties.add(name, jsonOfArgument(value));
      job.add("properties", properties.text());
      job.add("sections", jsonList({section.text()}));
      out.push_back({type, job.text()});
    }
  }
  return out;
}

bool namesProbing(std::string_view text) {
  constexpr std::array<std::string_view, 5> kMarks = {"probing-", "isProbing", "STRATEGY_PROBING",
                                                      "hasParameter(\"probe", "include("};
  return std::any_of(kMarks.begin(), kMarks.end(),
                     [&](std::string_view mark) { return text.find(mark) != std::string_view::npos; });
}

std::string newPostJob(const std::string& post, const std::vector<PostProperty>& properties,
                       const std::vector<std::string>& capabilities, bool probes) {
  std::string out =
      "# What `dotek run-post` hands to " + printable(post) +
      "\nschema = 1\nunit = \"mm\"\n\n[program]\nname = "
      "\"1001\"\ncomment = \"\"\n\n# The post's own properties, with their values.\n[properties]\n";
  for (const PostProperty& one : properties) {
    const bool plain = !one.value.empty() && one.value.front() != '{' && one.value.front() != '[' &&
                       one.value != "null" && one.value != "undefined";
    if (!one.title.empty())
      out += "# " + printable(one.title + (one.choices.empty() ? "" : ": " + one.choices)) + "\n";
    out += (plain ? "" : "# ") + jsonText(one.name) + " = " + one.value + "\n";
  }
  out += "\n# One operation after the other; the steps of an operation in their order.\n";
  const auto has = [&](std::string_view name) {
    return std::find(capabilities.begin(), capabilities.end(), name) != capabilities.end();
  };
  if (has("turning") && !has("milling")) {
    out += "# The post is one for turning: no mill's operation is written.\n";
    return out + R"([[section]]
type = "TYPE_TURNING"
strategy = "turningProfileRoughing"
work_offset = 1
tool = { number = 2, type = "TOOL_TURNING_GENERAL", description = "turn", spindleRPM = 800, surfaceSpeed = 120000.0, maximumSpindleSpeed = 2000, noseRadius = 0.8, coolant = "COOLANT_FLOOD" }
parameters = { "operation-comment" = "Turn" }
before = [{ manual = "STOP" }]

[[section.step]]
rapid = [30.0, 0.0, 5.0]

[[section.step]]
rapid = [20.0, 0.0, 5.0]

[[section.step]]
linear = [20.0, 0.0, -15.0]
feed = 200.0

[[section.step]]
arc = [25.0, 0.0, -20.0]
center = [25.0, 0.0, -15.0]
plane = "ZX"
clockwise = true
feed = 200.0

[[section.step]]
rapid = [30.0, 0.0, 5.0]
)";
  }
  if (!probes) out += "# The post names no probing cycle: a section of strategy \"probe\" is left out.\n";
  if (probes)
    out += R"([[section]]
strategy = "probe"
work_offset = 1
tool = { number = 7, type = "TOOL_PROBE", diameter = 6.0, description = "probe", spindleRPM = 50 }
parameters = { "operation-comment" = "Probe the bore" }

[[section.step]]
rapid = [100.0, 50.0, 20.0]

[[section.step]]
cycle = "probing-xy-circular-hole"
points = [[100.0, 50.0, 0.0]]
with = { clearance = 20.0, retract = 8.0, stock = 0.0, depth = 5.0, bottom = -5.0, feedrate = 1000.0, probeClearance = 4.0, probeOvertravel = 10.0, width1 = 40.0 }

)";
  out += R"([[section]]
strategy = "drill"
work_offset = 1
tool = { number = 3, type = "TOOL_DRILL", diameter = 8.0, description = "drill", spindleRPM = 1500, coolant = "COOLANT_FLOOD" }
parameters = { "operation-comment" = "Drill" }
before = [{ manual = "STOP" }]

[[section.step]]
rapid = [10.0, 10.0, 20.0]

[[section.step]]
cycle = "drilling"
points = [[10.0, 10.0, 0.0], [30.0, 10.0, 0.0]]
with = { clearance = 20.0, retract = 5.0, stock = 0.0, depth = 12.0, bottom = -12.0, feedrate = 200.0, retractFeedrate = 400.0, plungeFeedrate = 200.0, dwell = 0.0, incrementalDepth = 5.0, accumulatedDepth = 12.0, plungesPerRetract = 3 }

[[section.step]]
linear = [40.0, 10.0, 20.0]
feed = 500.0

[[section.step]]
arc = [50.0, 20.0, 20.0]
center = [40.0, 20.0, 20.0]
clockwise = false
feed = 500.0
)";
  return out;
}

} // namespace dotek::posts
