// What the window keeps from one start to the next, in a file of the user's.
#pragma once

#include <string>
#include <vector>

#include "app/file/settings_text.h"
#include "app/ui/ui_state.h"

namespace hapticwall::ui {

[[nodiscard]] file::Settings settings_of(const UiState& state);

// Takes what is there and fits; the rest stays as it is. Returns a line for every value that does
// not fit; unknown keys are none.
[[nodiscard]] std::vector<std::string> apply_settings(const file::Settings& settings,
                                                      UiState& state);

// How long a change rests before it is written: a drag is one change.
inline constexpr double kSettingsRestS = 1.0;

class SettingsFile {
 public:
  // An empty path: nothing is read or written.
  explicit SettingsFile(std::string path) : path_(std::move(path)) {}

  // Reads the file into `state`, where there is one. What is wrong with it is told; then a copy
  // stays beside it as PATH.broken, for the next save replaces it.
  void load(UiState& state);

  // Once a frame, `seconds` after the last: writes what has changed and rested.
  void pass(UiState& state, double seconds);

  // Writes at once, where something has changed.
  void save(UiState& state);

 private:
  void write(UiState& state, const file::Settings& settings);

  std::string path_;
  file::Settings saved_;    // as it is in the file
  file::Settings resting_;  // as it was when it was last looked at
  double rested_s_ = 0.0;
  double unseen_s_ = 0.0;  // since it was last looked at
  bool told_ = false;      // that it cannot be written
};

}  // namespace hapticwall::ui
