#include "project/LineShapes.h"

#include "support/Ascii.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace dotek::project {
namespace {

using View = std::string_view;

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

// Without blanks and comments, in capitals. What DPRNT prints keeps its brackets, which is all that counts.
std::string blockText(View line) {
  std::string out;
  bool comment = false;
  for (const char c : line) {
    comment = comment || c == '(';
    if (!comment && !isBlank(c)) out += upperCase(c);
    if (c == ')') comment = false;
  }
  return out;
}

// Reads one block from the left.
class BlockReader {
public:
  explicit BlockReader(View text) : rest_(text) {}

  BlockShape read() {
    if (rest_.starts_with('<') && rest_.ends_with('>') && rest_.find('/') == View::npos) {
      shape_.fits = true; // a program's name; a tag of XML looks the same
      return shape_;
    }
    header();
    if (at(0) == '/') skip(isDigit(at(1)) ? 2 : 1);
    if (at(0) == 'N' && isDigit(at(1))) {
      skip(1);
      digits();
      shape_.weight += 1;
      shape_.code = true;
    }
    while (!rest_.empty())
      if (!statement() && !word()) return begun();
    shape_.fits = true;
    shape_.weight = std::min(shape_.weight, 5);
    return shape_;
  }

private:
  char at(std::size_t i) const { return i < rest_.size() ? rest_[i] : '\0'; }
  void skip(std::size_t n) { rest_.remove_prefix(std::min(n, rest_.size())); }
  void digits() {
    while (isDigit(at(0)))
      skip(1);
  }

  BlockShape begun() const {
    BlockShape out;
    out.begins = shape_.weight > 0;
    return out;
  }

  void header() {
    if ((at(0) != 'O' && at(0) != ':') || !isDigit(at(1))) return;
    skip(1);
    digits();
    shape_.header = true;
    shape_.weight += 4;
    shape_.macroB += 3;
  }

  void taken(int weight) {
    shape_.weight += weight;
    shape_.macroB += weight;
  }

  // Of the rest of the block only the characters are looked at: what is wrong in it is for the reader to say.
  bool allOfExpression() const {
    return std::all_of(rest_.begin(), rest_.end(), [](char c) {
      return isCapital(c) || isDigit(c) || View("#[]+-*/.,=").find(c) != View::npos;
    });
  }

  bool statement() {
    if (at(0) == '#') {
      const bool variable = at(1) == '[' || at(1) == '#' || isDigit(at(1));
      if (!variable || rest_.find('=') == View::npos || !allOfExpression()) return false;
      taken(3);
      rest_ = {};
      return true;
    }
    for (const View print : {"DPRNT[", "BPRNT["}) {
      if (!rest_.starts_with(print)) continue;
      taken(3);
      rest_ = {};
      return true;
    }
    constexpr std::array<View, 12> kBegins = {"IF[",   "IF#",   "WHILE[", "GOTO#", "GOTO[", "ELSE",
                                              "ENDIF", "POPEN", "PCLOS",  "SETVN", "THEN",  "WHILE#"};
    constexpr std::array<View, 3> kNumbered = {"GOTO", "END", "DO"};
    const bool begins =
        std::any_of(kBegins.begin(), kBegins.end(), [&](View w) { return rest_.starts_with(w); });
    const bool numbered = std::any_of(kNumbered.begin(), kNumbered.end(),
                                      [&](View w) { return rest_.starts_with(w) && isDigit(at(w.size())); });
    if (!begins && !numbered) return false;
    if (!allOfExpression()) return false;
    taken(3);
    rest_ = {};
    return true;
  }

  bool word() {
    if (at(0) == ',' && isCapital(at(1))) skip(1);
    const char letter = at(0);
    if (!isCapital(letter)) return false;
    skip(1);
    while (at(0) == '-' || at(0) == '+')
      skip(1);
    const bool code = (letter == 'G' || letter == 'M') && isDigit(at(0));
    if (!value()) return false;
    shape_.weight += code ? 2 : 1;
    shape_.code = shape_.code || code;
    return true;
  }

