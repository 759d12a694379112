#include "frontend/mikroprog/Parse.h"

#include "support/Decimal.h"
#include "support/Files.h"
#include "support/messages/Common.h"
#include "support/messages/Mikroprog.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fmt/format.h>

namespace dotek::frontend::mikroprog {

namespace {

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}
bool isLetter(char c) {
  return c >= 'A' && c <= 'Z';
}

// What a Fanuc program would have here; "" for none.
std::string_view fanucSyntax(std::string_view text) {
  if (text.empty()) return "";
  switch (text[0]) {
  case '(': return "a comment begins with `;`";
  case '%': return "a program has no `%`";
  case '#': return "parameters are P0, P1, ..";
  case '[':
  case ']': return "brackets are not known to exist";
  case '/': return "blocks cannot be switched off";
  default: break;
  }
  for (const std::string_view word : {"IF", "WHILE", "GOTO", "THEN", "DO", "END"})
    if (text.starts_with(word)) return "jumps are G23, G27 and the L of other functions";
  return "";
}

// The room of its words is kept.
void clear(Line& line) {
  Line empty;
  empty.words.swap(line.words);
  empty.firsts.swap(line.firsts);
  empty.words.clear();
  empty.firsts.clear();
  line = std::move(empty);
}

class LineReader {
public:
  // Into `line`, whose room serves one line after the other.
  LineReader(FileId file, std::uint32_t begin, std::string_view text, Diagnostics& diagnostics, Line& line)
      : file_(file), begin_(begin), text_(text), diagnostics_(diagnostics), line_(line) {
    clear(line);
  }

  void read() {
    line_.range = {file_, begin_, begin_ + static_cast<std::uint32_t>(text_.size())};
    // First, so that a line that cannot be read keeps its comment.
    if (const std::size_t comment = text_.find(';'); comment != std::string_view::npos) {
      line_.commentRange = range(comment, text_.size());
      line_.comment = std::string(text_.substr(comment + 1));
    }
    blanks();
    if (at('N') && isDigit(peek(1))) {
      const std::size_t from = at_++;
      const auto number = digits();
      line_.numberRange = range(from);
      if (!number) {
        fail(line_.numberRange);
        return;
      }
      line_.number = number;
    }
    for (blanks(); at_ < text_.size() && text_[at_] != ';'; blanks())
      if (!item()) return;
  }

private:
  char peek(std::size_t ahead) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  bool at(char c) const { return at_ < text_.size() && text_[at_] == c; }
  void blanks() {
    while (at(' ') || at('\t'))
      ++at_;
  }
  SourceRange range(std::size_t from, std::size_t to) const {
    return {file_, begin_ + static_cast<std::uint32_t>(from), begin_ + static_cast<std::uint32_t>(to)};
  }
  SourceRange range(std::size_t from) const { return range(from, at_); }

  std::optional<std::uint64_t> digits() {
    const std::size_t from = at_;
    while (isDigit(peek(0)))
      ++at_;
    std::uint64_t out = 0;
    const auto result = std::from_chars(text_.data() + from, text_.data() + at_, out);
    if (result.ec != std::errc() || at_ - from > 9) return std::nullopt;
    return out;
  }

  // The text up to the next blank or comment, for messages.
  SourceRange rest(std::size_t from) const {
    std::size_t to = from + 1;
    while (to < text_.size() && text_[to] != ' ' && text_[to] != ';')
      ++to;
    return range(from, std::min(to, text_.size()));
  }

  bool fail(SourceRange where) { // false
    line_.unread = true;
    const std::string_view text = text_.substr(where.begin - begin_, where.end - where.begin);
    const std::string shown = toUtf8(text, isUtf8(text) ? Encoding::Utf8 : Encoding::Cp852);
    if (const std::string_view why = fanucSyntax(text); !why.empty())
      diagnostics_.report<diag::SufOtherControl>(where, shown, why);
    else
      diagnostics_.report<diag::SufWord>(where, shown, advice(text));
    return false;
  }

