// State of the panels between frames, owned by the application.
#pragma once

#include <imgui.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/draw/figure/identify_figure.h"
#include "app/draw/plot/extra_traces.h"
#include "app/draw/plot/phase_plot.h"
#include "app/draw/plot/plot.h"
#include "app/draw/plot/plot_cursors.h"
#include "app/draw/plot/plot_trigger.h"
#include "app/draw/plot/sample_history.h"
#include "app/draw/plot/spectrum_plot.h"
#include "app/draw/plot/theme.h"
#include "app/session/identify_experiment.h"
#include "app/session/live_session.h"
#include "app/session/replay_session.h"
#include "app/session/window_options.h"
#include "app/sound/live/sound_status.h"
#include "app/table/identify_report.h"
#include "app/ui/computed/all_runs.h"
#include "app/ui/computed/background.h"
#include "app/ui/computed/live_map.h"
#include "app/ui/computed/map_choice.h"
#include "app/ui/computed/study_state.h"
#include "app/ui/computed/tail.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/state/dock_layout.h"
#include "app/ui/state/export.h"
#include "app/ui/state/hand_lead.h"
#include "app/ui/state/messages.h"
#include "app/ui/state/timing_state.h"
#include "app/ui/state/undo.h"
#include "app/ui/wall/wall_camera.h"
#include "app/ui/wall/wall_picture.h"
#include "app/ui/wall/wall_resolution.h"
#include "core/scene.h"

namespace hapticwall::ui {

// Action of the mouse button that is held in the wall view.
enum class ViewDrag : std::uint8_t { kNone, kLeadHand, kTurn, kShift };

// Magnifications of the contact, relative to the wall view as it first shows a scene.
inline constexpr std::array kMagnifications{1, 2, 5, 10, 20, 50, 100, 200, 500, 1000};

// View of the magnifier, m.
struct Magnified {
  double face_m = 0.0;    // face of the magnified wall
  double middle_m = 0.0;  // centre of the view
};

struct WallState {
  // Stored in the settings file.
  struct Persisted {
    WallOrbit orbit;
    int magnification = 0;  // 1 to 1000; 0: automatic
  };
  struct Transient {
    ViewDrag drag = ViewDrag::kNone;
    std::array<ShownStiffness, kAxisCount> shown{};  // the fading tint of the walls
    std::array<Swept, kAxisCount> swept{};
    WallResolution resolution;
    bool view_refined = true;  // false: the picture still improves in the next frames
    int magnification = 0;     // in force; 0: none yet
    ImVec2 view_size;          // of the newest view, px
    Magnified magnified;
    draw::Trace trail;  // recent motion of the handle
  };

  Persisted persisted;
  Transient transient;
};

// Lengths of the time window, in s.
inline constexpr std::array kTimeWindowsS{0.05, 0.1, 0.2,  0.5,  1.0,   2.0,   4.0,
                                          6.0,  8.0, 10.0, 60.0, 600.0, 3600.0};

struct PlotsState {
  // Stored in the settings file.
  struct Persisted {
    draw::ChosenLines lines = draw::usual_lines();
    draw::TriggerSettings trigger;
    draw::PhaseSettings phase;
    draw::SpectrumSettings spectrum;
    bool show_bounds = true;
  } persisted;

  // Lives as long as the window.
  struct Transient {
    draw::AllPlotAxes axes;
    draw::Trigger trigger;
    bool was_following = true;
    draw::Cursors cursors;
    draw::PhaseView phase;
    draw::SpectrumView spectrum;
    draw::PlotScratch scratch;
    std::vector<draw::ExtraTrace> extra_traces;  // see replace_extra_traces()
    ExportJob exporting;
  } transient;
};

// The re-run of a recorded hand, and the same samples for the plots.
struct LaidOver {
  session::Overlay overlay;
  std::shared_ptr<const draw::SampleHistory> history;
};

// Lives as long as the window.
struct ReplayState {
  Background<std::unique_ptr<session::ReplaySession>> opening;
  std::string opening_path;
  double opening_s = 0.0;  // duration so far
  Background<LaidOver> rerun;
  std::string rerun_algorithm;
  bool wants_back = false;  // go back to the previous scene after this frame
};

// Plots that are shown: two, all, or the panels (a), (b), (c) of the paper's figures.
enum class PlotArrangement : std::uint8_t { kTwo, kAll, kFigure4, kFigure5And6 };

// An arrangement of windows that the user has named.
struct OwnLayout {
  std::string name;
  DockLayout layout;

