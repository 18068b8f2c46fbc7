#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "app/ui/panel/replay_panel.h"
#include "app/ui/panel/sections.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/text_edit.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/widgets.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::ui {
namespace {

std::string refusal_key(const ParameterDescription& parameter) {
  return fmt::format("algorithm.{}", parameter.key);
}

void set_parameter(const PanelContext& context, std::size_t index, std::optional<double> value) {
  AlgorithmSettings changed = context.session.scene().algorithm;
  changed.values[index] = value;
  context.edit.refusal.reset();
  if (const auto problem = ask_for_algorithm(context, changed))
    refuse(context, refusal_key(algorithm_parameters()[index]), problem->message);
}

std::string parameter_tooltip(const ParameterDescription& parameter) {
  std::string text(parameter.meaning);
  if (parameter.kind == ParameterKind::kNumber) {
    text +=
        fmt::format("\nfrom {:g} to {:g} {}", parameter.minimum, parameter.maximum, parameter.unit);
  }
  return text + fmt::format("\nempty: {}", parameter.default_text);
}

std::string field_id(const ParameterDescription& parameter) {
  return "##" + refusal_key(parameter);
}

// An empty field means the algorithm's default, shown as a hint.
void draw_number(const PanelContext& context, const ParameterDescription& parameter,
                 std::size_t index, std::optional<double> value) {
  const std::string shown = value ? rounded_number(*value) : std::string();
  const auto text =
      text_field(context, field_id(parameter).c_str(), std::string(parameter.default_text), shown);
  if (!text) return;
  if (text->find_first_not_of(' ') == std::string::npos) {
    set_parameter(context, index, std::nullopt);
    return;
  }
  if (const auto number = parse_number(*text)) {
    set_parameter(context, index, number);
  } else {
    refuse(context, refusal_key(parameter), no_number(*text));
  }
}

// A switch or a choice: the default, or one of the words.
void draw_choice(const PanelContext& context, const ParameterDescription& parameter,
                 std::size_t index, std::optional<double> value) {
  static constexpr std::array<std::string_view, 2> kSwitch{"false", "true"};
  const std::span<const std::string_view> words = parameter.kind == ParameterKind::kBoolean
                                                      ? std::span<const std::string_view>(kSwitch)
                                                      : parameter.choices;
  const std::string default_word = fmt::format("{} (default)", parameter.default_text);
  const auto chosen = value ? static_cast<std::size_t>(*value) : words.size();
  const std::string shown = chosen < words.size() ? std::string(words[chosen]) : default_word;
  if (!ImGui::BeginCombo(field_id(parameter).c_str(), shown.c_str())) return;
  if (ImGui::Selectable(default_word.c_str(), !value)) set_parameter(context, index, std::nullopt);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (list_choice(fmt::format("{0}###{1} = {0}", words[i], parameter.key), value && i == chosen))
      set_parameter(context, index, static_cast<double>(i));
  }
  ImGui::EndCombo();
}

// "rest_force_step_n" reads "rest force step": the unit stands beside the field.
std::string readable_key(std::string_view key) {
  for (const std::string_view ending :
       {"_n_s_per_m", "_n_per_m", "_m_per_s", "_n", "_m", "_s", "_j", "_hz"}) {
    if (key.ends_with(ending)) {
      key.remove_suffix(ending.size());
      break;
    }
  }
  std::string words(key);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

void draw_parameter(const PanelContext& context, const ParameterDescription& parameter) {
  const auto index = find_algorithm_parameter(parameter.key);
  if (!index) return;
  const std::optional<double> value = context.session.scene().algorithm.values[*index];
  const std::string tooltip = std::string(parameter.key) + "\n" + parameter_tooltip(parameter);
  field_label(context, readable_key(parameter.key), tooltip, parameter.unit);
  if (parameter.kind == ParameterKind::kNumber) {
    draw_number(context, parameter, *index, value);
  } else {
    draw_choice(context, parameter, *index, value);
    explain(tooltip);
  }
  unit_label(parameter.unit);
  draw_refusal(context, refusal_key(parameter));
}

// The following algorithm, and its parameters that are not shown yet.
void draw_follower(const PanelContext& context, const AlgorithmDescription& algorithm) {
  draw_parameter(context, kThenParameter);
  if (!has_follower(context.session.scene().algorithm)) return;
  const auto shown = algorithm.parameters;
  for (const ParameterDescription& parameter : algorithms()[follower_index()].parameters) {
    const bool twice = std::any_of(shown.begin(), shown.end(),
                                   [&](const auto& other) { return other.key == parameter.key; });
    if (!twice) draw_parameter(context, parameter);
  }
}

// Heights that no algorithm exceeds, so that the rows below stay where they are.
float largest_idea() {
  const FontScope font(nullptr, draw::kSmallFontSize);
  const float width = ImGui::GetContentRegionAvail().x;
  float height = 0.0F;
  for (const AlgorithmDescription& algorithm : algorithms()) {
    const std::string idea(algorithm.idea);
    height = std::max(height, ImGui::CalcTextSize(idea.c_str(), nullptr, false, width).y);
  }
  return height + ImGui::GetStyle().ItemSpacing.y;
}

float most_rows() {
  std::size_t rows = 0;
  for (const AlgorithmDescription& algorithm : algorithms())
    rows = std::max(rows, algorithm.parameters.size());
  // Plus one row for "then".
  return static_cast<float>(rows + 1) * ImGui::GetFrameHeightWithSpacing();
}

}  // namespace

void choose_algorithm(const PanelContext& context, std::size_t index) {
  if (index >= algorithms().size()) return;
  if (context.shows.replay != nullptr) {
    start_rerun(context.replay, context.toasts, *context.shows.replay,
                std::string(algorithms()[index].name));
    return;
  }
  AlgorithmSettings changed = context.session.scene().algorithm;
  changed.index = index;
  if (const auto problem = ask_for_algorithm(context, changed)) tell(context.toasts, *problem);
}

void draw_algorithm_section(const PanelContext& context) {
  section(context, "Algorithm", asked_for(context).algorithm);
  const auto list = algorithms();
  const std::size_t current = context.session.scene().algorithm.index;
  const std::size_t in_force = context.shows.in_force->algorithm.index;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const bool waits = i == current && current != in_force;
    const std::string label = fmt::format("{}   {}{}###{}", i + 1, list[i].name,
                                          waits ? "   asked for" : "", list[i].name);
    const std::string tooltip =
        fmt::format("{}\n{}\n\n{}\n\nkey {}; changes while it runs, without a jump of the force",
                    list[i].title, list[i].idea, list[i].equation, i + 1);
    if (list_choice(label, i == in_force, tooltip)) choose_algorithm(context, i);
  }
  if (current >= list.size()) return;
  const float end = ImGui::GetCursorPosY() + largest_idea() + most_rows();
  muted_text(context, list[current].idea);
  if (!context.window.more) return;
  for (const ParameterDescription& parameter : list[current].parameters)
    draw_parameter(context, parameter);
  draw_follower(context, list[current]);
  ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), end));
}

}  // namespace hapticwall::ui
