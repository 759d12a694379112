#include "tests/unit/FaultOperators.h"

#include "tests/policy/Tree.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <functional>
#include <utility>

namespace dotek::tests {

namespace {

bool isLetter(char c) {
  return c >= 'A' && c <= 'Z';
}
bool isDigit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// One line: its text, and what of it is code.
struct Line {
  std::string text;
  std::string code; // of the same length, comments as blanks

  explicit Line(std::string given) : text(std::move(given)), code(text) {
    int depth = 0;
    for (char& c : code) {
      depth += c == '(' ? 1 : 0;
      const bool comment = depth > 0;
      depth -= c == ')' ? 1 : 0;
      if (comment) c = ' ';
    }
  }
  std::string packed() const {
    std::string out;
    std::copy_if(code.begin(), code.end(), std::back_inserter(out), [](char c) { return c != ' '; });
    return out;
  }
  char at(std::size_t i) const { return i < code.size() ? code[i] : '\0'; }
  char beforeOf(std::size_t i) const { return i == 0 ? '\0' : code[i - 1]; }
  std::string with(std::size_t begin, std::size_t length, std::string_view other) const {
    std::string out = text;
    return out.replace(begin, length, other);
  }
};

struct Span {
  std::size_t begin = 0, length = 0;
};

std::size_t digitsFrom(const Line& line, std::size_t at) {
  std::size_t end = at;
  while (isDigit(line.at(end)))
    ++end;
  return end;
}

// After a value that begins at `at`; `at` itself: there is none.
std::size_t valueEnd(const Line& line, std::size_t at) {
  std::size_t end = at;
  if (line.at(end) == '-' || line.at(end) == '+') ++end;
  while (line.at(end) == '#')
    ++end;
  if (line.at(end) == '[') {
    int depth = 0;
    do {
      depth += line.at(end) == '[' ? 1 : line.at(end) == ']' ? -1 : 0;
      ++end;
    } while (depth > 0 && end < line.code.size());
    return end;
  }
  const std::size_t digits = end;
  while (isDigit(line.at(end)) || line.at(end) == '.')
    ++end;
  return end == digits ? at : end;
}

// A word of a block: a letter and its value.
struct Word {
  char letter = 0;
  Span all, value;
};

std::vector<Word> wordsOf(const Line& line) {
  std::vector<Word> out;
  if (line.packed().starts_with("IF[") || line.packed().starts_with("WHILE[")) return out;
  for (std::size_t i = 0; i < line.code.size(); ++i) {
    if (!isLetter(line.at(i)) || isLetter(line.beforeOf(i))) continue;
    const std::size_t end = valueEnd(line, i + 1);
    if (end == i + 1) continue;
    out.push_back({line.at(i), {i, end - i}, {i + 1, end - i - 1}});
  }
  return out;
}

// A number as it is: not that of a variable.
struct Literal {
  Span span;
  char before = 0; // the character in front of it
};

std::vector<Literal> literalsOf(const Line& line) {
  std::vector<Literal> out;
  for (std::size_t i = 0; i < line.code.size(); ++i) {
    if (!isDigit(line.at(i)) || isDigit(line.beforeOf(i)) || line.beforeOf(i) == '.') continue;
    std::size_t end = i;
    while (isDigit(line.at(end)) || line.at(end) == '.')
      ++end;
    if (line.beforeOf(i) != '#') out.push_back({{i, end - i}, line.beforeOf(i)});
    i = end;
  }
  return out;
}

struct Variable {
  Span digits; // after #
  int number = 0;
};

// Written with a number; also the bases of computed ones, `#[5041+#1]`.
std::vector<Variable> variablesOf(const Line& line) {
  std::vector<Variable> out;
  for (std::size_t i = 0; i < line.code.size(); ++i) {
    if (line.at(i) != '#') continue;
    const std::size_t begin = line.at(i + 1) == '[' ? i + 2 : i + 1;
    const std::size_t end = digitsFrom(line, begin);
    if (end == begin) continue;
    out.push_back({{begin, end - begin}, std::stoi(line.code.substr(begin, end - begin))});
  }
  return out;
}

std::uint32_t calledBy(const Line& line) {
  const std::string packed = line.packed();
  if (!packed.starts_with("G65P")) return 0;
  std::uint32_t out = 0;
  for (std::size_t i = 4; i < packed.size() && isDigit(packed[i]); ++i)
    out = out * 10 + static_cast<std::uint32_t>(packed[i] - '0');
  return out;
}

bool hasCode(const Line& line, char letter, std::string_view number) {
  const std::vector<Word> words = wordsOf(line);
  return std::any_of(words.begin(), words.end(), [&](const Word& word) {
    return word.letter == letter && line.code.substr(word.value.begin, word.value.length) == number;
  });
}

bool isStatement(const Line& line) {
  const std::string packed = line.packed();
  return !packed.empty() && packed[0] != '%' && packed[0] != 'O' && packed[0] != 'N';
}
bool isPlain(const Line& line) { // may be done twice or later
  const std::string packed = line.packed();
  return isStatement(line) && !packed.starts_with("WHILE") && !packed.starts_with("END") &&
         !packed.starts_with("GOTO") && !packed.starts_with("M99") && !packed.starts_with("IF");
}

class Places {
public:
  Places(std::string_view kind, std::string_view program, const FaultWords& words)
      : kind_(kind), words_(words) {
    for (std::string& line : linesOf(program))
      lines_.emplace_back(std::move(line));
  }

