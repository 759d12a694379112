// What flags of `sim` say of a run of Mikroprog. false: reported.
#pragma once

#include "project/Options.h"
#include "project/Session.h"
#include "sim/mikroprog/Dialect.h"
#include "stdlib/SetupDatum.h"
#include "support/Diagnostics.h"

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace dotek::driver {

// --var P5=3, O1=1, G52.Z=-12.
bool setParameters(const project::NamedTexts& given, const sim::mikroprog::Profile& profile,
                   sim::Machine& machine, Diagnostics& diagnostics);
// `saidBy`: "--datum". `part`: where the part is meant to be.
bool placeDatum(const stdlib::Setup::Zero& datum, std::string_view saidBy,
                const stdlib::MikroprogControl& control, const std::optional<std::array<double, 3>>& part,
                sim::Machine& machine, Diagnostics& diagnostics);

// The programs in the folder of `path` that the program runs by G28, and those that they run, by the names of
// their files; the program itself is among them where one of them runs it. One that is not there is left out.
// nullopt: one cannot be read, or the control refuses it; reported.
struct OtherSufs {
  std::deque<ir::Program> programs; // outlive what is compiled of them
  sim::mikroprog::OtherPrograms byName;
};
std::optional<OtherSufs> loadOthers(const std::string& path, const ir::Program& program,
                                    const stdlib::MikroprogControl& control, project::Session& session);

} // namespace dotek::driver