  static std::string advice(std::string_view word) {
    if (word.size() > 1 && word[0] >= 'a' && word[0] <= 'z' &&
        word.find_first_of("0123456789") != word.npos) {
      std::string capitals(word);
      for (char& c : capitals)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
      return fmt::format("whether small letters are addresses is not known (Q5); write `{}`", capitals);
    }
    return "a block holds addresses with numbers, `P1=value`, `@file` and a comment after `;`";
  }

  // `X 10`: where a number follows the blanks, the rest of the line is read as if they were not there.
  bool apart(std::size_t from) {
    const std::size_t end = at_;
    blanks();
    Value out;
    if (at_ == end || !value(out)) {
      at_ = end;
      return false;
    }
    line_.unread = true;
    diagnostics_.report<diag::SufWord>(
        range(from), text_.substr(from, at_ - from),
        fmt::format("whether blanks may be between an address and its number is not known (Q1); write `{}{}`",
                    text_[from], text_.substr(at_ - out.digits.size(), out.digits.size())));
    return true;
  }

  bool item() {
    const std::size_t from = at_;
    if (at('@')) {
      ++at_;
      while (at_ < text_.size() && text_[at_] != ';' && text_[at_] != ' ' && text_[at_] != '\t')
        ++at_;
      Word word;
      word.address = '@';
      word.file = std::string(text_.substr(from + 1, at_ - from - 1));
      word.range = range(from);
      if (word.file.empty()) return fail(rest(from));
      line_.add(std::move(word));
      return true;
    }
    if (!isLetter(peek(0)) || !fanucSyntax(text_.substr(at_)).empty()) return fail(rest(from));
    if (at('P') && isDigit(peek(1))) {
      ++at_;
      const auto number = digits();
      blanks();
      if (number && at('=')) return assignment(from, static_cast<std::uint32_t>(*number));
      at_ = from;
    }
    Word word;
    word.address = text_[at_++];
    if ((at(' ') || at('\t')) && apart(from)) return true;
    if (!value(word.value)) return fail(rest(from));
    word.range = range(from);
    line_.add(std::move(word));
    return true;
  }

  // A number or a parameter, with its sign.
  bool value(Value& out) {
    const std::size_t from = at_;
    if (at('-') || at('+')) out.negative = text_[at_++] == '-';
    if (at('P')) {
      ++at_;
      const auto number = digits();
      if (!number) return false;
      out.parameter = static_cast<std::uint32_t>(*number);
      out.digits = std::string(text_.substr(from, at_ - from));
      return true;
    }
    while (isDigit(peek(0)) || at('.'))
      ++at_;
    out.digits = std::string(text_.substr(from, at_ - from));
    out.negative = false; // the number has its sign
    out.number = parseNumber(out.digits.starts_with('+') ? out.digits.substr(1) : out.digits);
    return out.number.has_value();
  }

  bool assignment(std::size_t from, std::uint32_t parameter) {
    Assignment out;
    out.parameter = parameter;
    ++at_; // =
    char op = '+';
    for (;;) {
      blanks();
      Term term;
      term.op = op;
      const std::size_t begin = at_;
      if (!value(term.value)) return fail(rest(begin < text_.size() ? begin : from));
      term.range = range(begin);
      out.terms.push_back(std::move(term));
      blanks();
      if (!at('+') && !at('-') && !at('*') && !at('/')) break;
      op = text_[at_++];
    }
    out.range = range(from);
    if (line_.assignment || !line_.words.empty()) return fail(out.range);
    line_.assignment = std::move(out);
    return true;
  }

  FileId file_;
  std::uint32_t begin_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  Line& line_;
};

std::string place(const SourceMap& sources, SourceRange range) {
  const LineColumn at = sources.file(range.file).place(range.begin);
  return fmt::format("{}:{}", at.line, at.column);
}

} // namespace

