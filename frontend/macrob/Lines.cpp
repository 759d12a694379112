#include "frontend/macrob/Lines.h"

#include "frontend/macrob/Legend.h"
#include "frontend/macrob/Remarks.h"
#include "frontend/macrob/Stretch.h"
#include "support/Ascii.h"
#include "support/LineEnds.h"
#include "support/messages/Common.h"
#include "support/messages/MacroB.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <utility>

namespace dotek::frontend::macrob {
namespace {

// A comment that was broken in print goes over this many lines at most.
constexpr int kMostCommentLines = 3;

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
bool isEnd(char c) {
  return c == '\n' || c == '\r';
}
bool isOperator(char c) {
  return c == '*' || c == '/' || c == '+' || c == '-';
}
class Splitter {
public:
  Splitter(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics, Text text,
           Keep keep)
      : file_(file), limits_(limits), diagnostics_(diagnostics), text_(text),
        summary_(keep == Keep::Summary && text == Text::Program),
        jumps_(summary_ && mayJump(sources.file(file).bytes())), modes_(jumps_) {
    out_.bytes = sources.file(file).bytes();
  }

  Lines run() {
    while (at_ < out_.bytes.size())
      line();
    marks();
    reportRemarks();
    return std::move(out_);
  }

private:
  std::string& bytes() { return out_.bytes; }
  SourceRange range(std::size_t begin, std::size_t end) const {
    return {file_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  }
  void blank(std::size_t begin, std::size_t end) {
    std::fill(bytes().begin() + static_cast<std::ptrdiff_t>(begin),
              bytes().begin() + static_cast<std::ptrdiff_t>(end), ' ');
  }
  std::size_t endOfLine(std::size_t from) const { return dotek::endOfLine(out_.bytes, from); }
  std::size_t nextLine(std::size_t end) const {
    if (end >= out_.bytes.size()) return end;
    return end +
           (out_.bytes[end] == '\r' && end + 1 < out_.bytes.size() && out_.bytes[end + 1] == '\n' ? 2 : 1);
  }
  std::size_t skipBlanks(std::size_t from, std::size_t end) const {
    while (from < end && isBlank(out_.bytes[from]))
      ++from;
    return from;
  }

  // ---- one block

  // Takes a stretch of plain moves. false: none begins here.
  bool stretch() {
    if (!summary_ || !modes_.absolute() || legendBefore_ || at_ < looked_) return false;
    const Stretch found(bytes(), at_, !jumps_);
    looked_ = found.looked();
    if (found.end() == at_) return false;
    out_.stretches.push_back(range(at_, found.end()));
    out_.leftOut.blocks += found.leftOut().blocks;
    out_.leftOut.lengths += found.leftOut().lengths;
    for (const TextLine& one : found.kept()) {
      const std::size_t begin = skipBlanks(one.begin, one.end);
      std::size_t end = one.end;
      while (end > begin && (isBlank(bytes()[end - 1]) || isEnd(bytes()[end - 1])))
        --end;
      Line line;
      line.range = range(begin, end);
      line.end = static_cast<std::uint32_t>(one.end);
      out_.lines.push_back(std::move(line));
    }
    at_ = found.end();
    return true;
  }

  void line() {
    if (stretch()) return;
    Line line;
    std::size_t begin = at_;
    std::size_t end = at_;
    if (!tooLong(line, begin)) {
      end = cut(line, begin);
      if (summary_) followModes(begin, end);
      begin = skipBlanks(begin, end);
      while (end > begin && isBlank(bytes()[end - 1]))
        --end;
      line.range = range(begin, end);
      if (begin < end && bytes()[begin] == '%') {
        percents_.push_back(range(begin, begin + 1));
        blank(begin, begin + 1);
        begin = skipBlanks(begin + 1, end);
        line.range = range(begin, end);
      }
      if (begin == end) return;
      if (header(line)) headers_.push_back(out_.lines.size());
      legend(line);
      if (line.range.begin == line.range.end && !line.header) return;
    }
    line.end = static_cast<std::uint32_t>(at_);
    out_.lines.push_back(std::move(line));
  }

  void followModes(std::size_t begin, std::size_t end) {
    const std::size_t first = skipBlanks(begin, end);
    const char c = first < end ? upperCase(bytes()[first]) : '\0';
    modes_.pass(std::string_view(bytes()).substr(begin, end - begin),
                c == 'O' || c == ':' || c == '<' || c == '%');
  }

  bool tooLong(Line& line, std::size_t begin) {
    const std::size_t end = endOfLine(begin);
    if (end - begin <= limits_.lineBytes) return false;
    diagnostics_.report<diag::LineTooLong>(range(begin, begin + 1), end - begin, limits_.lineBytes);
    blank(begin, end);
    line.range = line.dropped = range(begin, end);
    line.reported = true;
    at_ = nextLine(end);
    return true;
  }

  // Moves at_ after the end of the block that begins at `begin`; gives where its text ends.
  std::size_t cut(Line& line, std::size_t begin) {
    std::size_t at = begin;
    while (true) {
      int open = 0;
      std::size_t last = std::string::npos; // last byte that is neither blank nor comment
      for (; at < bytes().size() && !isEnd(bytes()[at]); ++at) {
        const char c = bytes()[at];
        if ((c == ';' || c == '/') && remark(at)) {
          at = endOfLine(at);
          break;
        }
        if (c == ';') break;
        if (c == '(') {
          at = comment(line, at);
          continue;
        }
        if (isBlank(c)) continue;
        last = at;
        open += c == '[' ? 1 : c == ']' ? -1 : 0;
      }
      if (at < bytes().size() && bytes()[at] == ';') {
        at_ = at + 1;
        return at;
      }
      at_ = nextLine(at);
      if (open <= 0 || last == std::string::npos || !isOperator(bytes()[last]) ||
          !joins(line, last, static_cast<std::size_t>(open)))
        return at;
    }
  }

  // Takes a comment as other controls write it out of the text.
  bool remark(std::size_t at) {
    const std::size_t end = endOfLine(at);
    const std::size_t signs = remarkAt(std::string_view(bytes()).substr(0, end), at);
    if (signs == 0) return false;
    if (remarks_++ == 0) {
      firstRemark_ = range(at, at + signs);
      remarkSign_ = bytes().substr(at, signs);
    }
    blank(at, end);
    return true;
  }

  void reportRemarks() {
    if (remarks_ == 0) return;
    const std::string more = remarks_ == 1 ? "" : fmt::format(", and on {} more lines", remarks_ - 1);
    diagnostics_.report<diag::CommentSign>(firstRemark_, remarkSign_, more);
  }

  // Gives the place of the closing bracket (or of the last byte that belongs to the comment).
  std::size_t comment(Line& line, std::size_t open) {
    std::size_t end = endOfLine(open);
    const std::size_t close = bracketIn(")", open, end);
    if (close < end) {
      line.comments.push_back({range(open, close + 1), bytes().substr(open + 1, close - open - 1), 0});
      return close;
    }
    const std::size_t firstEnd = end;
    for (int i = 1; i < kMostCommentLines && end < bytes().size(); ++i) {
      const std::size_t start = skipBlanks(nextLine(end), bytes().size());
      end = endOfLine(start);
      if (end - start > limits_.lineBytes || (start < end && bytes()[start] == '%')) break;
      const std::size_t bracket = bracketIn("()", start, end);
      if (bracket == end) continue;
      if (bytes()[bracket] == '(') break;
      return brokenComment(line, open, firstEnd, bracket);
    }
    diagnostics_.report<diag::OpenComment>(range(open, open + 1));
    line.reported = true;
    blank(open, firstEnd);
    return firstEnd - 1;
  }

  // The first of one or two brackets from `from` on; `end` where there is none before it.
  std::size_t bracketIn(std::string_view brackets, std::size_t from, std::size_t end) {
    const auto isOne = [&](char c) { return c == brackets.front() || c == brackets.back(); };
    const auto first = bytes().begin();
    return static_cast<std::size_t>(std::find_if(first + static_cast<std::ptrdiff_t>(from),
                                                 first + static_cast<std::ptrdiff_t>(end), isOne) -
                                    first);
  }

  std::size_t brokenComment(Line& line, std::size_t open, std::size_t firstEnd, std::size_t close) {
    Fix fix{Fix::Applicability::Display, "write the comment on one line", {}};
    std::string text;
    for (std::size_t at = open + 1; at < close; ++at) {
      if (!isEnd(bytes()[at])) {
        text += bytes()[at];
        continue;
      }
      const std::size_t next = skipBlanks(nextLine(at), close);
      while (!text.empty() && isBlank(text.back()))
        text.pop_back();
      text += ' ';
      fix.edits.push_back({range(at, next), " "});
      blank(at, next);
      at = next - 1;
    }
    diagnostics_.report<diag::CommentOverLines>(range(open, firstEnd)).fix = std::move(fix);
    line.comments.push_back({range(open, close + 1), std::move(text), 0});
    return close;
  }

  // A block that was broken after an operator, as books do: the next line closes its brackets.
  bool joins(Line& line, std::size_t last, std::size_t open) {
    const std::size_t start = skipBlanks(at_, bytes().size());
    const std::size_t end = endOfLine(start);
    if (start == end || bytes()[start] == '%' || end - start > limits_.lineBytes) return false;
    std::int64_t balance = static_cast<std::int64_t>(open);
    for (std::size_t at = start; at < end; ++at)
      balance += bytes()[at] == '[' ? 1 : bytes()[at] == ']' ? -1 : 0;
    if (balance != 0) return false;
    const char op = bytes()[last];
    const bool doubled = bytes()[start] == op;
    const std::size_t behind = doubled ? skipBlanks(start + 1, end) : start;
    diagnostics_.report<diag::BlockOverLines>(range(last, last + 1)).fix =
        Fix{Fix::Applicability::Display, "write the block on one line", {{range(last + 1, behind), " "}}};
    line.reported = true;
    blank(last + 1, behind);
    return true;
  }

  // ---- headers, texts of drawings

  bool header(Line& line) {
    const std::size_t end = line.range.end;
    std::size_t at = line.range.begin;
    ProgramName name;
    const char first = bytes()[at];
    if (first == '<') {
      std::size_t close = at + 1;
      while (close < end && (std::isalnum(static_cast<unsigned char>(bytes()[close])) != 0 ||
                             std::string_view("+-._").find(bytes()[close]) != std::string_view::npos))
        ++close;
      if (close >= end || bytes()[close] != '>' || close == at + 1) return false;
      name.kind = ProgramName::Kind::Name;
      name.text = bytes().substr(at + 1, close - at - 1);
      at = close + 1;
    } else if (first == 'O' || first == 'o' || first == ':') {
      name.kind = first == ':' ? ProgramName::Kind::Colon : ProgramName::Kind::Number;
      std::size_t digits = skipBlanks(at + 1, end);
      std::size_t behind = digits;
      while (behind < end && isDigit(bytes()[behind]))
        ++behind;
      if (behind == digits || behind - digits > 12) return false;
      name.text = bytes().substr(digits, behind - digits);
      name.number = std::stoull(name.text);
      at = behind;
    } else {
      return false;
    }
    name.range = range(line.range.begin, at);
    if (first == 'o') {
      const SourceRange letter = range(line.range.begin, line.range.begin + 1);
      diagnostics_.report<diag::SmallLetter>(letter, "o").fix =
          Fix{Fix::Applicability::Display, "write capitals", {{letter, "O"}}};
    }
    blank(line.range.begin, at);
    line.range = range(skipBlanks(at, end), end);
    line.header = std::move(name);
    return true;
  }

  std::string withoutComments(const Line& line) const {
    std::string text = out_.bytes.substr(line.range.begin, line.range.end - line.range.begin);
    for (const Comment& one : line.comments)
      std::fill_n(text.begin() + (one.range.begin - line.range.begin), one.range.end - one.range.begin, ' ');
    return text;
  }

  // Finds what a listing explains beside its blocks, and takes it out where the file is one.
  void legend(Line& line) {
    const bool behindLegend = legendBefore_;
    legendBefore_ = false;
    const std::string_view whole =
        std::string_view(bytes()).substr(line.range.begin, line.range.end - line.range.begin);
    if (!behindLegend && whole.find('#') == std::string_view::npos) return;
    const std::string text = withoutComments(line);
    std::size_t begin = findLegend(text);
    if (begin == std::string::npos && behindLegend && isPlainText(text))
      begin = text.find_first_not_of(" \t");
    if (begin == std::string::npos) return;
    legendBefore_ = true;
    const std::size_t end = text.find_last_not_of(" \t") + 1;
    const SourceRange where = range(line.range.begin + begin, line.range.begin + end);
    line.legend = where;
    if (text_ != Text::Listing) return;
    diagnostics_.report<diag::LegendLine>(where);
    out_.legends.push_back(where);
    blank(where.begin, where.end);
    // A line without anything else is no block.
    if (!line.header && line.comments.empty() && text.find_first_not_of(" \t") == begin)
      line.range.end = line.range.begin;
  }

  // ---- %

  void marks() {
    if (percents_.empty()) return;
    std::vector<Line>& lines = out_.lines;
    const std::uint32_t first = percents_.front().begin;
    const auto behindFirst = static_cast<std::size_t>(
        std::find_if(lines.begin(), lines.end(), [&](const Line& l) { return l.range.begin > first; }) -
        lines.begin());
    std::size_t next = 0; // the first mark that ends something
    if (behindFirst < lines.size() && (headers_.empty() || headers_.front() >= behindFirst)) {
      out_.markFirst = true;
      next = 1;
      if (behindFirst > 0) skipLeader(behindFirst);
    }
    for (; next < percents_.size(); ++next) {
      const std::uint32_t place = percents_[next].begin;
      if (lines.empty() || lines.back().range.begin < place) {
        out_.markLast = true;
      } else if (!std::exchange(told_, true)) {
        // Two marks may meet where files were put together.
        diagnostics_.report<diag::TextBehindEnd>(percents_[next]);
      }
    }
  }

  void skipLeader(std::size_t count) {
    std::vector<Line>& lines = out_.lines;
    out_.leader = spanning(lines.front().range, lines[count - 1].range);
    diagnostics_.report<diag::TextBeforeStart>(out_.leader);
    blank(out_.leader.begin, out_.leader.end);
    lines.erase(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(count));
  }

  FileId file_;
  const Limits& limits_;
  Diagnostics& diagnostics_;
  Text text_;
  Lines out_;
  bool summary_, jumps_;
  TextModes modes_;
  std::size_t at_ = 0;
  std::size_t looked_ = 0; // no stretch begins before it
  bool legendBefore_ = false;
  bool told_ = false;
  std::size_t remarks_ = 0;
  SourceRange firstRemark_;
  std::string remarkSign_;
  std::vector<SourceRange> percents_;
  std::vector<std::size_t> headers_; // lines with one
};

} // namespace

Lines splitLines(FileId file, const SourceMap& sources, const Limits& limits, Diagnostics& diagnostics,
                 Text text, Keep keep) {
  return Splitter(file, sources, limits, diagnostics, text, keep).run();
}

} // namespace dotek::frontend::macrob
