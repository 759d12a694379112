#include "project/LineShapes.h"

#include "support/Ascii.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace dotek::project {
namespace {

using View = std::string_view;

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

bool isNamePart(char c) {
  return isLetter(c) || isDigit(c) || c == '_';
}

View trimmed(View text) {
  while (!text.empty() && isBlank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back()))
    text.remove_suffix(1);
  return text;
}

template <std::size_t N> bool isOneOf(View name, const std::array<View, N>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The pieces of an expression of GibbsCAM: names, numbers, texts, and signs between them.
enum class Piece : unsigned char { Value, Sign, Open, Close, Comma, Text, Other };

struct Pieces {
  std::vector<Piece> pieces;
  std::vector<View> names; // in the order of the line
};

Pieces piecesOf(View text) {
  Pieces out;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const std::size_t begin = i++;
    if (isBlank(c)) continue;
    if (c == '"' || c == '\'') {
      const std::size_t end = text.find(c, i);
      out.pieces.push_back(end == View::npos ? Piece::Other : Piece::Text);
      i = end == View::npos ? text.size() : end + 1;
    } else if (isLetter(c) || c == '_') {
      while (i < text.size() && (isNamePart(text[i]) || text[i] == '$'))
        ++i;
      out.pieces.push_back(Piece::Value);
      out.names.push_back(text.substr(begin, i - begin));
    } else if (isDigit(c) || (c == '.' && i < text.size() && isDigit(text[i]))) {
      while (i < text.size() && (isDigit(text[i]) || text[i] == '.'))
        ++i;
      out.pieces.push_back(Piece::Value);
    } else {
      out.pieces.push_back(View("+-*/=<>").find(c) != View::npos ? Piece::Sign
                           : c == '(' || c == '['                ? Piece::Open
                           : c == ')' || c == ']'                ? Piece::Close
                           : c == ','                            ? Piece::Comma
                                                                 : Piece::Other);
    }
  }
  return out;
}

// Values with something between them: what prose and most other languages do not keep to.
bool isExpression(View text) {
  const Pieces pieces = piecesOf(text);
  bool valueBefore = false;
  for (const Piece piece : pieces.pieces) {
    if (piece == Piece::Other) return false;
    const bool value = piece == Piece::Value || piece == Piece::Text;
    if (value && valueBefore) return false;
    valueBefore = value;
  }
  return true;
}

// Up to the comment sign that is in no text.
View withoutRemark(View line) {
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != '\0')
      quote = c == quote ? '\0' : quote;
    else if (c == '"')
      quote = c;
    else if (c == '!')
      return trimmed(line.substr(0, i));
  }
  return trimmed(line);
}

std::string firstName(View text) {
  std::size_t n = 0;
  while (n < text.size() && (isNamePart(text[n]) || text[n] == '$'))
    ++n;
  return upperCase(text.substr(0, n));
}

// Where the word begins that is not part of another one; npos: nowhere.
std::size_t findWord(View text, View word) {
  const std::string folded = upperCase(text);
  for (std::size_t at = folded.find(word); at != View::npos; at = folded.find(word, at + 1)) {
    const bool begins = at == 0 || !isNamePart(folded[at - 1]);
    const std::size_t end = at + word.size();
    if (begins && (end == folded.size() || !isNamePart(folded[end]))) return at;
  }
  return View::npos;
}

Shape ifShape(View text) {
  const std::size_t then = findWord(text, "THEN");
  if (then == View::npos) return {};
  View condition = trimmed(text.substr(2, then - 2));
  if (condition.ends_with(',')) condition = trimmed(condition.substr(0, condition.size() - 1));
  const View rest = trimmed(text.substr(then + 4));
  const bool joined = findWord(condition, "AND") != View::npos || findWord(condition, "OR") != View::npos;
  if (condition.find_first_of("=<>") == View::npos || !(joined || isExpression(condition))) return {};
  if (!rest.empty() && rest != "[" && !macroShape(rest).fits) return {};
  return {false, true, 3};
}

Shape forShape(View text) {
  const std::size_t to = findWord(text, "TO");
  const std::size_t equals = text.find('=');
  if (to == View::npos || equals == View::npos || equals > to) return {};
  return {false, true, 3};
}

