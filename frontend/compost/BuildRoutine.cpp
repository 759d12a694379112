// Routines, what is between them, and the whole file.
#include "frontend/compost/BuildAst.h"
#include "frontend/compost/Parse.h"
#include "support/messages/ComPost.h"

#include <algorithm>
#include <map>

namespace dotek::frontend::compost {

using Parser = grammar::ComPostParser;

Builder::Builder(FileId file, const SourceMap& sources, TokenFindings findings, Diagnostics& diagnostics)
    : file_(file), sources_(sources), source_(sources.file(file)), findings_(std::move(findings)),
      diagnostics_(diagnostics) {
  program_.file = file;
  program_.hasErrorNodes = findings_.broken;
}

bool Builder::losesText(SourceRange range) const {
  const auto behind = std::upper_bound(findings_.lost.begin(), findings_.lost.end(), range.begin,
                                       [](std::uint32_t at, SourceRange lost) { return at < lost.begin; });
  return behind != findings_.lost.begin() && std::prev(behind)->end > routineBegin_;
}

bool Builder::cutShort(SourceRange range) const {
  const auto next = std::lower_bound(findings_.lost.begin(), findings_.lost.end(), range.end,
                                     [](SourceRange lost, std::uint32_t at) { return lost.begin < at; });
  if (next == findings_.lost.end()) return false;
  return sources_.text({file_, range.end, next->begin}).find_first_not_of(" \t\r\n") ==
         std::string_view::npos;
}

void Builder::item(const ParseSession::Unit& unit, antlr4::TokenStream& stream) {
  if (auto* part = dynamic_cast<Parser::LooseItemContext*>(unit.tree)) return loose(*part->loose());
  flushEnds(std::nullopt);
  if (unit.failed) program_.hasErrorNodes = true;
  if (auto* part = dynamic_cast<Parser::RoutineItemContext*>(unit.tree))
    return routine(*part->routine(), stream);
  if (auto* part = dynamic_cast<Parser::DirectiveItemContext*>(unit.tree))
    return directive(*part->directive(), false);
  program_.hasErrorNodes = true;
  program_.items.push_back(ErrorItem{unit.range});
}

void Builder::routine(Parser::RoutineContext& context, antlr4::TokenStream& stream) {
  Routine result;
  const SourceRange label = rangeOf(*context.LABEL()->getSymbol());
  routineBegin_ = label.begin;
  openIfs_.clear();
  innerDirectives_.clear();
  lastDirective_ = {};
  result.nameRange = {file_, label.begin, label.end - 1};
  result.name = sources_.text(result.nameRange);
  SourceRange last = label;
  for (antlr4::tree::ParseTree* child : context.children) {
    if (auto* part = dynamic_cast<Parser::EntryContext*>(child)) {
      entry(*part, result.body);
      if (part->statement() != nullptr) lastDirective_ = {};
    } else if (auto* flow = dynamic_cast<Parser::StrayFlowContext*>(child)) {
      strayFlow(*flow, result.body);
      lastDirective_ = {};
    } else if (auto* term = dynamic_cast<Parser::DanglingTermContext*>(child)) {
      dangling(*term, result.body);
    } else {
      continue;
    }
    last = rangeOf(*dynamic_cast<antlr4::ParserRuleContext*>(child));
  }
  result.range = spanning(label, last);

  const antlr4::Token* stop = context.KW_RETURN() == nullptr ? nullptr : context.KW_RETURN()->getSymbol();
  const std::string& bytes = source_.bytes();
  pendingEnd_ = {};
  if (stop != nullptr && !isConjured(*stop)) {
    result.returnRange = keyword(*stop);
    result.range = spanning(label, *result.returnRange);
    pendingEnd_.at = RoutineEnd::At::Return;
    pendingEnd_.range = *result.returnRange;
  } else {
    const antlr4::Token* next = stream.LT(1);
    if (next->getType() == Parser::LABEL) {
      pendingEnd_.at = RoutineEnd::At::Label;
      pendingEnd_.range = rangeOf(*next);
      --pendingEnd_.range.end;
    } else {
      const auto end = static_cast<std::uint32_t>(bytes.size());
      pendingEnd_.range = {file_, end, end};
    }
  }
  // Directives after the last statement belong after the routine.
  const bool trailing = pendingEnd_.at != RoutineEnd::At::Return && lastDirective_.hasPlace();
  std::uint32_t point = pendingEnd_.range.begin;
  if (trailing) {
    for (const Item& inner : innerDirectives_) {
      const SourceRange range = std::visit([](const auto& node) { return node.range; }, inner);
      if (range.begin < last.end && range.begin > lastStatementEnd(result)) {
        point = range.begin;
        break;
      }
    }
    result.range.end = std::max(label.end, lastStatementEnd(result));
  }
  // At the start of the line where nothing but blanks is before.
  const std::uint32_t lineStart = source_.lineStart(source_.lineOf(point));
  if (bytes.find_first_not_of(" \t", lineStart) >= point) point = lineStart;
  pendingEnd_.insertionPoint = point;

  pendingRoutine_ = program_.items.size();
  program_.routines.try_emplace(result.name, program_.items.size());
  program_.items.push_back(std::move(result));
  for (Item& inner : innerDirectives_)
    program_.items.push_back(std::move(inner));
  innerDirectives_.clear();
}

std::uint32_t Builder::lastStatementEnd(const Routine& routine) {
  if (routine.body.empty()) return routine.nameRange.end;
  return std::visit(
      [](const auto& node) {
        if constexpr (requires { node->range; })
          return node->range.end;
        else
          return node.range.end;
      },
      routine.body.back());
}

// What is said of the ends of the last routine depends on what follows it.
void Builder::flushEnds(std::optional<SourceRange> strayEnd) {
  if (!pendingRoutine_) return;
  const auto& last = std::get<Routine>(program_.items[*pendingRoutine_]);
  pendingRoutine_.reset();
  if (losesText(pendingEnd_.range)) return;
  for (Diagnostic& diagnostic : reportMissingEnds(last, openIfs_, pendingEnd_, strayEnd, sources_))
    diagnostics_.add(std::move(diagnostic));
}

void Builder::loose(Parser::LooseContext& context) {
  const SourceRange range = rangeOf(context);
  program_.hasErrorNodes = true;
  program_.items.push_back(ErrorItem{range});
  std::optional<SourceRange> strayEnd;
  std::optional<SourceRange> colon;
  for (Parser::LooseEntryContext* part : context.looseEntry()) {
    if (part->strayFlow() != nullptr && !strayEnd) strayEnd = rangeOf(*part->strayFlow()->getStart());
    const antlr4::Token& first = *part->getStart();
    if (first.getType() == Parser::COLON && !colon) colon = rangeOf(first);
  }
  const bool earlyReturn = pendingRoutine_ && !openIfs_.empty() && strayEnd;
  flushEnds(earlyReturn ? strayEnd : std::nullopt);
  if (earlyReturn) return; // the open IF says the whole story
  if (colon && !quiet(*colon))
    return syntaxError(
        *colon, "a colon is alone, so no routine begins here; the colon of a label directly follows the "
                "name, `name:`");
  if (findings_.typographicLines.contains(lineOf(range))) return;
  if (losesText({file_, range.end, range.end})) return; // the label may have stood in what was dropped
  const SourceRange first = rangeOf(*context.getStart());
  Diagnostic& found = diagnostics_.report<diag::StatementOutsideRoutine>(first);
  if (sources_.text(first).starts_with('!'))
    found.note(first, "`!` begins a comment in macros alone; in a Prog it is in braces, `{ .. }`");
}

Program Builder::finish(const TokenBuffer& tokens) {
  flushEnds(std::nullopt);
  for (const antlr4::Token* token : tokens.all()) {
    if (token->getType() != Parser::COMMENT && token->getType() != Parser::UNTERMINATED_COMMENT) continue;
    const SourceRange range = rangeOf(*token);
    const std::uint32_t closing = token->getType() == Parser::COMMENT ? 1 : 0;
    program_.comments.push_back(
        {range, std::string(sources_.text({file_, range.begin + 1, range.end - closing}))});
  }
  return std::move(program_);
}

Program parse(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics) {
  ByteStream bytes = openBytes(file, sources, limits, diagnostics);
  TokenReader reader(&bytes);
  const Language compost = language();
  TokenBuffer tokens(reader, file, sources, compost, limits, diagnostics);
  Builder builder(file, sources, checkTokens(tokens, file, sources, limits, diagnostics), diagnostics);
  Parser parser(&tokens.stream());
  ParseSession session(parser, file, compost, limits, diagnostics);
  while (!session.atEnd()) {
    builder.item(session.run([&] { return parser.item(); }), tokens.stream());
    parser.getTreeTracker().reset(); // trees are large, and this one is built
  }
  return builder.finish(tokens);
}

} // namespace dotek::frontend::compost
