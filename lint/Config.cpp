#include "lint/Config.h"

#include "lint/Rule.h"
#include "project/Settings.h"
#include "project/SettingsPlace.h"
#include "stdlib/Toml.h"
#include "support/Glob.h"
#include "support/NearestName.h"
#include "support/messages/Lint.h"

#include <algorithm>
#include <filesystem>

namespace dotek::lint {

namespace fs = std::filesystem;
using stdlib::TomlDocument;
using stdlib::TomlEntry;
using stdlib::TomlTable;
using stdlib::TomlValue;

namespace {

const CodeInfo* codeInfo(std::string_view code) {
  const auto table = codeTable();
  const auto at =
      std::lower_bound(table.begin(), table.end(), code,
                       [](const CodeInfo& info, std::string_view key) { return info.code < key; });
  return at != table.end() && at->code == code ? &*at : nullptr;
}

void checkCode(const TomlDocument& document, const std::string& code, SourceRange range) {
  if (codeInfo(code) != nullptr) return;
  NearestName nearest(code);
  for (const CodeInfo& info : codeTable())
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

FailOn failOnOf(const TomlValue& value) {
  const std::string level = value.choice({"note", "warning", "error", "never"}, "warning");
  return level == "note"    ? FailOn::Note
         : level == "error" ? FailOn::Error
         : level == "never" ? FailOn::Never
                            : FailOn::Warning;
}

} // namespace

std::shared_ptr<Configs::File> Configs::load(const std::string& path, const std::string& folder) {
  auto file = std::make_shared<File>();
  file->settings.folder = folder;
  Config& config = file->base;
  const std::optional<FileId> id =
      dotek::project::readSettings(path, session_.limits(), session_.sources(), session_.diagnostics());
  if (!id) return file;
  const auto document = TomlDocument::parse(*id, session_.sources(), session_.diagnostics());
  if (!document) return file;
  const TomlTable lint = document->root().value("lint").table();
  if (const TomlValue select = lint.value("select")) config.select = codesOf(*document, select, true);
  config.ignore = codesOf(*document, lint.value("ignore"), false);
  if (const TomlValue failOn = lint.value("fail-on")) config.failOn = failOnOf(failOn);
  file->settings = dotek::project::settingsIn(*document, folder, session_);
  config.probe = file->settings.base.probe;
  for (const TomlEntry& entry : lint.value("severity").table().entries()) {
    checkCode(*document, entry.key, entry.keyRange);
    const std::string level = entry.value.choice({"off", "note", "warning", "error"}, "warning");
    std::optional<Severity> severity;
    if (level == "note") severity = Severity::Note;
    if (level == "warning") severity = Severity::Warning;
    if (level == "error") severity = Severity::Error;
    config.severity.emplace(entry.key, severity);
  }
  for (const TomlTable& table : lint.value("path").tables()) {
    Section& section = file->sections.emplace_back();
    const TomlValue patterns =
        table.require("path", "a pattern of paths such as \"lathe/**\", or a list of them");
    if (!patterns.isArray()) section.patterns.push_back({patterns.text(), patterns.range()});
    if (patterns.isArray())
      for (const TomlValue& item : patterns.items())
        section.patterns.push_back({item.text(), item.range()});
    for (const auto& [pattern, range, taken] : section.patterns) {
      if (pattern.empty()) continue; // of no text, reported; or it takes nothing
      if (pattern.find_first_not_of("./") == std::string::npos || pattern.starts_with('/') ||
          pattern.find("..") != std::string::npos || pattern.find('\\') != std::string::npos)
        document->fail(patterns.range(), "`" + pattern +
                                             "` takes no file; a pattern names what is below the folder of "
                                             "dotek.toml, with `/` between folders");
    }
    if (const TomlValue select = table.value("select")) section.select = codesOf(*document, select, true);
    section.ignore = codesOf(*document, table.value("ignore"), false);
    if (const TomlValue exclude = table.value("exclude")) section.exclude = exclude.flag();
  }
  document->finish();
  return file;
}

std::shared_ptr<Configs::File> Configs::inFolder(const std::string& folder) {
  if (const auto known = folders_.find(folder); known != folders_.end()) return known->second;
  const fs::path here(folder);
  std::error_code error;
  const fs::path file = dotek::project::settingsFileIn(here);
  std::shared_ptr<File> config;
  if (!file.empty()) {
    const fs::path near = file.lexically_proximate(fs::current_path(error));
    config = load(near.empty() ? file.generic_string() : near.generic_string(), folder);
  } else if (here.has_parent_path() && here.parent_path() != here) {
    config = inFolder(here.parent_path().generic_string());
  } else {
    config = std::make_shared<File>();
  }
  folders_.emplace(folder, config);
  return config;
}

const Config* Configs::of(const std::string& path) {
  if (const auto known = files_.find(path); known != files_.end()) return &known->second;
  std::error_code error;
  fs::path whole = fs::absolute(path, error).lexically_normal();
  if (!whole.has_filename() && whole.has_relative_path()) whole = whole.parent_path();
  const bool isFolder = fs::is_directory(whole, error);
  const std::shared_ptr<File> file = inFolder((isFolder ? whole : whole.parent_path()).generic_string());
  Config config = file->base;
  const std::string& folder = file->settings.folder;
  const dotek::project::Settings settings = file->settings.of(whole.generic_string());
  config.control = settings.control;
  config.form = settings.form;
  const std::string below = folder.empty() ? "" : whole.lexically_relative(folder).generic_string();
  for (Section& section : file->sections) {
    bool takes = false;
    for (Pattern& pattern : section.patterns) {
      if (!matchesGlob(pattern.text, below)) continue;
      takes = true;
      if (!isFolder) pattern.taken = true;
    }
    if (!takes) continue;
    if (section.select) {
      config.select = section.select;
      for (const std::string& code : *section.select)
        config.ignore.erase(code);
    }
    config.ignore.insert(section.ignore.begin(), section.ignore.end());
    config.exclude = section.exclude.value_or(config.exclude);
  }
  return &files_.emplace(path, std::move(config)).first->second;
}

namespace {

// The folders or the file that a pattern names before its first `*` or `?`; "": a name at any depth.
fs::path fixedPartOf(std::string_view pattern) {
  fs::path out;
  if (pattern.find('/') == std::string_view::npos) return out;
  for (const fs::path& part : fs::path(pattern)) {
    if (part.string().find_first_of("*?") != std::string::npos) break;
    if (!part.empty() && part != ".") out /= part;
  }
  return out;
}

bool isWithin(const fs::path& inner, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), inner.begin(), inner.end()).first == folder.end();
}

} // namespace

