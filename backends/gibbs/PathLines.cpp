// Lines of a path once more: what nothing reads is gone, and what looks odd is explained.
#include "backends/gibbs/Macro.h"
#include "support/Ascii.h"

#include <algorithm>
#include <map>
#include <set>

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
  // How many lines read a name, the lines that give it a value, and what a line reads.
  std::map<std::string, std::size_t, std::less<>> readers;
  std::map<std::string_view, std::vector<std::size_t>> assigned;
  const auto readBy = [&](std::size_t i) {
    const auto names = namesIn(std::string_view(lines[i].text).substr(targetOf(lines[i].text).size()));
    return std::set<std::string_view>(names.begin(), names.end());
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (const std::string_view name : readBy(i))
      ++readers.try_emplace(std::string(name)).first->second;
    if (const std::string_view target = targetOf(lines[i].text); !target.empty())
      assigned[target].push_back(i);
  }
  std::vector<bool> gone(lines.size());
  std::vector<std::string_view> unread;
  for (const auto& [target, at] : assigned)
    if (!readers.contains(target)) unread.push_back(target);
  while (!unread.empty()) {
    const std::string_view target = unread.back();
    unread.pop_back();
    for (const std::size_t i : assigned[target]) {
      gone[i] = true;
      for (const std::string_view name : readBy(i))
        if (--readers.find(name)->second == 0 && assigned.contains(name)) unread.push_back(name);
    }
  }
  std::vector<EmittedLine> kept;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!gone[i]) kept.push_back(std::move(lines[i]));
  lines = std::move(kept);
}

void explainHeights(std::vector<EmittedLine>& lines) {
  const auto takesPlane = [](std::string_view height) {
    return height.find("-plane") != std::string_view::npos;
  };
  if (std::none_of(lines.begin(), lines.end(),
                   [&](const EmittedLine& line) { return takesPlane(heightOf(line.text)); }))
    return;
  std::set<std::string, std::less<>> targets;
  for (const EmittedLine& line : lines)
    targets.emplace(targetOf(line.text));
  for (EmittedLine& line : lines) {
    const std::string_view height = heightOf(line.text);
    const auto names = namesIn(height);
    const bool number =
        std::none_of(names.begin(), names.end(), [](std::string_view name) { return isLetter(name[0]); });
    const bool computed = std::any_of(names.begin(), names.end(),
                                      [&](std::string_view name) { return targets.contains(name); });
    if (height.empty() || takesPlane(height) || number || computed) continue;
    line.text += " ! dotek: ignore path-height-differs -- counted from where the cycle begins";
  }
}

} // namespace dotek::backends::gibbs
