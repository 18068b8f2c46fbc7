// An experiment: a trial list with the scene of every slot, and the file of its answers.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/file/trials/answers_file.h"
#include "app/file/trials/trial_list.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::session {

inline constexpr std::size_t kMaxNameBytes = 64;  // bytes of the name of a participant or a session

struct ExperimentChoice {
  std::string list;         // path
  std::string participant;  // letters, digits, "-", "_"; for files and tables
  std::string session;
  std::string answers;     // path; empty: LIST-PARTICIPANT-SESSION.csv in the current folder
  bool on_device = false;  // a real one, which has no simulated hand
};

// The scene of the session with these texts of --set in addition.
using SceneWith = std::function<Result<Scene>(std::span<const std::string> overrides)>;

using SlotScenes = std::array<Scene, 2>;  // scenes of A and B

struct Experiment {
  std::string name;  // name of the list, without folder and ending
  std::vector<file::TrialSpec> trials;
  std::vector<SlotScenes> scenes;  // scenes of each trial
  file::AnswersFile answers;
};

// Reads the list, loads all slots, and opens the answers last. Refuses, with the line of the list,
// a slot that is no valid scene, that cannot change while the session runs, or that a device
// ignores. Refuses answers that are not those of the first trials of the list.
[[nodiscard]] Result<std::shared_ptr<Experiment>> open_experiment(const ExperimentChoice& choice,
                                                                  const SceneWith& scene_with);

}  // namespace hapticwall::session
