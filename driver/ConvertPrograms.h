// Private to Convert*.cpp: inputs that are programs of a control.
#pragma once

#include "driver/Command.h"
#include "ir/Program.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"
#include "support/LineMap.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dotek::driver {

// Reports options of the command line that none of the inputs takes.
void refuseOptions(const ConvertOptions& options, bool programs, bool cycles, Session& session);

struct ConvertedFile {
  OutputFile file;
  MappedResult map;
  std::vector<std::uint64_t> numbers; // of its programs
};

class ProgramConversion {
public:
  ProgramConversion(const ConvertOptions& options, Session& session) : options_(options), session_(session) {}

  // Reads the profiles. False where there is no such one: reported.
  bool load();
  // nullopt where the file cannot be read or translated: reported.
  std::optional<ConvertedFile> convert(const std::string& path);

private:
  bool translateCalls(ir::ProgramFile& file);

  const ConvertOptions& options_;
  Session& session_;
  std::optional<stdlib::Control> control_, source_;
  std::vector<stdlib::MacroSet> sets_;
  const stdlib::MacroSet* wanted_ = nullptr; // nullptr: calls stay as they are
};

} // namespace dotek::driver
