// The choice of a part of the loop that has a list and a table of keys: estimator, environment.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/ui/state/panel_context.h"
#include "app/ui/widget/described_field.h"
#include "app/ui/widget/parameter_rows.h"
#include "app/ui/widget/widgets.h"
#include "core/scene.h"

namespace hapticwall::ui {

// `list`: members with a description, the chosen one by the index in `settings`; `keys`: the union
// of their parameters, in the order of the settings' values.
template <class List, class Settings>
struct PartChoice {
  std::string_view table;  // "estimator"
  const List& list;
  std::span<const ParameterDescription> keys;
  Settings Scene::*settings;
  const char* explanation;  // tooltip of the menu
};
// Clang deduces no arguments of an aggregate before version 17.
template <class List, class Settings>
PartChoice(std::string_view, const List&, std::span<const ParameterDescription>, Settings Scene::*,
           const char*) -> PartChoice<List, Settings>;

// The menu. Calls `choose(scene, index)` on the scene that is asked for.
template <class List, class Settings, class Choose>
void draw_part_menu(const PanelContext& context, const PartChoice<List, Settings>& part,
                    const Choose& choose) {
  const std::size_t chosen = (context.session.scene().*part.settings).index;
  const std::string key = std::string(part.table) + ".name";
  ImGui::SetNextItemWidth(-1.0F);
  const std::string shown(part.list[chosen].description.name);
  if (ImGui::BeginCombo(("##" + std::string(part.table)).c_str(), shown.c_str())) {
    for (std::size_t i = 0; i < part.list.size(); ++i) {
      const auto& one = part.list[i].description;
      const std::string tooltip =
          std::string(one.title).append("\n").append(one.idea).append("\n\n").append(one.equation);
      if (list_choice(std::string(one.name), i == chosen, tooltip) && i != chosen)
        change_parameters(context, key, [&](Scene& scene) { choose(scene, i); });
    }
    ImGui::EndCombo();
  }
  explain(part.explanation);
  draw_refusal(context, key);
}

// The fields of the chosen one's keys.
template <class List, class Settings>
void draw_part_fields(const PanelContext& context, const PartChoice<List, Settings>& part) {
  const Settings& settings = context.session.scene().*part.settings;
  for (const ParameterDescription& parameter : part.list[settings.index].description.parameters) {
    const auto found = std::ranges::find(part.keys, parameter.key, &ParameterDescription::key);
    const auto index = static_cast<std::size_t>(found - part.keys.begin());
    const std::string key = std::string(part.table).append(".").append(parameter.key);
    const auto set = [&](std::optional<double> value) {
      change_parameters(context, key,
                        [&](Scene& scene) { (scene.*part.settings).values.at(index) = value; });
    };
    draw_described_field(context, {key, parameter, settings.values.at(index)}, set);
  }
}

}  // namespace hapticwall::ui
