// State of the text fields.
#pragma once

#include <imgui.h>

#include <array>
#include <optional>
#include <string>

namespace hapticwall::ui {

// Why the last typed value was refused.
struct Refusal {
  std::string key;  // of the field
  std::string why;
};

// The text field in edit; all others show the present values.
struct TextEdit {
  ImGuiID field = 0;
  ImGuiID asked = 0;     // the field that gets the keyboard next
  int typing_until = 0;  // a field has been promised the keyboard: letters are no keys until then
  std::string tooltip;   // tooltip of the preceding label, for its field
  std::array<char, 256> text{};
  std::optional<Refusal> refusal;
};

// Call it when a field is to get the keyboard, which takes Dear ImGui two frames.
inline void promise_keyboard(TextEdit& edit) { edit.typing_until = ImGui::GetFrameCount() + 3; }

}  // namespace hapticwall::ui
