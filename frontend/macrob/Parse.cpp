#include "frontend/macrob/Parse.h"

#include "frontend/macrob/BuildAst.h"
#include "frontend/macrob/Lines.h"
#include "frontend/macrob/Listing.h"
#include "frontend/macrob/Misprints.h"
#include "frontend/macrob/Scan.h"
#include "frontend/macrob/Slips.h"
#include "frontend/macrob/Targets.h"
#include "support/Files.h"
#include "support/messages/Common.h"
#include "support/messages/MacroB.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <set>

namespace dotek::frontend::macrob {

using Lexer = grammar::MacroBLexer;
using Parser = grammar::MacroBParser;

namespace {

// Words of the body that precede a comment; of a macro statement 0 or 1.
void placeComments(Block& block, std::vector<Comment>&& comments) {
  block.comments = std::move(comments);
  for (Comment& comment : block.comments) {
    comment.place = 0;
    if (const auto* words = std::get_if<Words>(&block.body)) {
      for (const nc::Word& word : words->words)
        if (word.range.begin < comment.range.begin) ++comment.place;
    } else if (!std::holds_alternative<std::monostate>(block.body)) {
      std::uint32_t begin = block.range.begin;
      if (block.sequenceNumber)
        begin = block.sequenceNumber->range.end;
      else if (block.blockDelete)
        begin = block.blockDelete->range.end;
      comment.place = 0;
      const auto inFront = [&](SourceRange body) { return comment.range.begin < body.begin; };
      const bool before = std::visit(
          [&](const auto& body) {
            using T = std::decay_t<decltype(body)>;
            if constexpr (std::is_same_v<T, std::monostate> || std::is_same_v<T, Words>)
              return false;
            else if constexpr (std::is_same_v<T, Port>)
              return comment.range.begin == begin;
            else
              return inFront(body.range);
          },
          block.body);
      comment.place = before ? 0 : 1;
    }
  }
}

// A list without tokens is refused by the runtime.
std::vector<std::unique_ptr<antlr4::Token>> onlyEnd() {
  std::vector<std::unique_ptr<antlr4::Token>> out;
  out.push_back(std::make_unique<antlr4::CommonToken>(antlr4::Token::EOF));
  return out;
}

// Reads the blocks that are not plain.
class GrammarReader {
public:
  GrammarReader(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics,
                Lines& lines, Text text, Forms forms)
      : text_(text), forms_(forms), file_(file), source_(sources.file(file).bytes()),
        diagnostics_(diagnostics), lines_(lines), language_(language()), bytes_(lines.bytes),
        lexer_(&bytes_, lines.bytes), buffer_(lexer_, file, sources, language_, limits, problems_),
        emptySource_(onlyEnd()), emptyStream_(&emptySource_), parser_(&emptyStream_),
        session_(parser_, file, language_, limits, ignored_) {
    language_.explain = [this](std::size_t, const antlr4::Token& offending, const antlr4::Parser&) {
      offending_ = offending.getTokenIndex();
      return std::string();
    };
    for (const Diagnostic& problem : problems_.all())
      diagnostics_.add(problem);
  }

