#include "support/Diagnostics.h"
#include "support/Printable.h"

#include <algorithm>
#include <vector>

namespace dotek {
namespace {

constexpr std::size_t kShownColumns = 160;

// The last line that an excerpt was cut from: findings in one long line decode it once.
class ShownLine {
public:
  void take(const SourceFile& file, std::uint32_t line) {
    if (file_ == &file && line_ == line) return;
    file_ = &file;
    line_ = line;
    text_ = printable(file.lineUtf8(line));
    starts_.clear();
    for (std::size_t i = 0; i < text_.size(); ++i)
      if ((text_[i] & 0xC0) != 0x80) starts_.push_back(static_cast<std::uint32_t>(i));
  }
  std::size_t length() const { return starts_.size(); } // in characters
  std::string part(std::size_t from, std::size_t count) const {
    const std::size_t begin = byteOf(from);
    return text_.substr(begin, byteOf(from + count) - begin);
  }

private:
  std::size_t byteOf(std::size_t character) const {
    return character < starts_.size() ? starts_[character] : text_.size();
  }

  const SourceFile* file_ = nullptr;
  std::uint32_t line_ = 0;
  std::string text_;
  std::vector<std::uint32_t> starts_; // first byte of each character
};

void appendPlace(std::string& out, SourceRange range, const SourceMap& sources) {
  if (!range.hasPlace()) {
    out += "dotek: ";
    return;
  }
  const LineColumn at = sources.file(range.file).place(range.begin);
  out += fmt::format("{}:{}:{}: ", printable(sources.file(range.file).name()), at.line, at.column);
}

// The line and the caret below it; a long line is cut around the caret.
void appendExcerpt(std::string& out, SourceRange range, const SourceMap& sources, ShownLine& shown) {
  if (!range.hasPlace()) return;
  const SourceFile& file = sources.file(range.file);
  const LineColumn begin = file.place(range.begin);
  shown.take(file, begin.line);
  const std::size_t length = shown.length();
  if (length == 0) return; // nothing to point at
  std::size_t column = begin.column - 1;
  std::size_t width = 1;
  if (range.end > range.begin) {
    const LineColumn end = file.place(range.end);
    width = end.line == begin.line ? end.column - begin.column : (length > column ? length - column : 1);
  }
  width = std::max<std::size_t>(width, 1);
  const std::size_t from =
      column > kShownColumns / 2 && length > kShownColumns ? column - kShownColumns / 2 : 0;
  const bool cutEnd = length > from + kShownColumns;
  std::string text = shown.part(from, kShownColumns);
  std::size_t characters = std::min(length - std::min(from, length), kShownColumns);
  column -= from;
  if (from > 0) {
    text.insert(0, "...");
    characters += 3;
    column += 3;
  }
  width = std::min(width, std::max<std::size_t>(characters > column ? characters - column : 1, 1));
  if (cutEnd) text += "...";
  out += "  " + text + "\n  " + std::string(column, ' ') + "^" + std::string(width - 1, '~') + "\n";
}

} // namespace

std::string renderText(const Diagnostics& diagnostics, const SourceMap& sources, std::uint32_t maxErrors) {
  std::string out;
  std::uint32_t errors = 0;
  std::uint32_t left = 0;
  ShownLine shown;
  for (const Diagnostic& d : diagnostics.all()) {
    if (d.severity == Severity::Error && ++errors > maxErrors && maxErrors != 0) {
      ++left;
      continue;
    }
    appendPlace(out, d.range, sources);
    out += fmt::format("{}: {} [{}]\n", severityName(d.severity), printable(d.message), d.code);
    appendExcerpt(out, d.range, sources, shown);
    for (const DiagnosticNote& note : d.notes) {
      appendPlace(out, note.range, sources);
      out += fmt::format("note: {}\n", printable(note.message));
      appendExcerpt(out, note.range, sources, shown);
    }
    if (d.fix) {
      appendPlace(out, d.fix->edits.empty() ? d.range : d.fix->edits.front().range, sources);
      const bool safe = d.fix->applicability == Fix::Applicability::Safe;
      out += fmt::format("{}: {}\n", safe ? "fix (`dotek lint --fix` makes it)" : "fix by hand",
                         printable(d.fix->title));
    }
  }
  if (left > 0)
    out += fmt::format("dotek: note: {} more errors are not shown; --max-errors 0 shows all\n", left);
  return out;
}

} // namespace dotek
