// Whether the length of a tool is in force: G43 and G49 before statements of programs, and before those that
// other programs of the files call.
#pragma once

#include "lint/Probing.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace dotek::lint {

// AsBefore: nothing of the program says it. Either: paths disagree, or a code that is computed, or a program
// that is called, may have changed it.
enum class Offset : std::uint8_t { AsBefore, On, Off, Either };

// Variables of the program that hold codes of other groups whatever happens: `#4=#4003`, `#4=90`.
std::set<std::uint32_t> codesOfOtherGroups(const ir::Program& program);

// G43, G44 and their forms with a point, G49; nothing: none of them. H0 is as good as G49. A computed code is
// Either, but for one of `others`, of which #4003 and the like are always.
std::optional<Offset> statedOffset(const ir::ProgramStatement& statement,
                                   const std::set<std::uint32_t>& others);

// The program that a G65 or M98 with a number that is written out calls; nothing: another statement.
std::optional<std::uint32_t> calledProgram(const ir::ProgramStatement& statement);

// The numbers that programs of this file call in that way.
const std::set<std::uint32_t>& calledIn(const macrob::File& file, const Project& project);

// Programs of the files that turn the offset on or off.
std::set<std::uint32_t> switchingPrograms(const Project& project);

// The offset before each statement; nothing where no path leads.
std::vector<std::optional<Offset>> offsetStates(const ir::Program& program, Offset entry,
                                                const std::set<std::uint32_t>& switching);

// How programs of the files are called.
struct CalledUnder {
  Offset offset = Offset::AsBefore; // On where one caller of several has it on
  SourceRange call;                 // the first call under it
};
// By their number; those that nothing calls are not in it.
std::map<std::uint32_t, CalledUnder> calledUnder(const Project& project,
                                                 const std::set<std::uint32_t>& switching);

} // namespace dotek::lint
