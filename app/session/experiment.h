// An experiment: a trial list with the scene of every slot, and the file of its answers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/file/trials/answers_file.h"
#include "app/file/trials/trial_list.h"
#include "app/session/trial_feed.h"
#include "app/session/trial_slots.h"
#include "core/result.h"

namespace hapticwall::session {

inline constexpr std::size_t kMaxNameBytes = 64;  // bytes of the name of a participant or a session

// The list of trials from standard input.
inline constexpr const char* kPiped = "-";

struct ExperimentChoice {
  std::string list;         // path; kPiped: another program gives the trials
  std::string participant;  // letters, digits, "-", "_"; for files and tables
  std::string session;
  std::string answers;     // path; empty: LIST-PARTICIPANT-SESSION.csv in the current folder
  bool on_device = false;  // a real one, which has no simulated hand
};

struct Experiment {
  std::string name;  // name of the list, without folder and ending; of the answers without a list
  std::vector<file::TrialSpec> trials;  // with a feed those so far
  std::vector<SlotScenes> scenes;       // scenes of each trial
  file::AnswersFile answers;
  std::unique_ptr<TrialFeed> feed;  // gives further trials; null: there are no others
};

// The values of the trial at this place for the columns of the answers.
[[nodiscard]] std::vector<std::string> values_at(const Experiment& experiment, std::size_t place);

// Reads the list, loads all slots, and opens the answers last. Refuses, with the line of the list,
// a slot that is no valid scene, that cannot change while the session runs, or that a device
// ignores. Refuses answers that are not those of the first trials of the list. With kPiped, trials
// come through `pipe` instead: without it, standard input and output.
[[nodiscard]] Result<std::shared_ptr<Experiment>> open_experiment(
    const ExperimentChoice& choice, const SceneWith& scene_with,
    std::unique_ptr<LinePipe> pipe = nullptr);

}  // namespace hapticwall::session