void Line::add(Word word) {
  if (find(word.address) == nullptr)
    firsts.push_back({word.address, static_cast<std::uint32_t>(words.size())});
  addresses |= bitOf(word.address);
  words.push_back(std::move(word));
}

namespace {

// Memory of a line with its words, and of what checks make of it.
constexpr std::uint64_t kOfLine = 600, kOfWord = 150;

std::string_view lineOf(const SourceFile& source, std::uint32_t number) {
  std::string_view text = source.line(number);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\x1a'))
    text.remove_suffix(1);
  return text;
}

// Coordinates are distances from here on, or X is a radius: the place of the tool is a sum, or what X means
// is asked of each.
bool changesX(const Line& line) {
  return std::any_of(line.words.begin(), line.words.end(), [](const Word& word) {
    return word.address == 'G' && (word.value.number == 91.0 || word.value.number == 24.0);
  });
}

} // namespace

Program parse(FileId file, const SourceMap& sources, Diagnostics& diagnostics, const Limits& limits,
              const Keeping& keeping) {
  const SourceFile& source = sources.file(file);
  Program out;
  out.file = file;
  std::vector<std::string_view> texts;
  texts.reserve(source.lineCount());
  for (std::uint32_t number = 1; number <= source.lineCount(); ++number)
    texts.push_back(lineOf(source, number));
  std::vector<bool> left;
  if (!keeping.axes.empty() && source.bytes().size() >= keeping.from) left = leftOut(texts, keeping.axes);
  if (left.empty()) out.lines.reserve(source.lineCount());
  std::uint64_t kept = kKeptOfText * source.bytes().size();
  Line line;
  for (std::uint32_t number = 1; number <= source.lineCount(); ++number) {
    const std::string_view text = texts[number - 1];
    if (text.empty() || (!left.empty() && left[number - 1])) continue;
    LineReader(file, source.lineStart(number), text, diagnostics, line).read();
    kept += kOfLine + kOfWord * line.words.size();
    if (kept > limits.keptBytes) {
      diagnostics.report<diag::FileTooLarge>(line.range, source.name(), limits.keptBytes);
      out.lines.clear();
      return out;
    }
    if (!left.empty() && changesX(line)) left.clear();
    out.lines.push_back(line); // a copy has no more room than it needs
  }
  return out;
}

std::string dumpTokens(const Program& program, const SourceMap& sources) {
  std::string out;
  const auto token = [&](SourceRange range, std::string_view kind) {
    out += fmt::format("{} {} {}\n", place(sources, range), kind, sources.textUtf8(range));
  };
  for (const Line& line : program.lines) {
    if (line.number) token(line.numberRange, "number");
    if (line.assignment) token(line.assignment->range, "assignment");
    for (const Word& word : line.words)
      token(word.range, word.address == '@' ? "file" : "word");
    if (line.comment) token(line.commentRange, "comment");
    if (line.unread) token(line.range, "unread");
  }
  return out;
}

std::string dumpAst(const Program& program, const SourceMap& sources) {
  std::string out = "program\n";
  for (const Line& line : program.lines) {
    out += fmt::format("  line {}", place(sources, line.range));
    if (line.unread) out += " unread";
    if (line.number) out += fmt::format(" N{}", *line.number);
    if (line.assignment) {
      out += fmt::format(" set P{} =", line.assignment->parameter);
      for (const Term& term : line.assignment->terms)
        out += fmt::format(" {} {}", term.op, term.value.digits);
    }
    for (const Word& word : line.words) {
      if (word.address == '@')
        out += " file " + word.file;
      else
        out += fmt::format(" {}={}", word.address, word.value.digits);
    }
    if (line.comment)
      out += " comment \"" +
             sources.textUtf8({line.commentRange.file, line.commentRange.begin + 1, line.commentRange.end}) +
             "\"";
    out += "\n";
  }
  return out;
}

} // namespace dotek::frontend::mikroprog
