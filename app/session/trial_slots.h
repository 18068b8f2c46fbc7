// The two walls of a trial as scenes, and their values as columns of the answers.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/file/trials/trial_list.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::session {

// The scene of the session with these texts of --set in addition.
using SceneWith = std::function<Result<Scene>(std::span<const std::string> overrides)>;

using SlotScenes = std::array<Scene, 2>;  // scenes of A and B

// Loads the slots of trials.
class SlotLoader {
 public:
  // `base`: the scene of the session. `on_device`: a real one, which has no simulated hand.
  SlotLoader(SceneWith scene_with, Scene base, bool on_device)
      : scene_with_(std::move(scene_with)), base_(std::move(base)), on_device_(on_device) {}

  // Refuses (exit status 2) a slot that is no valid scene, that cannot change while the session
  // runs, or that a device ignores.
  [[nodiscard]] Result<SlotScenes> load(const file::TrialSpec& trial) const;
  [[nodiscard]] const Scene& base() const { return base_; }

 private:
  [[nodiscard]] Result<Scene> slot_scene(const std::string& slot) const;

  SceneWith scene_with_;
  Scene base_;
  bool on_device_;
};

// The keys that the slots of these trials set, each once, in their order.
[[nodiscard]] std::vector<std::string> keys_of(std::span<const file::TrialSpec> trials);

// The values of these keys in A and B by turns: from the scenes, or the text of a slot for a key
// that is no number or name. Empty where a slot does not set such a key.
[[nodiscard]] std::vector<std::string> values_of(std::span<const std::string> keys,
                                                 const file::TrialSpec& trial,
                                                 const SlotScenes& scenes);

}  // namespace hapticwall::session
