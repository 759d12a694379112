// What a dotek.toml says for all commands.
#pragma once

#include "project/Options.h"
#include "stdlib/ProbeCodes.h"

#include <optional>
#include <string>
#include <vector>

namespace dotek::stdlib {
class TomlDocument;
class TomlTable;
} // namespace dotek::stdlib

namespace dotek::project {

class Session;

// What holds for one file.
struct Settings {
  std::string control;      // that programs are written for; "": not said
  std::string form;         // of Progs; "": not said
  stdlib::ProbeCodes probe; // `probe_on`, `probe_off`
  bool listing = false;     // NC programs are as a book prints them, as with --from listing
};

// A dotek.toml: what it says of all files, and its sections [[lint.path]] that change it, the later ones
// last.
struct SettingsFile {
  struct Section {
    std::vector<std::string> patterns; // of paths below the folder
    std::optional<std::string> control, form;
  };
  Settings base;
  std::vector<Section> sections;
  std::string folder; // absolute; "": there is no dotek.toml

  // `path` is absolute, of a file or a folder.
  Settings of(const std::string& path) const;
};

// `probe_on` and `probe_off` of a table, with what is wrong with them.
stdlib::ProbeCodes probeCodesIn(const stdlib::TomlDocument& document, const stdlib::TomlTable& table);

// `control` and `form`, also as keys of `[lint]` and `[[lint.path]]`, `from`, `data`, `prog`,
// `[field]`, `probe_on` and `probe_off`. What is wrong with them is reported, a control that nobody knows
// too.
SettingsFile settingsIn(const stdlib::TomlDocument& document, std::string folder, Session& session);

// Of the dotek.toml in the folder of the file or above it. A defect of that file is reported once. What its
// table [lint] has besides is for lint to judge.
Settings settingsOf(const std::string& path, Session& session);

// What stands for flags that nobody gives.
struct FlagDefaults {
  std::vector<std::string> data;   // folders of data files, each once
  std::optional<std::string> prog; // where all inputs have the same
  NamedTexts field;                // the post's field = the macro's variable
};

// `data`, `prog` and `[field]` of the dotek.toml of these inputs and above them, paths seen from here.
// Nothing is reported: whoever takes the settings does.
FlagDefaults flagDefaultsOf(const std::vector<std::string>& inputs);

// Data files that each dotek.toml below `folder` names, paths seen from here, each once; hidden folders
// aside.
std::vector<std::string> dataBelow(const std::string& folder);

// The control that the dotek.toml of the inputs names for all of them; "": none. Two that differ are an error
// that names both.
std::string controlOf(const std::vector<std::string>& inputs, Session& session);

} // namespace dotek::project
