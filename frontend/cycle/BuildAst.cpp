// Lines to blocks: comments, blank lines, `end`.
#include "frontend/cycle/BuildAst.h"
#include "frontend/cycle/Words.h"

#include "frontend/cycle/Parse.h"
#include "frontend/cycle/Tokens.h"
#include "support/Ascii.h"
#include "support/messages/Common.h"
#include "support/messages/Cycle.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace dotek::frontend::cycle {

Builder::Builder(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics)
    : sources_(sources), source_(sources.file(file)), limits_(limits), diagnostics_(diagnostics) {
  file_.file = file;
}

// ---- comments --------------------------------------------------------------------------------------------

bool Builder::blankAbove(std::uint32_t offset) const {
  const std::uint32_t line = lineOf(offset);
  return line > 1 && source_.line(line - 1).find_first_not_of(" \t\f\v") == std::string_view::npos;
}

void Builder::comments(const TokenBuffer& tokens) {
  for (const antlr4::Token* token : tokens.all()) {
    if (token->getType() != Parser::COMMENT) continue;
    Comment comment;
    comment.range = rangeOf(*token);
    comment.text = sources_.textUtf8({file_.file, comment.range.begin + 2, comment.range.end});
    while (!comment.text.empty() && (comment.text.back() == ' ' || comment.text.back() == '\t'))
      comment.text.pop_back();
    comment.blankBefore = blankAbove(comment.range.begin);
    comments_.push_back(std::move(comment));
  }
}

std::vector<Comment> Builder::commentsBefore(std::uint32_t offset) {
  std::vector<Comment> out;
  for (; nextComment_ < comments_.size() && comments_[nextComment_].range.begin < offset; ++nextComment_)
    out.push_back(std::move(comments_[nextComment_]));
  return out;
}

void Builder::attach(Statement& statement) {
  statement.blankBefore = blankAbove(statement.range.begin);
  statement.before = commentsBefore(statement.range.begin);
  const std::uint32_t line = lineOf(std::max(statement.range.end, statement.range.begin + 1) - 1);
  while (nextComment_ < comments_.size() && lineOf(comments_[nextComment_].range.begin) <= line) {
    if (statement.after) {
      statement.after->blankBefore = false;
      statement.before.push_back(std::move(*statement.after));
    }
    statement.after = std::move(comments_[nextComment_++]);
  }
  if (statement.after) statement.after->blankBefore = false;
}

// ---- blocks ----------------------------------------------------------------------------------------------

Block& Builder::block() {
  if (open_.empty()) return file_.body;
  Open& top = open_.back();
  if (auto* choice = std::get_if<If>(&top.statement.node))
    return choice->otherwise != nullptr ? *choice->otherwise : choice->parts.back().body;
  if (auto* touch = std::get_if<Touch>(&top.statement.node)) return *touch->otherwise;
  if (auto* repeat = std::get_if<Repeat>(&top.statement.node)) return repeat->body;
  if (auto* loop = std::get_if<For>(&top.statement.node)) return loop->body;
  return std::get<While>(top.statement.node).body;
}

void Builder::add(Statement statement) {
  attach(statement);
  statements().push_back(std::move(statement));
}

void Builder::open(Statement statement, SourceRange word, std::string name) {
  attach(statement);
  if (open_.size() >= limits_.nesting) {
    error<diag::NestingTooDeep>(word, limits_.nesting);
    statement.node = ErrorStatement{};
    statements().push_back(std::move(statement));
    return;
  }
  open_.push_back({std::move(statement), word, std::move(name)});
}

void Builder::close(SourceRange range, bool written) {
  if (open_.empty()) {
    error<diag::EndWithoutBlock>(range);
    return;
  }
  block().comments = commentsBefore(range.begin);
  Open done = std::move(open_.back());
  open_.pop_back();
  if (written) {
    done.statement.range.end = range.end;
    // A comment after `end` would be lost; it moves to the next statement.
  } else {
    error<diag::BlockNotClosed>(done.word, done.end);
  }
  statements().push_back(std::move(done.statement));
}