  std::vector<Fault> find() {
    for (now_ = 0; now_ < lines_.size(); ++now_) {
      const Line& line = lines_[now_];
      if (line.packed().empty() || line.packed()[0] == 'O' || line.packed()[0] == '%') continue;
      (this->*operatorOf())(line);
    }
    return std::move(out_);
  }

private:
  using Operator = void (Places::*)(const Line&);

public:
  static const std::vector<std::pair<std::string_view, Operator>>& operators() {
    static const std::vector<std::pair<std::string_view, Operator>> all = {
        {"change a sign", &Places::sign},
        {"drop a retract", &Places::retract},
        {"swap X and Y", &Places::swapAxes},
        {"forget the radius", &Places::radius},
        {"G91 for G90", &Places::incremental},
        {"leave the probe off", &Places::probeOff},
        {"one position variable for another", &Places::position},
        {"one variable for another", &Places::local},
        {"the wrong work system", &Places::system},
        {"change a number", &Places::number},
        {"turn a condition", &Places::condition},
        {"jump elsewhere", &Places::jump},
        {"forget a word", &Places::word},
        {"one macro for another", &Places::macro},
        {"another motion", &Places::motion},
        {"drop a line", &Places::drop},
        {"do a line twice", &Places::twice},
        {"exchange two lines", &Places::exchange},
    };
    return all;
  }

private:
  Operator operatorOf() const {
    const auto& all = operators();
    return std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == kind_; })->second;
  }
  void add(std::string after) {
    if (after != lines_[now_].text)
      out_.push_back({std::string(kind_), now_, lines_[now_].text, std::move(after)});
  }

  void sign(const Line& line) {
    for (std::size_t i = 0; i < line.code.size(); ++i) {
      if (line.at(i) != '+' && line.at(i) != '-') continue;
      const char before = line.beforeOf(i);
      const bool unary = !isDigit(before) && before != ']' && before != '.';
      add(line.with(i, 1, unary ? "" : line.at(i) == '+' ? "-" : "+"));
    }
    for (const Word& word : wordsOf(line))
      if (std::string_view("XYZIJK").find(word.letter) != std::string_view::npos &&
          line.at(word.value.begin) != '-')
        add(line.with(word.value.begin, 0, "-"));
  }

  bool measures(const Line& line) const {
    return words_.measures.contains(calledBy(line)) || hasCode(line, 'G', "31");
  }
  bool moves(const Line& line) const {
    return words_.travels.contains(calledBy(line)) || hasCode(line, 'G', "0") || hasCode(line, 'G', "1");
  }
  // The first move after a measure.
  void retract(const Line& line) {
    if (!moves(line)) return;
    for (std::size_t i = now_; i-- > 0;) {
      if (lines_[i].packed().starts_with("O") || moves(lines_[i])) return;
      if (measures(lines_[i])) return add("");
    }
  }

