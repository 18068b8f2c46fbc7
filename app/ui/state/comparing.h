// The two slots of the comparison, as the Compare section, its key and undo use them.
//
// The active slot is the one that the session runs: a change of the algorithm changes that slot.
// Toggling changes no slot and is no undo step. Undo restores both slots and keeps the active one.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/ui/state/compare_state.h"
#include "app/ui/state/panel_context.h"
#include "app/ui/state/plots_state.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::ui {

struct WantedScene;

// A is active and holds the algorithm of the scene. B holds `other`, or energy bounding, or none
// when A has energy bounding. Both have the values of the scene.
[[nodiscard]] CompareSlots slots_for(const Scene& scene,
                                     std::optional<std::size_t> other = std::nullopt);
[[nodiscard]] CompareSlots slots_of(const CompareState& compare);

// Starts the comparison of a new session. Clears the traces and ends a blind test.
void begin_comparison(CompareState& compare, PlotsState& plots, Toasts& toasts, const Scene& scene,
                      const CompareSlots& slots);

// Slots for the session of a wanted scene: its own where it has them. For a loaded scene A is the
// scene's and B keeps its algorithm. Otherwise unchanged.
[[nodiscard]] CompareSlots slots_after(const CompareState& compare, const WantedScene& wanted);

// Sets both slots; does not change the session.
void set_slots(CompareState& compare, const std::array<AlgorithmSettings, 2>& settings);

// All ticks of the session, in order.
void note_ticks(CompareState& compare, const Scene& scene, std::span<const Tick> ticks);

// Copies the session's algorithm into the active slot. Call it once a frame, after all panels.
void keep_slots(CompareState& compare, const Scene& scene);

// Asks the session to run a slot. After a problem the wall stays, and the user is told.
void choose_slot(const PanelContext& context, compare::Slot slot);
void toggle_slot(const PanelContext& context);
// The other slot takes `before`, the session's previous algorithm, if it has algorithms()[index],
// too: two walls side by side differ.
void keep_walls_apart(const PanelContext& context, const AlgorithmSettings& before,
                      std::size_t index);
// Copies the session's algorithm into a slot.
void take_present(const PanelContext& context, compare::Slot slot);

// "energy-bounding".
[[nodiscard]] std::string algorithm_name(const AlgorithmSettings& settings);
// "rest force step 0.01 N, …": the given numbers, without those that the algorithm ignores.
[[nodiscard]] std::string set_keys_text(const AlgorithmSettings& settings);

}  // namespace hapticwall::ui
