// The scenes that the user has loaded, asks for, and can go back to.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/ui/state/undo.h"
#include "core/algorithm_settings.h"
#include "core/scene.h"

namespace hapticwall::ui {

// A scene that needs a new session.
struct WantedScene {
  Scene scene;
  bool loaded = false;  // loaded from a file, not a change of the running scene
  // Otherwise the scene to which values can be reset, if it is another one.
  std::shared_ptr<const Scene> back_to = nullptr;
  // Slots of the comparison; nullopt: unchanged, or chosen for a loaded scene.
  std::optional<std::array<AlgorithmSettings, 2>> slots = std::nullopt;
};

struct SceneState {
  std::vector<std::string> recent;    // files, the newest first; stored in the settings file
  std::optional<WantedScene> wanted;  // starts at rest after this frame
  std::string wanted_recording;       // opens after this frame; empty: none
  Scene loaded;                       // source for resetting changed values
  UndoHistory undo;
  // Values of the parts that are switched off, by key.
  std::map<std::string, double, std::less<>> switched_off;
  bool repeats = false;  // the scene begins anew, at rest, at its end
};

}  // namespace hapticwall::ui
