// The arguments of every panel.
#pragma once

#include "app/draw/plot/theme.h"
#include "app/draw/verdict/tail.h"
#include "app/session/live_session.h"
#include "app/session/replay_session.h"
#include "app/ui/state/capabilities.h"
#include "app/ui/state/messages.h"
#include "app/ui/wall/wall_measures.h"
#include "core/scene.h"

namespace hapticwall::ui {

struct Appearance;
struct CompareState;
struct DockState;
struct FrameInput;
struct HandState;
struct IdentifyState;
struct PlotsState;
struct RecordingWishes;
struct ReplayState;
struct SceneState;
struct Selection;
struct SoundChoice;
struct TextEdit;
struct TimeView;
struct TimingState;
struct TourState;
struct WallState;
struct WindowState;

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

// The arguments of every panel: the session, and the states that several panels share. A source
// includes the header of each state that it uses, and of no other.
struct PanelContext {
  session::SampleSource& session;  // shows.live or shows.replay
  const session::Snapshot& snapshot;
  const draw::Theme& theme;
  Visibility shows;
  const Capabilities& can;
  Toasts& toasts;
  FrameInput& input;
  TextEdit& edit;
  Appearance& appearance;
  WindowState& window;
  DockState& dock;
  SceneState& scene;
  Selection& selection;
  TimeView& time;
  RecordingWishes& recording;
  HandState& hand;
  SoundChoice& sound;
  TourState& tour;
  WallState& wall;
  PlotsState& plots;
  CompareState& compare;
  TimingState& timing;
  const draw::Tails& tails;
  ReplayState& replay;
  IdentifyState& identify;
};

}  // namespace hapticwall::ui
