// What the window remembers of two algorithms felt in turn, of a blind test, and of the energy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "app/runtime/comparison.h"
#include "app/runtime/comparison_trials.h"
#include "core/energy_story.h"
#include "core/stabiliser/algorithm_settings.h"

namespace hapticwall::ui {

// The two algorithms of a comparison, and which of them the session runs.
struct CompareSlots {
  runtime::Slot active = runtime::Slot::kA;
  std::array<AlgorithmSettings, 2> settings{};

  [[nodiscard]] const AlgorithmSettings& of(runtime::Slot slot) const {
    return settings[static_cast<std::size_t>(slot)];
  }
};

// A blind test from its beginning, and its result after it.
struct BlindTest {
  runtime::BlindTrials trials;
  std::string a;  // what the slots held, in words
  std::string b;
  runtime::Slot slot_before = runtime::Slot::kA;             // in force again after the end
  std::optional<runtime::Presentation> felt = std::nullopt;  // what is felt now, of this trial
  bool running = true;
  std::string saved_as = {};  // empty: not yet
};

// Which ghost the plots have.
struct ShownGhost {
  runtime::Slot slot = runtime::Slot::kA;
  std::uint64_t onset_tick = 0;
  std::size_t points = 0;
  std::size_t algorithm = 0;

  friend bool operator==(const ShownGhost&, const ShownGhost&) = default;
};

struct CompareState {
  // Worth keeping from one start of the program to the next.
  struct Persisted {
    bool ghost_shown = true;
    // Of the next blind test.
    std::string question = runtime::TrialPlan{}.question;
    std::size_t trials = runtime::TrialPlan{}.trials;
    double confidence = runtime::TrialPlan{}.confidence;
  } persisted;

  // Lasts as long as the window.
  struct Transient {
    std::optional<runtime::Comparison> comparison;  // of the session that runs
    std::optional<EnergyLamp> lamp;                 // as well
    double lamp_encoder_m = 0.0;                    // that it was made with
    std::optional<ShownGhost> shown_ghost;
    std::optional<std::uint64_t> seed;  // of the next blind test; nothing: by chance
    std::optional<BlindTest> test;
    bool setting_up = false;  // the next one, although a result is there
  } transient;
};

}  // namespace hapticwall::ui
