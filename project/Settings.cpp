#include "project/Settings.h"

#include "project/Session.h"
#include "project/SettingsPlace.h"
#include "stdlib/ControlFiles.h"
#include "stdlib/Toml.h"
#include "support/Files.h"
#include "support/Glob.h"
#include "support/NearestName.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace dotek::project {

namespace fs = std::filesystem;

namespace {

using stdlib::TomlDocument;
using stdlib::TomlEntry;
using stdlib::TomlTable;
using stdlib::TomlValue;

// The dotek.toml in the folder or above it; empty: there is none.
fs::path settingsFileAbove(fs::path folder) {
  for (; !folder.empty(); folder = folder.parent_path()) {
    if (fs::path file = settingsFileIn(folder); !file.empty()) return file;
    if (folder == folder.root_path()) break;
  }
  return {};
}

// The folder in which the settings of a file or a folder are looked for first.
fs::path folderOf(const fs::path& whole) {
  std::error_code error;
  return fs::is_directory(whole, error) ? whole : whole.parent_path();
}

fs::path wholePath(const std::string& path) {
  std::error_code error;
  fs::path whole = fs::absolute(path, error).lexically_normal();
  return !whole.has_filename() && whole.has_relative_path() ? whole.parent_path() : whole;
}

std::string nearPath(const fs::path& path) {
  std::error_code error;
  const fs::path near = path.lexically_proximate(fs::current_path(error));
  return (near.empty() ? path : near).generic_string();
}

SettingsFile load(const fs::path& file, Session& session) {
  const auto id = readSettings(nearPath(file), session.limits(), session.sources(), session.diagnostics());
  if (!id) return {};
  const auto document = TomlDocument::parse(*id, session.sources(), session.diagnostics());
  if (!document) return {};
  SettingsFile out = settingsIn(*document, file.parent_path().generic_string(), session);
  const TomlTable lint = document->root().value("lint").table(); // lint says what it does not know of it
  static_cast<void>(lint.value("severity").table().entries());
  for (const TomlTable& section : lint.value("path").tables())
    static_cast<void>(section.entries());
  static_cast<void>(lint.entries());
  document->finish();
  return out;
}

// Nothing: not said. An empty name takes back what was said before.
std::optional<std::string> controlIn(const TomlDocument& document, const TomlTable& table,
                                     const std::string& folder, Session& session) {
  const TomlValue value = table.value("control");
  if (!value) return std::nullopt;
  std::string name = value.text();
  if (stdlib::isDataPath(name)) {
    name = nearPath((fs::path(folder) / name).lexically_normal());
    // What flagDefaultsOf() names is read before all settings.
    if (session.data().find("controls", name) != nullptr) return name;
    // A flag names the same file by another path.
    std::error_code error;
    for (const stdlib::DataFile* file : session.data().list("controls"))
      if (stdlib::isDataPath(file->name) && fs::equivalent(file->name, name, error)) return file->name;
    document.fail(value.range(), "no control file `" + name + "`");
    return "";
  }
  const stdlib::DataFiles& data = session.data();
  if (name.empty() || data.find("controls", name) != nullptr || data.find("mikroprog", name) != nullptr)
    return name;
  NearestName nearest(name);
  for (const char* kind : {"controls", "mikroprog"})
    for (const stdlib::DataFile* file : data.list(kind))
      nearest.offer(file->name);
  document.fail(value.range(), "no control `" + name + "`" +
                                   (nearest.result().empty() ? "; `dotek list controls` prints them"
                                                             : "; did you mean `" + nearest.result() + "`?"));
  return "";
}

std::optional<std::string> formIn(const TomlTable& table) {
  const TomlValue value = table.value("form");
  return value ? std::optional(value.text()) : std::nullopt;
}

std::string controlText(const std::string& control) {
  return control.empty() ? "no control" : "the control `" + control + "`";
}

std::vector<std::string> patternsIn(const TomlValue& patterns) {
  if (!patterns.isArray()) return {patterns.text()};
  std::vector<std::string> out;
  for (const TomlValue& item : patterns.items())
    out.push_back(item.text());
  return out;
}

} // namespace

stdlib::ProbeCodes probeCodesIn(const stdlib::TomlDocument& document, const stdlib::TomlTable& table) {
  stdlib::ProbeCodes out;
  for (const bool on : {true, false}) {
    const stdlib::TomlValue value = table.value(on ? "probe_on" : "probe_off");
    if (!value) continue;
    std::string text = value.text();
    if (stdlib::codeOf(text))
      (on ? out.on : out.off) = std::move(text);
    else
      document.fail(value.range(), "`" + text +
                                       "` is not one M or G code without further words; `M31` is the form. "
                                       "Where the machine needs a word "
                                       "beside it (P2), name the code that calls a program with that block");
  }
  return out;
}

SettingsFile settingsIn(const TomlDocument& document, std::string folder, Session& session) {
  SettingsFile out;
  out.folder = std::move(folder);
  const TomlTable root = document.root(), lint = root.value("lint").table();
  Settings& base = out.base;
  const std::optional<std::string> control = controlIn(document, root, out.folder, session),
                                   ofLint = controlIn(document, lint, out.folder, session),
                                   form = formIn(root), lintForm = formIn(lint);
  base.control = control && !control->empty() ? *control : ofLint.value_or("");
  base.form = form && !form->empty() ? *form : lintForm.value_or("");
  base.probe = probeCodesIn(document, root);
  // Taken before anything is read: flagDefaultsOf().
  static_cast<void>(root.value("data").texts());
  if (const TomlValue prog = root.value("prog"); prog && !prog.text().empty())
    if (isStream((fs::path(out.folder) / prog.text()).generic_string()))
      document.fail(prog.range(), "`" + prog.text() + "` is no regular file");
  for (const TomlEntry& entry : root.value("field").table().entries())
    static_cast<void>(entry.value.text());
  if (const TomlValue from = root.value("from"))
    base.listing = from.choice({"nc", "listing"}, "nc") == "listing";
  for (const TomlTable& table : lint.value("path").tables())
    out.sections.push_back(
        {patternsIn(table.value("path")), controlIn(document, table, out.folder, session), formIn(table)});
  return out;
}

