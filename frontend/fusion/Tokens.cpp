#include "frontend/fusion/Tokens.h"

#include <algorithm>
#include <array>

namespace dotek::frontend::fusion {

namespace {

using View = std::string_view;

bool isDigitOf(char c) {
  return c >= '0' && c <= '9';
}

// Longest first.
constexpr auto kSigns =
    std::to_array<View>({">>>=", "...", "===", "!==", ">>>", "<<=", ">>=", "**=", "&&=", "||=", "?\?=", "=>",
                         "==",   "!=",  "<=",  ">=",  "&&",  "||",  "?\?", "?.",  "++",  "--",  "+=",   "-=",
                         "*=",   "/=",  "%=",  "&=",  "|=",  "^=",  "<<",  ">>",  "**",  "{",   "}",    "(",
                         ")",    "[",   "]",   ";",   ",",   "<",   ">",   "+",   "-",   "*",   "/",    "%",
                         "&",    "|",   "^",   "!",   "~",   "?",   ":",   "=",   "."});

class Scanner {
public:
  Scanner(FileId file, View text) : file_(file), text_(text) {}

  Tokens run() {
    if (text_.starts_with("#!")) comment(lineEnd(0));
    while (skipBlanks())
      next();
    add(TokenType::End, at_);
    return std::move(out_);
  }

private:
  char here(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  std::size_t lineEnd(std::size_t from) const {
    return std::min(text_.find_first_of("\r\n", from), text_.size());
  }

  void add(TokenType type, std::size_t end) {
    out_.tokens.push_back({type, newLine_, static_cast<std::uint32_t>(at_), static_cast<std::uint32_t>(end)});
    newLine_ = false;
    at_ = end;
  }

  SourceRange rangeTo(std::size_t end) const {
    return {file_, static_cast<std::uint32_t>(at_), static_cast<std::uint32_t>(end)};
  }

  void comment(std::size_t end) {
    out_.comments.push_back({rangeTo(end)});
    if (text_.substr(at_, end - at_).find_first_of("\r\n") != View::npos) newLine_ = true;
    at_ = end;
  }

  bool mergeMarker() const {
    if (at_ != 0 && text_[at_ - 1] != '\n' && text_[at_ - 1] != '\r') return false;
    for (const char c : {'<', '=', '>'}) {
      std::size_t count = 0;
      while (here(count) == c)
        ++count;
      if (count == 7)
        return c == '=' ? here(7) == '\n' || here(7) == '\r' || here(7) == '\0' : here(7) == ' ';
    }
    return false;
  }

  // false: the text is at its end.
  bool skipBlanks() {
    while (at_ < text_.size()) {
      const char c = here();
      if (c == '\n' || c == '\r') {
        newLine_ = true;
        ++at_;
      } else if (c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0' || c == '\x1A') {
        ++at_;
      } else if (text_.substr(at_).starts_with("\xC2\xA0")) {
        at_ += 2;
      } else if (text_.substr(at_).starts_with("\xEF\xBB\xBF")) {
        at_ += 3;
      } else if (c == '/' && here(1) == '/') {
        comment(lineEnd(at_));
      } else if (c == '/' && here(1) == '*') {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == View::npos) {
          add(TokenType::Bad, text_.size());
          return false;
        }
        comment(end + 2);
      } else if (mergeMarker()) {
        const std::size_t end = lineEnd(at_);
        out_.mergeMarkers.push_back(rangeTo(end));
        at_ = end;
      } else {
        return true;
      }
    }
    return false;
  }

  void next() {
    const char c = here();
    if (isNameStart(c)) return name();
    if (isDigitOf(c) || (c == '.' && isDigitOf(here(1)))) return number();
    if (c == '"' || c == '\'') return string(c);
    if (c == '`') return templatePart();
    if (c == '}' && !templates_.empty() && templates_.back() == 0) {
      templates_.pop_back();
      return templatePart();
    }
    if (c == '/' && regexMayBegin() && regex()) return;
    for (const View sign : kSigns) {
      if (!text_.substr(at_).starts_with(sign)) continue;
      // `a ?.5 : b`
      if (sign == "?." && isDigitOf(here(2))) continue;
      if (!templates_.empty()) templates_.back() += sign == "{" ? 1 : sign == "}" ? -1 : 0;
      return add(TokenType::Sign, at_ + sign.size());
    }
    add(TokenType::Bad, at_ + 1);
  }

