#include "app/ui/widget/parameter_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/ui/state/changes.h"
#include "app/ui/state/scene_state.h"
#include "app/ui/state/text_edit.h"
#include "app/ui/widget/sliders.h"
#include "app/ui/widget/widgets.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::ui {
namespace {

std::string tooltip_of(const ParameterRow& row) {
  const std::string unit = row.unit.empty() ? "" : " " + std::string(row.unit);
  std::string text =
      fmt::format("{}\n{}\nfrom {} to {}{}", row.key, row.text.meaning,
                  number_text(row.range.minimum), number_text(row.range.maximum), unit);
  if (row.value != row.loaded) text += "\nin the scene: " + shown_value(row.loaded);
  return text + "\nchanges during the session";
}

// The switch of an optional part. Switching it on again restores its value.
std::optional<ParameterEdit> draw_switch(const PanelContext& context, const ParameterRow& row) {
  std::optional<ParameterEdit> edit;
  bool present = row.value.has_value();
  auto& switched_off = context.scene.switched_off;
  if (ImGui::Checkbox(("##switch " + row.key).c_str(), &present)) {
    if (!present) switched_off.insert_or_assign(row.key, *row.value);
    const auto before = switched_off.find(row.key);
    const double on =
        before != switched_off.end() ? before->second : row.loaded.value_or(row.text.suggestion);
    edit = ParameterEdit{present ? std::optional(on) : std::nullopt};
  }
  explain(present ? "Removes this part from the model." : "Adds this part to the model.");
  return edit;
}

std::string field_id(const ParameterRow& row) { return "##" + row.key; }

// Whole numbers have too few values for a slider, and absent parts have none.
std::optional<ParameterEdit> draw_slider(const PanelContext& context, const ParameterRow& row,
                                         float from, float to) {
  if (!row.value || row.whole || row.text.suggestion <= 0.0) return std::nullopt;
  const bool may_be_zero = row.range.minimum <= 0.0 && !row.range.minimum_excluded;
  LogRange range = range_around(row.text.suggestion, may_be_zero);
  range.minimum = std::max(range.minimum, row.range.minimum);
  range.maximum = std::min(range.maximum, row.range.maximum);
  const auto value = thin_slider(context, field_id(row).c_str(), *row.value, range, from, to);
  return value ? std::optional(ParameterEdit{*value}) : std::nullopt;
}

std::optional<ParameterEdit> draw_field(const PanelContext& context, const ParameterRow& row) {
  ImGui::BeginDisabled(!row.value);
  const std::string id = field_id(row);
  type_where_asked(context, id.c_str());
  const auto text = text_field(context, id.c_str(), row.value ? "" : kAbsent,
                               row.value ? rounded_number(*row.value) : "");
  ImGui::EndDisabled();
  explain(tooltip_of(row));
  if (!text) return std::nullopt;
  const auto number = parse_number(*text);
  if (!number) {
    refuse(context, row.key, no_number(*text));
    return std::nullopt;
  }
  if (row.whole && *number != std::round(*number)) {
    refuse(context, row.key, fmt::format("{} is no whole number", rounded_number(*number)));
    return std::nullopt;
  }
  if (row.scale != 1.0 && !row.range.contains(*number)) {  // the scene speaks of other units
    refuse(context, row.key,
           fmt::format("{} is out of range; it takes {} to {} {}", rounded_number(*number),
                       rounded_number(row.range.minimum), rounded_number(row.range.maximum),
                       row.unit));
    return std::nullopt;
  }
  return ParameterEdit{number};
}

}  // namespace

std::optional<ParameterEdit> draw_parameter_row(const PanelContext& context,
                                                const ParameterRow& row) {
  const float left = ImGui::GetCursorPosX();
  const float width = ImGui::GetContentRegionAvail().x;
  const bool changed = row.value != row.loaded;
  const draw::Tone tone = changed     ? draw::Tone::kAccent
                          : row.value ? draw::Tone::kText
                                      : draw::Tone::kMuted;
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(context.theme.colour(tone), "%s", row.text.label.c_str());
  explain(tooltip_of(row));
  // Every row reserves the column of the switch, so that all fields are aligned.
  const float switch_at = width - ImGui::GetFrameHeight();
  const float field_at = std::floor(kLabelShare * width);
  ImGui::SameLine(left + field_at);
  ImGui::SetNextItemWidth(switch_at - field_at - unit_width(row.unit));
  std::optional<ParameterEdit> edit = draw_field(context, row);
  const float from = ImGui::GetItemRectMin().x;
  const float to = ImGui::GetItemRectMax().x;
  unit_label(row.unit);
  if (row.optional) {
    ImGui::SameLine(left + switch_at);
    if (const auto switched = draw_switch(context, row)) edit = switched;
  }
  if (const auto slid = draw_slider(context, row, from, to)) edit = slid;
  draw_refusal(context, row.key);
  if (edit && edit->value) *edit->value /= row.scale;
  return edit;
}

void show_in_millimetres(ParameterRow& row) {
  row.unit = "mm";
  row.scale = kMillimetresPerMetre;
  row.text.suggestion *= row.scale;
  row.range.minimum *= row.scale;
  row.range.maximum *= row.scale;
  if (row.value) *row.value *= row.scale;
  if (row.loaded) *row.loaded *= row.scale;
}

void change_parameters(const PanelContext& context, const std::string& key,
                       const std::function<void(Scene&)>& edit) {
  Scene wanted = context.session.scene();
  edit(wanted);
  const auto problem = ask_for(context, wanted);
  context.edit.refusal.reset();
  if (!problem) return;
  // A problem of this key omits the key's name, because its field stands beside it.
  const bool own = problem->key == key || problem->key.empty();
  refuse(context, key, own ? problem->message : problem->key + ": " + problem->message);
}

}  // namespace hapticwall::ui
