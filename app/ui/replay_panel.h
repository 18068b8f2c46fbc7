// The recording that is replayed, in the control panel, and its hand under another algorithm.
#pragma once

#include <string>

#include "app/runtime/replay_session.h"
#include "app/ui/ui_state.h"

namespace hapticwall::ui {

void draw_replay_section(const PanelContext& context, runtime::ReplaySession& replay);

// Re-runs the recorded hand under this algorithm, on a thread of its own. What is laid over goes
// when the new one comes.
void start_rerun(UiState& state, const runtime::ReplaySession& replay,
                 const std::string& algorithm);

// Lays over what a re-run has come to, once it is done, or tells why there is nothing.
void notice_rerun(UiState& state, runtime::ReplaySession& replay);

// Draws what is laid over the replay (nothing: of no other session either) over the plots.
void draw_overlay_in_plots(UiState& state, const runtime::Overlay* overlay,
                           std::shared_ptr<const SampleHistory> history);

// The samples of an overlay as the plots take them.
[[nodiscard]] std::shared_ptr<const SampleHistory> history_of(const runtime::Overlay& overlay);

}  // namespace hapticwall::ui
