#include "posts/JobJson.h"
#include "posts/Json.h"
#include "posts/PostJob.h"
#include "stdlib/Toml.h"

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
  std::string name, strategy, type; // type of the operation; "": milling
  std::vector<double> at;
  Values tool, values;
  std::vector<std::string> types;
};

struct CycleTable {
  std::vector<CycleKind> kinds;
  std::map<std::string, std::pair<Values, Values>> own; // tool and values, by type
  struct Row {
    std::string kind, name, section; // JSON
  };
  std::vector<Row> rows; // operations of moves
  std::vector<std::string> holes;
};

Values valuesOf(const TomlTable& table) {
  Values out;
  for (const TomlEntry& entry : table.entries())
    out[entry.key] = entry.value.isText()   ? jsonText(entry.value.text())
                     : entry.value.isFlag() ? (entry.value.flag() ? "true" : "false")
                                            : jsonNumber(entry.value.number());
  return out;
}

CycleTable tableOf(const stdlib::DataFiles& data) {
  CycleTable out;
  const stdlib::DataFile* const file = data.find("fusion", "cycles");
  if (file == nullptr) throw stdlib::DataError("fusion/cycles.toml is not there");
  const TomlDocument document = TomlDocument::parse(*file);
  const TomlTable root = document.root();
  static_cast<void>(root.value("grade").text());
  static_cast<void>(root.value("source").text());
  out.holes = root.value("holes").texts();
  for (const TomlTable& table : root.value("kind").tables())
    out.kinds.push_back({table.value("name").text(), table.value("strategy").text(),
                         table.value("type").text(), table.value("at").numbers(),
                         valuesOf(table.value("tool").table()), valuesOf(table.value("values").table()),
                         table.value("types").texts()});
  for (const TomlTable& table : root.value("own").tables()) {
    const Values tool = valuesOf(table.value("tool").table());
    const Values values = valuesOf(table.value("values").table());
    for (const std::string& type : table.value("types").texts())
      out.own[type] = {tool, values};
  }
  for (const TomlTable& table : root.value("row").tables()) {
    const std::string kind = table.value("kind").text(), name = table.value("name").text();
    out.rows.push_back({kind, name, sectionOf(document, table)});
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

} // namespace

std::set<std::string, std::less<>> holeCycles(const stdlib::DataFiles& data) {
  const CycleTable table = tableOf(data);
  return {table.holes.begin(), table.holes.end()};
}

std::vector<std::string> matrixKinds(const project::Session& session) {
  std::vector<std::string> out;
  for (const CycleKind& kind : tableOf(session.data()).kinds)
    out.push_back(kind.name);
  return out;
}

std::vector<MatrixJob> matrixJobs(const std::string& kind, const JobOptions& options,
                                  const project::Session& session) {
  std::vector<MatrixJob> out;
  const auto add = [&](const std::string& name, const std::string& section, bool isCycle) {
    JsonObject job;
    job.add("most", std::to_string(options.most));
    job.add("map", "true");
    JsonObject properties;
    for (const auto& [property, value] : options.properties)
      properties.add(property, jsonOfArgument(value));
    job.add("properties", properties.text());
    job.add("sections", jsonList({section}));
    out.push_back({name, job.text(), isCycle});
  };
  const CycleTable table = tableOf(session.data());
  for (const CycleTable::Row& row : table.rows)
    if (row.kind == kind) add(row.name, row.section, false);
  for (const CycleKind& one : table.kinds) {
    if (one.name != kind) continue;
    const std::string above =
        fmt::format("[{}, {}, {}]", one.at.at(0), one.at.at(1), one.values.at("clearance"));
    for (const std::string& type : one.types) {
      const auto own = table.own.find(type);
      const Values tool = own == table.own.end() ? one.tool : merged(one.tool, own->second.first);
      const Values values = own == table.own.end() ? one.values : merged(one.values, own->second.second);
      JsonObject section;
      section.add("tool", jsonOf(tool));
      section.add("strategy", jsonText(one.strategy));
      if (!one.type.empty()) section.add("type", jsonText(one.type));
      section.add("initial", above);
      JsonObject parameters;
      parameters.add("operation-strategy", jsonText(one.strategy));
      parameters.add("operation-comment", jsonText(type));
      for (const char* const feed : {"operation:tool_feedCutting", "operation:tool_feedProbeLink",
                                     "operation:tool_feedProbeMeasure", "operation:tool_feedEntry"})
        parameters.add(feed, values.at("feedrate"));
      section.add("parameters", parameters.text());
      section.add(
          "records",
          jsonList({fmt::format(R"({{"record": "rapid", "to": {}}})", above),
                    fmt::format(R"({{"record": "cycle", "type": {}, "cycle": {}, "points": [[{}, {}, {}]]}})",
                                jsonText(type), jsonOf(values), one.at[0], one.at[1], one.at[2])}));
      add(type, section.text(), true);
    }
  }
  return out;
}

} // namespace dotek::posts
