// Writes TOML: plain lines, every number in the shortest form that reads back the same.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene_keys.h"

namespace hapticwall::file {

class TomlText {
 public:
  void comment(std::string_view text);
  void table(std::string_view name);           // [name]
  void table_of_array(std::string_view name);  // [[name]]
  void number(std::string_view key, double value);
  void integer(std::string_view key, std::uint64_t value);
  void boolean(std::string_view key, bool value);
  void string(std::string_view key, std::string_view value);
  void path(std::string_view key, const std::vector<PathPoint>& points);

  // All numbers of a table of a scene.
  template <typename Owner>
  void numbers(const Owner& owner) {
    for (const NumberKey<Owner>& key : number_keys<Owner>()) {
      const std::optional<double> value = key.get(owner);
      if (!value) continue;
      if (key.whole()) {
        integer(key.key, static_cast<std::uint64_t>(*value));
      } else {
        number(key.key, *value);
      }
    }
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void assign(std::string_view key, std::string_view value);
  std::string text_;
};

// The tables that a live session can change. `table`: the whole name, "device" or
// "recording.change.hand.y". `prefix` precedes the name: "" or "recording.change.".
// Owner: DeviceSettings, or HandSettings without the path, which no session changes.
template <typename Owner>
void write_numbers(TomlText& out, std::string_view table, const Owner& owner) {
  out.table(table);
  out.numbers(owner);
}
void write_algorithm(TomlText& out, std::string_view prefix, const AlgorithmSettings& algorithm);
void write_environment(TomlText& out, std::string_view prefix,
                       const EnvironmentSettings& environment);
void write_estimator(TomlText& out, std::string_view prefix, const EstimatorSettings& estimator);
// The walls of axis x, then of axis y.
void write_walls(TomlText& out, std::string_view prefix, const Scene& scene);
void write_simulator(TomlText& out, std::string_view prefix, const SimulatorSettings& simulator);

}  // namespace hapticwall::file
