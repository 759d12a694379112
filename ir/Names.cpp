#include "ir/Names.h"

#include "support/Decimal.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <unordered_set>

namespace dotek::ir {
namespace {

// Words that are where a name may appear, or after one.
constexpr std::string_view kWords[] = {
    "abs",     "acos",   "alarm",    "and",    "as",       "asin",     "atan",    "bitand",    "bitor",
    "bitxor",  "block",  "body",     "checks", "comment",  "coolant",  "cos",     "cycle",     "direction",
    "dwell",   "exp",    "false",    "feed",   "goto",     "here",     "host",    "if",        "in",
    "is",      "label",  "labels",   "ln",     "local",    "machine",  "measure", "mod",       "mode",
    "move",    "not",    "null",     "of",     "optional", "or",       "or_zero", "parameter", "point",
    "probe",   "result", "retract",  "return", "round",    "round_up", "set",     "sin",       "speed",
    "spindle", "sqrt",   "start",    "stop",   "store",    "system",   "tan",     "to",        "true",
    "trunc",   "units",  "value_or", "work",   "written"};

bool isIdentifier(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !name.empty() && letter(name.front()) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

// "a", "a_2": the second name that is "a".
std::vector<std::string> unique(const std::vector<std::string_view>& names) {
  std::unordered_set<std::string_view> given(names.begin(), names.end());
  std::unordered_set<std::string> taken;
  std::vector<std::string> out;
  for (const std::string_view name : names) {
    std::string text(name);
    for (std::size_t i = out.size() + 1; !taken.insert(text).second;) {
      do
        text = std::string(name) + "_" + std::to_string(i++);
      while (given.contains(text));
    }
    out.push_back(nameText(text));
  }
  return out;
}

} // namespace

std::string nameText(std::string_view name) {
  const bool bare =
      isIdentifier(name) && std::find(std::begin(kWords), std::end(kWords), name) == std::end(kWords);
  return bare ? std::string(name) : quoted(name);
}

std::string quoted(std::string_view text) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7F) {
      out += "\\x";
      out += kHex[byte >> 4U];
      out += kHex[byte & 15U];
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string constantText(double value, std::string_view digits) {
  if (digits.empty()) return "{" + numberText(value) + "}";
  const auto read = parseNumber(digits);
  if (read && *read == value && !digits.starts_with('+')) return std::string(digits);
  return numberText(value) + " written " + quoted(digits);
}

std::string Names::number(const Constant& constant) const {
  return numbers_ == Numbers::Plain ? numberText(constant.value)
                                    : constantText(constant.value, constant.digits);
}

Names::Names(const Cycle& cycle, Numbers numbers) : numbers_(numbers) {
  std::vector<std::string_view> names;
  for (const Variable& variable : cycle.variables)
    names.push_back(variable.name);
  variables_ = unique(names);
  names.clear();
  for (const LabelName& label : cycle.labels)
    names.push_back(label.name);
  labels_ = unique(names);
}

Names::Names(const Program& program) : numbers_(Numbers::AsWritten) {
  std::vector<std::string> texts;
  std::size_t made = 0;
  for (const ProgramLabel& label : program.labels)
    texts.push_back(label.number != 0 ? "n" + std::to_string(label.number) : "next" + std::to_string(++made));
  std::vector<std::string_view> names(texts.begin(), texts.end());
  labels_ = unique(names);
}

} // namespace dotek::ir
