// A blind test: which of two walls? Nobody sees their order before the end. The walls are A and B
// of Compare, or those of a trial list (docs/experiments.md).
//
// A presentation puts the scene of its slot in force at once, wherever the handle is. The loop
// blends the force over 50 ms, as for every change. Nothing is reset: a reset would end a recording
// and disarm a device. To begin from rest, leave the wall before the switch, or reset (R).
//
// While the test runs, everything that could reveal the order is hidden or inert (Visibility).
#pragma once

#include <memory>
#include <vector>

#include "app/ui/state/compare_state.h"
#include "app/ui/state/dock_state.h"
#include "app/ui/state/key_binding.h"
#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

// Panels read Visibility instead, which is constant during a frame.
[[nodiscard]] inline bool blind_test_runs(const CompareState& compare) {
  const auto& test = compare.transient.test;
  return test.has_value() && test->running;
}

// The wall is not heard.
[[nodiscard]] inline bool masks_sound(const CompareState& compare) {
  return blind_test_runs(compare) && compare.persisted.masking_noise;
}

// The scene for pictures: that of before the test while one runs, because a wall may have its place
// from its slot.
[[nodiscard]] inline const Scene& scene_to_show(const PanelContext& context) {
  return context.shows.hides_force ? context.compare.transient.test->before
                                   : context.session.scene();
}

// Writes SCENE-blind-test.csv into the recording folder: a list of equal trials of the slots A and
// B of Compare, with the question and the number that are set. Tells the user how to run it.
void write_trial_list(const PanelContext& context);
// Starts the test of a trial list, or shows its result if all trials were answered. It waits for
// go_on(). `running`: the session's scene.
[[nodiscard]] Failure start_experiment(CompareState& compare, DockState& dock, Toasts& toasts,
                                       const Scene& running,
                                       std::shared_ptr<session::Experiment> experiment);
// True if nothing can be felt before go_on(): at the beginning of a list, and at its breaks.
[[nodiscard]] bool waits(const BlindTest& test);
// True if the next trial has not come from the program that gives the trials.
[[nodiscard]] bool awaits_trial(const CompareState& compare);
// Takes what that program has sent. Call it once a frame, before the panels.
void heed_feed(const PanelContext& context);
// No effect unless a test runs, like the next three.
void go_on(const PanelContext& context);
// Puts the presentation in force.
void feel(const PanelContext& context, compare::Presentation presentation);
// Answers this trial, and stores the answer to a trial of a list first; an answer that cannot be
// stored does not count. The test ends after the last trial.
void choose(const PanelContext& context, compare::Presentation presentation);
// Ends the test and computes its results.
void finish(BlindTest& test);
// Ends the test with the trials answered so far. The last wall stays in force, and undo goes back.
void end_blind_test(const PanelContext& context);

// 1 and ← feel the first, 2 and → the second; with Ctrl they choose.
[[nodiscard]] std::vector<KeyBinding> blind_test_keys();

}  // namespace hapticwall::ui
