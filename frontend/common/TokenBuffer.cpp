#include "frontend/common/ParseSession.h"
#include "support/messages/Common.h"

#include <algorithm>

namespace dotek::frontend {

void ByteStream::consume() {
  if (position_ < bytes_.size()) ++position_;
}

size_t ByteStream::LA(ssize_t i) {
  if (i == 0) return 0;
  const ssize_t at = static_cast<ssize_t>(position_) + (i > 0 ? i - 1 : i);
  if (at < 0 || at >= static_cast<ssize_t>(bytes_.size())) return antlr4::IntStream::EOF;
  return static_cast<unsigned char>(bytes_[static_cast<size_t>(at)]);
}

void ByteStream::seek(size_t index) {
  position_ = std::min(index, bytes_.size());
}

std::string ByteStream::getText(const antlr4::misc::Interval& interval) {
  if (interval.a < 0 || interval.b < interval.a || interval.a >= static_cast<ssize_t>(bytes_.size()))
    return "";
  const auto begin = static_cast<size_t>(interval.a);
  return bytes_.substr(begin, static_cast<size_t>(interval.b) - begin + 1);
}

bool isConjured(const antlr4::Token& token) {
  return token.getTokenIndex() == INVALID_INDEX;
}

SourceRange rangeOf(FileId file, const antlr4::Token& token) {
  const auto begin = static_cast<std::uint32_t>(token.getStartIndex());
  if (token.getType() == antlr4::Token::EOF) return {file, begin, begin};
  return {file, begin, static_cast<std::uint32_t>(token.getStopIndex() + 1)};
}

SourceRange rangeOf(FileId file, const antlr4::ParserRuleContext& context) {
  const antlr4::Token* start = const_cast<antlr4::ParserRuleContext&>(context).getStart();
  const antlr4::Token* stop = const_cast<antlr4::ParserRuleContext&>(context).getStop();
  if (start == nullptr) return {file, 0, 0};
  const SourceRange first = rangeOf(file, *start);
  if (stop == nullptr || stop->getTokenIndex() < start->getTokenIndex())
    return {file, first.begin, first.begin};
  return spanning(first, rangeOf(file, *stop));
}

ByteStream openBytes(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics) {
  const SourceFile& source = sources.file(file);
  std::string bytes = source.bytes();
  for (std::uint32_t line = 1; line <= source.lineCount(); ++line) {
    const std::string_view text = source.line(line);
    if (text.size() <= limits.lineBytes) continue;
    const std::uint32_t begin = source.lineStart(line);
    diagnostics.report<diag::LineTooLong>({file, begin, begin + 1}, text.size(), limits.lineBytes);
    std::fill_n(bytes.begin() + begin, text.size(), ' ');
  }
  return ByteStream(std::move(bytes));
}

namespace {

bool contains(const std::vector<size_t>& types, size_t type) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

} // namespace

TokenBuffer::TokenBuffer(antlr4::Lexer& lexer, FileId file, const SourceMap& sources,
                         const Language& language, const Limits& limits, Diagnostics& diagnostics) {
  lexer.removeErrorListeners();
  const SourceFile& source = sources.file(file);
  std::vector<std::unique_ptr<antlr4::Token>> kept;
  std::uint32_t line = 0;
  std::uint32_t onLine = 0;
  std::uint32_t depth = 0;
  bool dropping = false;
  while (true) {
    std::unique_ptr<antlr4::Token> token = lexer.nextToken();
    const size_t type = token->getType();
    if (type == antlr4::Token::EOF) {
      kept.push_back(std::move(token));
      break;
    }
    const SourceRange range = rangeOf(file, *token);
    if (dropping && contains(language.unitStops, type)) {
      dropping = false;
      depth = 0;
    }
    if (dropping) {
      dropped_.back().end = range.end;
      continue;
    }
    if (token->getChannel() == antlr4::Token::DEFAULT_CHANNEL) {
      const std::uint32_t here = source.lineOf(range.begin);
      onLine = here == line ? onLine + 1 : 1;
      line = here;
      // The end of a line is kept, or the next line would be lost with this one.
      const char first = source.bytes()[range.begin];
      if (onLine > limits.lineTokens && first != '\n' && first != '\r') {
        // A stop on the same line is dropped again, without a second message.
        if (onLine == limits.lineTokens + 1)
          diagnostics.report<diag::TooManyTokens>(range, limits.lineTokens);
        dropping = true;
        dropped_.push_back(range);
        continue;
      }
      if (contains(language.depthResets, type)) depth = 0;
      if (contains(language.opening, type) && ++depth > limits.nesting) {
        diagnostics.report<diag::NestingTooDeep>(range, limits.nesting);
        dropping = true;
        dropped_.push_back(range);
        continue;
      }
      if (contains(language.closing, type) && depth > 0) --depth;
    }
    kept.push_back(std::move(token));
  }
  all_.reserve(kept.size());
  for (const auto& token : kept)
    all_.push_back(token.get());
  source_ = std::make_unique<antlr4::ListTokenSource>(std::move(kept));
  stream_ = std::make_unique<antlr4::CommonTokenStream>(source_.get());
}

TokenBuffer::~TokenBuffer() = default;

} // namespace dotek::frontend
