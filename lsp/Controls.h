// What a control and its probing macros say of a code, a variable and an argument, as Markdown for a hover.
#pragma once

#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"
#include "stdlib/MikroprogControl.h"
#include "support/Source.h"

#include <cstdint>
#include <optional>
#include <string>

namespace dotek::project {
class Session;
}

namespace dotek::lsp {

// "**G31** skip function" with group, grade and source; "" where the profile does not list the code.
std::string codeFact(const stdlib::Control& control, char letter, std::uint32_t tenths);
// What the variable is on this control: local of a letter, common, or what a system variable holds.
std::string variableFact(const stdlib::Control& control, std::uint32_t number);
// The short name of an argument: "overtravel", "target x".
std::string argumentName(const stdlib::MacroArgument& argument);
std::string argumentFact(const stdlib::MacroSet& set, const stdlib::MacroSignature& signature,
                         const stdlib::MacroArgument& argument);
// The program of a set with all its readings.
std::string programFact(const stdlib::MacroSet& set, std::uint32_t program);

// A function of Mikroprog with its letters.
std::string mikroprogFact(const stdlib::MikroprogFunction& function);
// The profile that the project names, else the one that the text is for. nullopt: there is none.
std::optional<stdlib::MikroprogControl> mikroprogControl(const SourceMap& sources, FileId file,
                                                         const std::string& path, project::Session& session);

} // namespace dotek::lsp
