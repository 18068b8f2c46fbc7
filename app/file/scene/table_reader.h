// Reads a TOML table key by key. Keys that no call asks for are errors.
//
// The readers of this folder throw ReadFailure. parse_scene() turns it into a Result, so that it
// never leaves the folder.
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

// "press.toml:12"; "--set KEY=VALUE" for a value of --set.
[[nodiscard]] std::string place_of(const toml::node& node, const std::string& origin);

// "a number in kg".
[[nodiscard]] std::string number_in(std::string_view unit);

// Throws ReadFailure if the text is not TOML, nested too deeply, or if it has more changes of a
// recording than kMaxChanges: these are refused before they take memory. `kind` names the expected
// file in the message.
[[nodiscard]] toml::table parse_toml(std::string_view text, const std::string& origin,
                                     std::string_view kind = "scene");

class TableReader {
 public:
  // `prefix`: the dotted name of the table with a final point; "" for the root.
  TableReader(const toml::table& table, std::string prefix, const std::string& origin)
      : table_(table), prefix_(std::move(prefix)), origin_(origin) {}

  // nullopt or null if the key is absent; throws for a wrong type.
  [[nodiscard]] std::optional<double> number(std::string_view key, std::string_view unit);
  [[nodiscard]] std::optional<std::uint64_t> count(std::string_view key);
  [[nodiscard]] std::optional<bool> boolean(std::string_view key);
  [[nodiscard]] std::optional<std::string> string(std::string_view key);
  // A string without control characters and of at most `longest` bytes; "" if it is absent.
  [[nodiscard]] std::string line(std::string_view key, std::size_t longest);
  [[nodiscard]] const toml::table* table(std::string_view key);
  [[nodiscard]] std::vector<const toml::table*> tables(std::string_view key);
  [[nodiscard]] const toml::node* node(std::string_view key);

  // Throws if the table has a key that no call asked for.
  void finish() const;

  [[noreturn]] void fail(const toml::node& node, std::string_view key,
                         std::string_view message) const;
  [[noreturn]] void fail_missing(std::string_view key, std::string_view wanted) const;

  // Reads all numbers of the table.
  template <typename Owner>
  void numbers(Owner& owner, std::span<const NumberKey<Owner>> keys = number_keys<Owner>()) {
    for (const NumberKey<Owner>& key : keys) {
      const std::optional<double> value = number(key.key, key.unit);
      if (value && key.whole() && *value != std::round(*value)) fail_fraction(key.key, *value);
      if (value) key.set(owner, *value);
      if (!value && key.required) fail_missing(key.key, number_in(key.unit));
    }
  }

  [[nodiscard]] const std::string& origin() const { return origin_; }

 private:
  template <typename Value>
  [[nodiscard]] std::optional<Value> value(std::string_view key, std::string_view wanted);
  [[noreturn]] void fail_fraction(std::string_view key, double value) const;
  [[noreturn]] void fail_type(const toml::node& node, std::string_view key,
                              std::string_view wanted) const;

  const toml::table& table_;
  std::string prefix_;
  const std::string& origin_;
  std::vector<std::string_view> known_;
};

// nullopt if the node is not an array of two finite numbers.
[[nodiscard]] std::optional<PathPoint> path_point(const toml::node& node);

}  // namespace hapticwall::file
