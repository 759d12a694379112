#include "frontend/gibbs/Lines.h"
#include "support/messages/Common.h"
#include "support/messages/Gibbs.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

using Lexer = grammar::GibbsMacroLexer;

namespace {

// A file with more broken lines is not a macro; the bound keeps bad input from taking long.
constexpr std::uint32_t kMaxErrors = 500;

bool isEnd(const antlr4::Token& token) {
  return token.getType() == Lexer::EOL || token.getType() == antlr4::Token::EOF;
}

bool isVisible(const antlr4::Token& token) {
  return token.getChannel() == antlr4::Token::DEFAULT_CHANNEL;
}

bool isTypographic(const antlr4::Token& token, const SourceFile& source) {
  if (token.getType() == Lexer::TYPOGRAPHIC_QUOTE) return true;
  if (token.getType() != Lexer::OPEN_TEXT && token.getType() != Lexer::OPEN_SINGLE_TEXT) return false;
  const std::string text = token.getText();
  if (source.encoding() == Encoding::Utf8) {
    for (std::size_t i = 0; i + 2 < text.size(); ++i) {
      const auto third = static_cast<unsigned char>(text[i + 2]);
      if (text[i] == '\xE2' && text[i + 1] == '\x80' && third >= 0x98 && third <= 0x9F) return true;
    }
    return false;
  }
  return text.find_first_of("\x82\x84\x91\x92\x93\x94") != std::string::npos;
}

} // namespace

Lines::Lines(FileId file, FileKind kind, const ParseContext& context)
    : file_(file), kind_(kind), context_(context) {
  language_.unitStops = {Lexer::EOL};
  language_.opening = {Lexer::LEFT_ROUND, Lexer::CONDITION_ROUND, Lexer::LEFT_SQUARE};
  language_.closing = {Lexer::RIGHT_ROUND, Lexer::RIGHT_SQUARE};
  language_.depthResets = {Lexer::EOL};
  language_.explain = [this](std::size_t, const antlr4::Token& offending, const antlr4::Parser&) {
    return explain(offending);
  };
  bytes_ = std::make_unique<ByteStream>(openBytes(file, context.sources, context.limits, problems_));
  errors_ = static_cast<std::uint32_t>(problems_.all().size());
  lexer_ = std::make_unique<RoleReader>(bytes_.get(), kind);
  buffer_ =
      std::make_unique<TokenBuffer>(*lexer_, file, context.sources, language_, context.limits, problems_);
  for (std::size_t i = errors_; i < problems_.all().size(); ++i)
    dropped_.push_back(problems_.all()[i].range);
  errors_ = static_cast<std::uint32_t>(problems_.all().size());
  parser_ = std::make_unique<grammar::GibbsMacroParser>(&buffer_->stream());
  session_ = std::make_unique<ParseSession>(*parser_, file, language_, context.limits, problems_);
  const std::string& text = context.sources.file(file).bytes();
  if (text.find_first_not_of(" \t\r\n\f\v") == std::string::npos)
    report<diag::EmptyFile>({file, 0, static_cast<std::uint32_t>(0)}, context.sources.file(file).name());
}

Lines::~Lines() = default;

bool Lines::next() {
  parser_->getTreeTracker().reset();
  if (errors_ > kMaxErrors) {
    if (following_ < tokens().size()) report<diag::TooManyErrors>(rangeOf(*tokens()[following_]), kMaxErrors);
    return false;
  }
  while (following_ < tokens().size()) {
    line_.first = following_;
    std::size_t at = following_;
    while (at < tokens().size() && !isEnd(*tokens()[at]))
      ++at;
    line_.last = at;
    following_ = at + 1;
    const bool any = std::any_of(tokens().begin() + static_cast<std::ptrdiff_t>(line_.first),
                                 tokens().begin() + static_cast<std::ptrdiff_t>(line_.last),
                                 [](const antlr4::Token* token) { return isVisible(*token); });
    if (!any) continue;
    errorsBefore_ = errors_;
    return true;
  }
  return false;
}

SourceRange Lines::range() const {
  SourceRange whole;
  for (std::size_t i = line_.first; i < line_.last; ++i) {
    if (!isVisible(*tokens()[i])) continue;
    const SourceRange here = rangeOf(*tokens()[i]);
    whole = whole.hasPlace() ? spanning(whole, here) : here;
  }
  return whole;
}

bool Lines::damaged() const {
  const SourceRange line = range();
  const std::uint32_t end = rangeOf(*tokens()[line_.last]).end;
  return std::any_of(dropped_.begin(), dropped_.end(),
                     [&](const SourceRange& cut) { return cut.begin >= line.begin && cut.begin <= end; });
}

