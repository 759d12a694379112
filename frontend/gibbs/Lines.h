// The three kinds of macro file, line by line, through the generated parser. Included by builder sources
// only, because it pulls in the ANTLR runtime.
#pragma once

#include "frontend/common/ParseSession.h"
#include "frontend/gibbs/Explain.h"
#include "frontend/gibbs/Parse.h"
#include "frontend/gibbs/Words.h"

#include "GibbsMacroParser.h"

#include <memory>
#include <string>
#include <vector>

namespace dotek::frontend::gibbs {

// Tokens and parser of one file. Problems are kept in a list of its own, so that the caller knows whether
// this file had any, and go to the context's list in the end.
class Lines {
public:
  Lines(FileId file, FileKind kind, const ParseContext& context);
  ~Lines();
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;

  // Moves to the next line that holds more than blanks and a comment.
  bool next();
  // From the first to the last word of the line.
  SourceRange range() const;
  // The tree of the line under the start rule of the file's kind, valid until next(). nullptr: the line is
  // broken, and its one error is reported.
  antlr4::ParserRuleContext* parse();
  // The line parsed, but the builder found an error in it.
  bool hasError() const { return errors_ != errorsBefore_; }

  FileId file() const { return file_; }
  const SourceMap& sources() const { return context_.sources; }
  const ParseContext& context() const { return context_; }
  SourceRange rangeOf(const antlr4::Token& token) const { return frontend::rangeOf(file_, token); }
  SourceRange rangeOf(const antlr4::ParserRuleContext& tree) const { return frontend::rangeOf(file_, tree); }
  std::string textOf(SourceRange range) const { return std::string(context_.sources.text(range)); }

  template <class Id, class... Args> Diagnostic& report(SourceRange range, const Args&... args) {
    if constexpr (Id::severity == Severity::Error) ++errors_;
    return problems_.report<Id>(range, args...);
  }
  // Comments of the whole file.
  std::vector<Comment> comments() const;
  // Hands the problems over; true if an error was among them.
  bool finish();

private:
  struct Span {
    std::size_t first = 0; // indices into tokens(), [first, last)
    std::size_t last = 0;
  };
  const std::vector<const antlr4::Token*>& tokens() const { return buffer_->all(); }
  bool reportBadTokens();
  bool damaged() const;
  std::string explain(const antlr4::Token& offending) const;

  FileId file_;
  FileKind kind_;
  const ParseContext& context_;
  Diagnostics problems_;
  Language language_;
  std::unique_ptr<ByteStream> bytes_;
  std::unique_ptr<RoleReader> lexer_;
  std::unique_ptr<TokenBuffer> buffer_;
  std::unique_ptr<grammar::GibbsMacroParser> parser_;
  std::unique_ptr<ParseSession> session_;
  std::vector<SourceRange> dropped_; // where limits cut a line
  Span line_;
  std::size_t following_ = 0; // first token after the line
  std::uint32_t errors_ = 0;
  std::uint32_t errorsBefore_ = 0;
};

// Comments of a token list, hidden channel.
std::vector<Comment> commentsOf(FileId file, const std::vector<const antlr4::Token*>& tokens,
                                const SourceMap& sources);

} // namespace dotek::frontend::gibbs
