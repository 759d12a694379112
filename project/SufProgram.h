// Programs of Mikroprog (.SUF), read against the profile of a control: what runs, and what is compared.
#pragma once

#include "ir/Program.h"
#include "project/Session.h"
#include "stdlib/MikroprogControl.h"

#include <optional>
#include <string>

namespace dotek::project {

// The profile of this name. nullopt: there is none, reported with those that there are.
std::optional<stdlib::MikroprogControl> loadMikroprogControl(const std::string& name, Session& session);

// The program as the control takes it. nullopt: it cannot be read, or the control refuses it; reported to
// `diagnostics` with the codes of lint's rules.
std::optional<ir::Program> readSuf(FileId file, const stdlib::MikroprogControl& control,
                                   const SourceMap& sources, Diagnostics& diagnostics);

struct SufProgram {
  stdlib::MikroprogControl control;
  ir::Program program;
};

// The file with this profile; "" for the one that the program says by itself. nullopt: reported, also where
// nothing says which profile it is for.
std::optional<SufProgram> loadSuf(const std::string& path, const std::string& control, Session& session);

} // namespace dotek::project
