// Everything that the panels remember from frame to frame, owned by the application.
#pragma once

#include <imgui.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/runtime/session.h"
#include "app/ui/compare_state.h"
#include "app/ui/plot.h"
#include "app/ui/plots_state.h"
#include "app/ui/replay_state.h"
#include "app/ui/scale_range.h"
#include "app/ui/theme.h"
#include "app/ui/timing_state.h"
#include "app/ui/toasts.h"
#include "app/ui/undo.h"
#include "app/ui/wall_state.h"
#include "core/scene.h"

namespace hapticwall::ui {

// Which plots are shown: all, or the panels (a), (b), (c) of the paper's figures.
enum class PlotArrangement : std::uint8_t { kAll, kFigure4, kFigure5And6 };

// What stands below the views.
enum class LowerPage : std::uint8_t { kPlots, kTiming, kBlindTest };

inline constexpr double kShortestTimeWindowS = 0.5;
inline constexpr double kLongestTimeWindowS = 10.0;

// What is worth keeping from one start of the program to the next.
struct PersistedState {
  double time_window_s = 6.0;
  PlotArrangement arrangement = PlotArrangement::kAll;
  LowerPage lower_page = LowerPage::kPlots;
  HiddenLines hidden_lines = 0;
  bool hand_stays_where_released = false;
  Look look = Look::kScreen;
  int scale_percent = 0;            // of everything; 0: as the screen says
  double panel_ems = 21.5;          // width of the control panel, in sizes of the text
  double view_share = 0.40;         // height of the views, of what is there
  double picture_share = 0.62;      // width of the wall's picture, of the views
  std::string recording_folder;     // empty: the current one
  std::vector<std::string> recent;  // scene files and recordings, the newest first
  int window_width = 0;             // in pixels at scale 1; 0: as fits the screen
  int window_height = 0;
  bool window_maximised = false;
};

// The one text field that is being edited; all others show what is in force.
struct TextEdit {
  ImGuiID field = 0;
  ImGuiID asked = 0;    // the field that shall have the keyboard next
  std::string tooltip;  // of the label that was just drawn, for its field
  std::array<char, 256> text{};
};

struct ItemRect {
  ImVec2 from;
  ImVec2 to;
  ImGuiID id = 0;  // 0: nothing that takes the pointer by itself

  [[nodiscard]] ImVec2 centre() const { return {0.5F * (from.x + to.x), 0.5F * (from.y + to.y)}; }
};

// A scene that needs a new session.
struct WantedScene {
  Scene scene;
  bool loaded = false;  // as it was written, not the running one with a change
  // Else the scene that its values can be reset to, where that is another one.
  std::shared_ptr<const Scene> back_to = nullptr;
  // What the slots of the comparison hold then; nothing: as they are, or as suits a loaded scene.
  std::optional<std::array<AlgorithmSettings, 2>> slots = std::nullopt;
};

// Why the last value that was typed into a field is not in force.
struct Refusal {
  std::string key;  // of the field
  std::string why;
};

// What lasts as long as the window.
struct TransientState {
  Toasts toasts;
  UndoHistory undo;
  bool help_shown = false;
  std::string settings_path;          // empty: they are not kept
  float screen_scale = 1.0F;          // what the screen asks for
  std::optional<float> forced_scale;  // of the command line, until the user chooses another
  TextEdit edit;
  std::optional<WantedScene> wanted_scene;  // to be started at rest after this frame
  std::string wanted_recording;             // to be opened after this frame; empty: none
  Scene loaded_scene;                       // to which changed values can be reset
  std::optional<Refusal> refusal;
  // What the parts that were switched off had, by key.
  std::map<std::string, double, std::less<>> switched_off;
  std::string recording_folder;  // of the command line; empty: the persisted one
  std::string recording_name;    // empty: named after scene and algorithm
  std::string mark_text;         // of the next mark
  std::size_t chosen_wall = 0;
  Axis shown_axis = Axis::kX;  // see shown_axis.h
  bool dragging_hand = false;
  std::optional<double> hand_m;  // where the pointer leads the hand
  bool follow = true;            // the plots follow the newest samples
  double time_from_s = 0.0;
  double time_to_s = 0.0;
  Trace scratch;
  std::map<std::string, ItemRect, std::less<>> items;  // where things were drawn in the last frame
};

struct UiState {
  PersistedState persisted;
  TransientState transient;
  PlotsState plots;
  WallState wall;
  ReplayState replay;
  CompareState compare;
  TimingState timing;
};

// What a panel is given.
struct PanelContext {
  runtime::Session& session;
  const runtime::Snapshot& snapshot;
  const Theme& theme;
  UiState& state;
};

inline void tell(UiState& state, MessageKind kind, std::string text) {
  state.transient.toasts.tell(kind, std::move(text));
}

// A problem that a session or the validation found, in one line.
inline void tell(UiState& state, const SceneProblem& problem) {
  tell(state, MessageKind::kProblem,
       problem.key.empty() ? problem.message : problem.key + ": " + problem.message);
}

// Notes where the last item was drawn.
inline void remember_item(UiState& state, std::string_view name) {
  const ItemRect rect{ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), ImGui::GetItemID()};
  state.transient.items.insert_or_assign(std::string(name), rect);
}

}  // namespace hapticwall::ui
