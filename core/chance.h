// The random numbers of a scene: functions of seed, axis, purpose and tick, without a state.
//
// Only whole numbers and exact operations, so that every machine and compiler gives the same bits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace hapticwall {

// What a random number is for. Numbers of different purposes are independent.
enum class Purpose : std::uint8_t { kLostTick, kPeriod, kPositionNoise, kForceNoise };

// Realtime-safe: yes.
class Chance {
 public:
  // `axis`: 0 for all that the axes share.
  Chance(int seed, std::size_t axis, Purpose purpose)
      : key_(mixed(mixed(static_cast<std::uint64_t>(seed)) +
                   kPurposes * static_cast<std::uint64_t>(axis) +
                   static_cast<std::uint64_t>(purpose))) {}

  // Uniform in [0, 1), in steps of 2^-53.
  [[nodiscard]] double uniform(std::uint64_t tick) const {
    constexpr double kStep = 0x1p-53;
    return static_cast<double>(word(tick, 0) >> 11U) * kStep;
  }

  // The sum of twelve uniform numbers less 6: mean 0, standard deviation 1, never beyond ±6. Close
  // to a normal number: beyond ±3 are 0.20 % in the place of 0.27 %.
  [[nodiscard]] double normal(std::uint64_t tick) const {
    constexpr unsigned kBits = 21;
    constexpr std::uint64_t kMask = (1U << kBits) - 1;
    std::uint64_t sum = 0;
    for (std::uint64_t i = 0; i < 4; ++i) {
      const std::uint64_t bits = word(tick, i);
      sum += (bits & kMask) + ((bits >> kBits) & kMask) + ((bits >> (2 * kBits)) & kMask);
    }
    constexpr auto kMiddle = static_cast<std::int64_t>(6 * kMask);
    return static_cast<double>(static_cast<std::int64_t>(sum) - kMiddle) * 0x1p-21;
  }

 private:
  static constexpr std::uint64_t kPurposes = 256;                // room for more of them
  static constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15U;  // 2^64 over the golden ratio

  // The finaliser of SplitMix64 (Steele, Lea, Flood 2014).
  [[nodiscard]] static std::uint64_t mixed(std::uint64_t bits) {
    bits += kGolden;
    bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9U;
    bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBU;
    return bits ^ (bits >> 31U);
  }
  [[nodiscard]] std::uint64_t word(std::uint64_t tick, std::uint64_t index) const {
    return mixed(key_ + kGolden * (4 * tick + index));
  }

  std::uint64_t key_;
};

}  // namespace hapticwall
