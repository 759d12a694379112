// What a cycle takes from other files: options that it uses, cycles that it calls.
#pragma once

#include "frontend/cycle/Ast.h"

#include <functional>
#include <string>
#include <vector>

namespace dotek::frontend::cycle {

// The tree of a cycle or of options by its name, seen from the file that asks; linked, unless it is being
// linked now. nullptr: there is none.
using FindCycle = std::function<const File*(const std::string& name)>;

// Fills Use::options, Call::called and Call::handedOn of the whole tree. The files that are found have to
// live as long as the tree.
void link(File& file, const FindCycle& find);

// Parameters, results and conditions of a linked cycle in their order, those of options where `use` is.
// Places of the latter lie in the options' file. Header and Needs are not among them.
std::vector<const Statement*> declarations(const File& file);

// Calls of a block and of the blocks within it, in source order.
std::vector<const Call*> callsOf(const Block& block);

} // namespace dotek::frontend::cycle
