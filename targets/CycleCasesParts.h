// Private to CycleCases*.cpp: one case on its path from values to what is compared.
#pragma once

#include "ir/Program.h"
#include "targets/CycleCases.h"

namespace dotek::targets {

// The posted program, ready to run.
struct CaseRunner::Posted {
  SourceMap sources;
  ir::ProgramFile file;
  sim::Bytecode code;
  std::set<std::uint32_t> stores;
};

struct CaseRunner::Values {
  verify::Case drawn;
  FieldTable fields;
  std::optional<verify::DrawnPath> path; // of the machine
  std::optional<sim::Part> part;
  bool rejected = false; // by the dialog
  std::string rejection;
  SourceRange rejectedAt;
  std::vector<frontend::compost::PostedLine> lines;
  std::optional<SourceRange> spindleOff; // the first block that stops the spindle, as posted
  std::unique_ptr<Posted> posted;
  std::optional<verify::Record> rehearsal;
};

} // namespace dotek::targets
