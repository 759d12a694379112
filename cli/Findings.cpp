#include "cli/Findings.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace dotek::cli {

std::string closingLine(const Diagnostics& findings) {
  std::set<FileId> files;
  std::size_t errors = 0, repairs = 0;
  for (const Diagnostic& one : findings.all()) {
    if (one.range.hasPlace()) files.insert(one.range.file);
    if (one.severity == Severity::Error) ++errors;
    if (one.fix && one.fix->applicability == Fix::Applicability::Safe) ++repairs;
  }
  const std::size_t count = findings.all().size();
  if (count == 0 || files.empty()) return "";
  std::string out = fmt::format("{} finding{} in {} file{}", count, count == 1 ? "" : "s", files.size(),
                                files.size() == 1 ? "" : "s");
  if (errors > 0) out += fmt::format(" ({} error{})", errors, errors == 1 ? "" : "s");
  if (repairs > 0) out += fmt::format("; {} can be repaired with --fix", repairs);
  return out;
}

std::string statisticsOf(const Diagnostics& findings) {
  std::map<std::string_view, std::pair<std::size_t, Severity>> counts;
  for (const Diagnostic& one : findings.all()) {
    auto& [count, severity] = counts[one.code];
    ++count;
    severity = std::max(severity, one.severity);
  }
  std::vector<std::pair<std::string_view, std::pair<std::size_t, Severity>>> rows(counts.begin(),
                                                                                  counts.end());
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return a.second.first > b.second.first; });
  std::string out;
  for (const auto& [code, row] : rows)
    out += fmt::format("{:>6}  {:<7}  {}\n", row.first, severityName(row.second), code);
  return out;
}

} // namespace dotek::cli
