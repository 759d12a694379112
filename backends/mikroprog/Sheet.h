// Lines of a program whose jumps have no block numbers yet.
#pragma once

#include "backends/mikroprog/Emit.h"

#include <map>

namespace dotek::backends::mikroprog {

using Mark = std::uint32_t; // a block that jumps go to

class Sheet {
public:
  // A block; `comment` follows its words, "" for none.
  void add(std::string text, const ir::Origin& origin, std::string comment = "");
  // A block with L between `before` and `after`: "G23", target, "O7".
  void jump(std::string before, Mark target, std::string after, const ir::Origin& origin,
            std::string comment = "");
  // A line of its own, without a number; nothing for an empty text.
  void comment(const std::string& text, const ir::Origin& origin);
  // On the next block.
  void place(Mark mark);
  std::size_t blocks() const { return blocks_; }

  // Numbers its blocks from `first` by `step`; the numbers of its marks go to `numbers`.
  void number(std::uint32_t first, std::uint32_t step, std::map<Mark, std::uint32_t>& numbers);
  // After number() of all sheets.
  void print(const std::map<Mark, std::uint32_t>& numbers, std::vector<EmittedLine>& out) const;

private:
  struct Line {
    bool block = true;
    std::uint32_t number = 0;
    std::vector<Mark> marks;
    std::string before, after, comment;
    std::optional<Mark> target;
    ir::Origin origin;
  };
  Line& push(const ir::Origin& origin);

  std::vector<Line> lines_;
  std::vector<Mark> pending_;
  std::size_t blocks_ = 0;
};

} // namespace dotek::backends::mikroprog
