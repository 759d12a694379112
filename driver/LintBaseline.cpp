#include "driver/LintBaseline.h"

#include "support/Printable.h"
#include "support/WholeName.h"
#include "support/messages/Lint.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>

namespace dotek::driver {
namespace {

namespace fs = std::filesystem;

bool isBelow(const std::string& file, const std::string& path) {
  const std::string whole = wholeName(path);
  if (file == whole) return true;
  return file.starts_with(whole.ends_with('/') ? whole : whole + "/");
}

} // namespace

lint::Baseline::Judged judgedBy(LookedAt looked, const SourceMap& sources) {
  std::map<std::string, FileId> read;
  for (FileId id = 0; id < sources.size(); ++id)
    read.emplace(asUtf8(wholeName(sources.file(id).name())), id);
  return
      [looked = std::move(looked), read = std::move(read)](const std::string& file, const std::string& code) {
        if (const auto at = read.find(file); at != read.end())
          return looked.file(at->second) && looked.ruleFor(code, at->second);
        std::error_code error;
        return !file.empty() && !fs::exists(file, error) && !error && looked.rule(code) &&
               std::any_of(looked.paths.begin(), looked.paths.end(),
                           [&](const std::string& path) { return isBelow(file, path); });
      };
}

std::optional<lint::Baseline> readBaseline(const std::string& path, project::Session& session) {
  const auto text = session.bytes(path, session.diagnostics());
  if (!text) return std::nullopt;
  std::string reason;
  std::optional<lint::Baseline> out = lint::Baseline::read(*text, reason, path);
  if (!out) session.diagnostics().report<diag::BaselineUnreadable>({}, path, reason);
  return out;
}

std::optional<lint::Baseline> keptBaseline(const std::string& path, project::Session& session,
                                           std::string& said) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return lint::Baseline();
  const auto text = session.bytes(path, session.diagnostics());
  if (!text) return std::nullopt;
  std::string reason;
  if (auto out = lint::Baseline::read(*text, reason, path)) return out;
  said = fmt::format("`{}` was no baseline ({}); nothing of it is kept", path, reason);
  return lint::Baseline();
}

} // namespace dotek::driver
