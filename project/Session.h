// What one command works with: inputs, diagnostics, data tables (loaded when first asked for).
#pragma once

#include "project/Options.h"
#include "stdlib/ComPostKeywords.h"
#include "stdlib/Control.h"
#include "stdlib/DataFiles.h"
#include "stdlib/Form.h"
#include "stdlib/GibbsKeywords.h"
#include "support/Diagnostics.h"

#include <map>
#include <optional>
#include <string>

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
  // The profile of this name, read once. nullptr: there is none.
  const stdlib::Control* control(const std::string& name);
  // nullopt with a diagnostic where there is no form of this name.
  std::optional<stdlib::Form> form(const std::string& name);

  // Reads a text file in the language's default encoding, once per path: the second time gives the same id.
  std::optional<FileId> read(const std::string& path, Encoding fallback);

private:
  const CommonOptions& options_;
  SourceMap sources_;
  Diagnostics diagnostics_;
  stdlib::DataFiles data_;
  std::optional<stdlib::GibbsKeywords> gibbs_;
  std::optional<stdlib::ComPostKeywords> compost_;
  std::map<std::string, std::optional<stdlib::Control>> controls_;
  std::map<std::string, std::optional<FileId>> read_;
};

} // namespace dotek::project
