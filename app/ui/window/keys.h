// The table of keys, used for input and for the help.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/ui/state/key_binding.h"

namespace hapticwall::ui {

struct Visibility;

// The first binding removes the force.
[[nodiscard]] const std::vector<KeyBinding>& key_bindings();

// key_bindings(); during a blind test only those that do not reveal the order.
[[nodiscard]] const std::vector<KeyBinding>& bindings_in_force(const Visibility& shows);

// Runs the bindings of the keys pressed in this frame.
void handle_keys(const PanelContext& context, std::span<const KeyBinding> bindings);

// "Ctrl+Shift+Z or Ctrl+Y".
[[nodiscard]] std::string keys_text(const KeyBinding& binding);
[[nodiscard]] const char* group_title(KeyGroup group);

}  // namespace hapticwall::ui
