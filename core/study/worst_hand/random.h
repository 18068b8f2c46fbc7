// Random numbers with the same bits on every machine: integers, sums and products alone.
#pragma once

#include <cstdint>

namespace hapticwall::worst_hand {

// SplitMix64 (Steele, Lea & Flood 2014). Realtime-safe: yes.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
  }
  // In [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
  // Mean 0, variance 1, within ±6: a sum of twelve needs no logarithm, whose last bit differs
  // between libraries.
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }

 private:
  std::uint64_t state_;
};

}  // namespace hapticwall::worst_hand
