// The replay section of the control panel, and re-runs of the recorded hand.
#pragma once

#include <string>

#include "app/session/replay_session.h"
#include "app/ui/panel/replay_state.h"
#include "app/ui/state/panel_context.h"
#include "app/ui/state/plots_state.h"

namespace hapticwall::ui {

void draw_replay_section(const PanelContext& context, session::ReplaySession& replay);

// Re-runs the recorded hand under this algorithm, on its own thread. The result replaces the
// present overlay.
void start_rerun(ReplayState& state, Toasts& toasts, const session::ReplaySession& replay,
                 const std::string& algorithm);

// Shows the result of a finished re-run as an overlay, or tells why there is none.
void notice_rerun(ReplayState& state, PlotsState& plots, Toasts& toasts,
                  session::ReplaySession& replay);

// Shows an overlay in the plots; null removes it.
void draw_overlay_in_plots(PlotsState& plots, const session::Overlay* overlay,
                           std::shared_ptr<const draw::SampleHistory> history);

// The samples of an overlay for the plots.
[[nodiscard]] std::shared_ptr<const draw::SampleHistory> history_of(const session::Overlay& overlay,
                                                                    const DeviceSettings& device);

}  // namespace hapticwall::ui
