// Words of the Cycle language: names, texts and numbers as print() writes them.
#pragma once

#include "ir/Cycle.h"
#include "ir/Program.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::ir {

// Bare where it is an identifier and no word of the language, else in quotes.
std::string nameText(std::string_view name);
// In quotes; quote and backslash as \" and \\, control characters as \xHH.
std::string quoted(std::string_view text);
// The digits as written where they read as the value; {5}: computed; 0.005 written "5": read otherwise.
std::string constantText(double value, std::string_view digits);

// How expressions refer to the variables and labels of a cycle: names, made unique by a number.
class Names {
public:
  enum class Numbers : std::uint8_t { AsWritten, Plain };
  // Plain: equal numbers have equal texts, however the source writes them.
  explicit Names(const Cycle& cycle, Numbers numbers = Numbers::AsWritten);
  // Labels of a program: N numbers, made up ones count from 1.
  explicit Names(const Program& program);
  std::string number(const Constant& constant) const;
  const std::string& variable(VariableId id) const { return id < variables_.size() ? variables_[id] : none_; }
  const std::string& label(LabelId id) const { return id < labels_.size() ? labels_[id] : none_; }

private:
  std::vector<std::string> variables_;
  std::vector<std::string> labels_;
  Numbers numbers_;
  std::string none_ = "\"?\""; // of an id that does not exist: verify() tells
};

// Append the text to `out`. A primary needs no brackets after a sign, `#` or a letter.
void write(const Expression& expression, const Names& names, std::string& out);
void writePrimary(const Expression& expression, const Names& names, std::string& out);
void write(const Condition& condition, const Names& names, std::string& out);

} // namespace dotek::ir
