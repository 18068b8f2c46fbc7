// State of a recording that opens or is shown.
#pragma once

#include <memory>
#include <string>

#include "app/draw/plot/sample_history.h"
#include "app/session/replay_session.h"
#include "app/ui/computed/background.h"

namespace hapticwall::ui {

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

}  // namespace hapticwall::ui
