// Private to Convert.cpp: cycles as programs for a control by Mikronex.
#pragma once

#include "driver/ConvertValues.h"
#include "support/LineMap.h"

#include <set>

namespace dotek::driver {

// The program of one folder. `files` are those that were written before, by name and folder.
struct MikroprogProgram {
  OutputFile file; // "SURFACEX.SUF", CR LF
  MappedResult map;
};

class MikroprogConversion {
public:
  MikroprogConversion(const ConvertOptions& options, LoweringInputs& inputs, Session& session)
      : options_(options), inputs_(inputs), session_(session) {}

  // Reports flags that mean nothing for this target, and unknown values of those that do. false: with an
  // error.
  bool checkFlags();
  // nullopt where something is missing or cannot be said: reported. `usedSets` and `usedDefaults` as of
  // lowerCycle() and applyDefaults().
  std::optional<MikroprogProgram> run(const CycleFolder& folder, std::set<std::string>& usedSets,
                                      std::set<std::string>& usedDefaults);

private:
  const JobOperation* operationOf(const CycleFolder& folder);
  std::optional<std::string> controlFor(const CycleFolder& folder, const LoweredCycle& lowered);
  bool fixParameters(LoweredCycle& lowered);
  std::string fromWhere(const std::string& name) const;

  const ConvertOptions& options_;
  LoweringInputs& inputs_;
  Session& session_;
  std::map<std::string, std::string> written_; // names of files, by folder
};

} // namespace dotek::driver
