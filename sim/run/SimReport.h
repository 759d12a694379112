// How a run ended, as diagnostics and as JSON.
#pragma once

#include "frontend/nc/Scan.h"
#include "sim/machine/Machine.h"
#include "sim/machine/Run.h"
#include "sim/run/SimWorld.h"
#include "support/LineChunks.h"

#include <string>

namespace dotek::sim {

// What precedes the first `%`, a warning.
void reportLeader(const std::string& path, const frontend::nc::Scanner& scanner, Session& session);
void reportScanError(const std::string& path, const frontend::nc::Scanner& scanner, const LineChunks& chunks,
                     Session& session);
// Nothing where the program came to its end. The scanner is at the block of the end.
void reportEnd(const std::string& path, const frontend::nc::Scanner& scanner, const Machine& machine,
               bool told, Session& session);
// The same of a program that was loaded, and what the run found besides. `advice`: of a run that did not come
// to its end, what it may lack; "": nothing. `folders`: of --programs.
void reportRun(const Run& run, const Machine& machine, const std::string& advice,
               const std::vector<std::string>& folders, bool told, Session& session);
// Of a program that came to its end: what G52, G68 and G92 leave on. `range`: its last block.
void reportShifts(const Machine& machine, SourceRange range, Session& session);
// The last lines of the trace: what was written.
void traceVariables(const Machine& machine, Trace& trace);
// What the program printed, the rotation that is in force at its end, and where `variables` says so the
// common variables that it left: lists of the pictures. `run`: nullptr of plain blocks.
void addLists(const Machine& machine, const Run* run, bool variables, SimWorld& world);
// docs/sim.md says what is in it. `run`: of a program that was loaded; nullptr: of plain blocks.
std::string summary(Machine& machine, const Run* run, const SimWorld& world, Session& session);
// Its last member.
std::string diagnosticsMember(const Diagnostics& diagnostics, const SourceMap& sources);
// The summary of a program that did not begin to run.
std::string notRunSummary(const Diagnostics& diagnostics, const SourceMap& sources);

// The line at which the scanner is, as a file of its own, since the program itself is not kept.
SourceRange placeOfLine(const std::string& path, const frontend::nc::Scanner& scanner, Session& session);
// Texts of programs are bytes.
std::string toUtf8Text(const std::string& bytes);
// A position as an object by axis; `shown` as of Trace::position.
std::string positionText(const Position& position, std::uint32_t shown);

} // namespace dotek::sim
