#include "app/file/scene/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/file/text/text.h"
#include "core/text.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kMaxKeysInMessage = 20;

std::string type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return fmt::format("the string {}", in_quotes(**node.as_string()));
    case toml::node_type::integer:
      return fmt::format("{}", **node.as_integer());
    case toml::node_type::floating_point:
      return number_text(**node.as_floating_point());
    case toml::node_type::boolean:
      return **node.as_boolean() ? "true" : "false";
    default:
      return "a date or a time";
  }
}

std::optional<double> number_of(const toml::node& node) {
  if (const auto* real = node.as_floating_point()) return **real;
  if (const auto* integer = node.as_integer()) return static_cast<double>(**integer);
  return std::nullopt;
}

}  // namespace

std::string number_in(std::string_view unit) {
  return unit.empty() ? "a number" : fmt::format("a number in {}", unit);
}

std::string place_of(const toml::node& node, const std::string& origin) {
  const toml::source_region& source = node.source();
  if (source.path && *source.path != origin) return *source.path;
  if (!source.begin) return shown(origin);
  return fmt::format("{}:{}", shown(origin), source.begin.line);
}

const toml::node* TableReader::node(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return table_.get(key);
}

std::optional<double> TableReader::number(std::string_view key, std::string_view unit) {
  const toml::node* found = node(key);
  if (found == nullptr) return std::nullopt;
  const std::optional<double> value = number_of(*found);
  if (!value) fail_type(*found, key, number_in(unit));
  if (!std::isfinite(*value)) {
    fail(*found, key, fmt::format("{} is not a finite number", number_text(*value)));
  }
  return value;
}

std::optional<std::uint64_t> TableReader::count(std::string_view key) {
  const toml::node* found = node(key);
  if (found == nullptr) return std::nullopt;
  const auto* integer = found->as_integer();
  if (integer == nullptr || **integer < 0) fail_type(*found, key, "a whole number from 0 on");
  return static_cast<std::uint64_t>(**integer);
}

template <typename Value>
std::optional<Value> TableReader::value(std::string_view key, std::string_view wanted) {
  const toml::node* found = node(key);
  if (found == nullptr) return std::nullopt;
  if (!found->is<Value>()) fail_type(*found, key, wanted);
  return **found->as<Value>();
}

std::optional<bool> TableReader::boolean(std::string_view key) {
  return value<bool>(key, "true or false");
}

std::optional<std::string> TableReader::string(std::string_view key) {
  return value<std::string>(key, "a string");
}

std::string TableReader::line(std::string_view key, std::size_t longest) {
  const toml::node* found = node(key);
  std::string text = string(key).value_or("");
  if (text.size() > longest) fail(*found, key, fmt::format("longer than {} bytes", longest));
  // The parser let only well-formed UTF-8 pass.
  for (std::string_view rest = text; !rest.empty();) {
    if (starts_with_control(rest)) fail(*found, key, "has a control character");
    rest.remove_prefix(std::max<std::size_t>(utf8_length(rest), 1));
  }
  return text;
}

const toml::table* TableReader::table(std::string_view key) {
  const toml::node* found = node(key);
  if (found != nullptr && !found->is_table())
    fail_type(*found, key, fmt::format("a table [{}]", key));
  return found == nullptr ? nullptr : found->as_table();
}

std::vector<const toml::table*> TableReader::tables(std::string_view key) {
  const toml::node* found = node(key);
  std::vector<const toml::table*> all;
  if (found == nullptr) return all;
  const std::string wanted = fmt::format("an array of tables, [[{}]]", key);
  if (!found->is_array()) fail_type(*found, key, wanted);
  for (const toml::node& element : *found->as_array()) {
    if (!element.is_table()) fail_type(element, key, wanted);
    all.push_back(element.as_table());
  }
  return all;
}

void TableReader::finish() const {
  for (const auto& [key, value] : table_) {
    const std::string_view name = key.str();
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    std::string hint = suggestion(name, known_);
    if (hint.empty() && known_.size() <= kMaxKeysInMessage) {
      hint = fmt::format("; known here: {}", joined(known_));
    }
    throw ReadFailure(fmt::format("{}: {}{}: unknown key{}", place_of(value, origin_), prefix_,
                                  shown(name), hint));
  }
}

void TableReader::fail(const toml::node& node, std::string_view key,
                       std::string_view message) const {
  throw ReadFailure(fmt::format("{}: {}{}: {}", place_of(node, origin_), prefix_, key, message));
}

void TableReader::fail_fraction(std::string_view key, double value) const {
  fail(*table_.get(key), key, fmt::format("{} where a whole number belongs", number_text(value)));
}

void TableReader::fail_type(const toml::node& node, std::string_view key,
                            std::string_view wanted) const {
  fail(node, key, fmt::format("{} where {} belongs", type_name(node), wanted));
}

void TableReader::fail_missing(std::string_view key, std::string_view wanted) const {
  constexpr std::size_t kMinHintBytes = 3;  // "y" is not a misspelt "x"
  std::string hint;
  for (const auto& [found, value] : table_) {
    const std::string_view name = found.str();
    const bool read = std::find(known_.begin(), known_.end(), name) != known_.end();
    if (read || name.size() < kMinHintBytes || !nearest_name(name, std::array{key})) continue;
    hint = fmt::format("; is {} meant for it?", in_quotes(name));
  }
  throw ReadFailure(fmt::format("{}: {}{} is missing; it takes {}{}", place_of(table_, origin_),
                                prefix_, key, wanted, hint));
}

std::optional<PathPoint> path_point(const toml::node& node) {
  const toml::array* pair = node.as_array();
  if (pair == nullptr || pair->size() != 2) return std::nullopt;
  const std::optional<double> time_s = number_of(*pair->get(0));
  const std::optional<double> position_m = number_of(*pair->get(1));
  if (!time_s || !position_m || !std::isfinite(*time_s) || !std::isfinite(*position_m)) {
    return std::nullopt;
  }
  return PathPoint{*time_s, *position_m};
}

}  // namespace hapticwall::file