  // The block of a line; lines are asked for in their order.
  Block read(std::size_t index) {
    const Line& line = lines_.lines[index];
    std::vector<Tok> tokens = tokensOf(line);
    Block block;
    const auto cut = [&](SourceRange r) { return r.begin >= line.range.begin && r.begin < line.range.end; };
    const bool dropped = line.dropped.begin < line.dropped.end ||
                         std::any_of(buffer_.dropped().begin(), buffer_.dropped().end(), cut);
    if (dropped) {
      unread(block, line, tokens);
      return block;
    }
    const std::vector<Tok> written = tokens;
    Misprints misprints = repair(tokens, index, text_);
    std::optional<Diagnostic> error = parse(tokens, block, line.range.end);
    if (error && !line.reported) {
      if (auto slip = findSlip(written, file_, source_, line.range.end, index == 0)) {
        // What was repaired beside it is part of the same slip.
        error = std::move(slip);
        misprints.found.clear();
      }
    }
    if (error) {
      if (text_ == Text::Program) hintAtListing(*error, written, index);
      unread(block, line, tokens);
    } else {
      block.repaired = line.reported || !misprints.found.empty();
      for (Diagnostic& remark : misprints.remarks)
        diagnostics_.add(std::move(remark));
    }
    // A bad block is one error, whatever else is wrong in it.
    bool told = line.reported;
    if (error) {
      if (told) error->severity = Severity::Warning;
      diagnostics_.add(std::move(*error));
      told = true;
    }
    for (Diagnostic& misprint : misprints.found) {
      if (std::exchange(told, true)) misprint.severity = Severity::Warning;
      diagnostics_.add(std::move(misprint));
    }
    return block;
  }

private:
  Misprints repair(std::vector<Tok>& tokens, std::size_t index, Text text) {
    std::vector<Diagnostic> found;
    if (text == Text::Listing) {
      const std::set<std::uint32_t>* used = nullptr;
      found = repairListing(tokens, file_, source_, [&](std::uint32_t n) {
        if (used == nullptr) used = &variablesOf(index);
        return used->contains(n);
      });
    }
    Misprints out = repairMisprints(tokens, file_, source_, forms_);
    out.found.insert(out.found.end(), std::make_move_iterator(found.begin()),
                     std::make_move_iterator(found.end()));
    const auto before = [](const Diagnostic& a, const Diagnostic& b) {
      return a.range.begin < b.range.begin;
    };
    std::stable_sort(out.found.begin(), out.found.end(), before);
    return out;
  }

  // Says that the block can be read as one of a listing, if it can.
  void hintAtListing(Diagnostic& error, std::vector<Tok> tokens, std::size_t index) {
    const Line& line = lines_.lines[index];
    const bool legend = line.legend.begin < line.legend.end;
    if (legend)
      std::erase_if(tokens, [&](const Tok& tok) {
        return tok.begin >= line.legend.begin && tok.begin < line.legend.end;
      });
    std::vector<Tok> plain = tokens;
    if (!tokens.empty()) {
      const Misprints misprints = repair(tokens, index, Text::Listing);
      if (!legend && repair(plain, index, Text::Program).found.size() == misprints.found.size()) return;
      // Who types a program loses a bracket, too.
      if (!legend && std::all_of(misprints.found.begin(), misprints.found.end(), [](const Diagnostic& one) {
            return one.code == diag::BracketRestored::code;
          }))
        return;
      Block ignored;
      if (parse(tokens, ignored, line.range.end)) return;
    }
    error.note(error.range, "a program from a book or a scan? `--from listing` can read this block");
  }

  // The next line's visible tokens; lines are asked for in their order.
  std::vector<Tok> tokensOf(const Line& line) {
    std::vector<Tok> out;
    const std::vector<const antlr4::Token*>& all = buffer_.all();
    for (; next_ < all.size(); ++next_) {
      const antlr4::Token& token = *all[next_];
      if (token.getType() == antlr4::Token::EOF || token.getStartIndex() >= line.range.end) break;
      if (token.getStartIndex() < line.range.begin || token.getChannel() != antlr4::Token::DEFAULT_CHANNEL ||
          token.getType() == Lexer::EOL)
        continue;
      out.push_back(tokOf(token, lines_.bytes));
    }
    joinCommas(out);
    return out;
  }

  // `,C2.` `,R1.` `,A30.` are words with addresses of their own: a chamfer, a rounding, an angle.
  static void joinCommas(std::vector<Tok>& tokens) {
    int depth = 0;
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
      depth += tokens[i].type == Lexer::LBRACKET ? 1 : tokens[i].type == Lexer::RBRACKET ? -1 : 0;
      const Tok& next = tokens[i + 1];
      if (depth != 0 || tokens[i].type != Lexer::COMMA || next.type != Lexer::ADDRESS ||
          next.text.size() != 1 || std::string_view("ACR").find(next.text[0]) == std::string_view::npos ||
          i + 2 >= tokens.size())
        continue;
      tokens[i] = Tok{Lexer::ADDRESS, tokens[i].begin, next.end, "," + next.text};
      tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(i + 1));
    }
  }

