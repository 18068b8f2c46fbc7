// A presentation for a room: the first window alone, and large.
#pragma once

#include <optional>
#include <string>

#include "app/draw/plot/theme.h"
#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

// The reason why this session has no two walls side by side, or nullopt.
[[nodiscard]] std::optional<std::string> why_no_two_walls(const PanelContext& context);

// Begins or ends the presentation. A message says why there is none.
void toggle_presentation(const PanelContext& context);
// Ends it when the session has no two walls any more.
void keep_presentation(const PanelContext& context);

// The scale at which the whole window is full of large text: 1 in a window of 1000 x 680 pixels.
[[nodiscard]] float presented_scale();
// The scale in force, or a smaller one at which the first window has room for its parts.
[[nodiscard]] float fitting_scale();

// All text has this scale until the end of the block.
class ScaleScope {
 public:
  explicit ScaleScope(float scale);
  ScaleScope(const ScaleScope&) = delete;
  ScaleScope& operator=(const ScaleScope&) = delete;
  ~ScaleScope();

 private:
  float before_;
};

}  // namespace hapticwall::ui
