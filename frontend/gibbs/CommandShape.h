// How the arguments of a command meet its signature, for those who run or translate it.
#pragma once

#include "frontend/gibbs/Ast.h"
#include "frontend/gibbs/Value.h"
#include "stdlib/GibbsKeywords.h"

#include <string>
#include <string_view>

namespace dotek::frontend::gibbs {

// Commands that wait for the user or hand over to another program. `name` is folded.
bool asksUser(std::string_view name);
// The specification of the argument at `index`; nullptr: the signature has no such argument.
const stdlib::ArgumentSpec* specAt(const stdlib::CommandSignature& signature, std::size_t index);
// The folded word that is as argument; "" for anything but a bare name.
std::string bareWord(const Expression& e);
// Number of arguments and words of choices agree.
bool fits(const stdlib::CommandSignature& signature, const Command& c);
// The command writes this argument.
bool isWritten(const stdlib::ArgumentSpec& spec);

// `number`, the first argument of a command of `family`, is that of the cycle's own tool or operation.
bool isOwn(std::string_view family, const Symbol* number);

} // namespace dotek::frontend::gibbs
