#include "app/ui/window/keys.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <initializer_list>

#include "app/ui/first/presentation.h"
#include "app/ui/page/plot_controls.h"
#include "app/ui/panel/arming_strip.h"
#include "app/ui/panel/hand_drag.h"
#include "app/ui/panel/layout_choice.h"
#include "app/ui/panel/replay_bar.h"
#include "app/ui/panel/sections.h"
#include "app/ui/panel/toolbar.h"
#include "app/ui/state/appearance.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/comparing.h"
#include "app/ui/state/frame_input.h"
#include "app/ui/state/panel_context.h"
#include "app/ui/state/text_edit.h"
#include "app/ui/window/help_overlay.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::ui {
namespace {

constexpr std::size_t kDigitKeys = 9;

ImGuiKeyChord ctrl(ImGuiKeyChord key) { return ImGuiMod_Ctrl | key; }

KeyBinding repeating(KeyBinding binding) {
  binding.repeats = true;
  return binding;
}

std::vector<KeyBinding> needing(Needs needs, std::vector<KeyBinding> bindings) {
  for (KeyBinding& binding : bindings) binding.needs = needs;
  return bindings;
}

std::vector<KeyBinding> force_keys() {
  return needing(
      &Capabilities::devices,
      {{KeyGroup::kForce, "force off, at once", {ImGuiKey_Space}, disarm, {}, 0, false, true},
       {KeyGroup::kForce, "arm a real device: the force rises", {ImGuiKey_A}, ask_to_arm}});
}

std::vector<KeyBinding> session_keys() {
  return {{KeyGroup::kSession, "pause, or run on", {ImGuiKey_P}, toggle_pause},
          repeating({KeyGroup::kSession,
                     "one tick, while paused",
                     {ImGuiKey_S, ImGuiKey_RightArrow},
                     single_step}),
          {KeyGroup::kSession, "slower: slow motion", {ImGuiKey_LeftBracket}, slower, {}, U'['},
          {KeyGroup::kSession, "faster", {ImGuiKey_RightBracket}, faster, {}, U']'},
          {KeyGroup::kSession, "reset: back to tick 0, at rest", {ImGuiKey_R}, ask_to_reset},
          {KeyGroup::kSession, "withdraw the hand from the wall", {ImGuiKey_H}, withdraw_hand}};
}

std::vector<KeyBinding> recording_keys() {
  return needing(
      &Capabilities::files,
      {{KeyGroup::kSession, "record, or stop recording", {ctrl(ImGuiKey_R)}, toggle_recording},
       {KeyGroup::kSession,
        "mark this moment of the recording, then name it",
        {ImGuiKey_M},
        mark_and_name}});
}

// Keys in addition to the session keys, which also apply.
std::vector<KeyBinding> replay_keys() {
  return needing(
      &Capabilities::files,
      {repeating(
           {KeyGroup::kReplay, "one tick back, while paused", {ImGuiKey_LeftArrow}, step_back}),
       {KeyGroup::kReplay, "begin anew at the end, or not", {ImGuiKey_L}, toggle_loop},
       {KeyGroup::kReplay, "to the mark before", {ImGuiKey_PageUp}, previous_mark},
       {KeyGroup::kReplay, "to the next mark", {ImGuiKey_PageDown}, next_mark}});
}

std::vector<KeyBinding> algorithm_keys() {
  std::vector<KeyBinding> keys;
  for (std::size_t i = 0; i < std::min(kDigitKeys, algorithms().size()); ++i) {
    const int offset = static_cast<int>(i);
    keys.push_back({KeyGroup::kAlgorithm,
                    std::string(algorithms()[i].name),
                    {ImGuiKey_1 + offset},
                    [i](const PanelContext& context) { choose_algorithm(context, i); },
                    {ImGuiKey_Keypad1 + offset}});
  }
  keys.push_back({KeyGroup::kAlgorithm,
                  "slot A or B of Compare; in a field: the next field",
                  {ImGuiKey_Tab},
                  toggle_slot});
  return keys;
}

std::vector<KeyBinding> parameter_keys() {
  return {{KeyGroup::kParameters, "undo the last change", {ctrl(ImGuiKey_Z)}, undo_change},
          {KeyGroup::kParameters,
           "redo it",
           {ctrl(ImGuiMod_Shift | ImGuiKey_Z), ctrl(ImGuiKey_Y)},
           redo_change}};
}

void larger(const PanelContext& context) { step_scale(context.appearance, 1); }
void smaller(const PanelContext& context) { step_scale(context.appearance, -1); }
void as_the_screen(const PanelContext& context) { set_scale(context.appearance, 0); }

void next_layout(const PanelContext& context) {
  if (!context.shows.hides_algorithm) choose_next_layout(context);
}

std::vector<KeyBinding> window_keys() {
  return {{KeyGroup::kWindow, "this help", {ImGuiKey_F1}, toggle_help, {}, U'?'},
          {KeyGroup::kWindow, "dark or light", {ImGuiKey_F2}, toggle_look},
          {KeyGroup::kWindow, "next layout of the windows", {ImGuiKey_F3}, next_layout},
          {KeyGroup::kWindow, "state of the loop", {ImGuiKey_F4}, toggle_status},
          {KeyGroup::kWindow,
           "close a list, help, presentation, or the newest message",
           {ImGuiKey_Escape},
           put_away}};
}

// A browser takes these itself.
std::vector<KeyBinding> desktop_keys() {
  return needing(
      &Capabilities::all_keys,
      {{KeyGroup::kWindow, "present to a room, or not", {ImGuiKey_F5}, toggle_presentation},
       repeating({KeyGroup::kWindow,
                  "everything larger",
                  {ctrl(ImGuiKey_Equal)},
                  larger,
                  {ctrl(ImGuiKey_KeypadAdd), ctrl(ImGuiMod_Shift | ImGuiKey_Equal)}}),
       repeating({KeyGroup::kWindow,
                  "everything smaller",
                  {ctrl(ImGuiKey_Minus)},
                  smaller,
                  {ctrl(ImGuiKey_KeypadSubtract)}}),
       {KeyGroup::kWindow,
        "scale of the screen",
        {ctrl(ImGuiKey_0)},
        as_the_screen,
        {ctrl(ImGuiKey_Keypad0)}}});
}

// The right arrow is used for the second wall.
std::vector<KeyBinding> blind_session_keys() {
  std::vector<KeyBinding> keys = session_keys();
  for (KeyBinding& binding : keys) std::erase(binding.chords, ImGuiKey_RightArrow);
  return keys;
}

std::vector<KeyBinding> joined(std::initializer_list<std::vector<KeyBinding>> parts) {
  std::vector<KeyBinding> all;
  for (const std::vector<KeyBinding>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// The modifiers of the press of this frame; at the end of the frame Ctrl may be up again.
ImGuiKeyChord modifiers_of(const FrameInput& input, ImGuiKey key) {
  for (const ImGuiInputEvent& event : ImGui::GetCurrentContext()->InputEventsTrail) {
    if (event.Type != ImGuiInputEventType_Key || event.Key.Key != key || !event.Key.Down) continue;
    const auto found = std::ranges::find(input.key_presses, event.EventId, &KeyPress::event);
    if (found != input.key_presses.end()) return found->mods;
  }
  return ImGui::GetIO().KeyMods;
}

// Shift counts only together with Ctrl; letters ignore it.
bool modifiers_fit(ImGuiKeyChord held, ImGuiKeyChord chord) {
  constexpr ImGuiKeyChord kStrong = ImGuiMod_Ctrl | ImGuiMod_Alt | ImGuiMod_Super;
  const ImGuiKeyChord wanted = chord & ImGuiMod_Mask_;
  if ((held & kStrong) != (wanted & kStrong)) return false;
  return wanted == 0 || (held & ImGuiMod_Shift) == (wanted & ImGuiMod_Shift);
}

bool typed(ImWchar character) {
  const ImVector<ImWchar>& queue = ImGui::GetIO().InputQueueCharacters;
  return character != 0 && std::find(queue.begin(), queue.end(), character) != queue.end();
}

bool is_arrow(ImGuiKey key) { return key == ImGuiKey_LeftArrow || key == ImGuiKey_RightArrow; }

// Keys that are commands do not navigate: Space takes the force away and presses nothing. The
// arrows navigate as soon as the cursor of the keyboard is seen, which ↑, ↓ and Alt begin.
void keep_from_navigation() {
  const ImGuiID owner = ImHashStr("keys of the window");
  for (const ImGuiKey key :
       {ImGuiKey_Tab, ImGuiKey_Space, ImGuiKey_PageUp, ImGuiKey_PageDown, ImGuiKey_Escape})
    ImGui::SetKeyOwner(key, owner);
  if (ImGui::GetIO().NavVisible) return;
  for (const ImGuiKey key : {ImGuiKey_LeftArrow, ImGuiKey_RightArrow})
    ImGui::SetKeyOwner(key, owner);
}

bool pressed(const FrameInput& input, const KeyBinding& binding) {
  const auto chord_pressed = [&](ImGuiKeyChord chord) {
    const auto key = static_cast<ImGuiKey>(chord & ~ImGuiMod_Mask_);
    if (is_arrow(key) && ImGui::GetIO().NavVisible) return false;
    return ImGui::IsKeyPressed(key, binding.repeats) &&
           (binding.always || modifiers_fit(modifiers_of(input, key), chord));
  };
  return std::any_of(binding.chords.begin(), binding.chords.end(), chord_pressed) ||
         std::any_of(binding.more.begin(), binding.more.end(), chord_pressed) ||
         typed(binding.character);
}

std::string chord_text(ImGuiKeyChord chord) {
  std::string text;
  if ((chord & ImGuiMod_Ctrl) != 0) text += "Ctrl+";
  if ((chord & ImGuiMod_Shift) != 0) text += "Shift+";
  const auto key = static_cast<ImGuiKey>(chord & ~ImGuiMod_Mask_);
  switch (key) {
    case ImGuiKey_LeftArrow:
      return text + "←";
    case ImGuiKey_RightArrow:
      return text + "→";
    case ImGuiKey_UpArrow:
      return text + "↑";
    case ImGuiKey_DownArrow:
      return text + "↓";
    case ImGuiKey_Escape:
      return text + "Esc";
    case ImGuiKey_Equal:
      return "Ctrl and +";
    case ImGuiKey_Minus:
      return "Ctrl and −";
    case ImGuiKey_LeftBracket:
      return "[";
    case ImGuiKey_RightBracket:
      return "]";
    default:
      return text + ImGui::GetKeyName(key);
  }
}

}  // namespace

const std::vector<KeyBinding>& key_bindings() {
  static const std::vector<KeyBinding> kBindings =
      joined({force_keys(), session_keys(), recording_keys(), replay_keys(), algorithm_keys(),
              parameter_keys(), plot_keys(), window_keys(), desktop_keys()});
  return kBindings;
}

const std::vector<KeyBinding>& bindings_in_force(const Visibility& shows) {
  static const std::vector<KeyBinding> kBlindBindings =
      joined({force_keys(), blind_session_keys(), recording_keys(), blind_test_keys(),
              window_keys(), desktop_keys()});
  return shows.hides_algorithm ? kBlindBindings : key_bindings();
}

void handle_keys(const PanelContext& context, std::span<const KeyBinding> bindings) {
  bool typing = ImGui::GetIO().WantTextInput || ImGui::GetFrameCount() <= context.edit.typing_until;
  if (!typing) keep_from_navigation();
  for (const KeyBinding& binding : bindings) {
    if (!has(context.can, binding.needs) || (typing && !binding.always) ||
        !pressed(context.input, binding))
      continue;
    binding.act(context);
    typing = typing || ImGui::GetFrameCount() <= context.edit.typing_until;
  }
}

std::string keys_text(const KeyBinding& binding) {
  std::string text;
  for (const ImGuiKeyChord chord : binding.chords) {
    if (!text.empty()) text += " or ";
    text += chord_text(chord);
  }
  const std::string character(binding.character != 0 ? 1 : 0, static_cast<char>(binding.character));
  if (!character.empty() && text != character) text += " or " + character;
  return text;
}

const char* group_title(KeyGroup group) {
  constexpr std::array kTitles{"Force",      "Session",    "Replay", "Algorithm",
                               "Parameters", "Blind test", "Plots",  "Window"};
  return kTitles.at(static_cast<std::size_t>(group));
}

}  // namespace hapticwall::ui
