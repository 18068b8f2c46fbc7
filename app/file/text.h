// Text for people: numbers, names and pieces of user input in one-line messages.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hapticwall::file {

// The shortest decimal form that reads back to the same double; '.' whatever the locale.
void append_number(std::string& text, double value);
[[nodiscard]] std::string number_text(double value);

// User input as it may stand in a message: cut to a sane length, without control characters or
// broken UTF-8, in single quotes.
[[nodiscard]] std::string in_quotes(std::string_view user_text);

// The same for something that stands in a message without quotes (a path, a key).
inline constexpr std::size_t kLongestQuote = 80;  // bytes
[[nodiscard]] std::string shown(std::string_view user_text, std::size_t longest = kLongestQuote);

// The most similar of `candidates`, where one is similar enough to be what was meant.
[[nodiscard]] std::optional<std::string_view> nearest_name(
    std::string_view word, std::span<const std::string_view> candidates);

// "; did you mean 'X'?", or nothing.
[[nodiscard]] std::string suggestion(std::string_view word,
                                     std::span<const std::string_view> candidates);

// "a, b, c".
[[nodiscard]] std::string joined(std::span<const std::string_view> names);

}  // namespace hapticwall::file
