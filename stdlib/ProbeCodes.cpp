#include "stdlib/ProbeCodes.h"

namespace dotek::stdlib {

ProbeCodes merged(const ProbeCodes& first, const ProbeCodes& second) {
  return {first.on.empty() ? second.on : first.on, first.off.empty() ? second.off : first.off};
}

std::optional<std::pair<char, std::uint32_t>> codeOf(std::string_view text) {
  if (text.size() < 2 || text.size() > 5) return std::nullopt;
  const char letter = static_cast<char>(text[0] & ~0x20);
  if (letter != 'M' && letter != 'G') return std::nullopt;
  std::uint32_t number = 0;
  for (const char c : text.substr(1)) {
    if (c < '0' || c > '9') return std::nullopt;
    number = number * 10 + static_cast<std::uint32_t>(c - '0');
  }
  return std::pair{letter, number * 10};
}

std::string otherMeaning(const Control& control, std::string_view code, bool on) {
  const auto parsed = codeOf(code);
  const CodeInfo* info = parsed ? control.find(parsed->first, parsed->second) : nullptr;
  if (info == nullptr || info->function == (on ? Function::ProbeOn : Function::ProbeOff)) return "";
  return info->title;
}

void addProbeCodes(Control& control, const ProbeCodes& codes) {
  for (const bool on : {false, true}) {
    const std::string& text = on ? codes.on : codes.off;
    const auto code = codeOf(text);
    if (!code || !otherMeaning(control, text, on).empty()) continue;
    std::erase_if(control.codes, [&](const CodeInfo& info) {
      return info.letter == code->first && info.tenths == code->second;
    });
    CodeInfo info;
    info.letter = code->first;
    info.tenths = code->second;
    info.function = on ? Function::ProbeOn : Function::ProbeOff;
    info.title = on ? "probe on" : "probe off";
    info.grade = "documented";
    info.source = "the user";
    control.codes.insert(control.codes.begin(), std::move(info));
  }
}

} // namespace dotek::stdlib
