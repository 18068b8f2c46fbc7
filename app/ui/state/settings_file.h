// The settings file: values that the window keeps between runs.
#pragma once

#include <string>
#include <vector>

#include "app/file/scene/settings_text.h"
#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

[[nodiscard]] file::Settings settings_of(const UiState& state);

// Applies every value that is valid. Returns one line for every invalid value; ignores unknown
// keys.
[[nodiscard]] std::vector<std::string> apply_settings(const file::Settings& settings,
                                                      UiState& state);

// Delay before a change is written, so that a drag is one write.
inline constexpr double kSettingsRestS = 1.0;

class SettingsFile {
 public:
  // With an empty path nothing is read or written.
  explicit SettingsFile(std::string path) : path_(std::move(path)) {}

  // Reads the file into `state`, if it exists. Tells the user about a broken file and copies it to
  // PATH.broken, because the next save replaces it.
  void load(UiState& state);

  // Once a frame, `seconds` after the previous one: writes changes that have rested.
  void pass(UiState& state, double seconds);

  // Writes changes at once.
  void save(UiState& state);

 private:
  void write(UiState& state, const file::Settings& settings);

  std::string path_;
  file::Settings saved_;    // as it is in the file
  file::Settings resting_;  // at the last look
  double rested_s_ = 0.0;
  double unseen_s_ = 0.0;  // since the last look
  bool told_ = false;      // the user knows that writing fails
};

}  // namespace hapticwall::ui
