// What every key does, in one table: the keys are handled from it, and the help shows it.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hapticwall::ui {

struct PanelContext;
struct UiState;

enum class KeyGroup : std::uint8_t {
  kForce,
  kSession,
  kReplay,
  kAlgorithm,
  kParameters,
  kBlindTest,  // only while one runs
  kPlots,
  kWindow
};

struct KeyBinding {
  KeyGroup group = KeyGroup::kWindow;
  std::string what;                   // for people, a few words
  std::vector<ImGuiKeyChord> chords;  // any of them
  std::function<void(const PanelContext&)> act;
  std::vector<ImGuiKeyChord> more = {};  // also these, which the help does not name
  ImWchar character = 0;                 // also this, wherever the keyboard has it
  bool repeats = false;                  // while it is held down
  bool always = false;                   // also while a text is typed, whatever else is held down
};

// The first is what takes the force away.
[[nodiscard]] const std::vector<KeyBinding>& key_bindings();

// Those while a blind test runs: without whatever could give its order away, with its own.
[[nodiscard]] const std::vector<KeyBinding>& blind_key_bindings();
[[nodiscard]] const std::vector<KeyBinding>& bindings_in_force(const UiState& state);

// Does what the keys that were pressed in this frame stand for.
void handle_keys(const PanelContext& context, std::span<const KeyBinding> bindings);

// "Ctrl+Shift+Z or Ctrl+Y".
[[nodiscard]] std::string keys_text(const KeyBinding& binding);
[[nodiscard]] const char* group_title(KeyGroup group);

}  // namespace hapticwall::ui
