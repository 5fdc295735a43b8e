// Random numbers that are the same with every compiler and library.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace clearway::assign {

// Source: S. Vigna, "Further scramblings of Marsaglia's xorshift generators", J. Comput. Appl.
// Math. 315 (2017): xorshift128+, seeded by SplitMix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_{split(seed), split(seed)} {}

  std::uint64_t next() {
    std::uint64_t x = state_[0];
    const std::uint64_t y = state_[1];
    state_[0] = y;
    x ^= x << 23;
    state_[1] = x ^ y ^ (x >> 18) ^ (y >> 5);
    return state_[1] + y;
  }

  // In [0, 1).
  double unit() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

  // In [0, bound); the bias is below bound / 2^32.
  int below(int bound) {
    return static_cast<int>(((next() >> 32) * static_cast<std::uint64_t>(bound)) >> 32);
  }

  template <class T>
  void shuffle(std::vector<T>& items) {
    for (int i = static_cast<int>(items.size()) - 1; i > 0; --i) {
      std::swap(items[static_cast<std::size_t>(i)], items[static_cast<std::size_t>(below(i + 1))]);
    }
  }

 private:
  static std::uint64_t split(std::uint64_t& seed) {
    std::uint64_t z = (seed += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t state_[2];
};

}  // namespace clearway::assign
