#include "project/Settings.h"

#include "project/Session.h"
#include "stdlib/Toml.h"
#include "support/Glob.h"
#include "support/NearestName.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <filesystem>

namespace dotek::project {

namespace fs = std::filesystem;

namespace {

using stdlib::TomlDocument;
using stdlib::TomlTable;
using stdlib::TomlValue;

SettingsFile load(fs::path folder, Session& session) {
  std::error_code error;
  for (; !folder.empty(); folder = folder.parent_path()) {
    const fs::path file = folder / "dotek.toml";
    if (fs::is_regular_file(file, error)) {
      const fs::path near = file.lexically_proximate(fs::current_path(error));
      const auto id = session.read((near.empty() ? file : near).generic_string(), Encoding::Utf8);
      if (!id) return {};
      const auto document = TomlDocument::parse(*id, session.sources(), session.diagnostics());
      return document ? settingsIn(*document, folder.generic_string(), session) : SettingsFile();
    }
    if (folder == folder.root_path()) break;
  }
  return {};
}

// Nothing: not said. An empty name takes back what was said before.
std::optional<std::string> controlIn(const TomlDocument& document, const TomlTable& table, Session& session) {
  const TomlValue value = table.value("control");
  if (!value) return std::nullopt;
  std::string name = value.text();
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
      document.fail(value.range(), "`" + text + "` is no code; `M31` is the form");
  }
  return out;
}

SettingsFile settingsIn(const TomlDocument& document, std::string folder, Session& session) {
  SettingsFile out;
  out.folder = std::move(folder);
  const TomlTable root = document.root(), lint = root.value("lint").table();
  Settings& base = out.base;
  const std::optional<std::string> control = controlIn(document, root, session),
                                   ofLint = controlIn(document, lint, session), form = formIn(root),
                                   lintForm = formIn(lint);
  base.control = control && !control->empty() ? *control : ofLint.value_or("");
  base.form = form && !form->empty() ? *form : lintForm.value_or("");
  base.probe = probeCodesIn(document, root);
  if (const TomlValue from = root.value("from"))
    base.listing = from.choice({"nc", "listing"}, "nc") == "listing";
  for (const TomlTable& table : lint.value("path").tables())
    out.sections.push_back(
        {patternsIn(table.value("path")), controlIn(document, table, session), formIn(table)});
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

Settings settingsOf(const std::string& path, Session& session) {
  std::error_code error;
  fs::path whole = fs::absolute(path, error).lexically_normal();
  if (!whole.has_filename() && whole.has_relative_path()) whole = whole.parent_path();
  const fs::path folder = fs::is_directory(whole, error) ? whole : whole.parent_path();
  const auto [at, isNew] = session.settings().try_emplace(folder.generic_string());
  if (isNew) at->second = load(folder, session);
  return at->second.of(whole.generic_string());
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
