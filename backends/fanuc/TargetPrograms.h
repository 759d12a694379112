// Private to Target*.cpp: inputs that are programs of a control.
#pragma once

#include "ir/Program.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"
#include "targets/Conversion.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dotek::targets {

class ProgramConversion {
public:
  ProgramConversion(const ConvertOptions& options, Session& session) : options_(options), session_(session) {}

  // Reads the profiles. False where there is no such one: reported.
  bool load();
  // Adds the file to `result`, or reports why it cannot be read or translated.
  void convert(const std::string& path, ConversionResult& result);

private:
  bool translateCalls(ir::ProgramFile& file, const stdlib::Control& source);
  // The control of the file, with the codes by which the target's switches the probe where it has none
  // itself: blocks that are added for another set's macros are the target's.
  stdlib::Control sourceOf(const ir::ProgramFile& file) const;

  const ConvertOptions& options_;
  Session& session_;
  std::optional<stdlib::Control> control_, source_;
  const stdlib::MacroSet* wanted_ = nullptr; // nullptr: calls stay as they are
};

} // namespace dotek::targets
