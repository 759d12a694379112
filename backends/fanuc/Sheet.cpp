#include "backends/fanuc/Sheet.h"

#include "backends/common/PlainText.h"

#include <set>

namespace dotek::backends::fanuc {

Sheet::Line& Sheet::push(std::string text, const ir::Origin& origin) {
  Line line;
  line.out = {std::move(text), origin.ranges, origin.reason};
  lines_.push_back(std::move(line));
  return lines_.back();
}

void Sheet::add(std::string text, const ir::Origin& origin) {
  Line& line = push(std::move(text), origin);
  line.mark = std::exchange(pending_, std::nullopt);
}

void Sheet::comment(std::string_view text, const ir::Origin& origin) {
  for (const std::string& part : wrapWords(text, kCommentWidth))
    push("(" + part + ")", origin).comment = true;
}

void Sheet::jump(std::string text, Mark target, const ir::Origin& origin) {
  add(std::move(text), origin);
  lines_.back().target = target;
}

void Sheet::place(Mark mark) {
  if (pending_)
    same_[mark] = *pending_;
  else
    pending_ = mark;
}

void Sheet::takeBack(const Checkpoint& checkpoint) {
  lines_.resize(checkpoint.lines);
  pending_ = checkpoint.pending;
}

void Sheet::append(const Sheet& other) {
  same_.insert(other.same_.begin(), other.same_.end());
  for (const Line& line : other.lines_) {
    lines_.push_back(line);
    if (line.comment || !pending_) continue;
    if (line.mark) same_[*line.mark] = *pending_;
    lines_.back().mark = std::exchange(pending_, std::nullopt);
  }
  if (!other.pending_) return;
  place(*other.pending_);
}

std::optional<std::vector<EmittedLine>> Sheet::finish(std::uint32_t lastNumber) const {
  const auto root = [&](Mark mark) {
    for (auto found = same_.find(mark); found != same_.end(); found = same_.find(mark))
      mark = found->second;
    return mark;
  };
  std::set<Mark> used;
  for (const Line& line : lines_)
    if (line.target) used.insert(root(*line.target));
  const std::uint32_t step = used.size() * 10 <= lastNumber ? 10 : 1;
  if (used.size() > lastNumber) return std::nullopt;
  std::map<Mark, std::uint32_t> numbers;
  for (const Line& line : lines_)
    if (line.mark && used.contains(root(*line.mark)))
      numbers.emplace(root(*line.mark), static_cast<std::uint32_t>(numbers.size() + 1) * step);
  std::vector<EmittedLine> out;
  for (const Line& line : lines_) {
    out.push_back(line.out);
    std::string& text = out.back().text;
    if (line.mark && used.contains(root(*line.mark)))
      text = "N" + std::to_string(numbers.at(root(*line.mark))) + " " + text;
    if (line.target) text += std::to_string(numbers.at(root(*line.target)));
  }
  return out;
}

} // namespace dotek::backends::fanuc
