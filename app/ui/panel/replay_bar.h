// The row on top while a recording is replayed: transport, speed, a slider over all of it, and the
// way back to the scene.
#pragma once

#include "app/runtime/replay_session.h"
#include "app/ui/ui_state.h"

namespace hapticwall::ui {

void draw_replay_bar(const PanelContext& context, runtime::ReplaySession& replay);

// Says how far a recording has been read that takes a while to open.
void draw_opening(const PanelContext& context);

// Goes there, and lets the plots follow.
void go_to(const PanelContext& context, runtime::ReplaySession& replay, double time_s);

// What the keys do while a recording is replayed; else nothing.
void slower(const PanelContext& context);
void faster(const PanelContext& context);
void toggle_loop(const PanelContext& context);
void step_back(const PanelContext& context);  // one tick, while paused
void previous_mark(const PanelContext& context);
void next_mark(const PanelContext& context);

// The next of the usual speeds below or above this one; the last one stays.
[[nodiscard]] double slower_than(double speed);
[[nodiscard]] double faster_than(double speed);

}  // namespace hapticwall::ui
