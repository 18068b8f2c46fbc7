// A key and its action, as a row of the table that handles keys and that the help shows.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/ui/state/capabilities.h"

namespace hapticwall::ui {

struct PanelContext;

enum class KeyGroup : std::uint8_t {
  kForce,
  kSession,
  kReplay,
  kAlgorithm,
  kParameters,
  kBlindTest,  // only during a blind test
  kPlots,
  kWindow
};

struct KeyBinding {
  KeyGroup group = KeyGroup::kWindow;
  std::string what;                   // purpose in a few words
  std::vector<ImGuiKeyChord> chords;  // any of these
  std::function<void(const PanelContext&)> act;
  std::vector<ImGuiKeyChord> more = {};  // alternative keys; the help omits them
  ImWchar character = 0;                 // alternative character, on any keyboard layout
  bool repeats = false;                  // while it is held down
  bool always = false;                   // true: active also while text is typed, with any modifier
  Needs needs = nullptr;
};

}  // namespace hapticwall::ui
