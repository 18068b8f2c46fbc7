// Rows for the parameters that may change during a session, from the tables of scene keys: label,
// field, unit, a switch for optional parts, and the reason of a refusal.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "app/ui/state/panel_context.h"
#include "app/ui/widget/widgets.h"
#include "core/scene_keys.h"
#include "core/units.h"

namespace hapticwall::ui {

// Texts that the tables of keys do not have.
struct ParameterText {
  std::string key;
  std::string label;
  std::string meaning;
  // Initial value of a part without one, and the middle of its slider.
  double suggestion = 0.0;
};

// One row: the present value and the value of the loaded scene.
struct ParameterRow {
  std::string key;  // dotted, from the root
  ParameterText text;
  std::string_view unit;
  ValueRange range;
  bool optional = false;
  bool whole = false;
  std::optional<double> value;  // in `unit`, like the range and the suggestion
  std::optional<double> loaded;
  double scale = 1.0;  // `unit` per unit of the scene
};

struct ParameterEdit {
  std::optional<double> value;  // nullopt: the part is absent
};

// Draws a row; returns the edit of this frame, if any.
[[nodiscard]] std::optional<ParameterEdit> draw_parameter_row(const PanelContext& context,
                                                              const ParameterRow& row);

// Asks the session for an edit of its scene. Shows a refusal below the row of `key`.
void change_parameters(const PanelContext& context, const std::string& key,
                       const std::function<void(Scene&)>& edit);

template <typename Owner>
[[nodiscard]] bool may_be_absent(const NumberKey<Owner>& key) {
  return !std::holds_alternative<double Owner::*>(key.member);
}

// Sets or removes the value; a required value stays.
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

// Lengths of a device are millimetres and less.
void show_in_millimetres(ParameterRow& row);

// The row of one key. `prefix` ends with a dot.
template <typename Owner>
[[nodiscard]] ParameterRow parameter_row(const std::string& prefix, const NumberKey<Owner>& key,
                                         const ParameterText& text, const Owner& in_force,
                                         const Owner& loaded) {
  ParameterRow row{prefix + std::string(key.key),
                   text,
                   key.unit,
                   key.range,
                   may_be_absent(key),
                   key.whole(),
                   key.get(in_force),
                   key.get(loaded)};
  if (key.unit == "m") show_in_millimetres(row);
  return row;
}

template <typename Owner>
[[nodiscard]] const NumberKey<Owner>& key_called(std::string_view name) {
  for (const NumberKey<Owner>& key : number_keys<Owner>()) {
    if (key.key == name) return key;
  }
  return number_keys<Owner>().front();
}

}  // namespace hapticwall::ui
