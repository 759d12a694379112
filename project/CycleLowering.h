// Files of the cycle language as IR.
#pragma once

#include "frontend/cycle/Lower.h"
#include "project/CallsAs.h"
#include "project/CycleFiles.h"
#include "project/Session.h"

#include <cstdint>
#include <optional>
#include <string>

namespace dotek::project {

// A file of the cycle language. Nothing is reported; a folder, or what cannot be read, is none.
bool isCycleFile(const std::string& path, Session& session);

// The cycle of a file with those that it calls, which lie beside it. nullopt: it has a defect, reported.
std::optional<frontend::cycle::Lowered> lowerCycleFile(const std::string& path, Session& session,
                                                       const CallsAs& calls = {});

// Reports all that is wrong with a cycle, whatever its values are: its mistakes and, where it has none, what
// no command can run or write. The file; nothing where it cannot be read.
std::optional<FileId> checkCycleFile(const std::string& path, CycleFiles& files, Session& session);

} // namespace dotek::project
