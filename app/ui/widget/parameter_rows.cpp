#include "app/ui/parameter_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/ui/sliders.h"
#include "app/ui/widgets.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::ui {
namespace {

constexpr const char* kAbsent = "none";

std::string shown_value(const std::optional<double>& value) {
  return value ? number_text(*value) : std::string(kAbsent);
}

std::string tooltip_of(const ParameterRow& row) {
  const std::string unit = row.unit.empty() ? "" : " " + std::string(row.unit);
  std::string text = fmt::format("{}\n{}\nfrom {} to {}{}", row.key, row.text.meaning,
                                 hapticwall::number_text(row.range.minimum),
                                 hapticwall::number_text(row.range.maximum), unit);
  if (row.value != row.loaded) text += "\nin the scene: " + shown_value(row.loaded);
  return text + "\nchanges while it runs";
}

// The switch of a part that may be absent; on again, the part is what it was.
std::optional<ParameterEdit> draw_switch(const PanelContext& context, const ParameterRow& row) {
  std::optional<ParameterEdit> edit;
  bool present = row.value.has_value();
  auto& switched_off = context.state.transient.switched_off;
  if (ImGui::Checkbox("##switch", &present)) {
    if (!present) switched_off.insert_or_assign(row.key, *row.value);
    const auto before = switched_off.find(row.key);
    const double on =
        before != switched_off.end() ? before->second : row.loaded.value_or(row.text.suggestion);
    edit = ParameterEdit{present ? std::optional(on) : std::nullopt};
  }
  remember_item(context.state, "switch " + row.key);
  explain(present ? "Leaves this part out of the model." : "Puts this part into the model.");
  return edit;
}

constexpr const char* kField = "##value";

// What counts has too few values for a slider, and what is absent has none.
std::optional<ParameterEdit> draw_slider(const PanelContext& context, const ParameterRow& row,
                                         float from, float to) {
  if (!row.value || row.whole || row.text.suggestion <= 0.0) return std::nullopt;
  const bool may_be_zero = row.range.minimum <= 0.0 && !row.range.minimum_excluded;
  LogRange range = range_around(row.text.suggestion, may_be_zero);
  range.minimum = std::max(range.minimum, row.range.minimum);
  range.maximum = std::min(range.maximum, row.range.maximum);
  const auto value = thin_slider(context, kField, *row.value, range, from, to);
  remember_item(context.state, row.key + "-slider");
  return value ? std::optional(ParameterEdit{*value}) : std::nullopt;
}

std::optional<ParameterEdit> draw_field(const PanelContext& context, const ParameterRow& row) {
  ImGui::BeginDisabled(!row.value);
  type_where_asked(context, kField);
  const auto text = text_field(context, kField, row.value ? "" : kAbsent,
                               row.value ? number_text(*row.value) : "");
  ImGui::EndDisabled();
  remember_item(context.state, row.key);
  explain(tooltip_of(row));
  if (!text) return std::nullopt;
  const auto number = parse_number(*text);
  if (!number) {
    refuse(context, row.key, fmt::format("'{}' is not a number", *text));
    return std::nullopt;
  }
  if (row.whole && *number != std::round(*number)) {
    refuse(context, row.key, fmt::format("{} is no whole number", number_text(*number)));
    return std::nullopt;
  }
  return ParameterEdit{number};
}

}  // namespace

std::optional<ParameterEdit> draw_parameter_row(const PanelContext& context,
                                                const ParameterRow& row) {
  ImGui::PushID(row.key.c_str());
  const float left = ImGui::GetCursorPosX();
  const float width = ImGui::GetContentRegionAvail().x;
  const bool changed = row.value != row.loaded;
  const Tone tone = changed ? Tone::kAccent : row.value ? Tone::kText : Tone::kMuted;
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(context.theme.colour(tone), "%s", row.text.label.c_str());
  explain(tooltip_of(row));
  // A column for the switch, whether this row has one or not: all fields end at one line.
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
  ImGui::PopID();
  return edit;
}

void refuse(const PanelContext& context, const std::string& key, std::string why) {
  context.state.transient.refusal = Refusal{key, std::move(why)};
}

void draw_refusal(const PanelContext& context, const std::string& key) {
  const auto& refusal = context.state.transient.refusal;
  if (!refusal || refusal->key != key) return;
  ImGui::PushFont(nullptr, kSmallFontSize);
  ImGui::PushStyleColor(ImGuiCol_Text, context.theme.colour(Tone::kBad));
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(refusal->why.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ImGui::PopFont();
  remember_item(context.state, "refusal");
}

void change_parameters(const PanelContext& context, const std::string& key,
                       const std::function<void(Scene&)>& edit) {
  Scene wanted = context.session.scene();
  edit(wanted);
  const auto problem = context.session.change_scene(wanted);
  context.state.transient.refusal.reset();
  if (!problem) return;
  // What concerns this very key needs no name beside its own field.
  const bool own = problem->key == key || problem->key.empty();
  refuse(context, key, own ? problem->message : problem->key + ": " + problem->message);
}

namespace {

using Values = std::vector<std::pair<std::string, std::string>>;  // key, value as shown

template <typename Owner>
void append(Values& values, const std::string& prefix, std::span<const NumberKey<Owner>> keys,
            const Owner& owner) {
  for (const NumberKey<Owner>& key : keys)
    values.emplace_back(prefix + std::string(key.key), shown_value(key.get(owner)));
}

// Everything of a scene that may change while it runs, less the integrator, in a fixed order.
Values values_of(const Scene& scene) {
  Values values;
  append(values, "device.", device_number_keys(), scene.device);
  if (scene.hand) append(values, "hand.", hand_number_keys(), *scene.hand);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const std::string prefix = scene.walls.size() == 1 ? "wall." : fmt::format("wall[{}].", i);
    append(values, prefix, wall_number_keys(), scene.walls[i]);
  }
  const auto parameters = algorithm_parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::optional<double>& value = scene.algorithm.values.at(i);
    values.emplace_back("algorithm." + std::string(parameters[i].key),
                        value ? value_text(parameters[i], *value) : kAbsent);
  }
  return values;
}

}  // namespace

std::vector<std::string> changed_values(const Scene& running, const Scene& loaded) {
  std::vector<std::string> lines;
  const Scene back = with_loaded_values(running, loaded);
  const Values now = values_of(running);
  const Values then = values_of(back);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i].second == then[i].second) continue;
    lines.push_back(
        fmt::format("{} = {}, in the scene {}", now[i].first, now[i].second, then[i].second));
  }
  if (running.simulator != back.simulator) {
    const auto words = [](const SimulatorSettings& simulator) {
      return fmt::format("{} × {}", simulator.integrator_name(), simulator.substeps);
    };
    lines.push_back(fmt::format("simulator: {}, in the scene {}", words(running.simulator),
                                words(back.simulator)));
  }
  return lines;
}

Scene with_loaded_values(const Scene& running, const Scene& loaded) {
  Scene scene = running;
  scene.device = loaded.device;
  scene.device.start_m = running.device.start_m;
  if (scene.hand && loaded.hand) {
    scene.hand = loaded.hand;
    scene.hand->path = running.hand->path;
    scene.hand->follows_mouse = running.hand->follows_mouse;
  }
  if (loaded.walls.size() == running.walls.size()) scene.walls = loaded.walls;
  scene.algorithm.values = loaded.algorithm.values;
  scene.simulator = loaded.simulator;
  return scene;
}

}  // namespace hapticwall::ui
