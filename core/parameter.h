// Descriptions of the keys in a scene's tables [environment], [algorithm] and [estimator].
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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

// A number that an algorithm or an environment shows of itself, one column of a recording. Several
// may share it.
struct SignalDescription {
  std::string_view name;  // ends with its unit: "bound_n"
  std::string_view meaning;
};

// An estimator or an environment, for people and files.
struct PartDescription {
  std::string_view name;   // the word in the file, --set and the sidecar
  std::string_view title;  // for people
  std::string_view idea;   // one line
  std::span<const ParameterDescription> parameters;
  std::string_view equation;  // for people: one to three lines
  std::span<const SignalDescription> signals = {};
};

// The value of a key, or nullopt: it is not set, or not in the table. `values` are in the order of
// `parameters`. Realtime-safe: yes.
[[nodiscard]] constexpr std::optional<double> find_value(
    std::span<const ParameterDescription> parameters, std::span<const std::optional<double>> values,
    std::string_view key) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].key == key) return values[i];
  }
  return std::nullopt;
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

// The unions of a list whose members have a description, behind the members of `all`.
template <std::size_t kMax, class List>
[[nodiscard]] constexpr auto unite_parameters(
    const List& list, DescriptionUnion<ParameterDescription, kMax> all = {}) {
  for (const auto& one : list) all.add(one.description.parameters, &ParameterDescription::key);
  return all;
}
template <std::size_t kMax, class List>
[[nodiscard]] constexpr auto unite_signals(const List& list) {
  DescriptionUnion<SignalDescription, kMax> all;
  for (const auto& one : list) all.add(one.description.signals, &SignalDescription::name);
  return all;
}

}  // namespace hapticwall