  bool value() {
    if (at(0) == '[') {
      taken(1);
      return bracket();
    }
    if (at(0) == '#') {
      while (at(0) == '#')
        skip(1);
      taken(1);
      if (at(0) == '[') return bracket();
      const bool number = isDigit(at(0));
      digits();
      return number;
    }
    const bool whole = isDigit(at(0));
    digits();
    if (at(0) != '.') return whole;
    skip(1);
    const bool fraction = isDigit(at(0));
    digits();
    return whole || fraction;
  }

  bool bracket() {
    int open = 0;
    while (!rest_.empty()) {
      const char c = at(0);
      skip(1);
      if (c == '[') ++open;
      if (c == ']' && --open == 0) return true;
    }
    return false;
  }

  View rest_;
  BlockShape shape_;
};

} // namespace

BlockShape blockShape(View line) {
  const std::string text = blockText(line);
  BlockShape all;
  all.blank = true;
  View rest = View(text).substr(0, text.find("//"));
  bool first = true;
  while (!rest.empty() && all.weight < 5) { // `;` ends a block in print
    const std::size_t end = std::min(rest.find(';'), rest.size());
    const View block = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const bool behind = !std::exchange(first, false);
    if (block.empty()) continue;
    if (block == "%") {
      all = {{false, true, 0}, 1, true};
      return all;
    }
    const BlockShape one = BlockReader(block).read();
    if (!one.fits && behind) break; // a comment, on many controls
    if (!one.fits) return one;
    all.blank = false;
    all.fits = true;
    all.weight = std::min(all.weight + one.weight, 5);
    all.macroB = std::min(all.macroB + one.macroB, 5);
    all.code = all.code || one.code;
    all.header = all.header || one.header;
  }
  return all;
}

bool hasStrayWord(View line) {
  constexpr std::array<View, 37> kWords = {
      "IF",  "THEN",  "ELSE", "ENDIF", "GOTO", "WHILE", "DO",  "END", "EQ",  "NE",   "GT",   "GE",   "LT",
      "LE",  "AND",   "OR",   "XOR",   "NOT",  "MOD",   "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "SQRT",
      "ABS", "ROUND", "FIX",  "FUP",   "LN",   "EXP",   "BIN", "BCD", "POW", "ADP",  "PRM"};
  std::string text;
  int comment = 0;
  for (const char c : line.substr(0, std::min(line.find("//"), line.find(';')))) {
    comment += c == '(' ? 1 : 0;
    if (comment == 0) text += upperCase(c);
    comment -= c == ')' && comment > 0 ? 1 : 0;
  }
  for (const View print : {"DPRNT", "BPRNT", "SETVN"})
    if (text.find(print) != std::string::npos) return false;
  const View rest = text;
  for (std::size_t i = 0; i < rest.size();) {
    const std::size_t end = std::min(rest.find_first_of(" \t", i), rest.size());
    View word = rest.substr(i, end - i);
    i = end + 1;
    while (!word.empty() && View(".,:!?").find(word.back()) != View::npos)
      word.remove_suffix(1);
    const bool letters = word.size() > 1 && std::all_of(word.begin(), word.end(), [](char c) {
                           return isCapital(c) || (c & 0x80) != 0;
                         });
    if (letters && std::find(kWords.begin(), kWords.end(), word) == kWords.end()) return true;
  }
  return false;
}

Shape sufShape(View line) {
  std::string text;
  for (const char c : line.substr(0, line.find(';')))
    if (!isBlank(c)) text += upperCase(c);
  if (text.empty()) return {true, false, 0};
  std::size_t i = 0;
  const auto at = [&](std::size_t n) { return n < text.size() ? text[n] : '\0'; };
  const auto number = [&] {
    const std::size_t begin = i;
    while (isDigit(at(i)) || at(i) == '.')
      ++i;
    return i > begin;
  };
  Shape shape;
  while (i < text.size()) {
    if (at(i) == '@') { // a file's name
      shape.weight += 2;
      break;
    }
    const char letter = at(i++);
    if (!isCapital(letter)) return {};
    if (letter == 'P' && isDigit(at(i))) {
      number();
      if (at(i) == '=') {
        shape.weight += 2;
        break;
      }
      continue;
    }
    if (at(i) == '-' || at(i) == '+') ++i;
    if (at(i) == 'P' && isDigit(at(i + 1))) {
      shape.weight += letter == 'F' ? 2 : 1;
      ++i;
    }
    if (!number()) return {};
  }
  shape.fits = true;
  return shape;
}

} // namespace dotek::project
