// A program of macro B as a part of a post: the fragment asks for its arguments, calls it and carries its
// text.
#pragma once

#include "backends/fusion/TargetCycle.h"

#include <optional>
#include <string>

namespace dotek::targets {

// As it is written for the control of the command. nullopt: refused, reported.
std::optional<CalledCycle> calledProgram(const std::string& path, const stdlib::Control& control,
                                         ConversionContext& context);

} // namespace dotek::targets
