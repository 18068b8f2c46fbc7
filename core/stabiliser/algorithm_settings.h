// Which algorithm a scene names, and the values of the algorithms' own keys.
//
// Every algorithm declares the keys that it reads (stabiliser.h); the union of them all is one
// fixed table, so that the values are a trivially copyable array which a scene, the window and the
// real-time thread share, and which a new algorithm extends without a change here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace hapticwall {

enum class ParameterKind : std::uint8_t { kNumber, kBoolean, kChoice };

// One key of the `[algorithm]` table.
struct ParameterDescription {
  std::string_view key;
  ParameterKind kind = ParameterKind::kNumber;
  std::string_view unit;                      // "" for a pure number, a switch or a choice
  double minimum = 0.0;                       // inclusive; numbers only
  double maximum = 0.0;                       // inclusive; numbers only
  std::span<const std::string_view> choices;  // kChoice only; the value is the index
  std::string_view default_text;              // what holds where the key is absent, in words
  std::string_view meaning;
};

inline constexpr std::size_t kMaximumAlgorithmParameters = 24;

// Index of the algorithm in the closed list (stabiliser.h) and a value (or nothing) for every key
// of algorithm_parameters(), in its order. A boolean is 0 or 1, a choice is its index.
struct AlgorithmSettings {
  std::size_t index = 0;
  std::array<std::optional<double>, kMaximumAlgorithmParameters> values{};

  friend bool operator==(const AlgorithmSettings&, const AlgorithmSettings&) = default;
};

}  // namespace hapticwall
