// Events of the pointer and of the keys since the frame before.
#pragma once

#include <imgui.h>

#include <vector>

namespace hapticwall::ui {

// The pointer's place at a time, on the clock of the window.
struct PointerEvent {
  double time_s = 0.0;
  ImVec2 at;
};

// The modifiers of a key press, from the window system.
struct KeyPress {
  ImU32 event = 0;  // ImGuiInputEvent::EventId
  ImGuiKeyChord mods = 0;
};

struct FrameInput {
  double now_s = 0.0;  // at the start of the frame
  std::vector<PointerEvent> pointer_events;
  std::vector<KeyPress> key_presses;  // in the queue of Dear ImGui
};

}  // namespace hapticwall::ui
