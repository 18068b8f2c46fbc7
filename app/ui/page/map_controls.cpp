#include "app/ui/page/map_controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "app/ui/widget/widgets.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::ui {
namespace {

void draw_number_choice(const PanelContext& context, std::size_t axis, const MapAxis& present) {
  constexpr std::array kNames{"across", "up"};
  auto& axes = context.state.map.choice.axes;
  field_label(context, kNames.at(axis), "The number of the scene along this axis", "");
  if (!ImGui::BeginCombo(fmt::format("##map number {}", axis).c_str(),
                         present.number.path.c_str())) {
    return;
  }
  for (const SceneNumber& number : map_numbers(context.session.scene())) {
    const bool chosen = number.path == present.number.path;
    if (!list_choice(fmt::format("{0}###map choice {1} {0}", number.path, axis), chosen) ||
        chosen) {
      continue;
    }
    if (number.path == axes.at(1 - axis).path) {
      std::swap(axes.front(), axes.back());
    } else {
      choose_number(axes.at(axis), number.path);
    }
  }
  ImGui::EndCombo();
}

void change_range(const PanelContext& context, MapAxisChoice& choice, double low, double high,
                  bool logarithmic) {
  if (const auto problem = set_range(choice, low, high, logarithmic))
    tell(context.state, MessageKind::kProblem, choice.path + ": " + *problem);
}

void draw_end(const PanelContext& context, std::size_t axis, bool upper, const MapAxis& present,
              float width) {
  ImGui::SetNextItemWidth(width);
  const auto typed =
      number_field(context, fmt::format("##map {} {}", upper ? "to" : "from", axis).c_str(),
                   upper ? present.high : present.low);
  explain("An end of the axis. A typed range stays when the value leaves it.");
  if (!typed) return;
  change_range(context, context.state.map.choice.axes.at(axis), upper ? present.low : *typed,
               upper ? *typed : present.high, present.logarithmic);
}

// Both ends in a row, and the unit.
void draw_ends(const PanelContext& context, std::size_t axis, const MapAxis& present) {
  constexpr const char* kTo = "to";
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float free = ImGui::GetContentRegionAvail().x - unit_width(present.number.unit);
  const float each = 0.5F * (free - ImGui::CalcTextSize(kTo).x - 2.0F * gap);
  draw_end(context, axis, false, present, each);
  ImGui::SameLine(0.0F, gap);
  ImGui::TextUnformatted(kTo);
  ImGui::SameLine(0.0F, gap);
  draw_end(context, axis, true, present, each);
  unit_label(present.number.unit);
}

void draw_axis(const PanelContext& context, std::size_t axis, const MapAxis& present) {
  draw_number_choice(context, axis, present);
  draw_ends(context, axis, present);
  bool logarithmic = present.logarithmic;
  ImGui::BeginDisabled(present.number.whole);
  if (ImGui::Checkbox(fmt::format("logarithmic###map log {}", axis).c_str(), &logarithmic)) {
    change_range(context, context.state.map.choice.axes.at(axis), present.low, present.high,
                 logarithmic);
  }
  ImGui::EndDisabled();
  explain("Equal ratios instead of equal steps between the values of the axis");
  ImGui::SameLine();
  if (button(fmt::format("around###map around {}", axis),
             "The usual range around the present value of this number", {.small = true})) {
    choose_number(context.state.map.choice.axes.at(axis), present.number.path);
  }
}

std::string algorithms_text(const MapChoice& choice) {
  if (choice.algorithms.empty()) return "the one in force";
  if (choice.algorithms.size() == algorithms().size()) return "all";
  if (choice.algorithms.size() == 1)
    return std::string(algorithms()[choice.algorithms.front()].name);
  return fmt::format("{} of {}", choice.algorithms.size(), algorithms().size());
}

void draw_algorithm_choice(const PanelContext& context) {
  MapChoice& choice = context.state.map.choice;
  field_label(context, "under", "The algorithms of the map, a field each", "");
  if (!ImGui::BeginCombo("##map algorithms", algorithms_text(choice).c_str())) return;
  if (list_choice("the one in force###map in force", choice.algorithms.empty()))
    choice.algorithms.clear();
  if (list_choice("all###map all", choice.algorithms.size() == algorithms().size())) {
    for (std::size_t i = 0; i < algorithms().size(); ++i) choose_algorithm_in_map(choice, i, true);
  }
  for (std::size_t i = 0; i < algorithms().size(); ++i) {
    bool chosen = std::ranges::binary_search(choice.algorithms, i);
    if (ImGui::Checkbox(fmt::format("{0}###map under {0}", algorithms()[i].name).c_str(), &chosen))
      choose_algorithm_in_map(choice, i, chosen);
  }
  ImGui::EndCombo();
}

}  // namespace

void draw_map_controls(const PanelContext& context, const StabilityMap& map) {
  draw_algorithm_choice(context);
  draw_axis(context, 0, map.x);
  draw_axis(context, 1, map.y);
}

}  // namespace hapticwall::ui
