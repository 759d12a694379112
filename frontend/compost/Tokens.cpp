#include "frontend/compost/Tokens.h"

#include "frontend/compost/Parse.h"
#include "support/messages/ComPost.h"
#include "support/messages/Common.h"

#include <ComPostParser.h>

#include <algorithm>
#include <fmt/format.h>

namespace dotek::frontend::compost {

using Lexer = grammar::ComPostLexer;
using Parser = grammar::ComPostParser;

namespace {

// The bracket after one of these begins arguments or a condition.
bool takesBracket(size_t type) {
  switch (type) {
  case Lexer::NAME:
  case Lexer::NUMERIC:
  case Lexer::BOOLEAN:
  case Lexer::KW_FORMAT:
  case Lexer::KW_IF:
  case Lexer::KW_AND:
  case Lexer::KW_OR:
  case Lexer::KW_NOT:
  case Lexer::LPAREN: return true;
  default: return false;
  }
}

struct Keyword {
  std::string_view text;
  size_t type = 0;
  bool mayHaveColon = false; // a slip
};

constexpr Keyword kKeywords[] = {
    {"IF", Lexer::KW_IF, true},         {"ELSE", Lexer::KW_ELSE, true}, {"END", Lexer::KW_END, true},
    {"RETURN", Lexer::KW_RETURN, true}, {"AND", Lexer::KW_AND, false},  {"OR", Lexer::KW_OR, false},
    {"NOT", Lexer::KW_NOT, false},      {"EOL", Lexer::KW_EOL, true},   {"FORMAT", Lexer::KW_FORMAT, true},
};

size_t wordType(std::string_view word) {
  const bool colon = word.ends_with(':');
  const std::string_view name = word.substr(0, word.size() - (colon ? 1 : 0));
  for (const Keyword& keyword : kKeywords)
    if (name == keyword.text && (!colon || keyword.mayHaveColon)) return keyword.type;
  if (colon) return Lexer::LABEL;
  if (word.ends_with('#')) return Lexer::NUMERIC;
  return word.ends_with('?') ? Lexer::BOOLEAN : Lexer::NAME;
}

bool hasTypographicQuote(std::string_view text, Encoding encoding) {
  if (encoding != Encoding::Utf8)
    return text.find_first_of("\x82\x84\x91\x92\x93\x94") != std::string_view::npos;
  for (std::size_t at = text.find("\xE2\x80"); at != std::string_view::npos;
       at = text.find("\xE2\x80", at + 2)) {
    if (at + 2 >= text.size()) return false;
    const auto third = static_cast<unsigned char>(text[at + 2]);
    if (third >= 0x98 && third <= 0x9E) return true;
  }
  return false;
}

bool isNameByte(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
}

// `END`, `RETURN`: words that an unclosed text has swallowed.
bool holdsBlockEnd(std::string_view text) {
  for (const std::string_view word : {"END", "RETURN", "IF"}) {
    for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
      const std::size_t end = at + word.size();
      if ((at == 0 || !isNameByte(text[at - 1])) && (end == text.size() || !isNameByte(text[end])))
        return true;
    }
  }
  return false;
}

} // namespace

std::unique_ptr<antlr4::Token> TokenReader::nextToken() {
  std::unique_ptr<antlr4::Token> next = ComPostLexer::nextToken();
  if (next->getChannel() != antlr4::Token::DEFAULT_CHANNEL) return next;
  auto& writable = static_cast<antlr4::CommonToken&>(*next);
  if (next->getType() == WORD) writable.setType(wordType(next->getText()));
  if (next->getType() == LPAREN && !takesBracket(previous_)) writable.setType(STRAY_LPAREN);
  previous_ = next->getType();
  return next;
}

Language language() {
  Language result;
  result.unitStops = {Lexer::KW_RETURN, Lexer::LABEL};
  result.insertable = {Lexer::KW_END, Lexer::KW_RETURN};
  result.insertableAnywhere = {Lexer::RPAREN, Lexer::EQUALS};
  result.emptyOnError = {Parser::RuleOperand, Parser::RulePictureText};
  result.opening = {Lexer::KW_IF, Lexer::LPAREN};
  result.closing = {Lexer::KW_END, Lexer::RPAREN};
  result.depthResets = {Lexer::KW_RETURN, Lexer::LABEL};
  result.explain = [](size_t, const antlr4::Token&, const antlr4::Parser&) {
    return std::string("this has no meaning here; the rest of the routine is not read");
  };
  return result;
}

