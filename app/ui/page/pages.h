// The windows that can be docked, one row each.
#pragma once

#include <imgui.h>

#include <span>

#include "app/draw/plot/sample_history.h"
#include "app/ui/state/dock_state.h"
#include "app/ui/state/panel_context.h"
#include "app/ui/wall/wall_renderer.h"

namespace hapticwall::ui {

class AllRuns;
struct MapState;
struct Studies;

// Parts that pages draw from.
struct PageParts {
  const PanelContext& context;
  const draw::SampleHistory& history;
  WallRenderer& renderer;
  // States of one page each.
  MapState& map;
  AllRuns& all_runs;
  Studies& studies;
};

struct Page {
  DockWindow window;
  void (*draw)(const PageParts& parts);  // only while it is seen: not behind another tab
  bool hidden_by_blind_test = false;     // it would reveal the order
  void (*notice)(const PageParts& parts, bool seen) = nullptr;  // called once a frame, seen or not
  ImGuiWindowFlags flags = 0;
  Needs needs = nullptr;
};
// All of them, whatever the machine has.
[[nodiscard]] std::span<const Page> pages();

// Pages, each in the source of its name.
void draw_controls_page(const PanelContext& context);              // the parameters
void draw_map_page(const PanelContext& context, MapState& state);  // stability over two numbers
void draw_all_page(const PanelContext& context, AllRuns& all);     // all algorithms, side by side
void draw_study_page(const PanelContext& context, Studies& studies);  // tables, on demand

}  // namespace hapticwall::ui
