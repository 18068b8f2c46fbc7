#include "app/ui/page/map_controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <string>
#include <utility>

#include "app/ui/state/text_edit.h"
#include "app/ui/widget/widgets.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::ui {
namespace {

constexpr float kBesideEms = 20.0F;  // width of a column whose lists stand beside their labels

// Opens a list beside its label, or below it in a narrow column.
bool begin_list(const PanelContext& context, const char* label, const char* tooltip,
                const std::string& id, const std::string& shown) {
  const bool narrow = ImGui::GetContentRegionAvail().x < ems(kBesideEms);
  field_label(context, label, tooltip, "");
  if (narrow) {
    ImGui::NewLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
  }
  const bool open = ImGui::BeginCombo(id.c_str(), shown.c_str());
  const std::string meaning = std::exchange(context.edit.tooltip, {});
  if (!open) explain(meaning);
  return open;
}

void draw_number_choice(const PanelContext& context, MapChoice& choice, std::size_t axis,
                        const MapAxis& present) {
  constexpr std::array kNames{"across", "up"};
  auto& axes = choice.axes;
  if (!begin_list(context, kNames.at(axis), "The number of the scene along this axis",
                  fmt::format("##map number {}", axis), present.number.path))
    return;
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
                  bool logarithmic, const std::string& field) {
  if (const auto problem = set_range(choice, low, high, logarithmic))
    refuse(context, field, *problem);
}

std::string end_field(std::size_t axis, bool upper) {
  return fmt::format("##map {} {}", upper ? "to" : "from", axis);
}

void draw_end(const PanelContext& context, MapChoice& choice, std::size_t axis, bool upper,
              const MapAxis& present, float width) {
  ImGui::SetNextItemWidth(width);
  const std::string field = end_field(axis, upper);
  const auto typed = number_field(context, field.c_str(), upper ? present.high : present.low);
  explain("An end of the axis. A typed range stays when the value leaves it.");
  if (!typed) return;
  change_range(context, choice.axes.at(axis), upper ? present.low : *typed,
               upper ? *typed : present.high, present.logarithmic, field);
}

// Draws both ends in a row, and the unit.
void draw_ends(const PanelContext& context, MapChoice& choice, std::size_t axis,
               const MapAxis& present) {
  constexpr const char* kTo = "to";
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float free = ImGui::GetContentRegionAvail().x - unit_width(present.number.unit);
  const float each = 0.5F * (free - ImGui::CalcTextSize(kTo).x - 2.0F * gap);
  draw_end(context, choice, axis, false, present, each);
  ImGui::SameLine(0.0F, gap);
  ImGui::TextUnformatted(kTo);
  ImGui::SameLine(0.0F, gap);
  draw_end(context, choice, axis, true, present, each);
  unit_label(present.number.unit);
  for (const bool upper : {false, true}) draw_refusal(context, end_field(axis, upper));
}

void draw_axis(const PanelContext& context, MapChoice& choice, std::size_t axis,
               const MapAxis& present) {
  draw_number_choice(context, choice, axis, present);
  draw_ends(context, choice, axis, present);
  bool logarithmic = present.logarithmic;
  ImGui::BeginDisabled(present.number.whole);
  if (ImGui::Checkbox(fmt::format("logarithmic###map log {}", axis).c_str(), &logarithmic)) {
    change_range(context, choice.axes.at(axis), present.low, present.high, logarithmic,
                 end_field(axis, false));
  }
  ImGui::EndDisabled();
  explain("Equal ratios instead of equal steps between the values of the axis");
  ImGui::SameLine();
  if (button(fmt::format("around###map around {}", axis),
             "The usual range around the present value of this number", {.small = true})) {
    choose_number(choice.axes.at(axis), present.number.path);
    context.edit.refusal.reset();
  }
}

std::string algorithms_text(const MapChoice& choice) {
  if (choice.algorithms.empty()) return "the one in force";
  if (choice.algorithms.size() == algorithms().size()) return "all";
  if (choice.algorithms.size() == 1)
    return std::string(algorithms()[choice.algorithms.front()].name);
  return fmt::format("{} of {}", choice.algorithms.size(), algorithms().size());
}

void draw_algorithm_choice(const PanelContext& context, MapChoice& choice) {
  if (!begin_list(context, "under", "The algorithms of the map, a field each", "##map algorithms",
                  algorithms_text(choice)))
    return;
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

void draw_map_controls(const PanelContext& context, MapChoice& choice, const StabilityMap& map) {
  draw_algorithm_choice(context, choice);
  draw_axis(context, choice, 0, map.x);
  draw_axis(context, choice, 1, map.y);
}

}  // namespace hapticwall::ui