bool Lines::reportBadTokens() {
  const SourceFile& source = sources().file(file_);
  for (std::size_t i = line_.first; i < line_.last; ++i) {
    if (!isTypographic(*tokens()[i], source)) continue;
    report<diag::TypographicQuote>(rangeOf(*tokens()[i]), "`\"`");
    return true;
  }
  for (std::size_t i = line_.first; i < line_.last; ++i) {
    const antlr4::Token& token = *tokens()[i];
    const SourceRange range = rangeOf(token);
    switch (token.getType()) {
    case Lexer::OPEN_TEXT:
      report<diag::UnterminatedText>({file_, range.begin, range.begin + 1}, "`\"`");
      return true;
    case Lexer::OPEN_SINGLE_TEXT:
      report<diag::UnterminatedText>({file_, range.begin, range.begin + 1}, "`'`");
      return true;
    case Lexer::WIDE_CHARACTER:
    case Lexer::OTHER: {
      const std::string text = token.getText();
      if (text == ";")
        report<diag::SyntaxError>(
            range, "`;` ends nothing here: one statement is on a line, and a comment begins with `!`");
      else if (text == "#")
        report<diag::SyntaxError>(range, "`#INCLUDE` is the only word that begins with `#`");
      else if (text == "{" || text == "}")
        report<diag::SyntaxError>(range,
                                  "`" + text + "` has no meaning in a macro; a comment begins with `!`");
      else if (text == "^" || text == "%")
        report<diag::SyntaxError>(range,
                                  "GibbsCAM macros have no operator `" + text + "`; they have + - * / only");
      else if (text == "_")
        report<diag::SyntaxError>(range, "a name begins with a letter, not with `_`");
      else if (static_cast<unsigned char>(text[0]) < 0x20 || static_cast<unsigned char>(text[0]) == 0x7F)
        report<diag::UnexpectedCharacter>(range, fmt::format("with code {}", static_cast<int>(text[0])));
      else
        report<diag::UnexpectedCharacter>(range, "`" + sources().textUtf8(range) + "`");
      return true;
    }
    default: break;
    }
  }
  return false;
}

antlr4::ParserRuleContext* Lines::parse() {
  if (damaged() || reportBadTokens()) return nullptr;
  buffer_->stream().seek(line_.first);
  const ParseSession::Unit unit = session_->run([this]() -> antlr4::ParserRuleContext* {
    switch (kind_) {
    case FileKind::Macro: return parser_->line();
    case FileKind::Dialog: return parser_->controlLine();
    case FileKind::DefineData: return parser_->definitionLine();
    }
    return nullptr;
  });
  if (unit.failed || unit.tree == nullptr) {
    ++errors_;
    return nullptr;
  }
  return unit.tree;
}

std::string Lines::explain(const antlr4::Token& offending) const {
  std::vector<Word> words;
  std::string comment;
  std::size_t at = SIZE_MAX;
  for (std::size_t i = line_.first; i < line_.last; ++i) {
    const antlr4::Token& token = *tokens()[i];
    if (token.getType() == Lexer::COMMENT) comment = sources().textUtf8(rangeOf(token));
    if (!isVisible(token)) continue;
    if (i >= offending.getTokenIndex() && at == SIZE_MAX) at = words.size();
    const bool touches = i + 1 < line_.last && isVisible(*tokens()[i + 1]) &&
                         tokens()[i + 1]->getStartIndex() == token.getStopIndex() + 1;
    const SourceRange range = rangeOf(token);
    words.push_back(
        {typeWithoutRole(token.getType(), sources().text(range)), sources().textUtf8(range), touches});
  }
  return explainLine(kind_, words, std::min(at, words.size()), comment);
}

std::vector<Comment> commentsOf(FileId file, const std::vector<const antlr4::Token*>& tokens,
                                const SourceMap& sources) {
  std::vector<Comment> comments;
  for (const antlr4::Token* token : tokens) {
    if (token->getType() != Lexer::COMMENT) continue;
    const SourceRange range = frontend::rangeOf(file, *token);
    comments.push_back({range, std::string(sources.text({file, range.begin + 1, range.end}))});
  }
  return comments;
}

std::vector<Comment> Lines::comments() const {
  return commentsOf(file_, tokens(), sources());
}

bool Lines::finish() {
  const bool failed = problems_.hasErrors();
  for (Diagnostic& problem : problems_.all())
    context_.diagnostics.add(std::move(problem));
  return failed;
}

} // namespace dotek::frontend::gibbs
