#include "ir/IdBits.h"

#include <doctest/doctest.h>
#include <random>
#include <set>

using dotek::ir::IdBits;
using dotek::ir::VariableId;

TEST_CASE("bits of variables hold what a set of them holds") {
  std::mt19937 random(7);
  for (const std::size_t count : {1U, 63U, 64U, 65U, 200U}) {
    IdBits bits(count), others(count);
    std::set<VariableId> set, otherSet;
    std::uniform_int_distribution<VariableId> draw(0, static_cast<VariableId>(count - 1));
    for (int i = 0; i < 300; ++i) {
      const VariableId id = draw(random);
      switch (i % 5) {
      case 0: bits.erase(id), set.erase(id); break;
      case 1: others.insert(id), otherSet.insert(id); break;
      case 2: others.erase(id), otherSet.erase(id); break;
      default: bits.insert(id), set.insert(id);
      }
      if (i % 50 == 49) {
        const std::size_t before = set.size();
        set.insert(otherSet.begin(), otherSet.end());
        CHECK(bits.unite(others) == (set.size() > before));
        CHECK_FALSE(bits.unite(others));
      }
      for (VariableId each = 0; each < count; ++each)
        REQUIRE(bits.contains(each) == set.contains(each));
    }
  }
}
