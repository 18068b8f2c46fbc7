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

// Until the end of the block all text has the size for which the window has room, whatever the
// scale: a window of 1000 x 680 pixels shows it at scale 1.
class LargeScope {
 public:
  LargeScope();
  LargeScope(const LargeScope&) = delete;
  LargeScope& operator=(const LargeScope&) = delete;
  ~LargeScope();

 private:
  float before_;
};

}  // namespace hapticwall::ui
