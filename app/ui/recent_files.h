// Files that the user opens: scenes and recordings, by name, by a drop, or once more from the list.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

inline constexpr std::size_t kMostRecentFiles = 8;

// A file ends with .csv, or with .csv.partial: a recording. Everything else is taken for a scene.
[[nodiscard]] bool is_recording(const std::string& path);

// To the front of the list, under its whole path; the oldest goes. A path that is there already
// moves.
void remember_recent(std::vector<std::string>& recent, const std::string& path);

// Asks for the scene or the recording of this file. What cannot be opened is told, and is no longer
// in the list.
void open_file(UiState& state, const std::string& path);

}  // namespace hapticwall::ui
