// The settings file: values that the window keeps between runs, as JSON.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "app/ui/window/ui_state.h"
#include "core/result.h"

namespace hapticwall::ui {

inline constexpr std::size_t kMaxSettingsBytes = 256U << 10U;

// The text of the settings file. Omits strings that are not UTF-8.
[[nodiscard]] std::string settings_text(const UiState& state);

// Applies every value that is valid. Returns one line for every invalid value and unknown key.
// Fails if the text is not JSON; `origin` names it in the message.
[[nodiscard]] Result<std::vector<std::string>> apply_settings(std::string_view text,
                                                              const std::string& origin,
                                                              UiState& state);
// Applies the settings of earlier versions, which were TOML. Ignores unknown keys.
[[nodiscard]] Result<std::vector<std::string>> apply_old_settings(std::string_view text,
                                                                  const std::string& origin,
                                                                  UiState& state);

// Delay before a change is written, so that a drag is one write.
inline constexpr double kSettingsRestS = 1.0;

class SettingsFile {
 public:
  // With an empty path, reads and writes nothing.
  explicit SettingsFile(std::string path) : path_(std::move(path)) {}

  // Reads the file into `state`. If it does not exist, reads that of an earlier version beside it,
  // which ends in ".toml". Tells the user about a broken file and copies it to PATH.broken, because
  // the next save replaces it.
  void load(UiState& state);

  // Writes changes that have rested. Call it once a frame, `seconds` after the previous call.
  void pass(UiState& state, double seconds);

  // Writes changes at once.
  void save(UiState& state);

 private:
  void write(UiState& state, const std::string& text);

  std::string path_;
  std::string saved_;    // text of the file
  std::string resting_;  // text at the last look
  double rested_s_ = 0.0;
  double unseen_s_ = 0.0;  // since the last look
  bool told_ = false;      // the user was told that writing fails
};

}  // namespace hapticwall::ui
