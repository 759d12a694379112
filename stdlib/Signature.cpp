#include "stdlib/Signature.h"

#include <charconv>
#include <fmt/format.h>

namespace dotek::stdlib {
namespace {

bool isUpper(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '+';
}
bool isLower(char c) {
  return c >= 'a' && c <= 'z';
}
bool isNamePart(char c) {
  return isLower(c) || (c >= '0' && c <= '9') || c == '_';
}

bool take(std::string_view& text, std::string_view mark) {
  if (!text.starts_with(mark)) return false;
  text.remove_prefix(mark.size());
  return true;
}

template <class Test> std::string_view takeWhile(std::string_view& text, Test test) {
  std::size_t n = 0;
  while (n < text.size() && test(text[n]))
    ++n;
  const std::string_view taken = text.substr(0, n);
  text.remove_prefix(n);
  return taken;
}

bool parseChoice(std::string_view& text, ArgumentSpec& argument) {
  argument.kind = ArgumentSpec::Kind::Choice;
  do {
    const std::string_view word = takeWhile(text, isUpper);
    if (word.empty()) return false;
    argument.keywords.emplace_back(word);
  } while (take(text, "|"));
  return true;
}

bool parseVariable(std::string_view& text, ArgumentSpec& argument) {
  if (take(text, "<>"))
    argument.kind = ArgumentSpec::Kind::ReadWrite;
  else if (take(text, ">"))
    argument.kind = ArgumentSpec::Kind::Result;
  if (text.empty() || !isLower(text[0])) return false;
  argument.name = takeWhile(text, isNamePart);
  if (take(text, "$"))
    argument.type = ArgumentSpec::Type::Text;
  else if (take(text, "*"))
    argument.type = ArgumentSpec::Type::ByParameter;
  argument.array = take(text, "[]");
  for (const char* prefix : {"point_ref", "line_ref", "circle_ref"})
    argument.geometry |= argument.name.starts_with(prefix);
  return true;
}

bool parseArgument(std::string_view text, ArgumentSpec& argument) {
  argument.optional = take(text, "?");
  if (take(text, "@")) {
    argument.kind = ArgumentSpec::Kind::Parameter;
    argument.family = takeWhile(text, [](char c) { return isLower(c) || c == '_'; });
    if (argument.family.empty()) return false;
  } else if (!text.empty() && isUpper(text[0])) {
    if (!parseChoice(text, argument)) return false;
  } else if (!parseVariable(text, argument)) {
    return false;
  }
  if (take(text, "...")) {
    argument.repeat = kNoBound;
    if (!text.empty()) {
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), argument.repeat);
      if (error != std::errc() || argument.repeat == 0) return false;
      text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
  }
  return text.empty();
}

} // namespace

std::optional<CommandSignature> parseSignature(std::string_view text, std::string& defect) {
  CommandSignature signature;
  const std::size_t blank = std::min(text.find(' '), text.size());
  signature.name = text.substr(0, blank);
  std::string_view rest = text.substr(blank);
  for (const char c : signature.name) {
    if (!isUpper(c) && c != '#') {
      defect = fmt::format("signature `{}`: a command name in capitals is expected first", text);
      return std::nullopt;
    }
  }
  if (signature.name.empty()) {
    defect = "a signature is empty";
    return std::nullopt;
  }
  bool optionalSeen = false;
  while (!rest.empty()) {
    rest.remove_prefix(1); // the blank after the name or the comma
    const std::size_t comma = std::min(rest.find(','), rest.size());
    ArgumentSpec argument;
    const std::string_view part = rest.substr(0, comma);
    if (!parseArgument(part, argument)) {
      defect = fmt::format("signature `{}`: `{}` is no argument", text, part);
      return std::nullopt;
    }
    if (optionalSeen && !argument.optional) {
      defect =
          fmt::format("signature `{}`: `{}` follows an optional argument and is not optional", text, part);
      return std::nullopt;
    }
    optionalSeen = argument.optional;
    signature.arguments.push_back(std::move(argument));
    rest.remove_prefix(comma);
    if (rest == "," || (rest.size() > 1 && rest[1] != ' ')) {
      defect = fmt::format("signature `{}`: a comma is followed by one blank and an argument", text);
      return std::nullopt;
    }
    if (!rest.empty()) rest.remove_prefix(1);
  }
  return signature;
}

} // namespace dotek::stdlib
