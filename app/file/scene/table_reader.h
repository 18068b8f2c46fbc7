// Reading a TOML table key by key: every key is asked for by name, the rest are errors.
//
// The readers of this folder report with the exception ReadFailure, which parse_scene() turns into
// a Result; it never leaves the folder.
#pragma once

#include <toml++/toml.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene_keys.h"

namespace hapticwall::file {

class ReadFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// "press.toml:12", or "--set KEY=VALUE" for a value that came from there.
[[nodiscard]] std::string place_of(const toml::node& node, const std::string& origin);

// "a number in kg".
[[nodiscard]] std::string number_in(std::string_view unit);

// Parses a text; throws ReadFailure for what is not TOML or nested beyond reason. `kind` names what
// it should have been.
[[nodiscard]] toml::table parse_toml(std::string_view text, const std::string& origin,
                                     std::string_view kind = "scene");

class TableReader {
 public:
  // `prefix`: the dotted name of the table with its point, "" for the root.
  TableReader(const toml::table& table, std::string prefix, const std::string& origin)
      : table_(table), prefix_(std::move(prefix)), origin_(origin) {}

  // Absent keys give nothing; a wrong type throws.
  [[nodiscard]] std::optional<double> number(std::string_view key, std::string_view unit);
  [[nodiscard]] std::optional<std::uint64_t> count(std::string_view key);
  [[nodiscard]] std::optional<bool> boolean(std::string_view key);
  [[nodiscard]] std::optional<std::string> string(std::string_view key);
  // A string without control characters, of at most so many bytes; "" where it is absent.
  [[nodiscard]] std::string line(std::string_view key, std::size_t longest);
  [[nodiscard]] const toml::table* table(std::string_view key);
  [[nodiscard]] std::vector<const toml::table*> tables(std::string_view key);
  [[nodiscard]] const toml::node* node(std::string_view key);

  // Throws for a key that nobody asked for.
  void finish() const;

  [[noreturn]] void fail(const toml::node& node, std::string_view key,
                         std::string_view message) const;
  [[noreturn]] void fail_missing(std::string_view key, std::string_view wanted) const;

  // All numbers of a key table into their owner.
  template <typename Owner>
  void numbers(std::span<const NumberKey<Owner>> keys, Owner& owner) {
    for (const NumberKey<Owner>& key : keys) {
      const std::optional<double> value = number(key.key, key.unit);
      if (value && key.whole() && *value != std::round(*value)) fail_fraction(key.key, *value);
      if (value) key.set(owner, *value);
      if (!value && key.required) fail_missing(key.key, number_in(key.unit));
    }
  }

  [[nodiscard]] const std::string& origin() const { return origin_; }

 private:
  [[noreturn]] void fail_fraction(std::string_view key, double value) const;
  [[noreturn]] void fail_type(const toml::node& node, std::string_view key,
                              std::string_view wanted) const;

  const toml::table& table_;
  std::string prefix_;
  const std::string& origin_;
  std::vector<std::string_view> known_;
};

// The values of an array of two numbers, nothing where it is none.
[[nodiscard]] std::optional<PathPoint> path_point(const toml::node& node);

}  // namespace hapticwall::file
