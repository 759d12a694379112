// Private to Post*.cpp: the Prog of a post, read, checked and repaired.
#pragma once

#include "frontend/compost/Ast.h"
#include "project/Session.h"

#include <optional>
#include <string>

namespace dotek::project {

// Reads, parses and checks the Prog. Under --recover its repairable errors become warnings that state the
// reading. nullopt where the file could not be read.
std::optional<frontend::compost::Program> loadProg(const std::string& path, Session& session,
                                                   bool checked = true);

// For messages: which cycles the Prog tells apart, and which of them `cycle` may have meant.
std::string testedCycles(const frontend::compost::Program& program, const std::string& cycle);

// The routine that posts `cycle`: `named` if given, else the only one whose branch for the cycle prints
// something. nullptr where there is none or several: reported.
const frontend::compost::Routine* chooseRoutine(const frontend::compost::Program& program,
                                                const std::optional<std::string>& named, SourceRange namedAt,
                                                const std::string& cycle, Session& session);

// Drops the notes and warnings of the front ends, which say how the inputs are written, so that what is said
// of this run is out; a note counts the warnings. Repairs and unverified readings stay.
void leaveFindingsToLint(Session& session);

} // namespace dotek::project
