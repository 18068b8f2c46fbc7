// State of the simulated hand that the user leads.
#pragma once

#include <imgui.h>

#include <glm/vec2.hpp>

#include "app/ui/state/hand_lead.h"

namespace hapticwall::ui {

inline constexpr double kMaxWithdrawMmPerS = 1000.0;

// The pointer drags the hand. Places are pixels.
struct HandDrag {
  HandLead lead;
  glm::vec2 hand_at{};  // start of the drag, in the view
  ImVec2 grabbed_at;    // pointer at the start of the drag, on the screen
  ImVec2 pointer;       // the newest place that `lead` knows
};

struct HandState {
  double withdraw_mm_per_s = 100.0;  // speed of withdraw_hand(); stored in the settings file
  HandDrag drag;
  bool led = false;  // by the pointer or a key, since the last reset
};

}  // namespace hapticwall::ui
