#include "backends/fanuc/Sheet.h"

#include "backends/common/PlainText.h"

#include <algorithm>
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

Mark Sheet::root(Mark mark) const {
  for (auto found = same_.find(mark); found != same_.end(); found = same_.find(mark))
    mark = found->second;
  return mark;
}

std::vector<bool> Sheet::numbered() const {
  std::set<Mark> used;
  for (const Line& line : lines_)
    if (line.target) used.insert(root(*line.target));
  std::vector<bool> out;
  for (const Line& line : lines_)
    out.push_back(line.mark && used.contains(root(*line.mark)));
  return out;
}

bool Sheet::endsInTarget() const {
  return pending_ && std::any_of(lines_.begin(), lines_.end(), [&](const Line& line) {
           return line.target && root(*line.target) == root(*pending_);
         });
}

const Sheet::Line* Sheet::backward() const {
  std::set<Mark> before;
  for (const Line& line : lines_) {
    if (line.mark) before.insert(root(*line.mark));
    if (line.target && before.contains(root(*line.target))) return &line;
  }
  return nullptr;
}

std::optional<std::vector<EmittedLine>> Sheet::finish(std::uint32_t lastNumber) const {
  std::set<Mark> used;
  for (const Line& line : lines_)
    if (line.target) used.insert(root(*line.target));
  const std::uint32_t step = used.size() * 10 <= lastNumber ? 10 : 1;
  return finish(step, step, lastNumber);
}

std::optional<std::vector<EmittedLine>> Sheet::finish(std::uint32_t first, std::uint32_t step,
                                                      std::uint32_t last) const {
  const std::vector<bool> targets = numbered();
  std::map<Mark, std::uint32_t> numbers;
  for (std::size_t i = 0; i < lines_.size(); ++i)
    if (targets[i])
      numbers.emplace(root(*lines_[i].mark), first + static_cast<std::uint32_t>(numbers.size()) * step);
  if (!numbers.empty() && first + (numbers.size() - 1) * step > last) return std::nullopt;
  std::vector<EmittedLine> out;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Line& line = lines_[i];
    out.push_back(line.out);
    std::string& text = out.back().text;
    if (targets[i])
      text = "N" + std::to_string(numbers.at(root(*line.mark))) + (text.empty() ? "" : " ") + text;
    if (line.target) text += std::to_string(numbers.at(root(*line.target)));
  }
  return out;
}

} // namespace dotek::backends::fanuc
