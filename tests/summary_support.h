// Summaries compared key by key and bit by bit.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "core/summary.h"

namespace hapticwall::testing {

template <typename Value>
bool same_bits(const Value& a, const Value& b) {
  return a == b;
}
// Unlike `==`, tells +0 from -0.
inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
inline bool same_bits(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? same_bits(*a, *b) : a == b;
}

// Names of the keys that differ in any bit; empty if none does.
inline std::string differences(const Summary& a, const Summary& b) {
  std::string names;
  for (const SummaryKey& key : kSummaryKeys) {
    const bool same =
        std::visit([&](auto member) { return same_bits(a.*member, b.*member); }, key.member);
    if (!same) names += std::string(key.name) + " ";
  }
  return names;
}

}  // namespace hapticwall::testing
