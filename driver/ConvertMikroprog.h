// Private to Convert.cpp and Verify*.cpp: cycles as programs for a control by Mikronex.
#pragma once

#include "driver/Command.h"
#include "project/Values.h"
#include "stdlib/MikroprogControl.h"
#include "support/LineMap.h"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace dotek::driver {

// The program of one folder. `files` are those that were written before, by name and folder.
struct MikroprogProgram {
  OutputFile file; // "SURFACEX.SUF", CR LF
  MappedResult map;
};

// The profile of this name. nullopt: there is none, reported.
std::optional<stdlib::MikroprogControl> loadMikroprogControl(const std::string& name, Session& session);
// The profile for a cycle: the given one, else the mill where it moves Y. nullopt: reported.
std::optional<std::string> mikroprogControlFor(const std::string& given, const CycleFolder& folder,
                                               const LoweredCycle& lowered, Session& session);
// The operation of the job for this folder; nullptr: none, or several, which is reported.
const JobOperation* mikroprogOperation(const LoweringInputs& inputs, const CycleFolder& folder,
                                       Session& session);
// Its start point, host inputs and values, as far as no flag gives them.
void takeOperation(const JobOperation& operation, const CommonOptions& options, LoweringInputs& inputs);

// How one program is written.
struct MikroprogWriting {
  const stdlib::MikroprogControl& control;
  std::string datum;            // of --datum; "": g92
  std::set<std::string> assume; // of --assume
  bool lengthToCentre = false;
  std::map<std::string, double> hosts;
  std::function<std::string(const std::string&)> fromWhere; // where the value of a parameter comes from
};

// The program of a cycle; a value is fixed for each of its parameters. nullopt where something is missing,
// cannot be said, or is turned away by the cycle's own checks: reported.
std::optional<MikroprogProgram> writeMikroprog(const CycleFolder& folder, LoweredCycle lowered,
                                               const MikroprogWriting& writing, Session& session);

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
  bool fixParameters(LoweredCycle& lowered);
  std::string fromWhere(const std::string& name) const;

  const ConvertOptions& options_;
  LoweringInputs& inputs_;
  Session& session_;
  std::map<std::string, std::string> written_; // names of files, by folder
};

} // namespace dotek::driver
