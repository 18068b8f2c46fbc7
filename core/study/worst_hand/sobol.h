// Points that fill the space of hands evenly.
#pragma once

#include <array>
#include <cstdint>

#include "core/study/worst_hand/hand_space.h"
#include "core/study/worst_hand/random.h"

namespace hapticwall::worst_hand {

// Sobol's sequence with the direction numbers of Joe and Kuo (2008), in the order of Gray codes,
// shifted by random bits. Realtime-safe: yes.
class Sobol {
 public:
  // Points of the first `numbers` dimensions; the others are 0.
  Sobol(Random& random, std::size_t numbers);
  // Precondition: fewer than 2^32 points so far.
  [[nodiscard]] HandPoint next();

 private:
  static constexpr std::size_t kBits = 32;

  std::array<std::array<std::uint32_t, kBits>, kHandNumbers> directions_{};
  std::array<std::uint32_t, kHandNumbers> now_{};
  std::size_t numbers_;
  std::uint32_t count_ = 0;
};

}  // namespace hapticwall::worst_hand
