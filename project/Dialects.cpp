#include "project/Dialects.h"

#include "support/Ascii.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <vector>

namespace dotek::project {
namespace {

using View = std::string_view;

constexpr int kCertain = 5; // no input of Dotek has it
constexpr int kStrong = 4;  // no block of Macro B is or begins so
constexpr std::size_t kMostShown = 3;

// Without comments in round brackets; brackets directly after a name are operands, `CYCLE81(50,0)`.
std::string withoutComments(View text) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '(' && (at == 0 || !isLetter(text[at - 1]))) {
      const std::size_t close = text.find(')', at);
      if (close == View::npos) break;
      at = close;
      out += ' ';
      continue;
    }
    out += text[at];
  }
  return out;
}

// `text` is found, and what it begins with does not go on a longer word.
bool hasWord(View line, View text) {
  for (std::size_t at = line.find(text); at != View::npos; at = line.find(text, at + 1))
    if (at == 0 || !isLetter(text.front()) || !isLetter(line[at - 1])) return true;
  return false;
}

// Three words in a row, two of them in small letters, outside of comments and quotes: no block of a control.
bool isProse(View line) {
  std::size_t words = 0, small = 0;
  char quote = 0;
  for (std::size_t at = 0; at < line.size();) {
    const char c = line[at];
    if (quote != 0 || c == '"') {
      quote = quote == 0 ? c : c == quote ? 0 : quote;
      ++at;
      continue;
    }
    if (c == '(' || c == ';' || c == '{' || c == '!' || line.substr(at).starts_with("//")) return false;
    if (!isLetter(c)) {
      if (c != ' ' && c != ',') words = small = 0;
      ++at;
      continue;
    }
    std::size_t end = at;
    bool lower = true;
    for (; end < line.size() && (isLetter(line[end]) || line[end] == '\''); ++end)
      lower = lower && (line[end] < 'A' || line[end] > 'Z');
    const bool joins = end < line.size() && View(" ,.:?").find(line[end]) == View::npos;
    words = joins || end - at < 2 ? 0 : words + 1;
    small = words == 0 ? 0 : small + (lower ? 1 : 0);
    if (words >= 3 && small >= 2) return true;
    at = end;
  }
  return false;
}

constexpr auto kText = static_cast<std::size_t>(Tongue::Markdown);

} // namespace

namespace {

// The characters of a text, one bit for each of 64 classes: a mark with a character that the line does not
// have cannot be in it.
std::uint64_t charactersOf(View text) {
  std::uint64_t out = 0;
  for (const char c : text)
    out |= std::uint64_t{1} << (static_cast<unsigned char>(c) & 63U);
  return out;
}

// Of each mark the characters that its line has to have.
std::vector<std::uint64_t> charactersOfMarks() {
  std::vector<std::uint64_t> out;
  for (const Mark& mark : dialectMarks())
    out.push_back(mark.fits != nullptr ? 0 : charactersOf(mark.text));
  return out;
}

} // namespace

void Dialects::look(View line) {
  static const std::vector<std::uint64_t> needed = charactersOfMarks();
  ++line_;
  const std::string folded = upperCase(trimmedText(line));
  if (folded.empty()) return;
  if (isProse(line)) ++prose_;
  if (trimmedText(line).ends_with(':')) ++headed_;
  const View text = folded;
  const View raw = withoutBlockNumber(text);
  const std::string coded = withoutComments(text);
  const View code = trimmedText(coded);
  const View body = withoutBlockNumber(code);
  // `trans = 3` gives a variable a value.
  const std::size_t name =
      std::min(text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789 "), text.size());
  const bool assignment = name > 0 && name < text.size() && text[name] == '=';
  const std::uint64_t present = charactersOf(text) | charactersOf(" "); // comments leave a blank
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if ((needed[i] & ~present) != 0) continue;
    const Mark& mark = dialectMarks()[i];
    bool seen = false;
    switch (mark.place) {
    case Place::Begin:
      if (assignment && mark.text.find('=') == View::npos) break;
      seen = text.starts_with(mark.text) || raw.starts_with(mark.text);
      break;
    case Place::Word: seen = hasWord(code, mark.text); break;
    case Place::Raw: seen = mark.fits != nullptr ? mark.fits(raw) : text.find(mark.text) != View::npos; break;
    case Place::Shape: seen = mark.fits(body.substr(0, body.find(';'))) || mark.fits(body); break;
    }
    if (seen) see(mark, trimmedText(line));
  }
}

void Dialects::see(const Mark& mark, View line) {
  Seen& seen = seen_[static_cast<std::size_t>(mark.tongue)];
  seen.weight += mark.weight;
  certain_ = certain_ || mark.weight == kCertain;
  if (seen.lastLine == line_) return;
  seen.lastLine = line_;
  ++seen.lines;
  if (mark.weight >= kStrong) ++seen.strong;
  // The lines that say most come first.
  const std::size_t width = 40;
  std::string shown = std::string(line.substr(0, line.size() > width ? width - 2 : width));
  if (line.size() > width) shown += "..";
  seen.shown.push_back({line_, mark.weight, std::move(shown)});
  std::stable_sort(seen.shown.begin(), seen.shown.end(),
                   [](const Shown& a, const Shown& b) { return a.weight > b.weight; });
  if (seen.shown.size() > kMostShown) seen.shown.pop_back();
}

