#include "cli/FindingsPage.h"

#include "sim/picture/PictureText.h"
#include "support/Printable.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <vector>

namespace dotek::cli {
namespace {

constexpr std::size_t kShownColumns = 160, kMostText = 20000;

constexpr const char* kStyle =
    R"(:root{color-scheme:light dark;--edge:#ccc;--back:#f3f4f6;--error:#b00020;--warning:#8a5000;--note:#00568f}
@media(prefers-color-scheme:dark){:root{--edge:#555;--back:#22262b;--error:#ff8a8a;--warning:#ffc36b;--note:#7cc4ff}}
body{font:16px/1.5 sans-serif;margin:0 auto;max-width:70em;padding:1em}h2{font-size:1.1em;border-bottom:1px solid var(--edge);overflow-wrap:anywhere}
pre{background:var(--back);padding:.5em;overflow:auto;margin:.3em 0}mark{text-decoration:underline 2px var(--error);background:none;color:inherit}
.error{color:var(--error)}.warning{color:var(--warning)}.note{color:var(--note)}article{margin:0 0 1.2em}p{margin:.2em 0;overflow-wrap:anywhere}
.code{font-family:monospace}table{border-collapse:collapse}td,th{padding:.1em 1em .1em 0;text-align:left}
@media print{article{break-inside:avoid}}
)";

std::string_view nameOf(Severity severity) {
  switch (severity) {
  case Severity::Error: return "error";
  case Severity::Warning: return "warning";
  case Severity::Note: return "note";
  }
  return "note";
}

std::string text(std::string_view given) {
  return sim::xmlText(given, kMostText);
}

// The line, what is meant in it underlined; a long one is cut around that.
std::string excerpt(SourceRange range, const SourceMap& sources) {
  const SourceFile& file = sources.file(range.file);
  const LineColumn begin = file.place(range.begin), end = file.place(range.end);
  const std::string line = printable(file.lineUtf8(begin.line));
  std::vector<std::size_t> starts; // of characters
  for (std::size_t i = 0; i < line.size(); ++i)
    if ((static_cast<unsigned char>(line[i]) & 0xC0U) != 0x80U) starts.push_back(i);
  if (starts.empty()) return "";
  const std::size_t length = starts.size();
  starts.push_back(line.size());
  const std::size_t first = std::min<std::size_t>(begin.column - 1, length);
  std::size_t last = end.line == begin.line ? std::min<std::size_t>(end.column - 1, length) : length;
  last = std::max(last, std::min(first + 1, length));
  const std::size_t from =
      length > kShownColumns && first > kShownColumns / 2 ? first - kShownColumns / 2 : 0;
  const std::size_t to = std::min(length, from + kShownColumns);
  last = std::min(last, to);
  const auto part = [&](std::size_t a, std::size_t b) {
    return text(std::string_view(line).substr(starts[a], starts[b] - starts[a]));
  };
  return fmt::format("<pre>{}{}<mark>{}</mark>{}{}</pre>\n", from > 0 ? "..." : "", part(from, first),
                     part(first, last), part(last, to), to < length ? "..." : "");
}

std::string placeOf(SourceRange range, const SourceMap& sources) {
  if (!range.hasPlace()) return "";
  const LineColumn at = sources.file(range.file).place(range.begin);
  return fmt::format("{}:{}:{}", text(printable(sources.file(range.file).name())), at.line, at.column);
}

std::string articleOf(const Diagnostic& one, const SourceMap& sources) {
  std::string out = fmt::format(
      "<article>\n<p><b class=\"{0}\">{0}</b> {1} <span class=\"code\">{2}</span></p>\n<p>{3}</p>\n",
      nameOf(one.severity), placeOf(one.range, sources), one.code, text(asUtf8(one.message)));
  if (one.range.hasPlace()) out += excerpt(one.range, sources);
  for (const DiagnosticNote& note : one.notes) {
    const std::string place = placeOf(note.range, sources);
    out += fmt::format("<p><b class=\"note\">note</b> {}{}{}</p>\n", place, place.empty() ? "" : " ",
                       text(asUtf8(note.message)));
    if (note.range.hasPlace()) out += excerpt(note.range, sources);
  }
  if (one.fix)
    out += fmt::format("<p><b>{}</b> {}</p>\n",
                       one.fix->applicability == Fix::Applicability::Safe ? "repair, made by --fix:"
                                                                          : "repair by hand:",
                       text(asUtf8(one.fix->title)));
  return out + "</article>\n";
}

} // namespace

std::string findingsPage(const Diagnostics& diagnostics, const SourceMap& sources,
                         const std::string& summary) {
  std::map<std::string, std::string> files; // by name, "" without a place
  std::map<std::string_view, std::size_t> codes;
  std::size_t errors = 0, warnings = 0, notes = 0;
  for (const Diagnostic& one : diagnostics.all()) {
    ++(one.severity == Severity::Error ? errors : one.severity == Severity::Warning ? warnings : notes);
    ++codes[one.code];
    files[one.range.hasPlace() ? printable(sources.file(one.range.file).name()) : ""] +=
        articleOf(one, sources);
  }
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>dotek lint</title>\n<style>{}</style>\n</head>\n<body>\n"
      "<h1>dotek lint</h1>\n<p><b class=\"error\">{} errors</b>, <b class=\"warning\">{} warnings</b>, "
      "<b class=\"note\">{} notes</b></p>\n",
      kStyle, errors, warnings, notes);
  if (!summary.empty()) out += "<p>" + text(printable(summary)) + "</p>\n";
  if (!codes.empty()) {
    out += "<table>\n<tr><th>rule or message</th><th>found</th></tr>\n";
    for (const auto& [code, count] : codes)
      out += fmt::format("<tr><td class=\"code\">{}</td><td>{}</td></tr>\n", code, count);
    out += "</table>\n<p><code>dotek explain CODE</code> says why it matters on the machine, and the "
           "repair.</p>\n";
  }
  for (const auto& [name, articles] : files)
    out += fmt::format("<h2>{}</h2>\n{}", name.empty() ? "dotek" : text(name), articles);
  return out + "</body>\n</html>\n";
}

} // namespace dotek::cli
