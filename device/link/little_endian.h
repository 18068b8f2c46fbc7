// Integers in the bytes of a report, little endian on every machine. Realtime-safe: yes, all of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

namespace hapticwall::device::hid {

// Rounded and clamped to the range of the type; 0 for NaN.
template <std::integral T>
T saturated(double value) {
  if (std::isnan(value)) return 0;
  constexpr auto kMin = static_cast<double>(std::numeric_limits<T>::min());
  constexpr auto kMax = static_cast<double>(std::numeric_limits<T>::max());
  return static_cast<T>(std::clamp(std::round(value), kMin, kMax));
}

// Preconditions of both: the bytes are there, and T has at most four.
template <std::integral T>
void put(std::span<std::uint8_t> bytes, std::size_t at, T value) {
  using Bits = std::make_unsigned_t<T>;
  const auto bits = static_cast<std::uint32_t>(static_cast<Bits>(value));
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(bits >> (8 * i));
  }
}

template <std::integral T>
T get(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bits |= static_cast<std::uint32_t>(bytes[at + i]) << (8 * i);
  }
  return static_cast<T>(static_cast<std::make_unsigned_t<T>>(bits));
}

}  // namespace hapticwall::device::hid
