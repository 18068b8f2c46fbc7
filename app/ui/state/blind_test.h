// A blind test: which of two walls? Nobody sees their order before the end.
//
// A presentation puts its slot in force at once, wherever the handle is. The loop blends the force
// over 50 ms, as for every change. Nothing is reset: a reset would end a recording and disarm a
// device. To begin from rest, leave the wall before the switch, or reset (R).
//
// While the test runs, everything that could reveal the order is hidden or inert (Visibility).
#pragma once

#include <vector>

#include "app/ui/state/key_binding.h"
#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

// Panels read Visibility instead, which is constant during a frame.
[[nodiscard]] inline bool blind_test_runs(const UiState& state) {
  const auto& test = state.compare.transient.test;
  return test.has_value() && test->running;
}

// The wall is neither heard nor felt by a gamepad's rumble.
[[nodiscard]] inline bool masks_sound(const UiState& state) {
  return blind_test_runs(state) && state.compare.persisted.masking_noise;
}

// Uses the question, trials and seed that are set. Tells the user when a slot is not valid.
void start_blind_test(const PanelContext& context);
// Puts the presentation in force. No effect unless a test runs, like the next two.
void feel(const PanelContext& context, compare::Presentation presentation);
// Answers this trial. The test ends after the last trial.
void choose(const PanelContext& context, compare::Presentation presentation);
// Ends the test with the trials answered so far, and restores the slot of before the test.
void end_blind_test(const PanelContext& context);

// Writes SCENE-blind-test-trials.csv and …-result.csv into the recording folder and tells the user.
// Adds a number when a file exists. No effect unless a test has ended.
void save_blind_test(const PanelContext& context);

// 1 and ← feel the first, 2 and → the second; with Ctrl they choose.
[[nodiscard]] std::vector<KeyBinding> blind_test_keys();

}  // namespace hapticwall::ui
