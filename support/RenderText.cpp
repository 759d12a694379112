#include "support/RenderText.h"

#include "support/Printable.h"

#include <algorithm>
#include <vector>

namespace dotek {
namespace {

constexpr std::size_t kShownColumns = 160;

// Sequences of a terminal (ECMA-48, SGR); none where nothing is painted.
struct Ink {
  explicit Ink(bool painted)
      : bold(painted ? "\x1b[1m" : ""), red(painted ? "\x1b[1;31m" : ""),
        magenta(painted ? "\x1b[1;35m" : ""), cyan(painted ? "\x1b[1;36m" : ""),
        green(painted ? "\x1b[1;32m" : ""), plain(painted ? "\x1b[0m" : "") {}

  std::string_view bold, red, magenta, cyan, green, plain;

  std::string_view of(Severity severity) const {
    switch (severity) {
    case Severity::Error: return red;
    case Severity::Warning: return magenta;
    case Severity::Note: return cyan;
    }
    return plain;
  }
};

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

void appendPlace(std::string& out, SourceRange range, const SourceMap& sources, const Ink& ink) {
  out += ink.bold;
  if (!range.hasPlace()) {
    out += "dotek:";
  } else {
    const LineColumn at = sources.file(range.file).place(range.begin);
    out += fmt::format("{}:{}:{}:", printable(sources.file(range.file).name()), at.line, at.column);
  }
  out += ink.plain;
  out += " ";
}

// The line and the caret below it; a long line is cut around the caret.
void appendExcerpt(std::string& out, SourceRange range, const SourceMap& sources, ShownLine& shown,
                   const Ink& ink) {
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
  out += fmt::format("  {}\n  {}{}^{}{}\n", text, std::string(column, ' '), ink.green,
                     std::string(width - 1, '~'), ink.plain);
}

} // namespace

std::string renderText(const Diagnostics& diagnostics, const SourceMap& sources, std::uint32_t maxErrors) {
  return renderText(diagnostics, sources, maxErrors, Colors::None);
}

std::string renderText(const Diagnostics& diagnostics, const SourceMap& sources, std::uint32_t maxErrors,
                       Colors colors) {
  const Ink ink(colors == Colors::Terminal);
  std::string out;
  std::uint32_t errors = 0;
  std::uint32_t left = 0;
  ShownLine shown;
  for (const Diagnostic& d : diagnostics.all()) {
    if (d.severity == Severity::Error && ++errors > maxErrors && maxErrors != 0) {
      ++left;
      continue;
    }
    appendPlace(out, d.range, sources, ink);
    out += fmt::format("{}{}:{} {} [{}]\n", ink.of(d.severity), severityName(d.severity), ink.plain,
                       printable(d.message), d.code);
    appendExcerpt(out, d.range, sources, shown, ink);
    for (const DiagnosticNote& note : d.notes) {
      appendPlace(out, note.range, sources, ink);
      out += fmt::format("{}note:{} {}\n", ink.cyan, ink.plain, printable(note.message));
      appendExcerpt(out, note.range, sources, shown, ink);
    }
    if (d.fix) {
      appendPlace(out, d.fix->edits.empty() ? d.range : d.fix->edits.front().range, sources, ink);
      const bool safe = d.fix->applicability == Fix::Applicability::Safe;
      out +=
          fmt::format("{}{}:{} {}\n", ink.green, safe ? "fix (`dotek lint --fix` makes it)" : "fix by hand",
                      ink.plain, printable(d.fix->title));
    }
  }
  if (left > 0)
    out += fmt::format("dotek: note: {} more errors are not shown; --max-errors 0 shows all\n", left);
  return out;
}

} // namespace dotek
