#include "project/Settings.h"

#include "project/Session.h"
#include "stdlib/Toml.h"

#include <filesystem>

namespace dotek::project {

namespace fs = std::filesystem;

namespace {

Settings load(fs::path folder, Session& session) {
  std::error_code error;
  for (; !folder.empty(); folder = folder.parent_path()) {
    const fs::path file = folder / "dotek.toml";
    if (fs::is_regular_file(file, error)) {
      const fs::path near = file.lexically_proximate(fs::current_path(error));
      const auto id = session.read((near.empty() ? file : near).generic_string(), Encoding::Utf8);
      if (!id) return {};
      const auto document = stdlib::TomlDocument::parse(*id, session.sources(), session.diagnostics());
      return document ? settingsIn(*document) : Settings();
    }
    if (folder == folder.root_path()) break;
  }
  return {};
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

Settings settingsIn(const stdlib::TomlDocument& document) {
  Settings out;
  const stdlib::TomlTable root = document.root();
  out.form = root.value("form").text();
  const std::string ofLint = root.value("lint").table().value("form").text();
  if (out.form.empty()) out.form = ofLint;
  out.probe = probeCodesIn(document, root);
  if (const stdlib::TomlValue from = root.value("from"))
    out.listing = from.choice({"nc", "listing"}, "nc") == "listing";
  return out;
}

const Settings& settingsOf(const std::string& path, Session& session) {
  std::error_code error;
  const fs::path folder = fs::absolute(path, error).lexically_normal().parent_path();
  const auto [at, isNew] = session.settings().try_emplace(folder.generic_string());
  if (isNew) at->second = load(folder, session);
  return at->second;
}

} // namespace dotek::project
