// What the window remembers of the recordings that it opens and replays.
#pragma once

#include <memory>
#include <string>

#include "app/runtime/replay_session.h"
#include "app/runtime/session.h"
#include "app/ui/background.h"
#include "app/ui/sample_history.h"

namespace hapticwall::ui {

// The recorded hand under another algorithm, and the same as the plots take it.
struct LaidOver {
  runtime::Overlay overlay;
  std::shared_ptr<const SampleHistory> history;
};

// Lasts as long as the window.
struct ReplayState {
  Background<std::unique_ptr<runtime::Session>> opening;
  std::string opening_path;
  double opening_s = 0.0;  // for how long
  Background<LaidOver> rerun;
  std::string rerun_algorithm;
  bool wants_back = false;  // to the scene that ran before, after this frame
};

// The session where it is a replay, or null.
[[nodiscard]] inline runtime::ReplaySession* replay_of(runtime::Session& session) {
  return dynamic_cast<runtime::ReplaySession*>(&session);
}

// Whether its samples have what nobody but a simulator knows.
[[nodiscard]] inline bool knows_truth(runtime::Session& session) {
  const runtime::ReplaySession* replay = replay_of(session);
  return replay != nullptr ? replay->recording().of_simulator()
                           : session.device_info().is_simulated;
}

}  // namespace hapticwall::ui
