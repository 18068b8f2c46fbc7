#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/ui/panel/replay_panel.h"
#include "app/ui/panel/sections.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/text_edit.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/described_field.h"
#include "app/ui/widget/widgets.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::ui {
namespace {

void draw_parameter(const PanelContext& context, const ParameterDescription& parameter) {
  const auto index = find_algorithm_parameter(parameter.key);
  if (!index) return;
  const std::string key = fmt::format("algorithm.{}", parameter.key);
  const AlgorithmSettings& settings = context.session.scene().algorithm;
  draw_described_field(context, {key, parameter, settings.values[*index]},
                       [&](std::optional<double> value) {
                         AlgorithmSettings changed = settings;
                         changed.values[*index] = value;
                         context.edit.refusal.reset();
                         if (const auto problem = ask_for_algorithm(context, changed))
                           refuse(context, key, problem->message);
                       });
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
