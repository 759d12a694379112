#include "frontend/common/ParseSession.h"
#include "support/messages/Common.h"

#include <algorithm>

namespace dotek::frontend {

// Recovery by unit: nothing is deleted, only tokens of `insertable` are conjured, and after an error the
// rest of the unit is eaten. One message a unit.
class ParseSession::Strategy final : public antlr4::DefaultErrorStrategy {
public:
  Strategy(FileId file, const Language& language, Diagnostics& diagnostics)
      : file_(file), language_(language), diagnostics_(diagnostics) {}

  bool failed = false;

  void sync(antlr4::Parser*) override {}

  void recover(antlr4::Parser* parser, std::exception_ptr) override {
    if (staysEmpty(parser)) return;
    antlr4::TokenStream* input = parser->getTokenStream();
    while (!isStop(input->LA(1)))
      parser->consume();
  }

  void reportError(antlr4::Parser* parser, const antlr4::RecognitionException& error) override {
    if (staysEmpty(parser)) return;
    antlr4::Token* offending = error.getOffendingToken();
    // A prediction that failed far ahead points at its first token; the furthest one is what does not fit.
    if (offending == nullptr) offending = parser->getCurrentToken();
    report(parser, *offending);
  }

  antlr4::Token* recoverInline(antlr4::Parser* parser) override {
    if (singleTokenInsertion(parser)) return getMissingSymbol(parser);
    throw antlr4::InputMismatchException(parser);
  }

  bool singleTokenInsertion(antlr4::Parser* parser) override {
    const antlr4::misc::IntervalSet expected = getExpectedTokens(parser);
    const std::vector<size_t>& anywhere = language_.insertableAnywhere;
    if (std::any_of(anywhere.begin(), anywhere.end(), [&](size_t type) { return expected.contains(type); }))
      return true;
    return std::any_of(language_.insertable.begin(), language_.insertable.end(), [&](size_t type) {
      return expected.contains(type) && isStop(parser->getTokenStream()->LA(1));
    });
  }

  // A unit ends before a token of this type.
  bool isStop(size_t type) const {
    return type == antlr4::Token::EOF || std::find(language_.unitStops.begin(), language_.unitStops.end(),
                                                   type) != language_.unitStops.end();
  }

private:
  bool staysEmpty(antlr4::Parser* parser) const {
    if (parser->getContext() == nullptr) return false;
    const std::vector<size_t>& rules = language_.emptyOnError;
    return std::find(rules.begin(), rules.end(), parser->getContext()->getRuleIndex()) != rules.end();
  }

  void report(antlr4::Parser* parser, const antlr4::Token& offending) {
    if (failed) return;
    failed = true;
    const size_t rule = parser->getContext() == nullptr ? 0 : parser->getContext()->getRuleIndex();
    const antlr4::Token& at = language_.place ? language_.place(offending, *parser) : offending;
    diagnostics_.report<diag::SyntaxError>(rangeOf(file_, at), language_.explain(rule, offending, *parser));
  }

  FileId file_;
  const Language& language_;
  Diagnostics& diagnostics_;
};

// Counts open rules; a tree deeper than the stack allows is never built.
class ParseSession::DepthGuard final : public antlr4::tree::ParseTreeListener {
public:
  explicit DepthGuard(std::uint32_t limit) : limit_(limit) {}

  std::uint32_t depth = 0;

  void enterEveryRule(antlr4::ParserRuleContext*) override {
    if (++depth > limit_) throw antlr4::ParseCancellationException("depth");
  }
  void exitEveryRule(antlr4::ParserRuleContext*) override {
    if (depth > 0) --depth;
  }
  void visitTerminal(antlr4::tree::TerminalNode*) override {}
  void visitErrorNode(antlr4::tree::ErrorNode*) override {}

private:
  std::uint32_t limit_;
};

ParseSession::ParseSession(antlr4::Parser& parser, FileId file, const Language& language,
                           const Limits& limits, Diagnostics& diagnostics)
    : parser_(parser), file_(file), language_(language), limits_(limits), diagnostics_(diagnostics),
      strategy_(std::make_shared<Strategy>(file, language, diagnostics)),
      guard_(std::make_unique<DepthGuard>(limits.nesting * 8 + 40)) {
  parser_.removeErrorListeners();
  parser_.setErrorHandler(strategy_);
  parser_.addParseListener(guard_.get());
  parser_.getInterpreter<antlr4::atn::ParserATNSimulator>()->setPredictionMode(
      antlr4::atn::PredictionMode::SLL);
}

ParseSession::~ParseSession() {
  parser_.removeParseListener(guard_.get());
}

bool ParseSession::atEnd() const {
  return parser_.getTokenStream()->LA(1) == antlr4::Token::EOF;
}

ParseSession::Unit ParseSession::runErased(const std::function<antlr4::ParserRuleContext*()>& rule) {
  antlr4::TokenStream& input = *parser_.getTokenStream();
  // The stream has an index only once something was looked at.
  const SourceRange first = rangeOf(file_, *input.LT(1));
  const size_t before = input.index();
  guard_->depth = 0;
  strategy_->failed = false;
  strategy_->reset(&parser_);
  parser_.setContext(nullptr);
  Unit unit;
  try {
    unit.tree = rule();
  } catch (const antlr4::ParseCancellationException&) {
    diagnostics_.report<diag::NestingTooDeep>(rangeOf(file_, *input.LT(1)), limits_.nesting);
    strategy_->failed = true;
    parser_.setContext(nullptr);
    // The parser's own consume() would add to a context, and there is none.
    while (!strategy_->isStop(input.LA(1)))
      input.consume();
  }
  unit.failed = strategy_->failed;
  if (input.index() == before && !atEnd()) {
    // A stop token that no rule takes: eat it, or the caller's loop would never end.
    if (!unit.failed) {
      diagnostics_.report<diag::SyntaxError>(rangeOf(file_, *input.LT(1)),
                                             language_.explain(0, *input.LT(1), parser_));
      unit.failed = true;
    }
    input.consume();
  }
  const antlr4::Token* last = input.index() > 0 ? input.LT(-1) : nullptr;
  unit.range = last == nullptr ? first : spanning(first, rangeOf(file_, *last));
  parser_.setContext(nullptr);
  return unit;
}

} // namespace dotek::frontend