  void swapAxes(const Line& line) {
    std::string out = line.text;
    for (const Word& word : wordsOf(line)) {
      if (word.letter == 'X') out[word.all.begin] = 'Y';
      if (word.letter == 'Y') out[word.all.begin] = 'X';
    }
    add(std::move(out));
  }

  void radius(const Line& line) {
    if (line.packed().find("GOTO") != std::string::npos || line.packed().find("#3000") != std::string::npos)
      return;
    for (const Variable& variable : variablesOf(line)) {
      const std::size_t begin = variable.digits.begin - 1;
      if (words_.radius.contains(line.code.substr(begin, variable.digits.length + 1)))
        add(line.with(begin, variable.digits.length + 1, "0"));
    }
  }

  void incremental(const Line& line) {
    for (const Word& word : wordsOf(line))
      if (line.code.substr(word.all.begin, word.all.length) == "G90")
        add(line.with(word.all.begin, word.all.length, "G91"));
  }

  void probeOff(const Line& line) {
    if (words_.probeOn.contains(line.packed())) add("");
  }

  // The same axis of another kind of position, another axis of the same kind; results alike.
  void position(const Line& line) {
    static constexpr std::array<int, 5> kPositions = {5001, 5021, 5041, 5061, 5081};
    for (const Variable& variable : variablesOf(line)) {
      const auto put = [&](int number) {
        add(line.with(variable.digits.begin, variable.digits.length, std::to_string(number)));
      };
      for (const int base : kPositions) {
        const int axis = variable.number - base;
        if (axis < 0 || axis > 2) continue;
        for (const int other : kPositions)
          if (other != base) put(other + axis);
        put(base + (axis + 1) % 3);
        put(base + (axis + 2) % 3);
      }
      if (variable.number >= 135 && variable.number <= 138)
        for (int other = 135; other <= 138; ++other)
          if (other != variable.number) put(other);
    }
  }

  void local(const Line& line) {
    std::set<int> used;
    for (std::size_t i = 0; i < lines_.size(); ++i)
      for (const Variable& variable : variablesOf(lines_[i]))
        if (programOf(i) == programOf(now_) && variable.number >= 1 && variable.number <= 33)
          used.insert(variable.number);
    for (const Variable& variable : variablesOf(line)) {
      if (!used.contains(variable.number) || used.size() < 2) continue;
      auto other = used.upper_bound(variable.number);
      if (other == used.end()) other = used.begin();
      add(line.with(variable.digits.begin, variable.digits.length, std::to_string(*other)));
    }
  }

  // Numbers of the systems' zeros; the system that a measure sets.
  void system(const Line& line) {
    for (std::size_t i = 0; i < line.code.size(); ++i) {
      if (!isDigit(line.at(i)) || isDigit(line.beforeOf(i))) continue;
      const std::size_t end = digitsFrom(line, i);
      if (end - i != 4 || line.code.substr(i, 2) != "52") continue;
      add(line.with(i, 4, std::to_string(std::stoi(line.code.substr(i, 4)) + 20)));
    }
    if (words_.measures.contains(calledBy(line)))
      for (const Word& word : wordsOf(line))
        if (word.letter == 'S')
          add(line.with(word.value.begin, word.value.length,
                        "[" + line.code.substr(word.value.begin, word.value.length) + "+1]"));
  }

  void number(const Line& line) {
    const bool jumps = line.packed().starts_with("N") || line.packed().starts_with("END");
    if (jumps) return;
    for (const Literal& literal : literalsOf(line)) {
      if (std::string_view("GMNOPT").find(literal.before) != std::string_view::npos) continue;
      const std::string text = line.code.substr(literal.span.begin, literal.span.length);
      std::string other = std::to_string(std::stoi(text) + 1);
      const std::size_t point = text.find('.');
      if (point != std::string::npos) other += text.substr(point);
      add(line.with(literal.span.begin, literal.span.length, other));
    }
  }

