// A set of the variables of one cycle, a bit for each: for flow analyses, which unite such sets many times.
#pragma once

#include "ir/Cycle.h"

#include <cstdint>
#include <vector>

namespace dotek::ir {

class IdBits {
public:
  // Empty; holds ids below `count`.
  explicit IdBits(std::size_t count) : words_((count + kBits - 1) / kBits) {}

  bool contains(VariableId id) const { return (words_[id / kBits] >> (id % kBits) & 1) != 0; }
  void insert(VariableId id) { words_[id / kBits] |= std::uint64_t{1} << (id % kBits); }
  void erase(VariableId id) { words_[id / kBits] &= ~(std::uint64_t{1} << (id % kBits)); }

  // Takes in another set of the same cycle. true: this one has grown.
  bool unite(const IdBits& other) {
    std::uint64_t grown = 0;
    for (std::size_t i = 0; i < words_.size(); ++i) {
      grown |= other.words_[i] & ~words_[i];
      words_[i] |= other.words_[i];
    }
    return grown != 0;
  }

private:
  static constexpr std::size_t kBits = 64;
  std::vector<std::uint64_t> words_;
};

} // namespace dotek::ir
