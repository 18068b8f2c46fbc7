// State of the comparison by touch, of the blind test and of the energy lamp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/compare/blind_trials.h"
#include "app/compare/contact_traces.h"
#include "app/compare/exposure.h"
#include "app/compare/trial_results.h"
#include "app/session/experiment.h"
#include "core/algorithm_settings.h"
#include "core/study/energy_story.h"

namespace hapticwall::ui {

// The two compared algorithms, and the one that the session runs.
struct CompareSlots {
  compare::Slot active = compare::Slot::kA;
  std::array<AlgorithmSettings, 2> settings{};

  [[nodiscard]] const AlgorithmSettings& of(compare::Slot slot) const {
    return settings[static_cast<std::size_t>(slot)];
  }
};

// The running blind test of a trial list, or its result.
struct BlindTest {
  compare::BlindTrials trials;
  Scene before;                                              // the session's before the test
  std::shared_ptr<session::Experiment> experiment;           // not null
  bool begun = false;                                        // false: waits for "Begin"
  std::optional<compare::Presentation> felt = std::nullopt;  // the presentation in force
  bool running = true;
  std::vector<file::Answer> answers = {};
  compare::TrialResults results = {};  // set at the end
  compare::Exposure exposure = {};     // of this trial
  bool feed_left = false;              // the program that gives the trials has gone
};

// Identifies the ghost in the plots.
struct ShownGhost {
  compare::Slot slot = compare::Slot::kA;
  std::uint64_t onset_tick = 0;
  std::size_t points = 0;
  std::size_t algorithm = 0;

  friend bool operator==(const ShownGhost&, const ShownGhost&) = default;
};

// Limits of the confidence that can be chosen for the interval of a blind test.
inline constexpr double kMinConfidence = 0.5;
inline constexpr double kMaxConfidence = 0.999;

struct CompareState {
  // Stored in the settings file.
  struct Persisted {
    bool open = false;  // the section Compare, and the field 'then' of the algorithm
    bool ghost_shown = true;
    // Settings of the next trial list that the page writes.
    std::string question = file::kUsualQuestion;
    std::size_t trials = 20;
    double confidence = compare::TrialPlan{}.confidence;
    bool masking_noise = true;  // noise replaces the sound
  } persisted;

  // Lives as long as the window.
  struct Transient {
    std::optional<compare::ContactTraces> comparison;  // traces of the running session
    std::optional<EnergyLamp> lamp;                    // lamp of the running session
    double lamp_encoder_m = 0.0;                       // resolution of the encoder, for `lamp`
    std::optional<ShownGhost> shown_ghost;
    std::optional<BlindTest> test;
    bool setting_up = false;  // the set-up page is open although a result exists
  } transient;
};

}  // namespace hapticwall::ui
