// The top row during a replay: transport, speed, time slider, and the way back to the scene.
#pragma once

#include "app/session/replay_session.h"
#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

void draw_replay_bar(const PanelContext& context, session::ReplaySession& replay);

// Shows the progress while a large recording opens.
void draw_opening(const PanelContext& context);

// Seeks; the plots follow.
void go_to(const PanelContext& context, session::ReplaySession& replay, double time_s);

// Key actions: the speed of a replay, or the slow motion of a simulator.
void slower(const PanelContext& context);
void faster(const PanelContext& context);
// Key actions during a replay only; no effect otherwise.
void toggle_loop(const PanelContext& context);
void step_back(const PanelContext& context);  // Goes back by one tick, while paused.
void previous_mark(const PanelContext& context);
void next_mark(const PanelContext& context);

// The next lower or higher usual speed; clamped at the ends.
[[nodiscard]] double slower_than(double speed);
[[nodiscard]] double faster_than(double speed);

}  // namespace hapticwall::ui
