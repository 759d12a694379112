// Private to Convert*.cpp: convert --to fusion.
#pragma once

#include "backends/fusion/Emit.h"
#include "driver/Command.h"
#include "project/Lowering.h"
#include "support/LineMap.h"

namespace dotek::driver {

// Parts of a Fusion post, one for each cycle of the command.
class FusionParts {
public:
  FusionParts(const ConvertOptions& options, const LoweringInputs& inputs, Session& session)
      : options_(options), inputs_(inputs), session_(session) {}

  // Options that speak of a program on a control, and a missing Prog, are reported.
  static void checkOptions(const ConvertOptions& options, Diagnostics& diagnostics);
  // `defaults` are those of the source, before its own checks turned any away.
  void add(const CycleFolder& folder, LoweredCycle& lowered, std::map<ir::VariableId, double> defaults);
  // The files and their maps; with --whole-post one file.
  void finish(std::vector<OutputFile>& files, std::vector<MappedResult>& maps) const;

private:
  struct Part {
    std::string cycle, prefix;
    std::vector<backends::fusion::EmittedLine> lines;
  };
  const ConvertOptions& options_;
  const LoweringInputs& inputs_;
  Session& session_;
  std::vector<Part> parts_;
};

} // namespace dotek::driver
