#include "backends/fusion/Script.h"

#include "backends/common/PlainText.h"
#include "support/Decimal.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace dotek::backends::fusion {

namespace {

constexpr std::size_t kCommentWidth = 100;

// ES3, ES5 and strict ES5, ES6; then values that scripts do not expect to be something else.
constexpr std::array<std::string_view, 72> kReserved = {
    "abstract",  "arguments",    "await",      "boolean", "break",    "byte",       "case",
    "catch",     "char",         "class",      "const",   "continue", "debugger",   "default",
    "delete",    "do",           "double",     "else",    "enum",     "eval",       "export",
    "extends",   "false",        "final",      "finally", "float",    "for",        "function",
    "goto",      "if",           "implements", "import",  "in",       "instanceof", "int",
    "interface", "let",          "long",       "native",  "new",      "null",       "package",
    "private",   "protected",    "public",     "return",  "short",    "static",     "super",
    "switch",    "synchronized", "this",       "throw",   "throws",   "transient",  "true",
    "try",       "typeof",       "undefined",  "var",     "void",     "volatile",   "while",
    "with",      "yield",        "async",      "of",      "get",      "set",        "Infinity",
    "NaN",       "globalThis"};

// What the functions of a fragment use by name.
constexpr std::array<std::string_view, 28> kUsed = {
    "x",       "y",        "z",          "cycle",         "tool",           "unit",
    "MM",      "Math",     "Number",     "String",        "isFinite",       "error",
    "warning", "localize", "writeln",    "writeBlock",    "properties",     "xOutput",
    "yOutput", "zOutput",  "feedOutput", "gMotionModal",  "currentSection", "createFormat",
    "step",    "steps",    "cycleType",  "hasOwnProperty"};

std::uint32_t decode(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
  };
  const std::uint32_t lead = byte(at);
  const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  if (length == 1 || at + length > text.size()) {
    ++at;
    return lead;
  }
  std::uint32_t code = lead & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i)
    code = (code << 6U) | (byte(at + i) & 0x3FU);
  at += length;
  return code;
}

std::string escape(std::uint32_t code) {
  return fmt::format("\\u{:04X}", code);
}

} // namespace

std::string quoted(std::string_view utf8) {
  std::string out = "\"";
  for (std::size_t at = 0; at < utf8.size();) {
    const std::uint32_t code = decode(utf8, at);
    if (code == '"' || code == '\\')
      out += std::string("\\") + static_cast<char>(code);
    else if (code >= ' ' && code <= '~')
      out += static_cast<char>(code);
    else if (code > 0xFFFF)
      out += escape(0xD800 + ((code - 0x10000) >> 10U)) + escape(0xDC00 + ((code - 0x10000) & 0x3FFU));
    else
      out += escape(code);
  }
  return out + "\"";
}

std::string numberLiteral(double value, bool operand) {
  const std::string text = numberText(value);
  return operand && text.starts_with('-') ? "(" + text + ")" : text;
}

bool isReserved(std::string_view name) {
  return std::find(kReserved.begin(), kReserved.end(), name) != kReserved.end();
}

LocalNames::LocalNames() : taken_(kUsed.begin(), kUsed.end()) {}

std::string LocalNames::take(std::string_view wanted) {
  std::string name;
  for (const char c : wanted)
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0) name.insert(0, 1, '_');
  while (isReserved(name) || !taken_.insert(name).second)
    name += '_';
  return name;
}

std::string prefixOf(const std::string& cycleName) {
  std::string out;
  bool upper = false;
  for (const char c : cycleName) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 || std::isalnum(byte) == 0) {
      upper = !out.empty();
      continue;
    }
    out += static_cast<char>(upper ? std::toupper(byte) : std::tolower(byte));
    upper = false;
  }
  if (out.empty() || std::isdigit(static_cast<unsigned char>(out[0])) != 0) out.insert(0, "cycle");
  return out;
}

void Script::add(std::string text, const ir::Origin& origin) {
  lines_.push_back({std::string(2 * depth_, ' ') + text, origin.ranges, origin.reason});
}

void Script::open(std::string text, const ir::Origin& origin) {
  add(std::move(text), origin);
  ++depth_;
}

void Script::close(std::string text) {
  --depth_;
  add(std::move(text));
}

void Script::comment(std::string_view utf8) {
  for (const std::string& line : wrapWords(plainText(utf8).text, kCommentWidth))
    add("// " + line);
}

void Script::text(std::string_view lines) {
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    const std::string_view line = lines.substr(0, end);
    if (line.empty())
      blank();
    else
      add(std::string(line));
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
}

} // namespace dotek::backends::fusion
