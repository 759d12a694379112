// Operators that fit in several languages.
#include "tests/unit/Mutants.h"

namespace dotek::tests {
namespace {

using Text = std::optional<std::string>;

void deleteLine(const InputFile& file, const Bundle&, Sites& sites) {
  for (const Line& line : linesOf(file))
    if (!isBlank(line.code)) sites.push_back(dropLine(file, line));
}

void duplicateLine(const InputFile& file, const Bundle&, Sites& sites) {
  for (const Line& line : linesOf(file))
    if (!isBlank(line.code))
      sites.push_back({line.offset, 0, file.text.substr(line.offset, line.length) + "\n"});
}

void swapLines(const InputFile& file, const Bundle&, Sites& sites) {
  const std::vector<Line> lines = linesOf(file);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (isBlank(lines[i - 1].code) || isBlank(lines[i].code)) continue;
    sites.push_back({lines[i - 1].offset, lines[i].offset + lines[i].length - lines[i - 1].offset,
                     file.text.substr(lines[i].offset, lines[i].length) + "\n" +
                         file.text.substr(lines[i - 1].offset, lines[i - 1].length)});
  }
}

// Texts in quotes hold no numbers, but the literals of a post do.
std::string numbersOf(const Line& line, char kind) {
  std::string out = line.code;
  const bool texts = kind == 'm' || kind == 'l';
  bool quoted = false;
  for (char& c : out) {
    if (c == '"') quoted = !quoted;
    if (texts && quoted) c = ' ';
  }
  return out;
}

void letterForZero(const InputFile& file, const Bundle&, Sites& sites) {
  static const std::regex word("[A-Za-z_][A-Za-z_0-9]*|[0-9.]+");
  const bool addresses = file.is("pns"); // letter and number are one word there
  for (const Line& line : linesOf(file)) {
    const std::string code = numbersOf(line, file.kind);
    for (std::sregex_iterator match(code.begin(), code.end(), word), none; match != none; ++match) {
      const std::string text = match->str();
      const bool name = text.size() > 1 && std::isalpha(static_cast<unsigned char>(text[0])) != 0 &&
                        (!addresses || std::isdigit(static_cast<unsigned char>(text[1])) == 0);
      if (name) continue;
      for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '0')
          sites.push_back({line.offset + static_cast<std::size_t>(match->position()) + i, 1, "O"});
    }
  }
}

void pointOf(const InputFile& file, const std::string& becomes, Sites& sites) {
  for (const Line& line : linesOf(file)) {
    const std::string code = numbersOf(line, file.kind);
    for (std::size_t i = 0; i < code.size(); ++i) {
      const auto digit = [&](std::size_t at) {
        return at < code.size() && std::isdigit(static_cast<unsigned char>(code[at])) != 0;
      };
      if (code[i] == '.' && (digit(i + 1) || (i > 0 && digit(i - 1))))
        sites.push_back({line.offset + i, 1, becomes});
    }
  }
}

void bracketLost(const InputFile& file, const Bundle&, Sites& sites) {
  const std::string brackets = file.is("n") ? "[]" : "()";
  for (const Line& line : linesOf(file)) {
    char quote = '\0';
    for (std::size_t i = 0; i < line.code.size(); ++i) {
      const char c = line.code[i];
      if (file.is("mp") && (c == '"' || c == '\'')) quote = quote == '\0' ? c : quote == c ? '\0' : quote;
      if (quote == '\0' && brackets.find(c) != std::string::npos) sites.push_back({line.offset + i, 1, ""});
    }
  }
}

// The characters that begin or end comments.
void commentMark(const InputFile& file, bool end, Sites& sites) {
  const char begin = file.is("p") ? '{' : file.is("n") ? '(' : file.is("s") ? ';' : '!';
  const char close = file.is("p") ? '}' : ')';
  bool inside = false;
  for (std::size_t i = 0; i < file.text.size(); ++i) {
    const bool comment = file.code[i] != file.text[i];
    const bool begins = comment && !inside && file.text[i] == begin;
    if (begins && !end) sites.push_back({i, 1, ""});
    if (comment && end && file.text[i] == close &&
        (i + 1 == file.text.size() || file.code[i + 1] == file.text[i + 1]))
      sites.push_back({i, 1, ""});
    if (begins) inside = true;
    if (!comment && file.text[i] != ' ') inside = false;
    if (comment && file.is("pn") && file.text[i] == close) inside = false;
  }
}

Text turnedComparison(const std::smatch& match) {
  std::string out = match.str();
  for (char& c : out) {
    switch (c) {
    case '<': c = '>'; break;
    case '>': c = '<'; break;
    case 'G': c = 'L'; break;
    case 'L': c = 'G'; break;
    default: break;
    }
  }
  return out;
}

Text turnedSign(const std::smatch& match) {
  return match.str(1) == "+" ? "-" : "+";
}

} // namespace

std::vector<Operator> generalOperators() {
  return {
      {"delete-line", kAllKinds, deleteLine},
      {"duplicate-line", kAllKinds, duplicateLine},
      {"swap-lines", kAllKinds, swapLines},
      {"letter-o-for-zero", kAllKinds, letterForZero},
      {"comma-for-point", "mdpns",
       [](const InputFile& file, const Bundle&, Sites& sites) { pointOf(file, ",", sites); }},
      {"point-lost", "mdpns",
       [](const InputFile& file, const Bundle&, Sites& sites) { pointOf(file, "", sites); }},
      {"bracket-lost", "mpn", bracketLost},
      taking("quote-lost", "ml", "\"", 0),
      taking("quote-lost", "p", "'", 0),
      {"comment-mark-lost", "mdpns",
       [](const InputFile& file, const Bundle&, Sites& sites) { commentMark(file, false, sites); }},
      {"comment-end-lost", "pn",
       [](const InputFile& file, const Bundle&, Sites& sites) { commentMark(file, true, sites); }},
      replacing("comparison-turned", "m", "<>|<=|>=|<|>", 0,
                [](const std::smatch& match) {
                  return match.str() == "<>" ? std::nullopt : turnedComparison(match);
                }),
      replacing("comparison-turned", "n", "GT|GE|LT|LE", 0, turnedComparison),
      taking("abs-lost", "m", "\\b(abs)\\(", 1, true),
      taking("abs-lost", "n", "(ABS)\\[", 1),
      replacing("sign-turned", "m", "[A-Za-z0-9_)] *([-+]) *[A-Za-z0-9_(]", 1, turnedSign),
      replacing("sign-turned", "n", "[0-9.\\]] *([-+])(?=[0-9#\\[A-Z])", 1, turnedSign),
  };
}

} // namespace dotek::tests
