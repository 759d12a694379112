#include "support/CodeHosts.h"

#include "support/Fingerprint.h"
#include "support/Printable.h"
#include "support/Sha256.h"
#include "support/WholeName.h"

#include <nlohmann/json.hpp>

namespace dotek {
namespace {

using Json = nlohmann::ordered_json;

// What a workflow command would take for its own signs. `property`: of what precedes `::`.
std::string escaped(std::string_view text, bool property) {
  std::string out;
  for (const char c : text) {
    const bool taken = c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ','));
    if (taken)
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out;
}

std::string_view commandOf(Severity severity) {
  switch (severity) {
  case Severity::Error: return "error";
  case Severity::Warning: return "warning";
  case Severity::Note: return "notice";
  }
  return "notice";
}

std::string_view severityOf(Severity severity) {
  switch (severity) {
  case Severity::Error: return "major";
  case Severity::Warning: return "minor";
  case Severity::Note: return "info";
  }
  return "info";
}

} // namespace

std::string renderGithub(const Diagnostics& diagnostics, const SourceMap& sources) {
  std::string out;
  for (const Diagnostic& one : diagnostics.all()) {
    out += fmt::format("::{} ", commandOf(one.severity));
    if (one.range.hasPlace()) {
      const SourceFile& file = sources.file(one.range.file);
      const LineColumn begin = file.place(one.range.begin), end = file.place(one.range.end);
      out += fmt::format("file={},line={},endLine={},", escaped(printable(withoutDot(file.name())), true),
                         begin.line, end.line);
      // Columns are of one line.
      if (begin.line == end.line) out += fmt::format("col={},endColumn={},", begin.column, end.column);
    }
    out += fmt::format("title={}::{}\n", escaped(one.code, true), escaped(asUtf8(one.message), false));
  }
  return out;
}

std::string renderGitlab(const Diagnostics& diagnostics, const SourceMap& sources) {
  Json rows = Json::array();
  Fingerprints fingerprints;
  for (const Diagnostic& one : diagnostics.all()) {
    const std::string path =
        one.range.hasPlace() ? std::string(withoutDot(sources.file(one.range.file).name())) : "";
    Json row;
    row["description"] = asUtf8(one.message);
    row["check_name"] = one.code;
    // GitLab compares fingerprints of all files: the name of the file is part of it.
    row["fingerprint"] = sha256(
        path + '\n' +
        (one.range.hasPlace() ? fingerprints.of(one, sources) : std::string(one.code) + '\n' + one.message));
    row["severity"] = severityOf(one.severity);
    row["location"]["path"] = asUtf8(path);
    row["location"]["lines"]["begin"] = one.range.hasPlace() ? sources.line(one.range) : 1;
    rows.push_back(std::move(row));
  }
  return escapeMarks(rows.dump(2, ' ', false, Json::error_handler_t::replace)) + "\n";
}

} // namespace dotek
