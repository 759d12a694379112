// Lines of a program whose jumps have no numbers yet.
#pragma once

#include "backends/fanuc/Emit.h"

#include <map>

namespace dotek::backends::fanuc {

using Mark = std::uint32_t; // a place that jumps go to

class Sheet {
public:
  struct Line {
    EmittedLine out;
    std::optional<Mark> mark;   // its N number is before the text
    std::optional<Mark> target; // its number is appended to the text
    bool comment = false;
  };

  void add(std::string text, const ir::Origin& origin);
  // In brackets, one line for each of at most kCommentWidth characters; `text` holds no brackets.
  void comment(std::string_view text, const ir::Origin& origin);
  // "GOTO ", "IF[..]GOTO ": the number of `target` follows.
  void jump(std::string text, Mark target, const ir::Origin& origin);
  // Before the next line that is no comment.
  void place(Mark mark);
  void append(const Sheet& other);
  // What is added after checkpoint() can be taken back.
  struct Checkpoint {
    std::size_t lines = 0;
    std::optional<Mark> pending;
  };
  Checkpoint checkpoint() const { return {lines_.size(), pending_}; }
  void takeBack(const Checkpoint& checkpoint);
  std::size_t size() const { return lines_.size(); }
  const std::vector<Line>& lines() const { return lines_; }

  // With numbers; nullopt: more targets than sequence numbers.
  std::optional<std::vector<EmittedLine>> finish(std::uint32_t lastNumber) const;
  // Targets numbered from `first` in steps of `step`. nullopt: numbers above `last`.
  std::optional<std::vector<EmittedLine>> finish(std::uint32_t first, std::uint32_t step,
                                                 std::uint32_t last) const;
  // The first jump that leads to a line before it; nullptr: none does.
  const Line* backward() const;
  // A jump leads after the last line.
  bool endsInTarget() const;
  // Lines with a number that a jump leads to.
  std::vector<bool> numbered() const;

  static constexpr std::size_t kCommentWidth = 68;

private:
  Line& push(std::string text, const ir::Origin& origin);
  Mark root(Mark mark) const;

  std::vector<Line> lines_;
  std::optional<Mark> pending_;
  std::map<Mark, Mark> same_; // marks that are where another is
};

} // namespace dotek::backends::fanuc
