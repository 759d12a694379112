// Findings in one command, one control or one expression.
#pragma once

#include "frontend/gibbs/Match.h"
#include "frontend/gibbs/Parse.h"

#include <functional>
#include <set>
#include <string>

namespace dotek::frontend::gibbs {

// A line of a macro; `isVariable` tells whether the file uses a name (folded) as a variable.
void checkCommand(const Command& command, SourceRange range,
                  const std::function<bool(const std::string&)>& isVariable, const ParseContext& context);

// Arguments against the signatures; says nothing where the table is not sure of itself.
void checkArguments(const Name& name, const std::vector<ExpressionPtr>& arguments,
                    const std::vector<const stdlib::CommandSignature*>& signatures, SourceRange range,
                    const ParseContext& context);

// Functions, texts in arithmetic, long texts. `arrays` holds the folded names that the file declares or
// assigns with an index.
void checkExpression(const Expression& expression, const std::set<std::string>& arrays,
                     const ParseContext& context);

// `; did you mean `NAME`?`, or nothing.
std::string didYouMean(const std::string& name);

} // namespace dotek::frontend::gibbs
