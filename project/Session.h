// What one command works with: inputs, diagnostics, data tables (loaded when first asked for).
#pragma once

#include "project/InputKind.h"
#include "project/Options.h"
#include "project/Settings.h"
#include "stdlib/ComPostKeywords.h"
#include "stdlib/Control.h"
#include "stdlib/DataFiles.h"
#include "stdlib/Form.h"
#include "stdlib/GibbsKeywords.h"
#include "stdlib/MacroSet.h"
#include "stdlib/ProbeCodes.h"
#include "support/Diagnostics.h"
#include "support/Files.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dotek::project {

class Session {
public:
  explicit Session(const CommonOptions& options);

  SourceMap& sources() { return sources_; }
  const SourceMap& sources() const { return sources_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  const Limits& limits() const { return options_.limits; }
  const CommonOptions& options() const { return options_; }
  const stdlib::DataFiles& data() const { return data_; }
  const stdlib::GibbsKeywords& gibbsKeywords();
  const stdlib::ComPostKeywords& compostKeywords();
  // The profile of this name, read once, with the probe codes of the user. nullptr: there is none.
  const stdlib::Control* control(const std::string& name);
  const stdlib::Control* control(const std::string& name, const stdlib::ProbeCodes& codes);
  // Codes that switch the probe, of the flags; else of what said them first. For controls that are read
  // later.
  const stdlib::ProbeCodes& probeCodes() const { return probeCodes_; }
  void takeProbeCodes(const stdlib::ProbeCodes& codes);
  // All sets of probing macros, by name; one that the control has with other variables as it has it. Without
  // a control as their data states them. Two controls that have the same ones get the same objects.
  const std::vector<stdlib::MacroSet>& macroSets(const stdlib::Control* control = nullptr);
  // nullptr: there is none.
  const stdlib::MacroSet* macroSet(const std::string& name, const stdlib::Control* control = nullptr);
  // nullopt with a diagnostic where there is no form of this name.
  std::optional<stdlib::Form> form(const std::string& name);

  // By folder: kept for settingsOf().
  std::map<std::string, SettingsFile>& settings() { return settings_; }
  // Reads a text file in the language's default encoding, once per path: the second time gives the same id.
  // "-" is standard input.
  std::optional<FileId> read(const std::string& path, Encoding fallback);

  // What an input is: --from says it, else recognise(), told `expected` where the command takes only that.
  // nullptr: it cannot be read, reported to `diagnostics`. Asked again, the answer is the same, and nothing
  // is read twice.
  const Recognition* kindOf(const std::string& path, Diagnostics& diagnostics,
                            std::optional<InputKind> expected = std::nullopt);

  // Bytes of a file that is no text of a language; streams are read once. nullopt: reported.
  std::optional<std::string> bytes(const std::string& path, Diagnostics& diagnostics);

  // A folder that a command takes with all that is below it.
  void addInputRoot(std::string folder) { inputRoots_.push_back(std::move(folder)); }
  // What an input of this folder may name: what is below --include-root, else below the input root that holds
  // the folder, else below the folder; and below each --include.
  ReadBounds bounds(const std::string& folder) const;

private:
  // Recognised as NC programs, which may be large.
  bool holdsPrograms(const std::string& path) const;
  // What an editor holds of the file; nullptr: nothing.
  const std::string* buffer(const std::string& path) const;

  const CommonOptions& options_;
  SourceMap sources_;
  Diagnostics diagnostics_;
  stdlib::DataFiles data_;
  std::optional<stdlib::GibbsKeywords> gibbs_;
  std::optional<stdlib::ComPostKeywords> compost_;
  std::map<std::pair<std::string, stdlib::ProbeCodes>, std::optional<stdlib::Control>> controls_;
  stdlib::ProbeCodes probeCodes_;
  std::map<std::string, std::vector<stdlib::MacroSet>> macroSets_; // by the package of the control; "": none
  std::map<std::string, std::optional<FileId>> read_;
  std::map<std::string, SettingsFile> settings_;
  std::vector<std::string> inputRoots_;
  std::map<std::string, Recognition> kinds_;
  std::map<std::string, std::string> whole_; // recognised and not yet read as a text
};

// A set that the command line names: there is none, and these are.
void reportUnknownMacroSet(const std::string& name, Session& session);

} // namespace dotek::project