namespace {

// `if far then stop "Far" end`: the line closes what it opens.
bool closesItself(std::string_view line) {
  line = line.substr(0, line.find("//"));
  const std::size_t last = line.find_last_not_of(" \t\r\n;");
  line = line.substr(0, last == std::string_view::npos ? 0 : last + 1);
  constexpr std::string_view kEnd = "end";
  return line.ends_with(kEnd) && line.size() > kEnd.size() &&
         (line[line.size() - kEnd.size() - 1] == ' ' || line[line.size() - kEnd.size() - 1] == ';');
}

} // namespace

// A line that could not be read. One that was to open, continue or close a block, in the words of another
// language, does so all the same: the lines after it are where they belong.
void Builder::lost(SourceRange range) {
  std::string_view text = sources_.text(range);
  const auto word = [&] {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    const std::string_view found = text.substr(0, text.find_first_of(" \t\r\n=(\";"));
    text.remove_prefix(found.size());
    return std::string(found);
  };
  const auto missing = [&] {
    auto out = std::make_unique<Expression>();
    out->range = range;
    return out;
  };
  Statement out;
  out.range = range;
  const std::string first = lowerCase(word());
  if (isForeignEnd(first) && !open_.empty()) {
    close(range, true);
    return;
  }
  auto* const choice = open_.empty() ? nullptr : std::get_if<If>(&open_.back().statement.node);
  if (isForeignElseIf(first) && choice != nullptr && choice->otherwise == nullptr) {
    choice->parts.push_back({missing(), {}, {}});
    return;
  }
  // The cases of one choice go on with what its first line opened.
  const bool chooses = isForeignCase(first) && text.find("probe") == std::string_view::npos;
  if (chooses && choice != nullptr && choice->otherwise == nullptr && isForeignCase(open_.back().end)) {
    choice->parts.push_back({missing(), {}, {}});
    return;
  }
  if (first == "cycle" || first == "options") {
    const std::string name = word();
    out.node = Header{first == "options", {range, isName(name) ? name : proposeName(name)}, std::nullopt};
    add(std::move(out));
    return;
  }
  if (first == "if" || chooses) {
    If opened;
    opened.parts.push_back({missing(), {}, {}});
    out.node = std::move(opened);
  } else if (first == "repeat") {
    out.node = Repeat{missing(), {}};
  } else if (first == "while") {
    out.node = While{missing(), missing(), {}};
  } else if (first == "for") {
    For loop;
    loop.name = {range, word()};
    loop.first = missing();
    loop.last = missing();
    out.node = std::move(loop);
  } else if (first == "touch") {
    // What it was to find and its `else` are known.
    Touch touch;
    touch.value = missing();
    if (text.find(" along ") != std::string_view::npos) {
      Coordinate& part = touch.along.emplace_back();
      part.range = range;
      part.value = missing();
    }
    const std::size_t arrow = text.rfind("->");
    text.remove_prefix(arrow == std::string_view::npos ? text.size() : arrow + 2);
    if (std::string name = word(); isName(name)) touch.name = Name{range, std::move(name)};
    const bool goesOn = word() == "else";
    if (goesOn) touch.otherwise = std::make_unique<Block>();
    // Without a name after an arrow each word of the line may be the name.
    if (touch.name || goesOn) out.node = std::move(touch);
    if (!goesOn) {
      add(std::move(out));
      return;
    }
  } else {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    // A value that it was to give: what reads it is no further mistake.
    const bool finds =
        text.find("touch ") != std::string_view::npos || text.find("call ") != std::string_view::npos;
    if (isName(first) && text.starts_with('=') && !text.starts_with("==") && !finds)
      out.node = Assign{{range, first}, missing()};
    add(std::move(out));
    return;
  }
  if (closesItself(text)) {
    out.node = ErrorStatement{};
    add(std::move(out));
    return;
  }
  open(std::move(out), range, first);
}

