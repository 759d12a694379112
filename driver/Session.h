// What one command works with: inputs, diagnostics, data tables (loaded when first asked for).
#pragma once

#include "driver/Driver.h"
#include "stdlib/ComPostKeywords.h"
#include "stdlib/DataFiles.h"
#include "stdlib/Form.h"
#include "stdlib/GibbsKeywords.h"
#include "support/messages/Commands.h"

#include <optional>
#include <string>

namespace dotek::driver {

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
  // nullopt with a diagnostic where there is no form of this name.
  std::optional<stdlib::Form> form(const std::string& name);

  // Reads a text file in the language's default encoding, once per path: the second time gives the same id.
  std::optional<FileId> read(const std::string& path, Encoding fallback);

  // Hands over what the command found. The status is 1 with errors, 2 with errors of the command line or of
  // reading and writing files; `output` is dropped with either unless `keepOutput`.
  Outcome finish(std::string output, bool keepOutput = false);

private:
  const CommonOptions& options_;
  SourceMap sources_;
  Diagnostics diagnostics_;
  stdlib::DataFiles data_;
  std::optional<stdlib::GibbsKeywords> gibbs_;
  std::optional<stdlib::ComPostKeywords> compost_;
  std::map<std::string, std::optional<FileId>> read_;
};

// Codes that mean wrong arguments, or a file that cannot be read or written: status 2.
bool isUsageCode(std::string_view code);

// Of findings that begin at one place, keeps those of the highest severity: the others tell of the same
// cause.
void keepStrongest(Diagnostics& diagnostics);

// Runs a command: a defect of the data files that `--data` names becomes a diagnostic.
template <class Command> Outcome guarded(const CommonOptions& options, const Command& command) {
  try {
    Session session(options);
    if (session.diagnostics().hasErrors()) return session.finish("");
    return command(session);
  } catch (const stdlib::DataError& error) {
    Outcome outcome;
    outcome.diagnostics.report<diag::DataFileDefect>({}, error.what());
    outcome.status = 2;
    return outcome;
  }
}

} // namespace dotek::driver
