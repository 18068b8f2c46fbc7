// What somebody does with every control, a row for each: one table for each panel.
//
// A control that no row names fails the test EveryControl: add a row to its panel's table.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/window/person.h"

namespace hapticwall::test {

struct Row {
  std::string item;  // that it must use, by the name under which it is drawn
  std::function<void(Person&)> use;
};
using Table = std::vector<Row>;

// A value of the window, or of its session.
using Look = std::function<double(Person&)>;

// ---- the usual kinds. `first` brings the control to light where it is not there by itself.

// Nothing can be done with it: the pointer rests on it.
[[nodiscard]] Row shown(std::string item, std::function<void(Person&)> first = {});
// A click makes it another one, a second click makes it what it was.
[[nodiscard]] Row flips(std::string item, Look look, std::function<void(Person&)> first = {});
// A click makes it this.
[[nodiscard]] Row sets(std::string item, Look look, double wanted,
                       std::function<void(Person&)> first = {});
// A text typed into it makes it this.
[[nodiscard]] Row takes(std::string item, std::string text, Look look, double wanted,
                        std::function<void(Person&)> first = {});
// Dragged to the right it grows, to the left it shrinks.
[[nodiscard]] Row slides(std::string item, Look look, std::function<void(Person&)> first = {});

// Does the same twice, and says what comes of it.
void expect_flips(Person& person, const std::string& item, const Look& look);

// Uses every row of a table, each from a window with nothing open.
void use_all(Person& person, const char* panel, const Table& table);

// A section that folds is open from now on.
void unfold(Person& person, const std::string& section, const std::string& something_in_it);

// ---- the panels
[[nodiscard]] Table head_rows(const std::string& folder);
[[nodiscard]] Table toolbar_rows();
[[nodiscard]] Table scene_rows(const std::string& scene_file);
[[nodiscard]] Table algorithm_rows();
[[nodiscard]] Table wall_rows(const std::string& scene_of_two_walls);
[[nodiscard]] Table hand_rows();
[[nodiscard]] Table device_rows();
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

// Of a real device.
[[nodiscard]] Table link_rows();

}  // namespace hapticwall::test
