#include "backends/fusion/TargetWritten.h"

#include "support/messages/Verify.h"

#include <algorithm>
#include <utility>

namespace dotek::targets {

Written writtenOf(const std::string& text) {
  Written out;
  constexpr std::string_view kNumber = "N1 ";
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    const bool numbered = line.starts_with(kNumber);
    if (numbered) line.erase(0, kNumber.size());
    out.text += line + "\n";
    out.lines.push_back(std::move(line));
    out.numbered.push_back(numbered);
    at = end + 1;
  }
  return out;
}

bool isComment(const std::string& line) {
  const std::size_t at = line.find_first_not_of(" \t");
  return at == std::string::npos || (line[at] == '(' && line.find(')') == line.find_last_not_of(" \t\r"));
}

bool hasNumber(const std::string& posted) {
  const std::size_t at = posted.find_first_not_of(" \t");
  return at != std::string::npos && posted[at] == 'N' && at + 1 < posted.size() && posted[at + 1] >= '0' &&
         posted[at + 1] <= '9';
}

SourceRange rangeOfLine(const SourceFile& file, FileId id, std::uint32_t line) {
  line = line == 0 ? file.lineCount() : std::min(line, file.lineCount());
  while (line > 1 && file.line(line).empty())
    --line;
  const std::string_view text = file.line(line);
  const std::size_t blank = std::min(text.find_first_not_of(" \t"), text.size());
  const std::uint32_t begin = file.lineStart(line);
  return {id, begin + static_cast<std::uint32_t>(blank), begin + static_cast<std::uint32_t>(text.size())};
}

bool losesDigits(const backends::fusion::RunResult& result) {
  return std::any_of(result.warnings.begin(), result.warnings.end(), [](const std::string& one) {
    return one.find("has more digits than are printed") != std::string::npos;
  });
}

std::string didInstead(const backends::fusion::RunResult& result) {
  if (result.fault) return "it fails: " + result.fault->text;
  if (!result.errors.empty()) return "it stops with `" + result.errors.front() + "`";
  return result.text.empty() ? "it writes nothing" : "it writes blocks";
}

void reportFault(const script::Fault& fault, std::uint32_t line, const Translation& translation,
                 Session& session) {
  Diagnostics& diagnostics = session.diagnostics();
  if (fault.kind == script::Fault::Kind::NoWorker) {
    diagnostics.report<diag::ScriptNotRun>({}, fault.text);
  } else if (fault.kind == script::Fault::Kind::Stopped) {
    diagnostics.report<diag::TranslationStopped>({}, translation.name, fault.text);
  } else {
    SourceMap& sources = session.sources();
    const FileId id = sources.add(SourceFile(translation.name, translation.text, Encoding::Utf8));
    diagnostics.report<diag::ScriptFails>(rangeOfLine(sources.file(id), id, line), fault.text);
  }
}

} // namespace dotek::targets
