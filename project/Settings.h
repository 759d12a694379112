// What a dotek.toml says for all commands.
#pragma once

#include <string>

namespace dotek::stdlib {
class TomlDocument;
}

namespace dotek::project {

class Session;

struct Settings {
  std::string form;     // of Progs; "": not said
  bool listing = false; // NC programs are as a book prints them, as with --from listing
};

// `form`, also as a key of `[lint]`, and `from`. What is wrong with them is reported.
Settings settingsIn(const stdlib::TomlDocument& document);

// Of the dotek.toml in the folder of the file or above it. A defect of that file is reported once; lint
// reports the keys that nobody knows.
const Settings& settingsOf(const std::string& path, Session& session);

} // namespace dotek::project