  // Its number is kept: jumps may go there.
  void unread(Block& block, const Line& line, const std::vector<Tok>& tokens) {
    block = Block{};
    block.body =
        Unread{line.range, std::string(source_.substr(line.range.begin, line.range.end - line.range.begin))};
    if (tokens.size() < 2 || tokens[0].type != Lexer::ADDRESS_N || tokens[1].type != Lexer::NUMBER) return;
    const std::string& digits = tokens[1].text;
    if (digits.size() > 15 || digits.find('.') != std::string::npos) return;
    block.sequenceNumber =
        SequenceNumber{{file_, tokens[0].begin, tokens[1].end}, digits, std::stoull(digits)};
  }

  std::optional<Diagnostic> parse(const std::vector<Tok>& tokens, Block& block, std::uint32_t end) {
    std::vector<std::unique_ptr<antlr4::Token>> list;
    const auto add = [&](std::size_t type, std::uint32_t begin, std::uint32_t behind,
                         const std::string& text) {
      auto token = std::make_unique<antlr4::CommonToken>(
          std::pair<antlr4::TokenSource*, antlr4::CharStream*>(&lexer_, &bytes_), type,
          antlr4::Token::DEFAULT_CHANNEL, begin, static_cast<std::size_t>(behind) - 1);
      token->setText(text);
      list.push_back(std::move(token));
    };
    for (const Tok& tok : tokens)
      add(tok.type, tok.begin, tok.end, tok.text);
    add(antlr4::Token::EOF, end, end, "<EOF>");
    antlr4::ListTokenSource source(std::move(list));
    antlr4::CommonTokenStream stream(&source);
    parser_.setTokenStream(&stream);
    // Frees the tree as well.
    const auto release = [this](antlr4::TokenStream*) { parser_.setTokenStream(&emptyStream_); };
    const std::unique_ptr<antlr4::TokenStream, decltype(release)> guard(&stream, release);
    ignored_ = Diagnostics();
    offending_ = tokens.size();
    const ParseSession::Unit unit = session_.run([this] { return parser_.block(); });
    for (const Diagnostic& one : ignored_.all())
      if (one.code == diag::NestingTooDeep::code) return one;
    if (unit.failed || unit.tree == nullptr)
      return explainBlock(tokens, std::min(offending_, tokens.size()), file_, source_, end);
    Builder builder(file_, forms_);
    block = builder.block(*static_cast<Parser::BlockContext*>(unit.tree));
    return builder.error();
  }

  // Variables that the program of a line names by number.
  const std::set<std::uint32_t>& variablesOf(std::size_t index) {
    if (index >= used_.first && index < used_.last) return used_.variables;
    std::size_t first = index;
    while (first > 0 && !lines_.lines[first].header)
      --first;
    std::size_t last = index + 1;
    while (last < lines_.lines.size() && !lines_.lines[last].header)
      ++last;
    used_ = {first, last, {}};
    std::set<std::uint32_t>& used = used_.variables;
    const std::string_view text = source_.substr(
        lines_.lines[first].range.begin, lines_.lines[last - 1].range.end - lines_.lines[first].range.begin);
    for (std::size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at + 1)) {
      std::size_t digit = at + 1;
      while (digit < text.size() && (text[digit] == ' ' || text[digit] == '\t'))
        ++digit;
      std::uint32_t number = 0;
      std::size_t digits = 0;
      for (; digit < text.size() && std::isdigit(static_cast<unsigned char>(text[digit])) != 0 && digits < 6;
           ++digit, ++digits)
        number = number * 10 + static_cast<std::uint32_t>(text[digit] - '0');
      if (digits > 0 && (digit == text.size() || text[digit] != '.')) used.insert(number);
    }
    return used;
  }

  Text text_;
  Forms forms_;
  FileId file_;
  std::string_view source_;
  Diagnostics& diagnostics_;
  Lines& lines_;
  Language language_;
  ByteStream bytes_;
  TokenReader lexer_;
  Diagnostics problems_;
  TokenBuffer buffer_;
  antlr4::ListTokenSource emptySource_;
  antlr4::CommonTokenStream emptyStream_;
  Parser parser_;
  Diagnostics ignored_; // the session's own words; Explain.cpp has better ones
  ParseSession session_;
  std::size_t next_ = 0;
  std::size_t offending_ = 0;
  struct Used {                      // of the program that was asked for last
    std::size_t first = 0, last = 0; // its lines, without the last
    std::set<std::uint32_t> variables;
  };
  Used used_;
};

