// Arguments of a command or a control against its signatures.
#pragma once

#include "frontend/gibbs/Ast.h"
#include "stdlib/GibbsKeywords.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dotek::frontend::gibbs {

struct Misfit {
  enum class Kind : std::uint8_t { Count, Choice, Parameter, Variable, Text, Number, Array };
  Kind kind = Kind::Count;
  std::size_t argument = 0; // index
};

// The signature that fits best.
struct Match {
  const stdlib::CommandSignature* signature = nullptr; // null: there are none
  // What each argument is; null after the last that the signature has.
  std::vector<const stdlib::ArgumentSpec*> specs;
  std::vector<Misfit> misfits;
};

Match matchArguments(const std::vector<const stdlib::CommandSignature*>& signatures,
                     const std::vector<ExpressionPtr>& arguments, const stdlib::GibbsKeywords& keywords,
                     const SourceMap& sources);

// Least and most number of arguments; most is kNoBound where there is no bound.
struct ArgumentCount {
  std::uint32_t least = 0;
  std::uint32_t most = 0;
};
ArgumentCount countOf(const stdlib::CommandSignature& signature);
// `FILE_OPEN unit, file_name$ [, READ or WRITE]`
std::string signatureText(const stdlib::CommandSignature& signature);
// An argument as a keyword: upper case, without blanks.
std::string keywordText(const Expression& argument, const SourceMap& sources);

} // namespace dotek::frontend::gibbs