void Configs::reportUnused(const std::vector<std::string>& paths) {
  std::vector<fs::path> walked;
  for (const std::string& path : paths) {
    std::error_code error;
    fs::path whole = fs::absolute(path, error).lexically_normal();
    if (!whole.has_filename() && whole.has_relative_path()) whole = whole.parent_path();
    if (fs::is_directory(whole, error)) walked.push_back(std::move(whole));
  }
  std::set<const File*> told;
  for (const auto& [folder, file] : folders_) {
    if (file->settings.folder.empty() || !told.insert(file.get()).second) continue;
    const fs::path own(file->settings.folder);
    const auto isWalked = [&](const fs::path& inner) {
      return std::any_of(walked.begin(), walked.end(),
                         [&](const fs::path& one) { return isWithin(inner, one); });
    };
    const bool whole = isWalked(own);
    if (whole) whole_.insert(own.lexically_normal().string());
    // All that the pattern could take was looked at, or there is no such folder.
    const auto isKnown = [&](const Pattern& pattern) {
      const fs::path fixed = fixedPartOf(pattern.text);
      if (whole || fixed.empty() || walked.empty()) return whole;
      std::error_code error;
      return isWalked(own / fixed) || !fs::exists(own / fixed, error);
    };
    for (const Section& section : file->sections)
      for (const Pattern& pattern : section.patterns)
        if (!pattern.taken && !pattern.text.empty() && isKnown(pattern))
          session_.diagnostics().report<diag::PathUnused>(pattern.range, pattern.text);
  }
}

bool Configs::knowsUnused(FileId settings) const {
  std::error_code error;
  const fs::path name = fs::absolute(session_.sources().file(settings).name(), error);
  return whole_.contains(name.lexically_normal().parent_path().string());
}

bool isWanted(std::string_view code, const LintOptions& options, const Config& config) {
  const std::string key(code);
  if (options.ignore.contains(key) || config.ignore.contains(key)) return false;
  const auto severity = config.severity.find(code);
  const bool named = severity != config.severity.end();
  if (options.select) return options.select->contains("all") || options.select->contains(key);
  if (named && !severity->second) return false;
  if (config.select) return named || config.select->contains("all") || config.select->contains(key);
  const CodeInfo* info = codeInfo(code);
  return named || info == nullptr || info->byDefault;
}

} // namespace dotek::lint