  [[nodiscard]] bool operator==(const OwnLayout&) const = default;
};

inline constexpr double kMaxWithdrawMmPerS = 1000.0;

// Stored in the settings file.
struct PersistedState {
  bool more = false;  // false: scene, algorithms, wall and plots alone
  bool tour_offered = true;
  double time_window_s = 6.0;
  PlotArrangement arrangement = PlotArrangement::kTwo;
  std::string layout = "bench";
  std::string docked;  // layout_text() of the windows as they are; empty: as the layout has them
  std::vector<OwnLayout> own_layouts;
  draw::HiddenLines hidden_lines = 0;
  double withdraw_mm_per_s = 100.0;  // speed of the hand, see withdraw_hand()
  draw::Look look = draw::Look::kScreen;
  int scale_percent = 0;            // 0: follow the screen
  std::string recording_folder;     // empty: the current one
  bool records_signals = false;     // signals of algorithms
  std::vector<std::string> recent;  // scene files and recordings, the newest first
  int window_width = 0;             // in pixels at scale 1; 0: as fits the screen
  int window_height = 0;
  bool window_maximised = false;
  double sound_volume = 0.5;  // 0 to 1
};

// The text field in edit; all others show the present values.
struct TextEdit {
  ImGuiID field = 0;
  ImGuiID asked = 0;     // the field that gets the keyboard next
  int typing_until = 0;  // a field has been promised the keyboard: letters are no keys until then
  std::string tooltip;   // tooltip of the preceding label, for its field
  std::array<char, 256> text{};
};

// The pointer's place at a time, on the clock of the window.
struct PointerEvent {
  double time_s = 0.0;
  ImVec2 at;
};

// The pointer drags the hand. Places are pixels.
struct HandDrag {
  HandLead lead;
  glm::vec2 hand_at{};  // start of the drag, in the view
  ImVec2 grabbed_at;    // pointer at the start of the drag, on the screen
  ImVec2 pointer;       // the newest place that `lead` knows
};

// A question in a popup.
enum class Question : std::uint8_t { kNone, kAsked, kShown };

// The modifiers of a key press, from the window system.
struct KeyPress {
  ImU32 event = 0;  // ImGuiInputEvent::EventId
  ImGuiKeyChord mods = 0;
};

// A scene that needs a new session.
struct WantedScene {
  Scene scene;
  bool loaded = false;  // loaded from a file, not a change of the running scene
  // Otherwise the scene to which values can be reset, if it is another one.
  std::shared_ptr<const Scene> back_to = nullptr;
  // Slots of the comparison; nullopt: unchanged, or chosen for a loaded scene.
  std::optional<std::array<AlgorithmSettings, 2>> slots = std::nullopt;
};

// Why the last typed value was refused.
struct Refusal {
  std::string key;  // of the field
  std::string why;
};

// A window that can be docked.
struct DockWindow {
  const char* name;
  const char* meaning;
};

enum class DockSituation : std::uint8_t { kNone, kFirstMinute, kBlindTest, kChosen };

// Lives as long as the window.
struct DockState {
  std::vector<DockWindow> windows;   // all of them, for the choice
  std::optional<DockLayout> chosen;  // as the user has arranged it; nullopt at the start
  DockLayout shown;                  // `chosen`, or that of the first minute or of a blind test
  DockLayout measured;               // as read after the sizes of `shown` were set
  DockSituation situation = DockSituation::kNone;
  bool rebuild = true;
  int settling = 0;  // frames until all sizes are known
  ImVec2 size;       // px
  float scale = 0.0F;
};

// Lives as long as the window.
struct TransientState {
  DockState dock;
  Toasts toasts;
  UndoHistory undo;
  bool help_shown = false;
  std::string settings_path;          // empty: settings are not stored
  float screen_scale = 1.0F;          // scale of the screen
  std::optional<float> forced_scale;  // from the command line, until the user chooses another
  TextEdit edit;
  std::optional<WantedScene> wanted_scene;  // starts at rest after this frame
  std::string wanted_recording;             // opens after this frame; empty: none
  Scene loaded_scene;                       // source for resetting changed values
  std::optional<Refusal> refusal;
  // Values of the parts that are switched off, by key.
  std::map<std::string, double, std::less<>> switched_off;
  std::string recording_folder;               // from the command line; empty: the persisted one
  bool records_signals = false;               // from the command line, or the persisted one
  std::string recording_name;                 // empty: named after scene and algorithm
  std::string mark_text;                      // of the next mark
  bool focus_mark = false;                    // the mark's field gets the keyboard
  bool names_mark = false;                    // the mark's field names the newest mark
  Question reset_question = Question::kNone;  // "a recording runs: reset?"
  std::vector<KeyPress> key_presses;          // in the queue of Dear ImGui
  std::size_t chosen_wall = 0;
  Axis shown_axis = Axis::kX;  // see shown_axis.h
  std::size_t tour_step = 0;   // from 1; 0: no tour
  bool tour_step_done = false;
  bool repeats = false;                      // the scene begins anew, at rest, at its end
  double now_s = 0.0;                        // at the start of the frame
  std::vector<PointerEvent> pointer_events;  // since the frame before
  HandDrag hand_drag;
  bool hand_led = false;  // by the pointer or a key, since the last reset
  bool sound_on = false;
  sound::SoundStatus sound;
  bool follow = true;                 // the plots follow the newest samples
  std::optional<double> looked_at_s;  // the moment that the views show; empty: the newest
  double time_from_s = 0.0;
  double time_to_s = 0.0;
  draw::Trace scratch;
};

// Lives as long as the window.
struct MapState {
  MapChoice choice;
  LiveMap live;
};

struct Identified {
  table::IdentifiedBy by;
  identify::Identification found;
  file::DeviceDescription device;  // with the numbers, if the model fits
  std::vector<draw::FigurePanel> panels;
};

// `hapticwall identify` in the window. Lives as long as the window.
struct IdentifyState {
  session::IdentifyChoice choice;
  std::string device = "sim";                               // as in session::WindowOptions
  std::optional<file::DeviceDescription> description{};     // see WindowOptions::description
  bool wanted = false;                                      // its session begins after this frame
  std::shared_ptr<session::IdentifyExperiment> experiment;  // of the session; null: none
  Background<Identified> fit;
  std::optional<Identified> result;
  std::string problem;  // why there is no result
  std::string name;     // of the device file; empty: that of the device
};

struct UiState {
  PersistedState persisted;
  TransientState transient;
  PlotsState plots;
  WallState wall;
  ReplayState replay;
  CompareState compare;
  TimingState timing;
  MapState map;
  AllRuns all_runs;
  Studies studies;
  IdentifyState identify;
  Tails tails;
};

}  // namespace hapticwall::ui
