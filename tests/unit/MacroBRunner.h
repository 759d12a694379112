// Runs the text of a converted program on arguments: a small reader of Macro B, written from the reference
// and not from the emitter, so that both are checked. It knows what a converted program may hold, and throws
// at anything else.
#pragma once

#include "support/Decimal.h"

#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace dotek::tests {

class MacroBRunner {
public:
  using Value = std::optional<double>; // nothing: null

  std::map<int, Value> variables;  // presets: system variables, common variables
  std::vector<std::string> blocks; // NC blocks that ran, words with values: "G65P9770Z5"
  int alarm = 0;                   // n of #3000=n
  std::string alarmText;
  bool returned = false; // M99 was reached

  // Locals #1 to #33 are what the call gives.
  void run(const std::string& program, const std::map<char, double>& arguments) {
    for (int i = 1; i <= 33; ++i)
      variables.erase(i);
    for (const auto& [letter, value] : arguments)
      variables[localOf(letter)] = value;
    split(program);
    std::size_t at = 0;
    for (int steps = 0; at < lines_.size(); ++steps) {
      if (steps > 100000) throw std::runtime_error("endless");
      const std::size_t next = at + 1;
      jump_.reset();
      text_ = lines_[at].text;
      position_ = 0;
      statement();
      if (alarm != 0 || returned) return;
      at = jump_ ? target(*jump_) : next;
    }
  }

  static int localOf(char letter) {
    static const std::map<char, int> kLocals = {
        {'A', 1},  {'B', 2},  {'C', 3},  {'D', 7},  {'E', 8},  {'F', 9},  {'H', 11},
        {'I', 4},  {'J', 5},  {'K', 6},  {'M', 13}, {'Q', 17}, {'R', 18}, {'S', 19},
        {'T', 20}, {'U', 21}, {'V', 22}, {'W', 23}, {'X', 24}, {'Y', 25}, {'Z', 26}};
    return kLocals.at(letter);
  }

private:
  struct Line {
    int number = 0; // N, 0 for none
    std::string text;
    std::string comment; // last one
  };

  void split(const std::string& program) {
    lines_.clear();
    std::string line;
    for (const char c : program + "\n") {
      if (c != '\n') {
        line += c;
        continue;
      }
      add(line);
      line.clear();
    }
  }

  void add(const std::string& raw) {
    Line line;
    bool comment = false;
    const bool message = raw.find("#3000") != std::string::npos;
    for (const char c : raw) {
      if (c == '(') {
        if (comment) throw std::runtime_error("a comment inside a comment: " + raw);
        comment = true;
        line.comment.clear();
      } else if (c == ')') {
        comment = false;
      } else if (comment) {
        line.comment += c;
      } else if (c != ' ') {
        line.text += c;
      }
    }
    if (comment) throw std::runtime_error("an open comment: " + raw);
    if (line.text == "%" || line.text.empty() || line.text[0] == 'O') return;
    if (line.text[0] == 'N') {
      std::size_t end = 1;
      while (end < line.text.size() && std::isdigit(static_cast<unsigned char>(line.text[end])) != 0)
        ++end;
      line.number = std::stoi(line.text.substr(1, end - 1));
      line.text.erase(0, end);
    }
    if (message && line.comment.empty()) throw std::runtime_error("an alarm without text: " + raw);
    lines_.push_back(std::move(line));
  }

