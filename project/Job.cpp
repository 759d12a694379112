#include "project/Job.h"

#include "project/Hosts.h"
#include "project/Settings.h"
#include "stdlib/HostInputs.h"
#include "stdlib/Toml.h"
#include "support/Files.h"

namespace dotek::project {

using stdlib::TomlDocument;
using stdlib::TomlEntry;
using stdlib::TomlTable;
using stdlib::TomlValue;

namespace {

void readProgram(const TomlTable& table, Job& job) {
  if (const TomlValue number = table.value("number")) {
    job.number = static_cast<std::uint64_t>(number.integer(0, 1, 99999999));
    job.numberRange = number.range();
  }
  if (table.has("title")) job.title = table.value("title").text();
  if (table.has("sequence")) {
    const TomlTable sequence = table.value("sequence").table();
    job.sequence = {static_cast<std::uint64_t>(sequence.value("start").integer(10, 0, 99999999)),
                    static_cast<std::uint64_t>(sequence.value("step").integer(10, 1, 99999))};
  }
}

void readRoutine(const TomlTable& table, std::string_view key, std::optional<std::string>& name,
                 SourceRange& range) {
  const TomlValue value = table.value(key);
  if (!value) return;
  name = value.text();
  range = value.range();
}

void takeHost(const TomlDocument& document, const std::string& host, const TomlValue& value,
              std::map<std::string, double>& out) {
  const double number = value.number();
  const std::string_view wanted = stdlib::hostInputRefuses(host, number);
  if (value.isNumber() && !wanted.empty()) document.fail(value.range(), std::string(wanted) + " is expected");
  out.insert_or_assign(host, number);
}

void readHosts(const TomlDocument& document, const TomlTable& table, std::map<std::string, double>& out) {
  for (const TomlEntry& entry : table.entries()) {
    if (stdlib::isHostInput(entry.key)) {
      takeHost(document, entry.key, entry.value, out);
      continue;
    }
    const std::string near = nearestHost(entry.key);
    document.fail(entry.keyRange, "no host input `" + entry.key + "`" +
                                      (near.empty() ? "" : "; did you mean `" + near + "`?"));
  }
}

void readTool(const TomlDocument& document, const TomlTable& table, Job& job) {
  const auto take = [&](std::string_view key, const char* host) {
    if (const TomlValue value = table.value(key)) takeHost(document, host, value, job.hosts);
  };
  take("number", "tool_number");
  take("offset", "tool_offset");
  take("radius", "tool_radius");
  job.lengthToCentre = table.value("length_to").choice({"tip", "centre"}, "tip") == "centre";
}

JobOperation readOperation(const TomlDocument& document, const TomlTable& table) {
  JobOperation out;
  out.range = table.range();
  const TomlValue cycle = table.require("cycle", "the name of a cycle's folder");
  out.cycle = cycle.text();
  out.cycleRange = cycle ? cycle.range() : out.range;
  if (table.value("at").isArray() && table.value("at").items().empty())
    document.fail(table.value("at").range(), "`at` holds no point; write [[x, y]], or leave `at` out");
  for (const TomlValue& point : table.value("at").items()) {
    const std::vector<double> numbers = point.isArray() ? point.numbers() : std::vector<double>{};
    if (numbers.size() == 2)
      out.at.emplace_back(numbers[0], numbers[1]);
    else
      document.fail(point.range(), "a point is [x, y], two numbers in mm");
  }
  if (table.has("host")) readHosts(document, table.value("host").table(), out.hosts);
  if (const TomlValue retract = table.value("retract"))
    out.hosts.insert_or_assign("retract", retract.number());
  for (const TomlEntry& entry : table.value("set").table().entries())
    out.set.push_back({entry.key, entry.value.number(), entry.keyRange});
  return out;
}

} // namespace

std::optional<Job> loadJob(const std::string& path, Session& session) {
  std::optional<std::string> bytes = session.bytes(path, session.diagnostics());
  if (!bytes) return std::nullopt;
  const std::optional<FileId> id = addText(inputName(path), std::move(*bytes), Encoding::Utf8, std::nullopt,
                                           session.sources(), session.diagnostics());
  if (!id) return std::nullopt;
  const std::optional<TomlDocument> document =
      TomlDocument::parse(*id, session.sources(), session.diagnostics());
  if (!document) return std::nullopt;
  Job job;
  job.file = *id;
  const TomlTable root = document->root();
  readProgram(root.value("program").table(), job);
  const TomlTable routines = root.value("routines").table();
  readRoutine(routines, "start", job.startRoutine, job.startRange);
  readRoutine(routines, "operation", job.operationRoutine, job.operationRange);
  readRoutine(routines, "end", job.endRoutine, job.endRange);
  readHosts(*document, root.value("host").table(), job.hosts);
  readTool(*document, root.value("tool").table(), job);
  job.setup = stdlib::readSetup(*document, root.value("setup").table());
  session.takeProbeCodes(probeCodesIn(*document, root));
  for (const TomlTable& operation : root.value("operation").tables())
    job.operations.push_back(readOperation(*document, operation));
  if (job.operations.empty() && !root.has("setup"))
    document->fail({*id, 0, 0}, "the job has no operation; write operation = [{ cycle = \"...\" }]");
  if (!document->finish()) return std::nullopt;
  return job;
}

} // namespace dotek::project
