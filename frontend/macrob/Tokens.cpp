#include "frontend/macrob/Tokens.h"

#include "frontend/macrob/Keywords.h"
#include "frontend/macrob/Lines.h"
#include "frontend/macrob/Parse.h"
#include "support/Ascii.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::frontend::macrob {

using Lexer = grammar::MacroBLexer;

namespace {

std::size_t tokenType(WordKind kind, char letter) {
  switch (kind) {
  case WordKind::If: return Lexer::KW_IF;
  case WordKind::Then: return Lexer::KW_THEN;
  case WordKind::Goto: return Lexer::KW_GOTO;
  case WordKind::While: return Lexer::KW_WHILE;
  case WordKind::Do: return Lexer::KW_DO;
  case WordKind::End: return Lexer::KW_END;
  case WordKind::And: return Lexer::KW_AND;
  case WordKind::Or: return Lexer::KW_OR;
  case WordKind::Xor: return Lexer::KW_XOR;
  case WordKind::Mod: return Lexer::KW_MOD;
  case WordKind::Relation: return Lexer::RELATION;
  case WordKind::Function: return Lexer::FUNCTION;
  case WordKind::Port: return Lexer::PORT;
  case WordKind::Print: return Lexer::PRINT;
  case WordKind::SetNames: return Lexer::KW_SETVN;
  case WordKind::Address: break;
  }
  return letter == 'N' ? Lexer::ADDRESS_N : letter == 'O' ? Lexer::ADDRESS_O : Lexer::ADDRESS;
}

} // namespace

std::unique_ptr<antlr4::Token> TokenReader::make(std::size_t kind, std::size_t begin, std::size_t end) {
  return std::make_unique<antlr4::CommonToken>(
      std::pair<antlr4::TokenSource*, antlr4::CharStream*>(this, getInputStream()), kind,
      antlr4::Token::DEFAULT_CHANNEL, begin, end - 1);
}

std::unique_ptr<antlr4::Token> TokenReader::nextToken() {
  if (waiting_.empty()) {
    skipBlanks();
    std::unique_ptr<antlr4::Token> next = MacroBLexer::nextToken();
    const std::size_t kind = next->getType();
    if (next->getChannel() != antlr4::Token::DEFAULT_CHANNEL || kind == antlr4::Token::EOF) return next;
    if (kind == EOL) {
      expectText_ = false;
      return next;
    }
    if (kind == LBRACKET && expectText_) return printText(*next);
    if (kind != WORD) return next;
    takeApart(*next);
  }
  std::unique_ptr<antlr4::Token> first = std::move(waiting_.front());
  waiting_.pop_front();
  return first;
}

// The scanner leaves blanks where it has read a block: one step over them, not one of the grammar for each.
void TokenReader::skipBlanks() {
  antlr4::CharStream& input = *getInputStream();
  const std::size_t from = input.index();
  const std::size_t at = std::min(text_.find_first_not_of(' ', from), text_.size());
  if (at > from) input.seek(at);
}

void TokenReader::takeApart(const antlr4::Token& run) {
  const std::string text = run.getText();
  std::string letters;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!isLetter(text[i])) continue;
    letters += upperCase(text[i]);
    places.push_back(run.getStartIndex() + i);
  }
  for (std::size_t at = 0; at < letters.size();) {
    const WordMatch match = wordAt(std::string_view(letters).substr(at));
    waiting_.push_back(
        make(tokenType(match.kind, letters[at]), places[at], places[at + match.length - 1] + 1));
    if (match.kind == WordKind::Print || match.kind == WordKind::SetNames) expectText_ = true;
    at += match.length;
  }
}

// From its bracket to the one that closes it, or to the end of the block.
std::unique_ptr<antlr4::Token> TokenReader::printText(const antlr4::Token& bracket) {
  expectText_ = false;
  antlr4::CharStream& input = *getInputStream();
  int depth = 1;
  while (depth > 0) {
    const std::size_t c = input.LA(1);
    if (c == antlr4::IntStream::EOF || c == '\n' || c == '\r' || c == ';') break;
    depth += c == '[' ? 1 : c == ']' ? -1 : 0;
    input.consume();
  }
  return make(PRINT_TEXT, bracket.getStartIndex(), input.index());
}

Tok tokOf(const antlr4::Token& token, std::string_view source) {
  Tok out;
  out.type = token.getType();
  out.begin = static_cast<std::uint32_t>(token.getStartIndex());
  out.end = static_cast<std::uint32_t>(token.getStopIndex() + 1);
  const bool verbatim = out.type == Lexer::PRINT_TEXT;
  for (const char c : source.substr(out.begin, out.end - out.begin)) {
    if (verbatim)
      out.text += c;
    else if (c != ' ' && c != '\t' && c != '\v' && c != '\f')
      out.text += upperCase(c);
  }
  return out;
}

std::size_t typeAt(const std::vector<Tok>& tokens, std::size_t i) {
  return i < tokens.size() ? tokens[i].type : antlr4::Token::EOF;
}

bool isOperator(std::size_t type) {
  switch (type) {
  case Lexer::PLUS:
  case Lexer::MINUS:
  case Lexer::STAR:
  case Lexer::SLASH:
  case Lexer::KW_AND:
  case Lexer::KW_OR:
  case Lexer::KW_XOR:
  case Lexer::KW_MOD: return true;
  default: return false;
  }
}

bool isAddress(std::size_t type) {
  return type == Lexer::ADDRESS || type == Lexer::ADDRESS_N;
}

bool expectsValue(std::size_t type) {
  return isOperator(type) || type == Lexer::LBRACKET || type == Lexer::EQUALS || type == Lexer::RELATION ||
         type == Lexer::COMMA;
}

Language language() {
  Language result;
  result.unitStops = {Lexer::EOL};
  result.opening = {Lexer::LBRACKET};
  result.closing = {Lexer::RBRACKET};
  result.depthResets = {Lexer::EOL};
  return result;
}

std::string dumpTokens(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics,
                       Text text) {
  Lines lines = splitLines(file, sources, limits, diagnostics, text);
  ByteStream bytes(lines.bytes);
  TokenReader reader(&bytes, lines.bytes);
  const Language macrob = language();
  const TokenBuffer tokens(reader, file, sources, macrob, limits, diagnostics);
  std::string out;
  const auto print = [&](SourceRange range, std::string_view kind) {
    const LineColumn place = sources.file(file).place(range.begin);
    std::string written;
    for (const char c : sources.textUtf8(range))
      written += c == '\n' ? "\\n" : c == '\r' ? "\\r" : std::string(1, c);
    out += fmt::format("{}:{} {} {}\n", place.line, place.column, kind, written);
  };
  std::size_t line = 0;
  for (const antlr4::Token* token : tokens.all()) {
    const SourceRange range = rangeOf(file, *token);
    for (; line < lines.lines.size() && lines.lines[line].range.begin <= range.begin; ++line)
      if (lines.lines[line].header) print(lines.lines[line].header->range, "HEADER");
    // Blank lines say nothing.
    if (token->getType() == antlr4::Token::EOF || token->getType() == Lexer::EOL) continue;
    print(range, reader.getVocabulary().getSymbolicName(token->getType()));
  }
  return out;
}

} // namespace dotek::frontend::macrob
