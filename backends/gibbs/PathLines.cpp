// Lines of a path once more: what nothing reads is gone, and what looks odd is explained.
#include "backends/gibbs/Macro.h"
#include "support/Ascii.h"

#include <algorithm>

namespace dotek::backends::gibbs {

namespace {

std::vector<std::string_view> namesIn(std::string_view text) {
  std::vector<std::string_view> out;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && (isLetter(text[end]) || isDigit(text[end]) || text[end] == '_'))
      ++end;
    if (end > i) out.push_back(text.substr(i, end - i));
    i = std::max(end, i + 1);
  }
  return out;
}

// "at_x" of "at_x = 0"; "" of a line that assigns nothing.
std::string_view targetOf(std::string_view line) {
  const std::size_t sign = line.find(" = ");
  if (sign == std::string_view::npos) return {};
  const std::string_view name = line.substr(0, sign);
  return name.find(' ') == std::string_view::npos ? name : std::string_view();
}

// The height that a line of the path goes to; "": it goes to none.
std::string_view heightOf(std::string_view line) {
  if (const std::size_t at = line.find("feed_z, "); at != std::string_view::npos) return line.substr(at + 8);
  if (line.find(" feed, ") == std::string_view::npos) return {};
  return line.substr(line.rfind(", ") + 2);
}

} // namespace

bool readAnywhere(const std::vector<EmittedLine>& lines, std::string_view name) {
  return std::any_of(lines.begin(), lines.end(), [&](const EmittedLine& line) {
    const std::string_view target = targetOf(line.text);
    const auto names = namesIn(std::string_view(line.text).substr(target.size()));
    return std::find(names.begin(), names.end(), name) != names.end();
  });
}

void dropUnreadLines(std::vector<EmittedLine>& lines) {
  const auto unread = [&](const EmittedLine& line) {
    const std::string_view target = targetOf(line.text);
    return !target.empty() && !readAnywhere(lines, target);
  };
  for (auto found = std::find_if(lines.begin(), lines.end(), unread); found != lines.end();
       found = std::find_if(lines.begin(), lines.end(), unread))
    lines.erase(found);
}

void explainHeights(std::vector<EmittedLine>& lines) {
  const auto takesPlane = [](std::string_view height) {
    return height.find("-plane") != std::string_view::npos;
  };
  if (std::none_of(lines.begin(), lines.end(),
                   [&](const EmittedLine& line) { return takesPlane(heightOf(line.text)); }))
    return;
  for (EmittedLine& line : lines) {
    const std::string_view height = heightOf(line.text);
    const auto names = namesIn(height);
    const bool number =
        std::none_of(names.begin(), names.end(), [](std::string_view name) { return isLetter(name[0]); });
    const bool computed = std::any_of(names.begin(), names.end(), [&](std::string_view name) {
      return std::any_of(lines.begin(), lines.end(),
                         [&](const EmittedLine& one) { return targetOf(one.text) == name; });
    });
    if (height.empty() || takesPlane(height) || number || computed) continue;
    line.text += " ! dotek: ignore path-height-differs -- counted from where the cycle begins";
  }
}

} // namespace dotek::backends::gibbs
