// The window as it opens: the same hand at the same wall under two algorithms, side by side. One of
// the two is the session; a click on the other one makes it the session.
#pragma once

#include <array>

#include "app/draw/plot/plot_trace.h"
#include "app/draw/wall/wall_picture.h"
#include "app/ui/computed/other_wall.h"
#include "app/ui/page/pages.h"
#include "app/ui/wall/wall_state.h"

namespace hapticwall::ui {

// The view of the first window.
struct FirstState {
  OtherWall other;  // the wall that is not the session
  draw::Swept other_swept;
  draw::ShownStiffness other_shown;      // the fading tint of its wall
  std::array<Magnified, 2> magnified{};  // of slots A and B
  draw::Trace trail;
  draw::PlotScratch scratch;
};

struct FirstParts {
  const PageParts& page;
  WallRenderer& other_renderer;
  FirstState& first;
};

// True for a session with another wall beside it, unless the user has asked for more, or a blind
// test or an experiment runs. A presentation shows it, too.
[[nodiscard]] bool shows_first_window(const PanelContext& context);

// Fills the current window from the cursor on.
void draw_first_window(const FirstParts& parts);

}  // namespace hapticwall::ui
