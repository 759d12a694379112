// SplitMix64: the same numbers on every platform, from a seed that may be any number.
#pragma once

#include <cstdint>
#include <string_view>

namespace dotek::verify {

class Random {
public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15u;
    return mixed(state_);
  }
  // 0 to n - 1; n > 0.
  std::uint64_t below(std::uint64_t n) { return (next() >> 32) * n >> 32; } // n below 2^32
  // 0 to 1, without 1.
  double share() { return static_cast<double>(next() >> 11) / 9007199254740992.0; } // 2^53
  bool chance(double probability) { return share() < probability; }
  double between(double least, double most) { return least + (most - least) * share(); }
  // least to most, both may come.
  std::int64_t whole(std::int64_t least, std::int64_t most) {
    return least + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(most - least) + 1));
  }

  static std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
    x = (x ^ x >> 27) * 0x94D049BB133111EBu;
    return x ^ x >> 31;
  }
  // A seed for a part of what `seed` draws.
  static std::uint64_t sub(std::uint64_t seed, std::uint64_t part) {
    return mixed(seed + 0x9E3779B97F4A7C15u * (part + 1));
  }
  static std::uint64_t hash(std::string_view name) { // FNV-1a
    std::uint64_t out = 0xCBF29CE484222325u;
    for (const char c : name)
      out = (out ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
    return out;
  }

private:
  std::uint64_t state_;
};

} // namespace dotek::verify
