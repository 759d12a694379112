// Tokens of a Prog and what the ANTLR shell needs to know of ComPost. Included by builder sources only.
#pragma once

#include "frontend/common/ParseSession.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"
#include "support/Source.h"

#include <ComPostLexer.h>

#include <set>
#include <vector>

namespace dotek::frontend::compost {

// Tells words apart, and renames an opening bracket that can begin neither an argument nor a condition, so
// that the grammar needs no lookahead.
class TokenReader final : public grammar::ComPostLexer {
public:
  using ComPostLexer::ComPostLexer;
  std::unique_ptr<antlr4::Token> nextToken() override;

private:
  size_t previous_ = antlr4::Token::EOF;
};

Language language();

// What can be said of the text before it is parsed.
struct TokenFindings {
  std::set<std::uint32_t> typographicLines; // further syntax errors there are consequences
  std::vector<SourceRange> lost;            // text in which ENDs and RETURNs may have been lost, by place
  bool broken = false;                      // an error was reported
};

// Reports quotes of word processors, texts and comments that are not closed, braces in comments.
TokenFindings checkTokens(const TokenBuffer& tokens, FileId file, const SourceMap& sources,
                          const Limits& limits, Diagnostics& diagnostics);

} // namespace dotek::frontend::compost
