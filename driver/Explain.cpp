#include "driver/Assumptions.h"
#include "driver/Driver.h"
#include "driver/Session.h"
#include "stdlib/HostInputs.h"
#include "support/NearestName.h"

#include <algorithm>

namespace dotek::driver {
namespace {

// Words of `text` in lines of at most 90 characters.
std::string wrapped(std::string_view text) {
  std::string out;
  std::size_t column = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    if (column > 0 && column + 1 + word.size() > 90) {
      out += '\n';
      column = 0;
    } else if (column > 0) {
      out += ' ';
      ++column;
    }
    out += word;
    column += word.size();
    at = end + 1;
  }
  return out + "\n";
}

std::string table(const std::vector<std::pair<std::string, std::string>>& rows) {
  std::size_t width = 0;
  for (const auto& row : rows)
    width = std::max(width, row.first.size());
  std::string out;
  for (const auto& [name, text] : rows)
    out += fmt::format("{:<{}}  {}\n", name, width, text);
  return out;
}

} // namespace

Outcome explain(const std::string& code) {
  Outcome outcome;
  std::vector<std::string> codes;
  for (const MessageInfo& info : messageTable()) {
    codes.emplace_back(info.code);
    if (info.code != code) continue;
    outcome.output =
        fmt::format("{}: {}\n\n{}", info.code, severityName(info.severity), wrapped(info.explanation));
    return outcome;
  }
  const std::string near = nearestName(code, codes);
  outcome.diagnostics.report<diag::UnknownCode>({}, code,
                                                near.empty() ? "" : "; did you mean `" + near + "`?");
  outcome.status = 2;
  return outcome;
}

Outcome list(const std::string& what, const CommonOptions& options) {
  return guarded(options, [&](Session& session) {
    std::vector<std::pair<std::string, std::string>> rows;
    if (what == "limits") {
      for (const LimitInfo& limit : limitTable())
        rows.emplace_back(limit.name, fmt::format("{:>9}  {}", session.limits().*limit.member, limit.what));
    } else if (what == "hosts") {
      for (const stdlib::HostInput& host : stdlib::kHostInputs)
        rows.emplace_back(host.name, host.meaning);
    } else if (what == "assumptions") {
      rows = assumptionTable();
    } else if (what == "rules") {
      for (const MessageInfo& info : messageTable())
        rows.emplace_back(info.code, severityName(info.severity));
    } else if (what == "forms" || what == "controls" || what == "macros" || what == "cycles") {
      for (const stdlib::DataFile* file : session.data().list(what))
        rows.emplace_back(file->name, file->origin);
      if (rows.empty())
        return session.finish("none in this release; a folder given with --data can add some\n");
    } else if (what == "targets") {
      return session.finish("none in this release\n");
    } else {
      session.diagnostics().report<diag::UnknownList>({}, what);
    }
    return session.finish(table(rows));
  });
}

} // namespace dotek::driver