bool isOffsetSpeltAsLoop(const Block& block, std::uint32_t& loop) {
  const auto* words = std::get_if<Words>(&block.body);
  if (words == nullptr || words->words.size() != 1 || words->words[0].address != 'D') return false;
  const auto* number = std::get_if<nc::Number>(&words->words[0].value->node);
  if (number == nullptr || number->digits.size() != 2 || number->digits[0] != '0') return false;
  loop = static_cast<std::uint32_t>(number->digits[1] - '0');
  return loop >= 1 && loop <= 3;
}

// `D01` that an END 1 without DO 1 follows is `DO 1` with a zero.
void repairLoops(Program& program, Diagnostics& diagnostics) {
  int open[4] = {};
  const auto loopOf = [](const auto& statement) {
    return statement.loop && statement.loop->value <= 3 ? statement.loop->value : 0;
  };
  for (std::size_t i = 0; i < program.blocks.size(); ++i) {
    Block& block = program.blocks[i];
    if (const auto* loop = std::get_if<Do>(&block.body)) ++open[loopOf(*loop)];
    if (const auto* end = std::get_if<End>(&block.body)) --open[loopOf(*end)];
    std::uint32_t loop = 0;
    if (!isOffsetSpeltAsLoop(block, loop) || open[loop] > 0) continue;
    bool closes = false;
    for (std::size_t j = i + 1; j < program.blocks.size() && !closes; ++j) {
      const auto* other = std::get_if<Do>(&program.blocks[j].body);
      const auto* end = std::get_if<End>(&program.blocks[j].body);
      if (other != nullptr && loopOf(*other) == loop) break;
      closes = end != nullptr && loopOf(*end) == loop;
    }
    if (!closes) continue;
    const SourceRange range = std::get<Words>(block.body).words[0].range;
    diagnostics.report<diag::DoAsOffset>(range, loop).fix = Fix{
        Fix::Applicability::Display, fmt::format("write `DO{}`", loop), {{range, fmt::format("DO{}", loop)}}};
    const SourceRange digit{range.file, range.end - 1, range.end};
    block.body = Do{range, nullptr, LoopNumber{digit, std::to_string(loop), loop}};
    for (Comment& comment : block.comments)
      comment.place = std::min(comment.place, 1u);
    block.repaired = true;
    ++open[loop];
  }
}

bool isBare(const Block& block) {
  return std::holds_alternative<std::monostate>(block.body) && !block.sequenceNumber && !block.blockDelete;
}

} // namespace

namespace {

// Misprints of text recognition with one certain repair. Who says that a file is a listing says that its text
// is not the one that ran, so `lint --fix` may write what did.
void repairListing(FileId file, std::size_t from, Diagnostics& diagnostics) {
  static constexpr std::string_view kCertain[] = {
      "letter-o-for-zero",
      "zero-for-letter-o",
      "decimal-comma",
      "do-as-offset",
      "condition-bracket-missing",
      "word-needs-brackets",
      "bracketed-assignment",
      "degree-sign",
      "block-over-lines",
      "comment-over-lines",
      "star-for-hash",
      "variable-number-form",
      "stray-if",
      "six-for-letter-g",
      "hash-lost",
      "bracket-restored",
      "small-letter",
  };
  for (std::size_t i = from; i < diagnostics.all().size(); ++i) {
    Diagnostic& one = diagnostics.all()[i];
    // `l` and `o` may be digits.
    const bool digit = one.code == "small-letter" && one.fix &&
                       one.fix->edits.front().text.find_first_of("LOI") != std::string::npos;
    if (one.fix && one.range.file == file && !digit &&
        std::find(std::begin(kCertain), std::end(kCertain), one.code) != std::end(kCertain))
      one.fix->applicability = Fix::Applicability::Safe;
  }
}

} // namespace

namespace {

// Memory that a file takes, as measured for blocks of many kinds: the tree, and what rules and the IR make of
// it.
class Kept {
public:
  Kept(std::size_t text, std::uint64_t limit) : bytes_(kKeptOfText * text), limit_(limit) {}

