#include "driver/LintConfig.h"

#include "lint/Rule.h"
#include "project/Settings.h"
#include "stdlib/Toml.h"
#include "support/Files.h"
#include "support/NearestName.h"

#include <algorithm>
#include <filesystem>

namespace dotek::driver {

namespace fs = std::filesystem;
using stdlib::TomlDocument;
using stdlib::TomlEntry;
using stdlib::TomlTable;
using stdlib::TomlValue;

namespace {

const lint::CodeInfo* codeInfo(std::string_view code) {
  const auto table = lint::codeTable();
  const auto at =
      std::lower_bound(table.begin(), table.end(), code,
                       [](const lint::CodeInfo& info, std::string_view key) { return info.code < key; });
  return at != table.end() && at->code == code ? &*at : nullptr;
}

void checkCode(const TomlDocument& document, const std::string& code, SourceRange range) {
  if (codeInfo(code) != nullptr) return;
  NearestName nearest(code);
  for (const lint::CodeInfo& info : lint::codeTable())
    nearest.offer(info.code);
  document.fail(range, "no message or rule `" + code + "`" +
                           (nearest.result().empty() ? "" : "; did you mean `" + nearest.result() + "`?"));
}

std::set<std::string> codesOf(const TomlDocument& document, const TomlValue& value, bool all) {
  std::set<std::string> out;
  for (const TomlValue& item : value.items()) {
    const std::string code = item.text();
    if (!(all && code == "all")) checkCode(document, code, item.range());
    out.insert(code);
  }
  return out;
}

} // namespace

std::shared_ptr<const LintConfig> LintConfigs::load(const std::string& path) {
  auto config = std::make_shared<LintConfig>();
  const std::optional<FileId> id = readText(path, Encoding::Utf8, std::nullopt, session_.limits(),
                                            session_.sources(), session_.diagnostics());
  if (!id) return config;
  const auto document = TomlDocument::parse(*id, session_.sources(), session_.diagnostics());
  if (!document) return config;
  const TomlTable lint = document->root().value("lint").table();
  if (const TomlValue select = lint.value("select")) config->select = codesOf(*document, select, true);
  config->ignore = codesOf(*document, lint.value("ignore"), false);
  if (const TomlValue failOn = lint.value("fail-on")) {
    const std::string level = failOn.choice({"note", "warning", "error", "never"}, "warning");
    config->failOn = level == "note"    ? FailOn::Note
                     : level == "error" ? FailOn::Error
                     : level == "never" ? FailOn::Never
                                        : FailOn::Warning;
  }
  config->control = lint.value("control").text();
  config->form = settingsIn(*document).form;
  for (const TomlEntry& entry : lint.value("severity").table().entries()) {
    checkCode(*document, entry.key, entry.keyRange);
    const std::string level = entry.value.choice({"off", "note", "warning", "error"}, "warning");
    std::optional<Severity> severity;
    if (level == "note") severity = Severity::Note;
    if (level == "warning") severity = Severity::Warning;
    if (level == "error") severity = Severity::Error;
    config->severity.emplace(entry.key, severity);
  }
  document->finish();
  return config;
}

std::shared_ptr<const LintConfig> LintConfigs::inFolder(const std::string& folder) {
  if (const auto known = folders_.find(folder); known != folders_.end()) return known->second;
  const fs::path here(folder);
  std::error_code error;
  const fs::path file = here / "dotek.toml";
  std::shared_ptr<const LintConfig> config;
  if (fs::is_regular_file(file, error)) {
    const fs::path near = file.lexically_proximate(fs::current_path(error));
    config = load(near.empty() ? file.generic_string() : near.generic_string());
  } else if (here.has_parent_path() && here.parent_path() != here) {
    config = inFolder(here.parent_path().generic_string());
  } else {
    config = std::make_shared<LintConfig>();
  }
  folders_.emplace(folder, config);
  return config;
}

const LintConfig* LintConfigs::of(const std::string& path) {
  std::error_code error;
  fs::path absolute = fs::absolute(path, error).lexically_normal();
  if (!fs::is_directory(absolute, error)) absolute = absolute.parent_path();
  if (!absolute.has_filename() && absolute.has_relative_path()) absolute = absolute.parent_path();
  return inFolder(absolute.generic_string()).get();
}

bool isWanted(std::string_view code, const LintOptions& options, const LintConfig& config) {
  const std::string key(code);
  if (options.ignore.contains(key) || config.ignore.contains(key)) return false;
  const auto severity = config.severity.find(code);
  const bool named = severity != config.severity.end();
  if (options.select) return options.select->contains("all") || options.select->contains(key);
  if (named && !severity->second) return false;
  if (config.select) return named || config.select->contains("all") || config.select->contains(key);
  const lint::CodeInfo* info = codeInfo(code);
  return named || info == nullptr || info->byDefault;
}

} // namespace dotek::driver
