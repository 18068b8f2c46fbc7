// A scene that leaves its process, and the equality of two scenes.
#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "app/python/scene.h"

namespace hapticwall::python {

// The path of a hand that the text of a scene file does not hold. `points` and `pieces` are the
// bytes of PathPoint and PathPiece.
struct PathState {
  std::size_t axis = 0;
  nanobind::bytes points;
  std::string file;
  std::string sha256;
  double rate_hz = 0.0;  // of the pieces; 0: there are none
  nanobind::bytes pieces;
};

// A scene file, and the paths of a `path_file` or of a recording. The points travel with the scene:
// the file need not be there.
struct SceneState {
  std::string toml;
  std::vector<PathState> paths;
};

// Raises ValueError for the scene of a session that changed parameters or cannot be repeated.
[[nodiscard]] SceneState state_of(const SceneBox& scene);
// Its algorithms must be in the list. Raises ValueError for a state that is no scene.
[[nodiscard]] SceneBox scene_of_state(const SceneState& state);
// A scene file as text. Raises ValueError and OSError.
[[nodiscard]] SceneBox scene_of_text(const std::string& toml);

// True if runs of both give the same rows. Name, description and changes count, too.
[[nodiscard]] bool equal(const SceneBox& a, const SceneBox& b);

// The scene's algorithm and the plug-ins whose parameters it sets: indices in algorithms().
[[nodiscard]] std::vector<std::size_t> algorithms_of(const SceneBox& scene);

void bind_scene_state(nanobind::class_<SceneBox>& scene, nanobind::module_& m);

}  // namespace hapticwall::python