// COMMAND value, value; a word of the language has an underline, or is one of a few.
Shape commandShape(View text) {
  constexpr std::array<View, 9> kPlain = {"MESSAGE", "DIALOG", "INPUT",   "DEBUG",  "WAIT",
                                          "CHECK",   "PRINT",  "DEGREES", "RADIANS"};
  const std::string name = firstName(text);
  View rest = trimmed(text.substr(name.size()));
  if (name.empty() || isDigit(name[0])) return {};
  const bool compound = name.find('_') != std::string::npos && name.front() != '_' && name.back() != '_';
  if (rest.empty()) return {false, true, compound ? 1 : 0};
  if (rest.starts_with('(') || !isExpression(rest.starts_with(',') ? rest.substr(1) : rest)) return {};
  const bool list = rest.find(',') != View::npos;
  return {false, true,
          compound                      ? 2
          : isOneOf(View(name), kPlain) ? (list || rest.front() == '"' ? 2 : 1)
                                        : 0};
}

// Blanks and capitals apart, is this a literal of ComPost, a word with its arguments, a bracket? The weight
// of what only a Prog has.
class ProgReader {
public:
  explicit ProgReader(View text) : rest_(text) {}

  Shape read() {
    Shape shape;
    bool first = true;
    while (skipBlanks(), !rest_.empty()) {
      const int weight = piece(first);
      if (weight < 0) return {};
      shape.weight += weight;
      first = false;
    }
    shape.fits = true;
    shape.weight = std::min(shape.weight, 5);
    return shape;
  }

private:
  void skipBlanks() {
    while (!rest_.empty() && isBlank(rest_.front()))
      rest_.remove_prefix(1);
  }

  bool literal() {
    const std::size_t end = rest_.find('\'', 1);
    if (end == View::npos) return false;
    rest_.remove_prefix(end + 1);
    return true;
  }

  // -1: nothing of a Prog.
  int piece(bool first) {
    const char c = rest_.front();
    if (c == '\'') return literal() ? (first ? 1 : 0) : -1;
    if (c == '(' || c == ')' || c == ',' || c == '=') {
      rest_.remove_prefix(1);
      return 0;
    }
    if (c == '#') {
      rest_.remove_prefix(1);
      skipBlanks();
      const bool number = !rest_.empty() && isDigit(rest_.front());
      while (!rest_.empty() && isDigit(rest_.front()))
        rest_.remove_prefix(1);
      skipBlanks();
      const bool picture = rest_.starts_with('=') && rest_.find('\'') != View::npos;
      return number ? (picture ? 3 : 0) : -1;
    }
    if (isDigit(c)) {
      while (!rest_.empty() && isDigit(rest_.front()))
        rest_.remove_prefix(1);
      return 0;
    }
    return isLetter(c) || (c & 0x80) != 0 ? word(first) : -1;
  }

  int word(bool first) {
    std::size_t n = 0;
    while (n < rest_.size() && (isNamePart(rest_[n]) || (rest_[n] & 0x80) != 0))
      ++n;
    const View name = rest_.substr(0, n);
    rest_.remove_prefix(n);
    const bool mark = rest_.starts_with('#') || rest_.starts_with('?');
    const bool label = rest_.starts_with(':');
    if (mark || label) rest_.remove_prefix(1);
    const View after = trimmed(rest_);
    if (mark) return after.starts_with('(') && after.find('\'') != View::npos ? 3 : 1;
    if (label) return first && after.empty() ? 1 : first ? 0 : -1;
    if (name == "RETURN") return first && after.empty() ? 3 : after.empty() ? 2 : 0;
    if (name == "EOL") return 2;
    return name == "FORMAT" && after.starts_with('(') ? 3 : 0;
  }

  View rest_;
};

} // namespace

Shape macroShape(View line) {
  const View text = withoutRemark(line);
  if (text.empty()) return {true, false, 0};
  if (text == "[" || text == "]") return {false, true, 0};
  const std::string name = firstName(text);
  if (text.front() == ':')
    return {false, text.size() > 1 && firstName(text.substr(1)).size() == text.size() - 1,
            text.size() > 1 && isLetter(text[1]) ? 2 : 0};
  if (constexpr View kInclude = "#INCLUDE"; upperCase(text).starts_with(kInclude)) {
    // One name, in quotes where it has blanks: a sentence may begin with the word.
    const View file = trimmed(text.substr(kInclude.size()));
    const bool fits = !file.empty() && file.front() != '<' &&
                      (file.front() == '"' || file.find_first_of(" \t") == View::npos);
    return {false, fits, fits ? 2 : 0};
  }
  const View rest = trimmed(text.substr(name.size()));
  if (name.empty() || name == "END" || name == "ENDIF" || name == "ELSEIF") return {};
  if (rest == ":") return {false, true, 0}; // a label; a Prog has the same
  if (name == "IF") return ifShape(text);
  if (name == "FOR") return forShape(text);
  if (name == "NEXT" && !rest.empty() && isExpression(rest)) return {false, true, 2};
  if (name == "GOTO" || name == "ON_ERROR") return {false, isExpression(rest) || name == "ON_ERROR", 2};
  constexpr std::array<View, 5> kLists = {"CALL", "ARGS", "GLOBAL", "LOCAL", "PERMANENT"};
  if (isOneOf(View(name), kLists) && !rest.empty())
    return rest.find_first_of("=;{}") == View::npos ? Shape{false, true, 2} : Shape{};
  if (rest.starts_with('=') ||
      ((rest.starts_with('(') || rest.starts_with('[')) && rest.find('=') != View::npos)) {
    const bool fits = isExpression(rest) && !rest.starts_with("==");
    return {false, fits, fits && name.ends_with('$') ? 1 : 0};
  }
  return commandShape(text);
}

