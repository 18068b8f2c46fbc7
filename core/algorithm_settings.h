// A scene's choice of algorithm, with the values of the algorithms' keys.
//
// Every algorithm declares its keys (algorithm.h), and their union is one fixed table. The values
// are therefore a trivially copyable array, shared by a scene, the window and the real-time thread.
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
  std::string_view unit;  // "" for a pure number, a switch or a choice
  double minimum = 0.0;
  double maximum = 0.0;
  std::span<const std::string_view> choices;  // kChoice only; the value is the index
  std::string_view default_text;              // the default in words
  std::string_view meaning;
};

// The kinds of keys. `minimum` and `maximum` are inclusive.
[[nodiscard]] constexpr ParameterDescription number_parameter(std::string_view key,
                                                              std::string_view unit, double minimum,
                                                              double maximum,
                                                              std::string_view default_text,
                                                              std::string_view meaning) {
  return {key, ParameterKind::kNumber, unit, minimum, maximum, {}, default_text, meaning};
}
// Off by default.
[[nodiscard]] constexpr ParameterDescription switch_parameter(std::string_view key,
                                                              std::string_view meaning) {
  return {key, ParameterKind::kBoolean, "", 0.0, 1.0, {}, "false", meaning};
}
// The first choice is the default.
[[nodiscard]] constexpr ParameterDescription choice_parameter(
    std::string_view key, std::span<const std::string_view> choices, std::string_view meaning) {
  const auto last = static_cast<double>(choices.size() - 1);
  return {key, ParameterKind::kChoice, "", 0.0, last, choices, choices.front(), meaning};
}

inline constexpr std::size_t kMaxAlgorithmParameters = 40;  // with those of plug-ins

// Index of the algorithm in the closed list (algorithm.h) and a value (or nothing) for every key
// of algorithm_parameters(), in its order. A boolean is 0 or 1, a choice is its index.
struct AlgorithmSettings {
  std::size_t index = 0;
  // Of a plug-in, whose file may be loaded again: 1 is the first load, 0 the newest one.
  std::uint32_t revision = 0;
  std::array<std::optional<double>, kMaxAlgorithmParameters> values{};

  friend bool operator==(const AlgorithmSettings&, const AlgorithmSettings&) = default;
};

}  // namespace hapticwall
