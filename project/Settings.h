// What a dotek.toml says for all commands.
#pragma once

#include "stdlib/ProbeCodes.h"

#include <string>

namespace dotek::stdlib {
class TomlDocument;
class TomlTable;
} // namespace dotek::stdlib

namespace dotek::project {

class Session;

struct Settings {
  std::string form;         // of Progs; "": not said
  stdlib::ProbeCodes probe; // `probe_on`, `probe_off`
  bool listing = false;     // NC programs are as a book prints them, as with --from listing
};

// `probe_on` and `probe_off` of a table, with what is wrong with them.
stdlib::ProbeCodes probeCodesIn(const stdlib::TomlDocument& document, const stdlib::TomlTable& table);

// `form`, also as a key of `[lint]`, `from`, `probe_on` and `probe_off`. What is wrong with them is reported.
Settings settingsIn(const stdlib::TomlDocument& document);

// Of the dotek.toml in the folder of the file or above it. A defect of that file is reported once; lint
// reports the keys that nobody knows.
const Settings& settingsOf(const std::string& path, Session& session);

} // namespace dotek::project
