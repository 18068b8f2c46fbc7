// State of the window as a whole.
#pragma once

#include <string>

namespace hapticwall::ui {

struct WindowState {
  // Stored in the settings file.
  bool more = false;  // false: scene, algorithms, wall and plots alone
  int width = 0;      // in pixels at scale 1; 0: as fits the screen
  int height = 0;
  bool maximised = false;

  // Lives as long as the window.
  bool presents = false;      // for a room: the first window alone, and large
  std::string settings_path;  // empty: settings are not stored
  bool help_shown = false;
  bool status_shown = false;  // the state of the loop, at the bottom
};

}  // namespace hapticwall::ui