  // `length`: of the line. `scanned`: the block, where the grammar is not needed.
  void add(std::size_t length, const Block* scanned) {
    constexpr std::uint64_t kBlock = 500, kWord = 400, kByte = 60;
    constexpr std::uint64_t kGrammarByte = 240; // each may be a token and two nodes
    const auto* words = scanned == nullptr ? nullptr : std::get_if<Words>(&scanned->body);
    bytes_ += kBlock + (words != nullptr     ? kWord * words->words.size()
                        : scanned != nullptr ? kByte * length
                                             : kGrammarByte * length);
  }
  bool isTooMuch() const { return bytes_ > limit_; }

private:
  std::uint64_t bytes_, limit_;
};

} // namespace

File parse(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics, Text text,
           Reader reader, Forms forms, Keep keep) {
  const std::size_t reported = diagnostics.all().size();
  File out;
  out.file = file;
  Kept kept(sources.file(file).bytes().size(), limits.keptBytes);
  const auto tooLarge = [&](SourceRange from) {
    diagnostics.report<diag::FileTooLarge>(from, sources.file(file).name(), limits.keptBytes);
    File none;
    none.file = file;
    none.hasErrors = none.tooLarge = true;
    return none;
  };
  if (kept.isTooMuch()) return tooLarge({file, 0, 0});
  Lines lines = splitLines(file, sources, limits, diagnostics, text, keep);
  out.leftOut = lines.leftOut;
  out.markFirst = lines.markFirst;
  out.markLast = lines.markLast;
  out.leader = lines.leader;
  out.legends = std::move(lines.legends);

  std::vector<std::optional<Block>> blocks(lines.lines.size());
  bool all = true;
  for (std::size_t i = 0; i < lines.lines.size(); ++i) {
    const Line& line = lines.lines[i];
    const bool whole = line.dropped.begin == line.dropped.end;
    const std::size_t length = line.range.end - line.range.begin;
    if (whole && reader == Reader::Fast)
      blocks[i] = scanBlock(std::string_view(lines.bytes).substr(line.range.begin, length), line.range,
                            limits, text == Text::Program);
    kept.add(length, blocks[i] ? &*blocks[i] : nullptr);
    if (kept.isTooMuch()) return tooLarge({file, line.range.begin, line.range.begin + 1});
    if (!blocks[i]) {
      all = false;
      continue;
    }
    blocks[i]->repaired = line.reported;
    std::fill(lines.bytes.begin() + line.range.begin, lines.bytes.begin() + line.end, ' ');
  }
  if (!all) {
    for (const SourceRange& stretch : lines.stretches)
      std::fill(lines.bytes.begin() + stretch.begin, lines.bytes.begin() + stretch.end, ' ');
    GrammarReader grammar(file, sources, limits, diagnostics, lines, text, forms);
    for (std::size_t i = 0; i < blocks.size(); ++i)
      if (!blocks[i]) blocks[i] = grammar.read(i);
  }

  for (std::size_t i = 0; i < blocks.size(); ++i) {
    Line& line = lines.lines[i];
    Block& block = *blocks[i];
    block.range = line.range;
    const bool header = line.header.has_value();
    if (header && !out.programs.empty()) {
      out.programs.back().closed = true;
      out.programs.back().blocks.shrink_to_fit(); // of many programs the room that is left over adds up
    }
    if (header || out.programs.empty()) out.programs.emplace_back();
    Program& program = out.programs.back();
    if (header) program.name = std::move(line.header);
    out.hasErrors = out.hasErrors || block.repaired || std::holds_alternative<Unread>(block.body);
    if (header && isBare(block)) {
      program.comments = std::move(line.comments);
      continue;
    }
    placeComments(block, std::move(line.comments));
    program.blocks.push_back(std::move(block));
  }
  if (!out.programs.empty() && out.markLast) out.programs.back().closed = true;
  for (Program& program : out.programs) {
    const std::size_t before = diagnostics.all().size();
    repairLoops(program, diagnostics);
    out.hasErrors = out.hasErrors || diagnostics.all().size() != before;
  }
  if (text == Text::Listing) repairListing(file, reported, diagnostics);
  markTargets(out);
  return out;
}

} // namespace dotek::frontend::macrob
