// Everything that the panels remember from frame to frame, owned by the application.
#pragma once

#include <imgui.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "app/runtime/session.h"
#include "app/ui/plot.h"
#include "app/ui/theme.h"
#include "core/scene.h"

namespace hapticwall::ui {

// Which plots are shown: all, or the panels (a), (b), (c) of the paper's figures.
enum class PlotArrangement : std::uint8_t { kAll, kFigure4, kFigure5And6 };

inline constexpr double kShortestTimeWindowS = 0.5;
inline constexpr double kLongestTimeWindowS = 10.0;

// What is worth keeping from one start of the program to the next.
struct PersistedState {
  double time_window_s = 6.0;
  PlotArrangement arrangement = PlotArrangement::kAll;
  HiddenLines hidden_lines = 0;
  bool hand_stays_where_released = false;
};

enum class MessageKind : std::uint8_t { kNone, kNote, kProblem };

struct Message {
  MessageKind kind = MessageKind::kNone;
  std::string text;
};

// The one text field that is being edited; all others show what is in force.
struct TextEdit {
  ImGuiID field = 0;
  std::array<char, 256> text{};
};

struct ItemRect {
  ImVec2 from;
  ImVec2 to;

  [[nodiscard]] ImVec2 centre() const { return {0.5F * (from.x + to.x), 0.5F * (from.y + to.y)}; }
};

// A scene that needs a new session.
struct WantedScene {
  Scene scene;
  bool loaded = false;  // as it was written, not the running one with a change
};

// Why the last value that was typed into a field is not in force.
struct Refusal {
  std::string key;  // of the field
  std::string why;
};

// What lasts as long as the window.
struct TransientState {
  Message message;
  TextEdit edit;
  std::optional<WantedScene> wanted_scene;  // to be started at rest after this frame
  Scene loaded_scene;                       // to which changed values can be reset
  std::optional<Refusal> refusal;
  // What the parts that were switched off had, by key.
  std::map<std::string, double, std::less<>> switched_off;
  std::string recording_folder;
  std::string recording_name;  // empty: named after scene and algorithm
  std::size_t chosen_wall = 0;
  bool dragging_hand = false;
  std::optional<double> hand_m;  // where the pointer leads the hand
  double magnifier_span_m = 2e-3;
  bool follow = true;  // the plots follow the newest samples
  double time_from_s = 0.0;
  double time_to_s = 0.0;
  Trace scratch;
  std::map<std::string, ItemRect, std::less<>> items;  // where things were drawn in the last frame
};

struct UiState {
  PersistedState persisted;
  TransientState transient;
};

// What a panel is given.
struct PanelContext {
  runtime::Session& session;
  const runtime::Snapshot& snapshot;
  const Theme& theme;
  UiState& state;
};

inline void tell(UiState& state, MessageKind kind, std::string text) {
  state.transient.message = {kind, std::move(text)};
}

// A problem that a session or the validation found, in one line.
inline void tell(UiState& state, const SceneProblem& problem) {
  tell(state, MessageKind::kProblem,
       problem.key.empty() ? problem.message : problem.key + ": " + problem.message);
}

// Notes where the last item was drawn.
inline void remember_item(UiState& state, std::string_view name) {
  const ItemRect rect{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
  state.transient.items.insert_or_assign(std::string(name), rect);
}

}  // namespace hapticwall::ui