void Builder::line(const ParseSession::Unit& unit) {
  if (unit.failed || unit.tree == nullptr) {
    file_.hasErrorNodes = true;
    lost(unit.range);
    return;
  }
  auto* line = dynamic_cast<Parser::LineContext*>(unit.tree);
  if (line != nullptr && line->statement() != nullptr) statement(*line->statement());
}

File Builder::finish() {
  const auto end = static_cast<std::uint32_t>(source_.bytes().size());
  while (!open_.empty())
    close({file_.file, end, end}, false);
  file_.body.comments = commentsBefore(end + 1);
  return std::move(file_);
}

// ---- the parser ------------------------------------------------------------------------------------------

const Header* File::header() const {
  for (const Statement& statement : body.statements)
    if (const auto* header = std::get_if<Header>(&statement.node)) return header;
  return nullptr;
}

namespace {

// What is declared by a word of the language, or by what is no name, is one mistake, wherever it is used.
void reportOnce(Diagnostics& found, const SourceMap& sources, Diagnostics& diagnostics) {
  std::set<std::string> declared, told;
  for (const Diagnostic& one : found.all())
    if (one.code == diag::WordAsName::code || one.code == diag::NameSpelling::code)
      declared.insert(std::string(sources.text(one.range)));
  for (Diagnostic& one : found.all()) {
    const std::string text(sources.text(one.range));
    if (one.code == diag::SyntaxError::code && declared.contains(text)) continue;
    if (one.code == diag::NameSpelling::code && !told.insert(text).second) continue;
    diagnostics.add(std::move(one));
  }
}

} // namespace

File parse(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& reported) {
  Diagnostics diagnostics;
  ByteStream bytes = openBytes(file, sources, limits, diagnostics);
  TokenReader reader(&bytes);
  const Language cycles = language();
  TokenBuffer tokens(reader, file, sources, cycles, limits, diagnostics);
  grammar::CycleParser parser(&tokens.stream());
  ParseSession session(parser, file, cycles, limits, diagnostics);
  Builder builder(file, sources, limits, diagnostics);
  builder.comments(tokens);
  while (!session.atEnd())
    builder.line(session.run([&] { return parser.line(); }));
  for (const std::size_t at : reader.tooLong()) {
    const auto place = static_cast<std::uint32_t>(at);
    diagnostics.report<diag::StatementTooLong>({file, place, place}, kStatementTokens);
  }
  for (const auto& [first, last] : reader.capitals()) {
    const SourceRange range{file, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last) + 1};
    std::string small = lowerCase(sources.text(range));
    Diagnostic& found = diagnostics.report<diag::WordInCapitals>(range, sources.textUtf8(range), small);
    found.fix = Fix{Fix::Applicability::Safe, "write `" + small + "`", {{range, small}}};
  }
  File out = builder.finish();
  reportOnce(diagnostics, sources, reported);
  return out;
}

std::string dumpTokens(FileId file, const SourceMap& sources, const Limits& limits,
                       Diagnostics& diagnostics) {
  ByteStream bytes = openBytes(file, sources, limits, diagnostics);
  TokenReader reader(&bytes);
  const Language cycles = language();
  const TokenBuffer tokens(reader, file, sources, cycles, limits, diagnostics);
  std::string out;
  for (const antlr4::Token* token : tokens.all()) {
    if (token->getType() == antlr4::Token::EOF) continue;
    const SourceRange range = rangeOf(file, *token);
    const LineColumn place = sources.file(file).place(range.begin);
    const std::string text =
        token->getType() == grammar::CycleLexer::NEWLINE ? "" : " " + sources.textUtf8(range);
    out += fmt::format("{}:{} {}{}\n", place.line, place.column,
                       reader.getVocabulary().getSymbolicName(token->getType()), text);
  }
  return out;
}

} // namespace dotek::frontend::cycle
