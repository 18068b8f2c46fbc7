// The states of all pages, panels and views, owned by the application.
#pragma once

#include "app/draw/verdict/tail.h"
#include "app/ui/computed/all_runs.h"
#include "app/ui/computed/study_state.h"
#include "app/ui/first/first_window.h"
#include "app/ui/page/map_state.h"
#include "app/ui/panel/hand_state.h"
#include "app/ui/panel/identify_state.h"
#include "app/ui/panel/replay_state.h"
#include "app/ui/panel/sound_switch.h"
#include "app/ui/state/appearance.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/state/dock_state.h"
#include "app/ui/state/frame_input.h"
#include "app/ui/state/messages.h"
#include "app/ui/state/panel_context.h"
#include "app/ui/state/plots_state.h"
#include "app/ui/state/recording_wishes.h"
#include "app/ui/state/scene_state.h"
#include "app/ui/state/text_edit.h"
#include "app/ui/state/time_view.h"
#include "app/ui/state/timing_state.h"
#include "app/ui/state/tour.h"
#include "app/ui/state/window_state.h"
#include "app/ui/wall/wall_state.h"
#include "app/ui/widget/shown_axis.h"

namespace hapticwall::ui {

struct UiState {
  Capabilities can;
  Toasts toasts;
  FrameInput input;
  TextEdit edit;
  Appearance appearance;
  WindowState window;
  DockState dock;
  SceneState scene;
  Selection selection;
  TimeView time;
  RecordingWishes recording;
  HandState hand;
  SoundChoice sound;
  TourState tour;
  WallState wall;
  PlotsState plots;
  CompareState compare;
  TimingState timing;
  draw::Tails tails;
  ReplayState replay;
  IdentifyState identify;
  MapState map;
  AllRuns all_runs;
  Studies studies;
  FirstState first;
};

[[nodiscard]] inline PanelContext context_of(UiState& state, session::SampleSource& session,
                                             const session::Snapshot& snapshot,
                                             const draw::Theme& theme, const Visibility& shows) {
  return {.session = session,
          .snapshot = snapshot,
          .theme = theme,
          .shows = shows,
          .can = state.can,
          .toasts = state.toasts,
          .input = state.input,
          .edit = state.edit,
          .appearance = state.appearance,
          .window = state.window,
          .dock = state.dock,
          .scene = state.scene,
          .selection = state.selection,
          .time = state.time,
          .recording = state.recording,
          .hand = state.hand,
          .sound = state.sound,
          .tour = state.tour,
          .wall = state.wall,
          .plots = state.plots,
          .compare = state.compare,
          .timing = state.timing,
          .tails = state.tails,
          .replay = state.replay,
          .identify = state.identify};
}

}  // namespace hapticwall::ui
