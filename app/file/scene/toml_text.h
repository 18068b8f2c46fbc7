// Writes TOML: plain lines, every number in the shortest form that reads back the same.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene.h"

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

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void assign(std::string_view key, std::string_view value);
  std::string text_;
};

// The tables that a live session can change. `table`: the whole name, "device" or
// "recording.change.hand.y". `prefix` precedes the name: "" or "recording.change.".
void write_device(TomlText& out, std::string_view table, const DeviceSettings& device);
// Without the path, which no session changes.
void write_hand_numbers(TomlText& out, std::string_view table, const HandSettings& hand);
void write_algorithm(TomlText& out, std::string_view prefix, const AlgorithmSettings& algorithm);
// The walls of axis x, then of axis y.
void write_walls(TomlText& out, std::string_view prefix, const Scene& scene);
void write_simulator(TomlText& out, std::string_view prefix, const SimulatorSettings& simulator);

}  // namespace hapticwall::file
