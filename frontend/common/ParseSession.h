// The shell around ANTLR: bytes in, bounded depth and recovery, diagnostics in the field's words. Included
// by the builder sources of the front ends only, because it pulls in the ANTLR runtime.
#pragma once

#include "support/Diagnostics.h"
#include "support/Limits.h"
#include "support/Source.h"

#include <antlr4-runtime.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::frontend {

// A CharStream over bytes: takes any input, an index is a byte offset.
class ByteStream final : public antlr4::CharStream {
public:
  explicit ByteStream(std::string bytes) : bytes_(std::move(bytes)) {}

  void consume() override;
  size_t LA(ssize_t i) override;
  ssize_t mark() override { return -1; }
  void release(ssize_t) override {}
  size_t index() override { return position_; }
  void seek(size_t index) override;
  size_t size() override { return bytes_.size(); }
  std::string getSourceName() const override { return "input"; }
  std::string getText(const antlr4::misc::Interval& interval) override;
  std::string toString() const override { return bytes_; }

private:
  std::string bytes_;
  size_t position_ = 0;
};

// What a front end says the shell of its language. Token types are those of the generated lexer.
struct Language {
  // Recovery after a syntax error eats up to, not over, the first of these.
  std::vector<size_t> unitStops;
  // Tokens that recovery may conjure (`isConjured` tells); the builder reports them, the shell does not.
  std::vector<size_t> insertable;
  // Tokens that recovery may conjure before whatever is there (a closing bracket).
  std::vector<size_t> insertableAnywhere;
  // Rules that, where they do not match, stay empty and consume nothing: the builder sees the missing part
  // and reports it, the shell does not.
  std::vector<size_t> emptyOnError;
  // Brackets and block keywords, counted before any parser runs.
  std::vector<size_t> opening;
  std::vector<size_t> closing;
  // Tokens after which the count begins again (end of line, RETURN).
  std::vector<size_t> depthResets;
  // The message for a syntax error: `rule` is the parser's rule index, `offending` the token that does not
  // fit. In the field's words; never a token set.
  std::function<std::string(size_t rule, const antlr4::Token& offending, const antlr4::Parser& parser)>
      explain;
  // The token that the message points at; without it the offending one.
  std::function<const antlr4::Token&(const antlr4::Token& offending, const antlr4::Parser& parser)> place =
      {};
};

SourceRange rangeOf(FileId file, const antlr4::Token& token);
// From the first to the last token of a rule; an empty rule gives an empty range at its start.
SourceRange rangeOf(FileId file, const antlr4::ParserRuleContext& context);
// A token that recovery put in, standing for text that is not there.
bool isConjured(const antlr4::Token& token);

// The tokens of one file after the checks that must precede parsing: bytes a line, tokens a line, depth of
// brackets. Tokens of an offending stretch are dropped, and the stretch is reported.
class TokenBuffer {
public:
  TokenBuffer(antlr4::Lexer& lexer, FileId file, const SourceMap& sources, const Language& language,
              const Limits& limits, Diagnostics& diagnostics);
  ~TokenBuffer();
  TokenBuffer(const TokenBuffer&) = delete;
  TokenBuffer& operator=(const TokenBuffer&) = delete;

  antlr4::CommonTokenStream& stream() { return *stream_; }
  // All tokens that were kept, hidden ones too, in order; the last is EOF.
  const std::vector<const antlr4::Token*>& all() const { return all_; }
  // Stretches whose tokens were dropped; each was reported.
  const std::vector<SourceRange>& dropped() const { return dropped_; }

private:
  std::vector<SourceRange> dropped_;
  std::vector<const antlr4::Token*> all_;
  std::unique_ptr<antlr4::ListTokenSource> source_;
  std::unique_ptr<antlr4::CommonTokenStream> stream_;
};

// Bytes of the file for a lexer, with lines over the limit reported and blanked.
ByteStream openBytes(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics);

// Drives a generated parser unit by unit. No exception leaves it.
class ParseSession {
public:
  ParseSession(antlr4::Parser& parser, FileId file, const Language& language, const Limits& limits,
               Diagnostics& diagnostics);
  ~ParseSession();
  ParseSession(const ParseSession&) = delete;
  ParseSession& operator=(const ParseSession&) = delete;

  struct Unit {
    // nullptr where the depth limit was hit: the unit was reported and skipped.
    antlr4::ParserRuleContext* tree = nullptr;
    // A syntax error was reported in this unit.
    bool failed = false;
    // What the unit consumed.
    SourceRange range;
  };

  bool atEnd() const;
  // Runs one start rule, to be called as `session.run([&] { return parser.line(); })`. Always consumes at
  // least one token, so that a loop until atEnd() ends. Trees live until the parser dies.
  template <class Rule> Unit run(const Rule& rule) {
    return runErased([&rule]() -> antlr4::ParserRuleContext* { return rule(); });
  }

private:
  class Strategy;
  class DepthGuard;

  Unit runErased(const std::function<antlr4::ParserRuleContext*()>& rule);

  antlr4::Parser& parser_;
  FileId file_;
  const Language& language_;
  const Limits& limits_;
  Diagnostics& diagnostics_;
  std::shared_ptr<Strategy> strategy_;
  std::unique_ptr<DepthGuard> guard_;
};

} // namespace dotek::frontend
