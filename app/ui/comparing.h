// Two algorithms felt in turn: what the Compare section, its key and the undo do with the slots.
//
// The active slot is what the session runs: whatever changes the algorithm changes that slot.
// Toggling changes neither slot, and so it is no step of the undo, which keeps both slots' contents
// and leaves the active one active.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/ui/compare_state.h"
#include "app/ui/ui_state.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::ui {

// A holds what the scene says and is active. B holds `other`, or the energy bounding algorithm, or,
// where that is A's already, the virtual coupling; with the values of the scene.
[[nodiscard]] CompareSlots slots_for(const Scene& scene,
                                     std::optional<std::size_t> other = std::nullopt);
[[nodiscard]] CompareSlots slots_of(const UiState& state);

// A session begins: the traces are gone, a blind test ends with what was answered.
void begin_comparison(UiState& state, const Scene& scene, const CompareSlots& slots);

// The slots of the session that a wanted scene gets: its own, where it has them; where it was
// loaded, A is the scene's and B stays with its algorithm; else they are what they were.
[[nodiscard]] CompareSlots slots_after(const UiState& state, const WantedScene& wanted);

// Of either slot; the session is the caller's business.
void set_slots(UiState& state, const std::array<AlgorithmSettings, 2>& settings);

// All samples of the session, in order.
void note_samples(UiState& state, const Scene& scene, std::span<const Sample> samples);

// Once a frame, after all panels: the active slot holds what the session runs.
void keep_slots(UiState& state, const Scene& scene);

// Makes the session run a slot; a problem leaves everything as it was.
[[nodiscard]] std::optional<SceneProblem> put_in_force(const PanelContext& context,
                                                       runtime::Slot slot);
// The same for the user, who is told of a problem.
void choose_slot(const PanelContext& context, runtime::Slot slot);
void toggle_slot(const PanelContext& context);
// Stores what the session runs in a slot.
void take_present(const PanelContext& context, runtime::Slot slot);

// "energy-bounding".
[[nodiscard]] std::string algorithm_name(const AlgorithmSettings& settings);
// "rest_force_step_n = 0.01, …": of the keys that this algorithm reads, those that are set.
[[nodiscard]] std::string set_keys_text(const AlgorithmSettings& settings);

}  // namespace hapticwall::ui