TokenFindings checkTokens(const TokenBuffer& tokens, FileId file, const SourceMap& sources,
                          const Limits& limits, Diagnostics& diagnostics) {
  TokenFindings found;
  std::set<std::uint32_t> brokenLines;
  const SourceFile& source = sources.file(file);
  found.lost = tokens.dropped();
  for (std::uint32_t line = 1; line <= source.lineCount(); ++line) {
    const std::size_t length = source.line(line).size();
    if (length <= limits.lineBytes) continue;
    const std::uint32_t begin = source.lineStart(line);
    found.lost.push_back({file, begin, static_cast<std::uint32_t>(begin + length)});
  }
  found.broken = !found.lost.empty();

  const auto typographic = [&](SourceRange range) {
    found.broken = true;
    brokenLines.insert(source.lineOf(range.begin));
    if (found.typographicLines.insert(source.lineOf(range.begin)).second)
      diagnostics.report<diag::TypographicQuote>(range, "`'`");
  };
  for (const antlr4::Token* token : tokens.all()) {
    const SourceRange range = rangeOf(file, *token);
    switch (token->getType()) {
    case Lexer::TYPOGRAPHIC_TEXT:
    case Lexer::TYPOGRAPHIC_QUOTE: typographic(range); break;
    case Lexer::UNTERMINATED_LITERAL: {
      const std::string_view text = sources.text(range);
      if (holdsBlockEnd(text)) found.lost.push_back(range);
      if (hasTypographicQuote(text, source.encoding())) {
        typographic(range);
        break;
      }
      found.broken = true;
      brokenLines.insert(source.lineOf(range.begin));
      if (found.typographicLines.contains(source.lineOf(range.begin))) break;
      Diagnostic& diagnostic = diagnostics.report<diag::UnterminatedText>(range, "apostrophe");
      const std::uint32_t start = source.lineStart(source.lineOf(range.begin));
      if (sources.text({file, start, range.begin}).find('\'') != std::string_view::npos)
        diagnostic.note(
            {file, start, range.begin},
            "the line has an odd number of apostrophes; the missing one may belong to a text before this");
      break;
    }
    case Lexer::UNTERMINATED_COMMENT:
      found.broken = true;
      found.lost.push_back(range);
      diagnostics.report<diag::UnterminatedComment>({file, range.begin, range.begin + 1});
      break;
    default: break;
    }
  }
  // With quotes out of step, texts of the same line may have swallowed ends too.
  for (const antlr4::Token* token : tokens.all()) {
    if (token->getType() != Lexer::LITERAL && token->getType() != Lexer::TYPOGRAPHIC_TEXT) continue;
    const SourceRange range = rangeOf(file, *token);
    if (brokenLines.contains(source.lineOf(range.begin)) && holdsBlockEnd(sources.text(range)))
      found.lost.push_back(range);
  }
  std::sort(found.lost.begin(), found.lost.end(),
            [](SourceRange a, SourceRange b) { return a.begin < b.begin; });
  return found;
}

std::string dumpTokens(FileId file, const SourceMap& sources, const Limits& limits,
                       Diagnostics& diagnostics) {
  ByteStream bytes = openBytes(file, sources, limits, diagnostics);
  TokenReader reader(&bytes);
  const Language compost = language();
  const TokenBuffer tokens(reader, file, sources, compost, limits, diagnostics);
  checkTokens(tokens, file, sources, limits, diagnostics);
  std::string out;
  for (const antlr4::Token* token : tokens.all()) {
    const size_t type = token->getType();
    if (type == antlr4::Token::EOF) continue;
    const SourceRange range = rangeOf(file, *token);
    const LineColumn place = sources.file(file).place(range.begin);
    std::string text;
    for (const char c : sources.textUtf8(range)) {
      if (c == '\n')
        text += "\\n";
      else if (c == '\r')
        text += "\\r";
      else
        text += c;
    }
    out += fmt::format("{}:{} {} {}\n", place.line, place.column,
                       reader.getVocabulary().getSymbolicName(type), text);
  }
  return out;
}

} // namespace dotek::frontend::compost
