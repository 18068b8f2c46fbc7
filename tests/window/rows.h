// One table for each panel, with a row for each control: it uses the control and checks the effect.
//
// ControlsTest fails for a control without a row: add a row to the table of its panel.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/window/deeds.h"

namespace hapticwall::test {

struct Row {
  std::string item;  // the name of the control, which the row must use
  std::function<void(Person&)> use;
};
using Table = std::vector<Row>;

// ---- the usual kinds. `first` shows the control if it is hidden at first.

// The pointer can rest on it.
[[nodiscard]] Row shown(std::string item, std::function<void(Person&)> first = {});
// A click changes the value, and a second click changes it back.
[[nodiscard]] Row flips(std::string item, Look look, std::function<void(Person&)> first = {});
// A click sets the value to `wanted`.
[[nodiscard]] Row sets(std::string item, Look look, double wanted,
                       std::function<void(Person&)> first = {});
// Typing `text` into it sets the value to `wanted`.
[[nodiscard]] Row takes(std::string item, std::string text, Look look, double wanted,
                        std::function<void(Person&)> first = {});
// A drag to the right increases the value, a drag to the left decreases it.
[[nodiscard]] Row slides(std::string item, Look look, std::function<void(Person&)> first = {});

// A click does this deed.
[[nodiscard]] Row does(std::string item, std::function<void(Person&, const Act&)> deed);

// Uses every row of a table. Lists, help and messages are closed before each row.
void use_all(Person& person, const char* panel, const Table& table);

// Opens a folding section.
void unfold(Person& person, const std::string& section, const std::string& something_in_it);

// ---- the panels
[[nodiscard]] Table head_rows(const std::string& folder);
[[nodiscard]] Table toolbar_rows();
[[nodiscard]] Table scene_rows(const std::string& scene_file);
[[nodiscard]] Table algorithm_rows();
[[nodiscard]] Table wall_rows(const std::string& scene_of_two_walls);
[[nodiscard]] Table hand_rows();
[[nodiscard]] Table device_rows();
[[nodiscard]] Table departure_rows();
[[nodiscard]] Table loop_rows();
[[nodiscard]] Table view_rows();
[[nodiscard]] Table plot_control_rows();
[[nodiscard]] Table plot_rows();
[[nodiscard]] Table status_rows();
[[nodiscard]] Table overlay_rows();
[[nodiscard]] Table page_rows();
[[nodiscard]] Table compare_rows();
[[nodiscard]] Table recording_rows();
[[nodiscard]] Table corner_rows();

// Rows of a real device.
[[nodiscard]] Table link_rows();
// Rows of a list with two trials and a break between them.
[[nodiscard]] Table experiment_rows();

}  // namespace hapticwall::test
