#include "frontend/mikroprog/Format.h"

#include <algorithm>
#include <string_view>

namespace dotek::frontend::mikroprog {

namespace {

constexpr char kEndOfFile = '\x1a'; // of DOS

// "007" -> "7", "1.500" -> "1.5", "2." -> "2", "+.5" -> "0.5", "-0" -> "0".
std::string numberLaid(std::string_view digits) {
  const bool minus = digits.starts_with('-');
  if (minus || digits.starts_with('+')) digits.remove_prefix(1);
  const std::size_t point = digits.find('.');
  std::string_view whole = digits.substr(0, point);
  std::string_view part = point == std::string_view::npos ? std::string_view() : digits.substr(point + 1);
  while (whole.starts_with('0'))
    whole.remove_prefix(1);
  while (part.ends_with('0'))
    part.remove_suffix(1);
  std::string out = whole.empty() ? "0" : std::string(whole);
  if (!part.empty()) out += "." + std::string(part);
  return minus && out != "0" ? "-" + out : out;
}

std::string laid(const Value& value) {
  if (value.number) return numberLaid(value.digits);
  return (value.negative ? "-P" : "P") + std::to_string(value.parameter.value_or(0));
}

void addWord(std::string& line, const std::string& word) {
  if (!line.empty()) line += ' ';
  line += word;
}

std::string laid(const Line& line) {
  std::string out;
  if (line.number) out = "N" + std::to_string(*line.number);
  if (line.assignment) {
    std::string sum = "P" + std::to_string(line.assignment->parameter) + "=";
    for (std::size_t i = 0; i < line.assignment->terms.size(); ++i) {
      const Term& term = line.assignment->terms[i];
      if (i > 0) sum += term.op;
      sum += laid(term.value);
    }
    addWord(out, sum);
  }
  bool file = false;
  for (const Word& word : line.words) {
    file = word.address == '@';
    addWord(out, file ? "@" + word.file : word.address + laid(word.value));
  }
  if (!line.comment) return out;
  // What M29 writes begins right after its file.
  if (!out.empty() && !file) out += ' ';
  return out + ";" + *line.comment;
}

bool same(const Value& a, const Value& b) {
  return a.number == b.number && a.parameter == b.parameter && a.negative == b.negative;
}

bool same(const Line& a, const Line& b) {
  if (a.unread || b.unread || a.number != b.number || a.comment != b.comment ||
      a.assignment.has_value() != b.assignment.has_value())
    return false;
  if (a.assignment &&
      (a.assignment->parameter != b.assignment->parameter ||
       !std::equal(a.assignment->terms.begin(), a.assignment->terms.end(), b.assignment->terms.begin(),
                   b.assignment->terms.end(),
                   [](const Term& x, const Term& y) { return x.op == y.op && same(x.value, y.value); })))
    return false;
  return std::equal(a.words.begin(), a.words.end(), b.words.begin(), b.words.end(),
                    [](const Word& x, const Word& y) {
                      return x.address == y.address && x.file == y.file && same(x.value, y.value);
                    });
}

} // namespace

std::optional<std::string> format(const Program& program, const SourceMap& sources) {
  const SourceFile& source = sources.file(program.file);
  std::string out;
  auto next = program.lines.begin();
  for (std::uint32_t number = 1; number <= source.lineCount(); ++number) {
    const bool read = next != program.lines.end() && next->range.begin == source.lineStart(number);
    const std::string_view text = source.line(number);
    const bool ends = text.ends_with(kEndOfFile);
    if (read) {
      if (next->unread) return std::nullopt;
      out += laid(*next++);
    }
    if (ends) out += kEndOfFile;
    if (number < source.lineCount() || (!text.empty() && !ends)) out += '\n';
  }
  return out;
}

bool sameProgram(const Program& a, const Program& b) {
  return std::equal(a.lines.begin(), a.lines.end(), b.lines.begin(), b.lines.end(),
                    [](const Line& x, const Line& y) { return same(x, y); });
}

} // namespace dotek::frontend::mikroprog
