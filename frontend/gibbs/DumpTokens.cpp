#include "frontend/gibbs/Lines.h"

namespace dotek::frontend::gibbs {

// Lines over the limit are reported and blanked; all else is shown as the lexer splits it, blanks left out.
std::string dumpTokens(FileId file, const ParseContext& context) {
  ByteStream bytes = openBytes(file, context.sources, context.limits, context.diagnostics);
  WordReader lexer(&bytes);
  lexer.removeErrorListeners();
  std::string out;
  const SourceFile& source = context.sources.file(file);
  for (std::unique_ptr<antlr4::Token> token = lexer.nextToken(); token->getType() != antlr4::Token::EOF;
       token = lexer.nextToken()) {
    const SourceRange range = rangeOf(file, *token);
    const LineColumn place = source.place(range.begin);
    out += fmt::format("{}:{} {}", place.line, place.column,
                       lexer.getVocabulary().getSymbolicName(token->getType()));
    if (token->getType() != grammar::GibbsMacroLexer::EOL)
      out += fmt::format(" {}", context.sources.textUtf8(range));
    out += "\n";
  }
  return out;
}

} // namespace dotek::frontend::gibbs
