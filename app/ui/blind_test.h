// A blind test: which of two walls, the order of which nobody sees before the end.
//
// A presentation puts its slot in force at once, wherever the handle is: the loop blends the force
// over 50 ms, as with every change. Nothing is reset: that would end a recording and disarm a
// device. Whoever wants to begin from rest leaves the wall before the switch, or resets (R).
//
// While it runs, whatever could give the order away is hidden or inert: see blind_test_runs().
#pragma once

#include <string>
#include <vector>

#include "app/ui/keys.h"
#include "app/ui/ui_state.h"

namespace hapticwall::ui {

// Panels that show anything of algorithm, force or energy ask this first.
[[nodiscard]] inline bool blind_test_runs(const UiState& state) {
  const auto& test = state.compare.transient.test;
  return test.has_value() && test->running;
}

// With the question, trials and seed that are set. The user is told where a slot is not valid.
void start_blind_test(const PanelContext& context);
// The presentation is felt from now on. Without effect unless a test runs, like the next two.
void feel(const PanelContext& context, runtime::Presentation presentation);
// The answer of this trial; after the last one the test ends.
void choose(const PanelContext& context, runtime::Presentation presentation);
// Ends the test with the trials that were answered: the slot in force is the one before it.
void end_blind_test(const PanelContext& context);

// Writes SCENE-blind-test-trials.csv and …-result.csv into the recording folder, under a number
// where one of them exists, and says where. Without effect unless a test has ended.
void save_blind_test(const PanelContext& context);

// 1 and ← feel the first, 2 and → the second; with Ctrl they choose.
[[nodiscard]] std::vector<KeyBinding> blind_test_keys();

}  // namespace hapticwall::ui
