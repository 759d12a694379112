#include "backends/mikroprog/Sheet.h"

#include <fmt/format.h>
#include <utility>

namespace dotek::backends::mikroprog {

Sheet::Line& Sheet::push(const ir::Origin& origin) {
  Line line;
  line.origin = origin;
  line.marks = std::exchange(pending_, {});
  lines_.push_back(std::move(line));
  ++blocks_;
  return lines_.back();
}

void Sheet::add(std::string text, const ir::Origin& origin, std::string comment) {
  Line& line = push(origin);
  line.before = std::move(text);
  line.comment = std::move(comment);
}

void Sheet::jump(std::string before, Mark target, std::string after, const ir::Origin& origin,
                 std::string comment) {
  Line& line = push(origin);
  line.before = std::move(before);
  line.after = std::move(after);
  line.comment = std::move(comment);
  line.target = target;
}

void Sheet::comment(const std::string& text, const ir::Origin& origin) {
  if (text.empty()) return;
  Line line;
  line.block = false;
  line.origin = origin;
  line.comment = text;
  lines_.push_back(std::move(line));
}

void Sheet::place(Mark mark) {
  pending_.push_back(mark);
}

void Sheet::number(std::uint32_t first, std::uint32_t step, std::map<Mark, std::uint32_t>& numbers) {
  std::uint32_t next = first;
  for (Line& line : lines_) {
    if (!line.block) continue;
    line.number = std::exchange(next, next + step);
    for (const Mark mark : line.marks)
      numbers[mark] = line.number;
  }
}

void Sheet::print(const std::map<Mark, std::uint32_t>& numbers, std::vector<EmittedLine>& out) const {
  for (const Line& line : lines_) {
    std::string text;
    if (line.block) {
      text = fmt::format("N{} {}", line.number, line.before);
      if (line.target) text += fmt::format(" L{}", numbers.at(*line.target));
      if (!line.after.empty()) text += " " + line.after;
      if (!line.comment.empty()) text += " ;" + line.comment;
    } else {
      text = ";" + line.comment;
    }
    out.push_back({std::move(text), line.origin.ranges, line.origin.reason});
  }
}

} // namespace dotek::backends::mikroprog
