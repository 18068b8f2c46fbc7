// Text for people: numbers, names and pieces of user input in one-line messages.
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace hapticwall::file {

// The shortest decimal form that reads back to the same double, in the C locale. For files: 1e+09,
// where number_text() (core/scene_keys.h) writes 1e9 for people.
void append_number(std::string& text, double value);
[[nodiscard]] std::string shortest_number(double value);
// "1.234" of value * factor; "-" if there is no value or it is not finite. A negative value that
// rounds to zero keeps no sign.
[[nodiscard]] std::string fixed(std::optional<double> value, double factor, int digits);

// The number that all of `text` spells in the C locale; nullopt for anything else, and for a number
// that is out of range or not finite.
template <typename Number>
[[nodiscard]] std::optional<Number> parsed(std::string_view text, int base = 10) {
  Number value{};
  const char* end = text.data() + text.size();
  std::from_chars_result read{};
  if constexpr (std::floating_point<Number>) {
    read = std::from_chars(text.data(), end, value);
    if (!std::isfinite(value)) return std::nullopt;
  } else {
    read = std::from_chars(text.data(), end, value, base);
  }
  return read.ec == std::errc{} && read.ptr == end ? std::optional(value) : std::nullopt;
}

// The date and time now: "2026-11-23T20:25:38Z".
[[nodiscard]] std::string utc_now();

// The parts of `text` between separators; one part if there is none.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

// Spreadsheets begin a file in UTF-8 with this mark.
[[nodiscard]] constexpr std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text;
}

// The text without spaces and tabs at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

// User input for a message: cut to a sane length, without control characters and invalid UTF-8, in
// single quotes.
[[nodiscard]] std::string in_quotes(std::string_view user_text);

// in_quotes() without the quotes, for a path or a key.
inline constexpr std::size_t kMaxQuoteBytes = 80;  // bytes
[[nodiscard]] std::string shown(std::string_view user_text, std::size_t longest = kMaxQuoteBytes);

// The most similar of `candidates`, if one is similar enough.
[[nodiscard]] std::optional<std::string_view> nearest_name(
    std::string_view word, std::span<const std::string_view> candidates);

// "; did you mean 'X'?", or an empty text.
[[nodiscard]] std::string suggestion(std::string_view word,
                                     std::span<const std::string_view> candidates);

// The names of all elements, for nearest_name() and joined(). `name`: a member with a text.
template <typename Elements, typename Name>
[[nodiscard]] std::vector<std::string_view> names_of(const Elements& elements, Name name) {
  std::vector<std::string_view> names;
  names.reserve(std::size(elements));
  for (const auto& element : elements) names.emplace_back(element.*name);
  return names;
}

// The names of all parts of a list, such as estimators() or environments().
template <typename Parts>
[[nodiscard]] std::vector<std::string_view> names_of(const Parts& parts) {
  std::vector<std::string_view> names;
  names.reserve(std::size(parts));
  for (const auto& part : parts) names.push_back(part.description.name);
  return names;
}

// "a, b, c".
[[nodiscard]] std::string joined(std::span<const std::string_view> names);

}  // namespace hapticwall::file
