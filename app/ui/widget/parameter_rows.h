// Rows of the parameters that may change while it runs, straight from the tables of scene keys:
// label, a typed value, its unit, a switch where the part may be absent, and, where a value was
// refused, why.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "app/ui/ui_state.h"
#include "core/scene_keys.h"

namespace hapticwall::ui {

// What the tables of keys do not say.
struct ParameterText {
  std::string key;
  std::string label;
  std::string meaning;
  // For a part that is switched on and never had a value; the middle of its slider.
  double suggestion = 0.0;
};

// One row: what is in force, and what the loaded scene says.
struct ParameterRow {
  std::string key;  // dotted, from the root
  ParameterText text;
  std::string_view unit;
  ValueRange range;
  bool optional = false;
  bool whole = false;
  std::optional<double> value;
  std::optional<double> loaded;
};

struct ParameterEdit {
  std::optional<double> value;  // nothing: the part is left out
};

// Draws a row; returns what the user has asked for in this frame, if anything.
[[nodiscard]] std::optional<ParameterEdit> draw_parameter_row(const PanelContext& context,
                                                              const ParameterRow& row);

// Asks the session for its scene with an edit. A refusal is told below the row of `key`.
void change_parameters(const PanelContext& context, const std::string& key,
                       const std::function<void(Scene&)>& edit);

// Says below the row of `key` why what was typed there is not in force.
void refuse(const PanelContext& context, const std::string& key, std::string why);

// Below the row of `key`, in words, where its last value was refused.
void draw_refusal(const PanelContext& context, const std::string& key);

template <typename Owner>
[[nodiscard]] bool may_be_absent(const NumberKey<Owner>& key) {
  return !std::holds_alternative<double Owner::*>(key.member);
}

// Sets or leaves out; what may not be absent stays.
template <typename Owner>
void assign(const NumberKey<Owner>& key, Owner& owner, std::optional<double> value) {
  if (value) {
    key.set(owner, *value);
  } else if (may_be_absent(key)) {
    std::visit(
        [&](auto place) {
          if constexpr (!std::is_same_v<decltype(place), double Owner::*>) (owner.*place).reset();
        },
        key.member);
  }
}

// The row of `text` in the table `keys`. `prefix` ends with its point.
template <typename Owner>
[[nodiscard]] ParameterRow parameter_row(const std::string& prefix, const NumberKey<Owner>& key,
                                         const ParameterText& text, const Owner& in_force,
                                         const Owner& loaded) {
  return {prefix + std::string(key.key),
          text,
          key.unit,
          key.range,
          may_be_absent(key),
          key.whole(),
          key.get(in_force),
          key.get(loaded)};
}

template <typename Owner>
[[nodiscard]] const NumberKey<Owner>& key_called(std::span<const NumberKey<Owner>> keys,
                                                 std::string_view name) {
  for (const NumberKey<Owner>& key : keys) {
    if (key.key == name) return key;
  }
  return keys.front();
}

// ---- against the loaded scene ----

// One line for every value that is not the loaded scene's: of device, hand, simulator, walls and
// the algorithms' keys; the choice of the algorithm does not count.
[[nodiscard]] std::vector<std::string> changed_values(const Scene& running, const Scene& loaded);

// `running` with all of these as the loaded scene has them.
[[nodiscard]] Scene with_loaded_values(const Scene& running, const Scene& loaded);

}  // namespace hapticwall::ui