Shape dialogShape(View line) {
  constexpr std::array<View, 9> kBoxes = {"LABEL", "INPUT", "IMAGE",  "FRAME",       "OK",
                                          "CHECK", "RADIO", "BUTTON", "DROPDOWN_NEW"};
  const View text = withoutRemark(line);
  if (text.empty()) return {true, false, 0};
  const std::string name = firstName(text);
  const View rest = trimmed(text.substr(name.size()));
  const auto commas = std::count(rest.begin(), rest.end(), ',');
  if (name == "DIALOG" && commas >= 4) return {false, true, 4};
  const bool box = isOneOf(View(name), kBoxes) || name == "CANCEL";
  if (box && commas >= 3 && !rest.empty() && rest.front() != '"') return {false, true, 3};
  return {false, macroShape(text).fits, 0};
}

bool isProse(View line) {
  int words = 0, others = 0;
  bool small = false;
  for (std::size_t i = 0; i < line.size();) {
    const std::size_t end = std::min(line.find_first_of(" \t", i), line.size());
    View word = line.substr(i, end - i);
    i = end + 1;
    while (!word.empty() && View(".,:;!?()\"'").find(word.back()) != View::npos)
      word.remove_suffix(1);
    if (word.empty()) continue;
    const bool letters =
        std::all_of(word.begin(), word.end(), [](char c) { return isLetter(c) || (c & 0x80) != 0; });
    ++(letters ? words : others);
    small = small || (letters && word.size() > 1 && word[1] >= 'a' && word[1] <= 'z');
  }
  return small && words >= 3 && words > others;
}

bool isDefinition(View line) {
  const View text = withoutRemark(line);
  const std::string name = firstName(text);
  const View rest = trimmed(text.substr(name.size()));
  if (name.empty() || isDigit(name[0]) || !rest.starts_with('=')) return false;
  const View value = trimmed(rest.substr(1));
  return !value.empty() && std::all_of(value.begin(), value.end(),
                                       [](char c) { return isDigit(c) || c == '.' || c == '-' || c == '+'; });
}

Shape progShape(View line, bool& inComment) {
  std::string text;
  bool literal = false;
  for (const char c : line) {
    if (inComment) {
      inComment = c != '}';
    } else if (c == '{' && !literal) {
      inComment = true;
    } else {
      literal = c == '\'' ? !literal : literal;
      text += c;
    }
  }
  if (trimmed(text).empty()) return {true, false, 0};
  return ProgReader(trimmed(text)).read();
}

Shape cycleShape(View line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin == View::npos || line.substr(begin).starts_with("//")) return {true, false, 0};
  const View text = line.substr(begin);
  const View word = text.substr(0, text.find_first_of(" \t"));
  const View rest = text.substr(std::min(text.size(), word.size() + 1));
  const auto has = [&](View what) { return rest.find(what) != View::npos; };
  if (word == "cycle") return {false, rest.find('"') != View::npos, 3};
  if ((word == "parameter" || word == "result") && has(":")) return {false, true, 3};
  if (word == "touch" && (has(" by ") || has(" to "))) return {false, true, 3};
  if ((word == "protected" || word == "rapid" || word == "feed") && rest.starts_with("move "))
    return {false, true, 3};
  if (word == "probe" && (rest == "on" || rest == "off")) return {false, true, 1};
  if (word == "set" && has(" becomes ")) return {false, true, 3};
  if (word == "if" || word == "else" || word == "end" || word == "call" || word == "alarm")
    return {false, true, 0};
  return {false, has("= "), 0};
}

} // namespace dotek::project