  void name() {
    std::size_t end = at_;
    while (end < text_.size() && isNamePart(text_[end]))
      ++end;
    add(TokenType::Name, end);
  }

  void number() {
    std::size_t end = at_;
    const auto take = [&] {
      while (end < text_.size() && (isNamePart(text_[end]) || text_[end] == '.')) {
        const bool hex = text_.substr(at_).starts_with("0x") || text_.substr(at_).starts_with("0X");
        const bool exponent = !hex && (text_[end] == 'e' || text_[end] == 'E');
        ++end;
        if (exponent && end < text_.size() && (text_[end] == '+' || text_[end] == '-')) ++end;
      }
    };
    take();
    add(TokenType::Number, end);
  }

  void string(char quote) {
    for (std::size_t end = at_ + 1; end < text_.size(); ++end) {
      if (text_[end] == quote) return add(TokenType::String, end + 1);
      if (text_[end] == '\\') {
        if (text_.substr(end + 1).starts_with("\r\n")) ++end;
        ++end;
      } else if (text_[end] == '\n' || text_[end] == '\r') {
        return add(TokenType::Bad, end);
      }
    }
    add(TokenType::Bad, text_.size());
  }

  // From a backquote, or from the brace that ends a value within.
  void templatePart() {
    for (std::size_t end = at_ + 1; end < text_.size(); ++end) {
      if (text_[end] == '`') return add(TokenType::Template, end + 1);
      if (text_[end] == '\\') {
        ++end;
      } else if (text_[end] == '$' && end + 1 < text_.size() && text_[end + 1] == '{') {
        templates_.push_back(0);
        return add(TokenType::Template, end + 2);
      }
    }
    add(TokenType::Bad, text_.size());
  }

  bool regexMayBegin() const {
    if (out_.tokens.empty()) return true;
    const Token& last = out_.tokens.back();
    const View text = text_.substr(last.begin, last.end - last.begin);
    switch (last.type) {
    case TokenType::Name: {
      constexpr std::array<View, 11> kBefore = {"return", "typeof", "case", "in", "of",  "delete",
                                                "void",   "throw",  "new",  "do", "else"};
      return std::find(kBefore.begin(), kBefore.end(), text) != kBefore.end();
    }
    case TokenType::Number:
    case TokenType::String:
    case TokenType::Regex: return false;
    case TokenType::Template: return text.ends_with("${");
    case TokenType::Sign: return text != ")" && text != "]" && text != "}" && text != "++" && text != "--";
    default: return true;
    }
  }

  bool regex() {
    bool inClass = false;
    for (std::size_t end = at_ + 1; end < text_.size(); ++end) {
      const char c = text_[end];
      if (c == '\n' || c == '\r') return false;
      if (c == '\\') {
        ++end;
      } else if (c == '[') {
        inClass = true;
      } else if (c == ']') {
        inClass = false;
      } else if (c == '/' && !inClass) {
        ++end;
        while (end < text_.size() && isNamePart(text_[end]))
          ++end;
        add(TokenType::Regex, end);
        return true;
      }
    }
    return false;
  }

  FileId file_;
  View text_;
  std::size_t at_ = 0;
  bool newLine_ = false;
  Tokens out_;
  std::vector<int> templates_; // of each open value of a template, its open braces
};

} // namespace

bool isNameStart(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$' ||
         (static_cast<unsigned char>(c) >= 0x80);
}

bool isNamePart(char c) {
  return isNameStart(c) || isDigitOf(c);
}

bool isReserved(View word) {
  constexpr auto kWords = std::to_array<View>(
      {"break", "case",   "catch", "class",      "const",   "continue", "debugger", "default", "delete",
       "do",    "else",   "enum",  "export",     "extends", "false",    "finally",  "for",     "function",
       "if",    "import", "in",    "instanceof", "new",     "null",     "return",   "super",   "switch",
       "this",  "throw",  "true",  "try",        "typeof",  "var",      "void",     "while",   "with"});
  return std::binary_search(kWords.begin(), kWords.end(), word);
}

Tokens tokenize(FileId file, View text) {
  return Scanner(file, text).run();
}

} // namespace dotek::frontend::fusion
