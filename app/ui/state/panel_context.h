// The arguments of every panel, and what all panels do with them: tell, show a page, take the
// keyboard.
#pragma once

#include <imgui.h>

#include <string>
#include <utility>

#include "app/draw/plot/plot.h"
#include "app/draw/plot/theme.h"
#include "app/session/live_session.h"
#include "app/session/replay_session.h"
#include "app/ui/state/dock_layout.h"
#include "app/ui/state/messages.h"
#include "app/ui/state/ui_state.h"
#include "core/scene.h"

namespace hapticwall::ui {

// Decided once a frame, before any panel draws.
struct Visibility {
  session::LiveSession* live = nullptr;      // null while a recording is shown
  session::ReplaySession* replay = nullptr;  // null while a session is live
  // A running blind test hides the force and all that follows from it, and the algorithm.
  bool hides_force = false;
  bool hides_algorithm = false;
  Axis axis = Axis::kX;  // of plots, magnifier, readout and the wall's fields
  // The newest scene that the loop has echoed; the session's own scene is the one asked for.
  const Scene* in_force = nullptr;
};

// The arguments of every panel.
struct PanelContext {
  session::SampleSource& session;  // shows.live or shows.replay
  const session::Snapshot& snapshot;
  const draw::Theme& theme;
  UiState& state;
  Visibility shows;
};

// The time axes of the plots.
[[nodiscard]] inline draw::TimeWindow time_window(const UiState& state) {
  return {state.transient.time_from_s, state.transient.time_to_s};
}

// Shows the page from the next frame on. During a blind test only its own windows are shown. The
// page gets the focus: else a window that is new takes it from a part that leaves, and comes to the
// front.
inline void show_page(UiState& state, const char* page) {
  DockState& dock = state.transient.dock;
  ImGui::SetWindowFocus((std::string("###page ") + page).c_str());
  if (dock.chosen) bring_to_front(*dock.chosen, page);
  dock.rebuild = true;
}

// Call it when a field is to get the keyboard, which takes Dear ImGui two frames.
inline void promise_keyboard(UiState& state) {
  state.transient.edit.typing_until = ImGui::GetFrameCount() + 3;
}

inline void tell(UiState& state, MessageKind kind, std::string text) {
  state.transient.toasts.tell(kind, std::move(text));
}

inline void tell(UiState& state, const Error& error) {
  tell(state, MessageKind::kProblem, error.message);
}
// A failure, or this note.
inline void tell(UiState& state, const Failure& failure, std::string note) {
  if (failure) return tell(state, *failure);
  tell(state, MessageKind::kNote, std::move(note));
}

// Tells a problem of the session or of the validation, in one line.
inline void tell(UiState& state, const SceneProblem& problem) {
  tell(state, MessageKind::kProblem,
       problem.key.empty() ? problem.message : problem.key + ": " + problem.message);
}

}  // namespace hapticwall::ui
