// Scenes and recordings that the user opens by path, by drop, or from the list of recent files.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/ui/state/panel_context.h"
#include "app/ui/state/scene_state.h"

namespace hapticwall::ui {

inline constexpr std::size_t kMaxRecentFiles = 8;

// Moves the absolute path to the front of the list; the oldest entry drops out.
void remember_recent(std::vector<std::string>& recent, const std::string& path);

// Asks for the scene or the recording in this file. A failure shows a message and removes the file
// from the list.
void open_file(SceneState& state, Toasts& toasts, const std::string& path);

}  // namespace hapticwall::ui