  std::size_t target(int number) const {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (lines_[i].number == number) return i;
    }
    throw std::runtime_error("no N" + std::to_string(number));
  }

  // ---- reading
  // ---------------------------------------------------------------------------------------------

  bool take(const std::string& word) {
    if (text_.compare(position_, word.size(), word) != 0) return false;
    position_ += word.size();
    return true;
  }
  void expect(const std::string& word) {
    if (!take(word)) throw std::runtime_error("`" + word + "` is missing in " + text_);
  }
  char peek() const { return position_ < text_.size() ? text_[position_] : '\0'; }

  void statement() {
    if (peek() == '\0') return;
    if (take("IF")) {
      expect("[");
      const bool holds = condition();
      expect("]");
      if (take("GOTO")) {
        const int number = whole();
        if (holds) jump_ = number;
        return;
      }
      expect("THEN");
      if (peek() != '#') throw std::runtime_error("THEN takes an assignment here: " + text_);
      if (holds) statement();
      return;
    }
    if (take("GOTO")) {
      jump_ = whole();
      return;
    }
    if (peek() == '#') {
      ++position_;
      const int number = subscript();
      expect("=");
      const Value value = expression();
      if (position_ != text_.size()) throw std::runtime_error("more after the value: " + text_);
      if (number == 3000) {
        alarm = static_cast<int>(*value);
        for (const Line& line : lines_) {
          if (line.text == text_) alarmText = line.comment;
        }
        return;
      }
      if (number == 0 || (number >= 4000 && number < 5200))
        throw std::runtime_error("written: #" + std::to_string(number));
      variables[number] = value;
      return;
    }
    block();
  }

  void block() {
    std::string out;
    while (peek() != '\0') {
      const char address = text_[position_++];
      if (address < 'A' || address > 'Z') throw std::runtime_error("no word: " + text_);
      const Value value = operand();
      if (value) out += address + numberText(*value);
    }
    if (out == "M99") returned = true;
    blocks.push_back(out);
  }

  int whole() {
    std::string digits;
    while (std::isdigit(static_cast<unsigned char>(peek())) != 0)
      digits += text_[position_++];
    if (digits.empty()) throw std::runtime_error("a number is missing in " + text_);
    return std::stoi(digits);
  }

  // After `#`.
  int subscript() {
    if (take("[")) {
      const Value value = expression();
      expect("]");
      return static_cast<int>(std::lround(value.value_or(0)));
    }
    return whole();
  }

  bool condition() {
    if (take("[")) { // [[a EQ b]AND[c LT d]]
      bool holds = condition();
      expect("]");
      while (true) {
        if (take("AND")) {
          expect("[");
          holds = condition() && holds;
        } else if (take("OR")) {
          expect("[");
          holds = condition() || holds;
        } else {
          return holds;
        }
        expect("]");
      }
    }
    const Value left = expression();
    for (const char* relation : {"EQ", "NE", "GT", "GE", "LT", "LE"}) {
      if (!take(relation)) continue;
      const Value right = expression();
      const std::string r = relation;
      if (r == "EQ") return left == right;
      if (r == "NE") return left != right;
      const double a = left.value_or(0);
      const double b = right.value_or(0);
      return r == "GT" ? a > b : r == "GE" ? a >= b : r == "LT" ? a < b : a <= b;
    }
    throw std::runtime_error("a relation is missing in " + text_);
  }

  Value expression() {
    Value left = term();
    while (peek() == '+' || peek() == '-') {
      const bool plus = text_[position_++] == '+';
      const double right = term().value_or(0);
      left = plus ? left.value_or(0) + right : left.value_or(0) - right;
    }
    return left;
  }

  Value term() {
    Value left = operand();
    while (peek() == '*' || peek() == '/' || text_.compare(position_, 3, "MOD") == 0) {
      const char op = peek();
      position_ += op == 'M' ? 3 : 1;
      const double right = operand().value_or(0);
      if (op != '*' && right == 0) throw std::runtime_error("division by zero: " + text_);
      left = op == '*'   ? left.value_or(0) * right
             : op == '/' ? left.value_or(0) / right
                         : std::fmod(left.value_or(0), right);
    }
    return left;
  }

  Value operand() {
    if (peek() == '-') {
      ++position_;
      const Value value = operand();
      return value ? Value(0 - *value) : Value(0.0);
    }
    if (take("#")) {
      const int number = subscript();
      const auto found = variables.find(number);
      return found == variables.end() ? Value() : found->second;
    }
    if (take("[")) {
      const Value value = expression();
      expect("]");
      return value;
    }
    if (std::isalpha(static_cast<unsigned char>(peek())) != 0) return function();
    std::string digits;
    while (std::isdigit(static_cast<unsigned char>(peek())) != 0 || peek() == '.')
      digits += text_[position_++];
    const auto number = parseNumber(digits);
    if (!number) throw std::runtime_error("a value is missing in " + text_);
    return *number;
  }

  Value function() {
    constexpr double kDegree = 3.14159265358979323846 / 180;
    for (const char* name : {"ABS", "SQRT", "FIX", "FUP", "ROUND", "SIN", "COS", "TAN", "ATAN"}) {
      if (!take(name)) continue;
      expect("[");
      const double x = expression().value_or(0);
      expect("]");
      const std::string f = name;
      if (f == "ABS") return std::fabs(x);
      if (f == "SQRT") return std::sqrt(x);
      if (f == "FIX") return std::trunc(x);
      if (f == "FUP") return x < 0 ? std::floor(x) : std::ceil(x);
      if (f == "ROUND") return std::round(x);
      if (f == "SIN") return std::sin(x * kDegree);
      if (f == "COS") return std::cos(x * kDegree);
      if (f == "TAN") return std::tan(x * kDegree);
      if (!take("/")) return std::atan(x) / kDegree;
      expect("[");
      const double run = expression().value_or(0);
      expect("]");
      return std::atan2(x, run) / kDegree;
    }
    throw std::runtime_error("no function this reader knows: " + text_);
  }

  std::vector<Line> lines_;
  std::string text_;
  std::size_t position_ = 0;
  std::optional<int> jump_;
};

} // namespace dotek::tests
