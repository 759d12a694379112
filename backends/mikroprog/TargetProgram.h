// Private to Target*.cpp: cycles as programs for a control by Mikronex.
#pragma once

#include "backends/mikroprog/Emit.h"
#include "project/Compilation.h"
#include "project/SufProgram.h"
#include "project/Values.h"
#include "stdlib/MikroprogControl.h"
#include "targets/Verification.h"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::targets {

// The program of one folder.
struct MikroprogProgram {
  std::string name;                         // of its file, "SURFACEX.SUF"
  std::vector<backends::EmittedLine> lines; // without their CR LF
};

// The profile for a cycle: the given one, else the mill where it moves Y. nullopt: reported.
std::optional<std::string> mikroprogControlFor(const std::string& given, const CycleFolder& folder,
                                               const LoweredCycle& lowered, Session& session);

// How one program is written.
struct MikroprogWriting {
  const stdlib::MikroprogControl& control;
  std::string datum;            // of --datum; "": g92
  std::set<std::string> assume; // of --assume
  bool lengthToCentre = false;
  std::map<std::string, double> hosts;
  std::function<std::string(const std::string&)> fromWhere; // where the value of a parameter comes from
  bool cycleFile = false;      // of the cycle language: optional parameters that are not fixed are left out
  ir::Cycle* folded = nullptr; // where to put what the program is written from; nullptr: nobody asks
};

// The program of a cycle; a value is fixed for each of its parameters. nullopt where something is missing,
// cannot be said, or is rejected by the cycle's own checks: reported.
std::optional<MikroprogProgram> writeMikroprog(const CycleFolder& folder, LoweredCycle lowered,
                                               const MikroprogWriting& writing, Session& session);

// What the ToolPath.mac of the folder touches for these values of its fields; empty where it draws nothing,
// or cannot be run. Nothing is reported.
std::vector<backends::mikroprog::DrawnSurface>
drawnSurfaces(const CycleFolder& folder, const std::vector<std::pair<std::string, double>>& values,
              const std::map<std::string, double>& hosts, Session& session);

// A program that is written anew for each case.
std::unique_ptr<Verification> mikroprogVerification(const VerificationSource& source);

} // namespace dotek::targets
