// A file of the cycle language as a part of a post: the program that it becomes on the control, and what the
// operation asks for.
#pragma once

#include "backends/fusion/Emit.h"
#include "targets/Conversion.h"

#include <optional>
#include <string>
#include <vector>

namespace dotek::targets {

struct CalledCycle {
  LoweredCycle lowered;
  backends::fusion::ProgramCall call;
  std::vector<OutputArgument> arguments;
  std::string macros;
  std::map<ir::VariableId, std::vector<backends::fusion::Choice>> choices;
  std::map<ir::VariableId, std::string> groups;
};

// Without the `%` around them.
std::vector<backends::EmittedLine> linesOf(const OutputFile& file, const MappedResult& map);
// nullopt: refused, reported. `file`: of the folder.
std::optional<CalledCycle> calledCycle(const CycleFolder& folder, std::size_t index, const std::string& file,
                                       ConversionContext& context);

} // namespace dotek::targets
