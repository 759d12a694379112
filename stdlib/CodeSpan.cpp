#include "stdlib/CodeSpan.h"

#include "stdlib/Control.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::stdlib {

std::optional<CodeSpan> codeSpan(std::string_view text) {
  constexpr std::uint32_t kMostCodes = 1000;
  std::size_t at = 0;
  const auto letter = [&]() -> char {
    const char c = at < text.size() ? static_cast<char>(text[at] & ~0x20) : '\0';
    return c == 'G' || c == 'M' ? c : '\0';
  };
  const auto digit = [&] { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
  const auto number = [&]() -> std::optional<std::uint32_t> {
    const std::size_t begin = at;
    std::uint32_t out = 0;
    for (; digit() && at - begin < 5; ++at)
      out = out * 10 + static_cast<std::uint32_t>(text[at] - '0');
    if (at == begin) return std::nullopt;
    out *= 10;
    if (at + 1 < text.size() && text[at] == '.' && text[at + 1] >= '1' && text[at + 1] <= '9') {
      out += static_cast<std::uint32_t>(text[at + 1] - '0');
      at += 2;
    }
    return out;
  };
  CodeSpan span;
  span.letter = letter();
  if (span.letter == 0) return std::nullopt;
  ++at;
  const auto first = number();
  if (!first) return std::nullopt;
  span.first = span.last = *first;
  if (at < text.size() && text[at] == '-') {
    ++at;
    if (const char other = letter(); other != 0) {
      if (other != span.letter) return std::nullopt;
      ++at;
    }
    const auto last = number();
    if (!last || *last < *first || *first % 10 != 0 || *last % 10 != 0 || *last - *first >= kMostCodes * 10)
      return std::nullopt;
    span.last = *last;
  }
  return at == text.size() ? std::optional(span) : std::nullopt;
}

std::vector<std::string> auxiliaryCodes(const std::set<std::string>& assumed) {
  constexpr std::string_view kName = "auxiliary=";
  std::vector<std::string> out;
  for (const std::string& one : assumed)
    if (one.starts_with(kName) && codeSpan(one.substr(kName.size()))) out.push_back(one.substr(kName.size()));
  return out;
}

std::string takenAuxiliary(const Control& control, const std::vector<std::string>& codes) {
  for (const std::string& text : codes) {
    const auto span = codeSpan(text);
    if (!span || span->first != span->last) continue; // a range fills what nothing lists
    const CodeInfo* const info = control.find(span->letter, span->first);
    if (info != nullptr && info->function != Function::Other && info->function != Function::Auxiliary)
      return fmt::format("{} is {}", text, info->title);
  }
  return "";
}

void addAuxiliary(Control& control, const std::vector<std::string>& codes) {
  for (const std::string& text : codes) {
    const auto span = codeSpan(text);
    if (!span) continue;
    for (std::uint32_t tenths = span->first; tenths <= span->last; tenths += 10) {
      const CodeInfo* const info = control.find(span->letter, tenths);
      const bool single = span->first == span->last;
      if (info != nullptr && !(single && info->function == Function::Other)) continue;
      std::erase_if(control.codes,
                    [&](const CodeInfo& one) { return one.letter == span->letter && one.tenths == tenths; });
      CodeInfo code;
      code.letter = span->letter;
      code.tenths = tenths;
      code.function = Function::Auxiliary;
      code.title = "auxiliary";
      code.grade = "documented";
      code.source = "the user";
      control.codes.push_back(std::move(code));
    }
  }
}

} // namespace dotek::stdlib
