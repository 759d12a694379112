#include "support/Diagnostics.h"
#include "support/LineMap.h"
#include "support/Printable.h"

#include <nlohmann/json.hpp>

namespace dotek {
namespace {

using Json = nlohmann::ordered_json;

Json place(SourceRange range, const SourceMap& sources) {
  Json out;
  if (!range.hasPlace()) {
    out["file"] = "";
    for (const char* key : {"line", "column", "endLine", "endColumn"})
      out[key] = 1;
    return out;
  }
  const SourceFile& file = sources.file(range.file);
  const LineColumn begin = file.place(range.begin);
  const LineColumn end = file.place(range.end);
  out["file"] = asUtf8(file.name());
  out["line"] = begin.line;
  out["column"] = begin.column;
  out["endLine"] = end.line;
  out["endColumn"] = end.column;
  return out;
}

Json fixOf(const Diagnostic& diagnostic, const SourceMap& sources) {
  if (!diagnostic.fix) return nullptr;
  Json out;
  out["applicability"] = diagnostic.fix->applicability == Fix::Applicability::Safe ? "safe" : "display";
  out["title"] = diagnostic.fix->title;
  out["edits"] = Json::array();
  for (const Edit& edit : diagnostic.fix->edits) {
    Json one = place(edit.range, sources);
    one["text"] = edit.text;
    out["edits"].push_back(std::move(one));
  }
  return out;
}

} // namespace

std::string renderJson(const Diagnostics& diagnostics, const SourceMap& sources) {
  Json array = Json::array();
  for (const Diagnostic& d : diagnostics.all()) {
    Json one = place(d.range, sources);
    one["severity"] = severityName(d.severity);
    one["code"] = d.code;
    one["message"] = asUtf8(d.message);
    one["notes"] = Json::array();
    for (const DiagnosticNote& note : d.notes) {
      Json row = place(note.range, sources);
      row["message"] = asUtf8(note.message);
      one["notes"].push_back(std::move(row));
    }
    one["fix"] = fixOf(d, sources);
    array.push_back(std::move(one));
  }
  // Names and texts may hold any bytes: replace what is no UTF-8 instead of throwing.
  return escapeMarks(array.dump(2, ' ', false, Json::error_handler_t::replace)) + "\n";
}

std::string renderLineMap(const std::vector<MappedResult>& results, const SourceMap& sources) {
  Json array = Json::array();
  for (const MappedResult& result : results) {
    Json one;
    one["name"] = asUtf8(result.name);
    one["lines"] = Json::array();
    for (const MappedLine& line : result.lines) {
      Json row;
      row["line"] = line.line;
      row["sources"] = Json::array();
      for (const SourceRange& range : line.ranges)
        row["sources"].push_back(place(range, sources));
      row["reason"] = line.reason;
      one["lines"].push_back(std::move(row));
    }
    array.push_back(std::move(one));
  }
  return escapeMarks(array.dump(2, ' ', false, Json::error_handler_t::replace)) + "\n";
}

} // namespace dotek
