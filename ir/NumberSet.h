// A set of numbers of variables whose copies share what is equal.
#pragma once

#include "ir/SharedMap.h"

#include <cstdint>
#include <initializer_list>

namespace dotek::ir {

// 64 neighbours are the bits of one value.
class NumberSet {
public:
  NumberSet() = default;
  NumberSet(std::initializer_list<std::uint32_t> numbers) {
    for (const std::uint32_t number : numbers)
      insert(number);
  }

  bool empty() const { return words_.empty(); }
  bool contains(std::uint32_t number) const {
    const std::uint64_t* word = words_.find(number / 64);
    return word != nullptr && (*word & bitOf(number)) != 0;
  }
  void insert(std::uint32_t number) {
    const std::uint64_t* word = words_.find(number / 64);
    const std::uint64_t before = word == nullptr ? 0 : *word;
    if ((before & bitOf(number)) == 0) words_.set(number / 64, before | bitOf(number));
  }
  void erase(std::uint32_t number) {
    const std::uint64_t* word = words_.find(number / 64);
    if (word == nullptr || (*word & bitOf(number)) == 0) return;
    if (const std::uint64_t rest = *word & ~bitOf(number); rest != 0)
      words_.set(number / 64, rest);
    else
      words_.erase(number / 64);
  }
  // Whether anything changed.
  bool unite(const NumberSet& other) {
    return words_.unite(other.words_, [](std::uint64_t mine, std::uint64_t its) { return mine | its; });
  }
  // Whether anything changed.
  bool intersect(const NumberSet& other) {
    return words_.intersect(
        other.words_, [](std::uint64_t mine, std::uint64_t its) { return mine & its; },
        [](std::uint64_t word) { return word == 0; });
  }
  // In ascending order.
  template <class Visit> void each(const Visit& visit) const {
    words_.each([&](std::uint32_t place, std::uint64_t word) {
      for (std::uint32_t i = 0; i < 64; ++i)
        if ((word >> i & 1U) != 0) visit(place * 64 + i);
    });
  }

private:
  static std::uint64_t bitOf(std::uint32_t number) { return std::uint64_t{1} << (number % 64); }

  SharedMap<std::uint64_t> words_;
};

} // namespace dotek::ir
