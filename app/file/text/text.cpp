#include "app/file/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <numeric>

#include "core/text.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kMaxNumberBytes = 32;  // "-1.7976931348623157e+308" has 24
constexpr std::size_t kMaxWordBytes = 64;    // compared with known names; none is longer
constexpr std::size_t kShortestPrefix = 3;   // "damping" stands for "damping_n_s_per_m"

// Levenshtein distance, with the swap of two neighbours counted once.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last.swap(last);
    last.swap(row);
  }
  return last.back();
}

}  // namespace

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[sizeof "9999-12-31T23:59:59Z"] = {};
  const std::size_t length = std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return {text, length};
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

void append_number(std::string& text, double value) {
  std::array<char, kMaxNumberBytes> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

std::string fixed(std::optional<double> value, double factor, int digits) {
  if (!value || !std::isfinite(*value)) return "-";
  const std::string text = fmt::format("{:.{}f}", *value * factor, digits);
  return text.find_first_not_of("-0.") == std::string::npos ? fmt::format("{:.{}f}", 0.0, digits)
                                                            : text;
}

std::string shortest_number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string in_quotes(std::string_view user_text) { return "'" + shown(user_text) + "'"; }

std::string shown(std::string_view user_text, std::size_t longest) {
  std::string result;
  while (!user_text.empty()) {
    if (result.size() >= longest) return result + "...";
    const std::size_t length = utf8_length(user_text);
    if (length > 0 && !starts_with_control(user_text)) {
      result += user_text.substr(0, length);
    } else {
      result += '?';
    }
    user_text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

std::optional<std::string_view> nearest_name(std::string_view word,
                                             std::span<const std::string_view> candidates) {
  if (word.empty() || word.size() > kMaxWordBytes) return std::nullopt;
  std::optional<std::string_view> nearest;
  std::size_t nearest_distance = std::max<std::size_t>(word.size() / 3, 1) + 1;
  for (const std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance >= nearest_distance) continue;
    nearest = candidate;
    nearest_distance = distance;
  }
  if (nearest || word.size() < kShortestPrefix) return nearest;
  const auto longer = std::find_if(candidates.begin(), candidates.end(),
                                   [&](std::string_view name) { return name.starts_with(word); });
  if (longer != candidates.end()) return *longer;
  // "stifness" for "stiffness_n_per_m": as long a piece of the name is similar.
  for (const std::string_view candidate : candidates) {
    const std::string_view head = candidate.substr(0, word.size() + 1);
    if (edit_distance(word, head) <= 2 && word.size() > 2 * kShortestPrefix) return candidate;
  }
  return std::nullopt;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> candidates) {
  const std::optional<std::string_view> name = nearest_name(word, candidates);
  return name ? fmt::format("; did you mean '{}'?", *name) : "";
}

std::string joined(std::span<const std::string_view> names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace hapticwall::file