std::size_t Dialects::strongest() const {
  std::size_t out = 0;
  const auto rank = [&](std::size_t i) {
    return seen_[i].weight >= factsOf(static_cast<Tongue>(i)).least ? seen_[i].weight : 0;
  };
  for (std::size_t i = 1; i < kTongues; ++i)
    if (rank(i) > rank(out)) out = i;
  return out;
}

std::size_t Dialects::best() const {
  const std::size_t out = strongest();
  return isText(out) ? kText : out;
}

// Lines of sentences, or lines that end with a colon and nothing else of a control.
bool Dialects::isText(std::size_t best) const {
  constexpr int kProse = 2;
  const Seen& seen = seen_[best];
  if (certain_ || seen.weight == 0 || !factsOf(static_cast<Tongue>(best)).control) return false;
  return prose_ * kProse > seen.weight || (seen.strong == 0 && headed_ == seen.lines && headed_ > 0);
}

int Dialects::weight() const {
  const std::size_t at = strongest();
  return seen_[at].weight >= factsOf(static_cast<Tongue>(at)).least ? seen_[at].weight : 0;
}

bool Dialects::marked() const {
  return weight() > 0 && seen_[best()].strong >= 2 && factsOf(static_cast<Tongue>(best())).control;
}

std::string Dialects::name() const {
  return std::string(factsOf(static_cast<Tongue>(best())).name);
}

std::optional<Foreign> Dialects::foreign() const {
  const TongueFacts& facts = factsOf(static_cast<Tongue>(best()));
  const Seen& seen = seen_[best()];
  if (!facts.control || seen.shown.empty()) return std::nullopt;
  std::vector<Shown> shown = seen.shown;
  std::sort(shown.begin(), shown.end(), [](const Shown& a, const Shown& b) { return a.line < b.line; });
  std::string lines;
  for (const Shown& one : shown)
    lines += fmt::format("{}line {} `{}`", lines.empty() ? "" : ", ", one.line, one.text);
  const auto more = seen.lines - static_cast<int>(shown.size());
  if (more > 0) lines += fmt::format(" and {} more", more);
  return Foreign{std::string(facts.name), std::move(lines), std::string(facts.remedy)};
}

namespace {

// What `dotek dump --stage ir` prints: its first line, and one that follows at any distance.
bool isPrintedIr(View text) {
  const View first = text.substr(0, text.find_first_of("\r\n"));
  const auto hasLine = [&](View begin) {
    for (std::size_t at = text.find(begin); at != View::npos; at = text.find(begin, at + 1))
      if (at > 0 && text[at - 1] == '\n') return true;
    return false;
  };
  if (first == "units mm" || first == "units inch") return hasLine("cycle ");
  const View word = first.substr(0, first.find(' '));
  return word == "program" && (hasLine("  body\n") || hasLine("  body\r"));
}

} // namespace

std::optional<std::string> otherFormat(View bytes) {
  struct Magic {
    View begin;
    View name;
  };
  constexpr std::array kMagic = {
      Magic{"\x89PNG", "an image"},
      Magic{"GIF8", "an image"},
      Magic{"\xFF\xD8\xFF", "an image"},
      Magic{"II*\0", "an image"},
      Magic{"PK\x03\x04", "an archive"},
      Magic{"\x1F\x8B", "an archive"},
      Magic{"%PDF-", "a PDF"},
      Magic{"\x7F"
            "ELF",
            "a program"},
      Magic{"{\\rtf", "RTF text"},
  };
  for (const Magic& magic : kMagic)
    if (bytes.starts_with(magic.begin)) return std::string(magic.name);
  if (bytes.starts_with("BM") && bytes.size() > 10 && bytes.substr(6, 4).find('\0') != View::npos)
    return "an image";
  if (bytes.substr(0, 200).find("/namespace/nc/format/compact-nci") != View::npos &&
      bytes.find('\0') != View::npos)
    return "a job of Autodesk's CAM, which `dotek run-post POST.cps JOB.cnc` runs";
  View text = bytes;
  while (!text.empty() &&
         (trimmedText(text).size() < text.size() || View("\r\n").find(text.front()) != View::npos)) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == 0 || begin == View::npos) break;
    text.remove_prefix(begin);
  }
  if (isPrintedIr(text)) return "what `dotek dump --stage ir` prints, an output of Dotek";
  const std::string head = lowerCase(text.substr(0, 40));
  if (head.starts_with("<svg")) return "an SVG picture";
  for (const View tag : {"<?xml", "<!doctype", "<html", "<!--"})
    if (head.starts_with(tag))
      return text.substr(0, 2000).find("<svg") != View::npos ? "an SVG picture" : "HTML or XML";
  if (text.starts_with('{') || text.starts_with('[')) {
    const std::size_t inside = text.find_first_not_of(" \t\r\n", 1);
    const char next = inside == View::npos ? '\0' : text[inside];
    const bool json = next == '"' || (text.starts_with('[') && (next == '{' || next == '[' || next == ']')) ||
                      (text.starts_with('{') && next == '}' && text.size() < 5);
    const std::size_t close = next == '"' ? text.find('"', inside + 1) : View::npos;
    const std::size_t colon = close == View::npos ? close : text.find_first_not_of(" \t\r\n", close + 1);
    const bool named = colon != View::npos && (text[colon] == ':' || text.starts_with('['));
    if (json && (next != '"' || named)) return "JSON";
  }
  return std::nullopt;
}

} // namespace dotek::project
