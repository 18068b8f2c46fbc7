// Descriptions of the keys in a scene's tables [algorithm] and [estimator].
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace hapticwall {

// Every value is a double: a number, 0 or 1, or the index of a choice.
enum class ParameterKind : std::uint8_t { kNumber, kBoolean, kChoice };

// One key of a table.
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

// A union of descriptions, each name once, in the order of their first appearance. Menus, files and
// columns show this order.
template <class Description, std::size_t kMax>
struct DescriptionUnion {
  std::array<Description, kMax> members{};
  std::size_t count = 0;

  [[nodiscard]] constexpr std::span<const Description> in_use() const {
    return std::span(members).first(count);
  }
  constexpr void add(std::span<const Description> all, std::string_view Description::*name) {
    for (const Description& wanted : all) {
      bool known = false;
      for (const Description& member : in_use()) known = known || member.*name == wanted.*name;
      if (!known) members.at(count++) = wanted;  // too many: does not compile
    }
  }
};

}  // namespace hapticwall
