#include "support/Sarif.h"

#include "support/Fingerprint.h"
#include "support/Printable.h"
#include "support/Version.h"
#include "support/WholeName.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

namespace dotek {
namespace {

using Json = nlohmann::ordered_json;

// Relative to the folder that the command ran in.
std::string uri(std::string_view path) {
  std::string out;
  for (const char c : withoutDot(path)) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || std::string_view("-._~/").find(c) != std::string_view::npos)
      out += c;
    else
      out += fmt::format("%{:02X}", byte);
  }
  return out;
}

Json region(SourceRange range, const SourceFile& file) {
  const LineColumn begin = file.place(range.begin);
  const LineColumn end = file.place(range.end);
  Json out;
  out["startLine"] = begin.line;
  out["startColumn"] = begin.column;
  out["endLine"] = end.line;
  out["endColumn"] = end.column;
  return out;
}

Json location(SourceRange range, const SourceMap& sources) {
  const SourceFile& file = sources.file(range.file);
  Json physical;
  physical["artifactLocation"]["uri"] = uri(file.name());
  physical["region"] = region(range, file);
  Json out;
  out["physicalLocation"] = std::move(physical);
  return out;
}

// Changes grouped by file, in the order of the edits.
Json changes(const Fix& fix, const SourceMap& sources) {
  std::vector<std::pair<FileId, Json>> files;
  for (const Edit& edit : fix.edits) {
    Json replacement;
    replacement["deletedRegion"] = region(edit.range, sources.file(edit.range.file));
    replacement["insertedContent"]["text"] = edit.text;
    if (files.empty() || files.back().first != edit.range.file)
      files.emplace_back(edit.range.file, Json::array());
    files.back().second.push_back(std::move(replacement));
  }
  Json out = Json::array();
  for (auto& [file, replacements] : files) {
    Json change;
    change["artifactLocation"]["uri"] = uri(sources.file(file).name());
    change["replacements"] = std::move(replacements);
    out.push_back(std::move(change));
  }
  return out;
}

Json resultOf(const Diagnostic& d, std::size_t rule, const SourceMap& sources) {
  Json out;
  out["ruleId"] = d.code;
  out["ruleIndex"] = rule;
  out["level"] = severityName(d.severity);
  out["message"]["text"] = asUtf8(d.message);
  if (d.range.hasPlace()) out["locations"] = Json::array({location(d.range, sources)});
  Json related = Json::array();
  for (const DiagnosticNote& note : d.notes) {
    if (!note.range.hasPlace()) continue;
    Json one = location(note.range, sources);
    one["message"]["text"] = note.message;
    related.push_back(std::move(one));
  }
  if (!related.empty()) out["relatedLocations"] = std::move(related);
  // A fix that is only shown is no `fixes` entry: tools would offer to apply it.
  if (d.fix && d.fix->applicability == Fix::Applicability::Safe && !d.fix->edits.empty()) {
    Json fix;
    fix["description"]["text"] = d.fix->title;
    fix["artifactChanges"] = changes(*d.fix, sources);
    out["fixes"] = Json::array({std::move(fix)});
  }
  return out;
}

} // namespace

std::string renderSarif(const Diagnostics& diagnostics, const SourceMap& sources,
                        const std::vector<SarifRule>& rules) {
  std::map<std::string_view, std::size_t> index;
  Json ruleRows = Json::array();
  for (const SarifRule& rule : rules) {
    index.emplace(rule.code, ruleRows.size());
    Json row;
    row["id"] = rule.code;
    row["shortDescription"]["text"] = rule.summary;
    row["help"]["text"] = rule.help;
    if (!rule.helpMarkdown.empty()) row["help"]["markdown"] = rule.helpMarkdown;
    row["defaultConfiguration"]["level"] = severityName(rule.severity);
    ruleRows.push_back(std::move(row));
  }
  Json run;
  run["tool"]["driver"]["name"] = "dotek";
  run["tool"]["driver"]["version"] = kVersion;
  run["tool"]["driver"]["semanticVersion"] = kVersion;
  run["tool"]["driver"]["rules"] = std::move(ruleRows);
  run["columnKind"] = "unicodeCodePoints";
  run["results"] = Json::array();
  Fingerprints fingerprints;
  for (const Diagnostic& d : diagnostics.all()) {
    const auto at = index.find(d.code);
    if (at == index.end()) continue;
    Json result = resultOf(d, at->second, sources);
    if (d.range.hasPlace()) result["partialFingerprints"]["dotekLine/v1"] = fingerprints.of(d, sources);
    run["results"].push_back(std::move(result));
  }
  Json log;
  log["$schema"] =
      "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";
  log["version"] = "2.1.0";
  log["runs"] = Json::array({std::move(run)});
  // Names and texts may hold any bytes: replace what is no UTF-8 instead of throwing.
  return escapeMarks(log.dump(2, ' ', false, Json::error_handler_t::replace)) + "\n";
}

} // namespace dotek
