// Programs for a lathe, which no profile describes: the same codes mean something else there.
#pragma once

#include "ir/NcWords.h"

#include <cstddef>
#include <optional>
#include <string_view>

namespace dotek::stdlib {

// Puts a word of a block in. `value`: nothing where it is computed; then it is any number that is none (NaN).
void addWord(ir::NcWords& block, char address, std::optional<double> value);

// What the blocks of a text show, each looked at once, in any order.
class LatheSigns {
public:
  struct Sign {
    std::string_view what; // that the block does, to follow "this block"
    std::size_t at = 0;    // as it was given
  };

  // `at`: what the block is to be found by.
  void look(const ir::NcWords& block, std::size_t at);
  // The text is that of a mill, whatever follows.
  bool isOfMill() const { return mill_; }
  // The first sign; nothing: it is a mill's, or nothing shows.
  std::optional<Sign> sign() const;

private:
  bool mill_ = false;
  bool y_ = false;
  std::optional<Sign> certain_;
  std::optional<Sign> withoutY_; // counts where no block of the text has a Y
};

// What the block does on a lathe and not on a mill, to follow "there it"; "": it means the same.
std::string_view meaningOnLathe(const ir::NcWords& block);

} // namespace dotek::stdlib