  void condition(const Line& line) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kOpposites = {
        {{"EQ", "NE"}, {"NE", "EQ"}, {"LT", "GE"}, {"GE", "LT"}, {"GT", "LE"}, {"LE", "GT"}}};
    if (!line.packed().starts_with("IF[") && !line.packed().starts_with("WHILE[")) return;
    for (std::size_t i = 0; i + 2 <= line.code.size(); ++i) {
      if (isLetter(line.beforeOf(i)) || isLetter(line.at(i + 2))) continue;
      for (const auto& [one, other] : kOpposites)
        if (line.code.substr(i, 2) == one) add(line.with(i, 2, other));
    }
  }

  void jump(const Line& line) {
    const std::size_t at = line.code.find("GOTO");
    if (at == std::string::npos) return;
    const std::size_t end = digitsFrom(line, at + 4);
    const std::string to = line.code.substr(at + 4, end - at - 4);
    for (const std::string& label : labels())
      if (label != to) add(line.with(at + 4, end - at - 4, label));
  }

  void word(const Line& line) {
    const std::vector<Word> words = wordsOf(line);
    if (words.size() < 2) return;
    for (const Word& one : words)
      if (one.letter != 'P' && line.code.substr(one.all.begin, one.all.length) != "G65")
        add(line.with(one.all.begin, one.all.length, ""));
  }

  void macro(const Line& line) {
    std::set<std::uint32_t> called;
    for (const Line& one : lines_)
      if (calledBy(one) != 0) called.insert(calledBy(one));
    if (calledBy(line) == 0) return;
    const std::size_t at = line.code.find('P') + 1;
    for (const std::uint32_t other : called)
      if (other != calledBy(line)) add(line.with(at, digitsFrom(line, at) - at, std::to_string(other)));
  }

  void motion(const Line& line) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kOthers = {
        {{"G0", "G1"}, {"G1", "G0"}, {"G31", "G1"}}};
    for (const Word& word : wordsOf(line))
      for (const auto& [one, other] : kOthers)
        if (line.code.substr(word.all.begin, word.all.length) == one)
          add(line.with(word.all.begin, word.all.length, other));
  }

  void drop(const Line& line) {
    if (isStatement(line)) add("");
  }
  void twice(const Line& line) {
    if (isPlain(line)) add(line.text + "\n" + line.text);
  }
  void exchange(const Line& line) {
    if (now_ + 1 >= lines_.size() || !isPlain(line) || !isPlain(lines_[now_ + 1])) return;
    out_.push_back({std::string(kind_), now_, line.text + "\n" + lines_[now_ + 1].text,
                    lines_[now_ + 1].text + "\n" + line.text});
  }

  // The line where the program begins in which line `i` is.
  std::size_t programOf(std::size_t i) const {
    while (i > 0 && !lines_[i].packed().starts_with("O"))
      --i;
    return i;
  }
  std::set<std::string> labels() const {
    std::set<std::string> out;
    for (std::size_t i = programOf(now_) + 1; i < lines_.size() && !lines_[i].packed().starts_with("O"); ++i)
      if (lines_[i].at(0) == 'N') out.insert(lines_[i].code.substr(1, digitsFrom(lines_[i], 1) - 1));
    return out;
  }

  std::string_view kind_;
  const FaultWords& words_;
  std::vector<Line> lines_;
  std::size_t now_ = 0;
  std::vector<Fault> out_;
};

} // namespace

std::string Fault::text() const {
  const auto shown = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;)
      text.replace(at, 1, " / ");
    return "`" + text + "`";
  };
  return fmt::format("{}, line {}: {} {}", kind, line + 1, shown(before),
                     after.empty() ? std::string("is dropped") : "becomes " + shown(after));
}

const std::vector<std::string_view>& faultKinds() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> out;
    for (const auto& one : Places::operators())
      out.push_back(one.first);
    return out;
  }();
  return names;
}

std::vector<Fault> faultsOf(std::string_view kind, std::string_view program, const FaultWords& words) {
  return Places(kind, program, words).find();
}

std::string withFault(std::string_view program, const Fault& fault) {
  std::string out;
  const std::vector<std::string> lines = linesOf(program);
  const auto more = static_cast<std::size_t>(std::count(fault.before.begin(), fault.before.end(), '\n'));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i > fault.line && i <= fault.line + more) continue;
    if (i != fault.line)
      out += lines[i] + "\n";
    else if (!fault.after.empty())
      out += fault.after + "\n";
  }
  return out;
}

} // namespace dotek::tests