Settings SettingsFile::of(const std::string& path) const {
  Settings out = base;
  if (folder.empty() || sections.empty()) return out;
  const std::string below = fs::path(path).lexically_relative(folder).generic_string();
  for (const Section& section : sections) {
    if (std::none_of(section.patterns.begin(), section.patterns.end(),
                     [&](const std::string& pattern) { return matchesGlob(pattern, below); }))
      continue;
    out.control = section.control.value_or(out.control);
    out.form = section.form.value_or(out.form);
  }
  return out;
}

namespace {

// Each folder is looked at once: without a file of its own it has the settings of the one above.
const SettingsFile& settingsAt(const fs::path& folder, Session& session) {
  auto& known = session.settings();
  std::vector<std::string> without;
  SettingsFile found;
  for (fs::path at = folder; !at.empty(); at = at.parent_path()) {
    const std::string name = at.generic_string();
    if (const auto before = known.find(name); before != known.end()) {
      if (without.empty()) return before->second;
      found = before->second;
      break;
    }
    without.push_back(name);
    if (const fs::path file = settingsFileIn(at); !file.empty()) {
      found = load(file, session);
      break;
    }
    if (at == at.root_path()) break;
  }
  for (const std::string& name : without)
    known.emplace(name, found);
  return known[folder.generic_string()];
}

} // namespace

Settings settingsOf(const std::string& path, Session& session) {
  const fs::path whole = wholePath(path);
  return settingsAt(folderOf(whole), session).of(whole.generic_string());
}

FlagDefaults flagDefaultsOf(const std::vector<std::string>& inputs) {
  FlagDefaults out;
  std::set<fs::path> known;
  std::set<std::string> progs; // "": of an input without one
  for (const std::string& input : inputs) {
    const fs::path file = settingsFileAbove(folderOf(wholePath(input)));
    if (!known.insert(file).second) continue;
    SourceMap sources;
    Diagnostics unheard;
    const auto id = file.empty() ? std::nullopt : readSettings(file, Limits(), sources, unheard);
    const auto document = id ? TomlDocument::parse(*id, sources, unheard) : std::nullopt;
    const auto seen = [&](const std::string& path) {
      return nearPath((file.parent_path() / path).lexically_normal());
    };
    const TomlValue prog = document ? document->root().value("prog") : TomlValue();
    progs.insert(prog && !prog.text().empty() ? seen(prog.text()) : "");
    if (!document) continue;
    for (const std::string& folder : document->root().value("data").texts())
      if (std::string path = seen(folder);
          std::find(out.data.begin(), out.data.end(), path) == out.data.end())
        out.data.push_back(std::move(path));
    const TomlTable root = document->root(), lint = root.value("lint").table();
    std::vector<std::string> controls = {root.value("control").text(), lint.value("control").text()};
    for (const TomlTable& table : lint.value("path").tables())
      controls.push_back(table.value("control").text());
    for (const std::string& control : controls) {
      std::error_code error;
      if (!stdlib::isDataPath(control) || !fs::is_regular_file(seen(control), error)) continue;
      if (std::string path = seen(control);
          std::find(out.data.begin(), out.data.end(), path) == out.data.end())
        out.data.push_back(std::move(path));
    }
    for (const TomlEntry& entry : document->root().value("field").table().entries())
      if (std::string variable = entry.value.text(); !variable.empty())
        out.field.emplace_back(entry.key, std::move(variable));
  }
  if (progs.size() == 1 && !progs.begin()->empty()) out.prog = *progs.begin();
  return out;
}

std::vector<std::string> dataBelow(const std::string& folder) {
  constexpr int kDeepest = 6;
  constexpr std::size_t kMostEntries = 50000;
  std::vector<std::string> holders, out;
  std::error_code error;
  std::size_t seen = 0;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
  for (; !error && at != end && ++seen < kMostEntries; at.increment(error)) {
    const std::string name = at->path().filename().generic_string();
    std::error_code unknown;
    if (at->is_directory(unknown)) {
      if (name.starts_with('.') || at.depth() >= kDeepest) at.disable_recursion_pending();
    } else if (name == "dotek.toml") {
      holders.push_back(at->path().generic_string());
    }
  }
  std::sort(holders.begin(), holders.end());
  for (const std::string& holder : holders)
    for (std::string& one : flagDefaultsOf({holder}).data)
      if (std::find(out.begin(), out.end(), one) == out.end()) out.push_back(std::move(one));
  return out;
}

std::string controlOf(const std::vector<std::string>& inputs, Session& session) {
  std::string out;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    std::string control = settingsOf(inputs[i], session).control;
    if (i > 0 && control != out) {
      session.diagnostics().report<diag::ControlsDiffer>({}, inputs.front(), controlText(out), inputs[i],
                                                         controlText(control));
      return "";
    }
    out = std::move(control);
  }
  return out;
}

} // namespace dotek::project
