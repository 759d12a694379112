// Maps and sets whose copies share what is equal.
#include "ir/SharedMap.h"
#include "ir/NumberSet.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <map>
#include <random>
#include <set>

using dotek::ir::NumberSet;
using dotek::ir::SharedMap;

namespace {

std::set<std::uint32_t> numbers(const NumberSet& set) {
  std::set<std::uint32_t> out;
  set.each([&](std::uint32_t number) { out.insert(number); });
  return out;
}

std::map<std::uint32_t, int> entries(const SharedMap<int>& map) {
  std::map<std::uint32_t, int> out;
  map.each([&](std::uint32_t key, int value) { out.emplace(key, value); });
  return out;
}

// Close together, or anywhere.
std::uint32_t draw(std::mt19937& random) {
  return random() % 4 == 0 ? static_cast<std::uint32_t>(random())
                           : static_cast<std::uint32_t>(random() % 300);
}

} // namespace

TEST_CASE("set of numbers: as std::set, and copies are apart") {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    NumberSet one, other;
    std::set<std::uint32_t> plain, otherPlain;
    for (int i = 0; i < 40; ++i) {
      const std::uint32_t number = draw(random);
      one.insert(number);
      plain.insert(number);
      if (i == 20) {
        other = one;
        otherPlain = plain;
      }
      const std::uint32_t gone = random() % 2 == 0 ? number : draw(random);
      one.erase(gone);
      plain.erase(gone);
      other.insert(number + 1);
      otherPlain.insert(number + 1);
    }
    CHECK(numbers(one) == plain);
    CHECK(numbers(other) == otherPlain);
    for (const std::uint32_t number : otherPlain)
      CHECK(one.contains(number) == plain.contains(number));

    std::set<std::uint32_t> both, either = plain;
    std::set_intersection(plain.begin(), plain.end(), otherPlain.begin(), otherPlain.end(),
                          std::inserter(both, both.begin()));
    either.insert(otherPlain.begin(), otherPlain.end());
    NumberSet united = one;
    CHECK(united.unite(other) == (either != plain));
    CHECK(numbers(united) == either);
    CHECK_FALSE(united.unite(other));
    NumberSet common = one;
    CHECK(common.intersect(other) == (both != plain));
    CHECK(numbers(common) == both);
    CHECK_FALSE(common.intersect(other));
    CHECK(numbers(one) == plain);
  }
}

TEST_CASE("set of numbers: empty ones") {
  NumberSet empty, one{0, 63, 64, UINT32_MAX};
  CHECK(empty.empty());
  CHECK_FALSE(empty.contains(0));
  CHECK_FALSE(empty.unite(NumberSet{}));
  CHECK(numbers(one) == std::set<std::uint32_t>{0, 63, 64, UINT32_MAX});
  CHECK(one.intersect(empty));
  CHECK(one.empty());
}

TEST_CASE("shared map: values that one side has alone are changed as asked") {
  std::mt19937 random(11);
  for (int round = 0; round < 200; ++round) {
    SharedMap<int> one, other;
    std::map<std::uint32_t, int> plain, otherPlain;
    for (int i = 0; i < 30; ++i) {
      const std::uint32_t key = draw(random);
      one.set(key, i);
      plain[key] = i;
      if (i == 10) {
        other = one;
        otherPlain = plain;
      }
      const std::uint32_t second = draw(random);
      other.set(second, -i);
      otherPlain[second] = -i;
    }
    std::map<std::uint32_t, int> expected;
    for (const auto& [key, value] : plain)
      expected[key] = otherPlain.contains(key) ? std::max(value, otherPlain[key]) : value + 1000;
    for (const auto& [key, value] : otherPlain)
      if (!plain.contains(key)) expected[key] = value + 1000;
    SharedMap<int> united = one;
    united.unite(
        other, [](int mine, int its) { return std::max(mine, its); },
        [](std::uint32_t, int value) { return value + 1000; });
    // What both share since the copy may be left as it is: the same value on both sides.
    for (auto& [key, value] : expected)
      if (plain.contains(key) && otherPlain.contains(key)) CHECK(*united.find(key) == value);
    CHECK(entries(united) == expected);
    CHECK(entries(one) == plain);
    united.transform([](std::uint32_t, int) { return 5; });
    for (const auto& [key, value] : expected)
      CHECK(*united.find(key) == 5);
  }
}
