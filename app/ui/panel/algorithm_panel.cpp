#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/ui/panel/replay_panel.h"
#include "app/ui/panel/sections.h"
#include "app/ui/panel/tour_strip.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/state/comparing.h"
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

}  // namespace

void choose_algorithm(const PanelContext& context, std::size_t index) {
  if (index >= algorithms().size()) return;
  if (context.shows.replay != nullptr) {
    start_rerun(context.replay, context.toasts, *context.shows.replay,
                std::string(algorithms()[index].name));
    return;
  }
  note_choice(context.tour, index);
  const AlgorithmSettings before = context.session.scene().algorithm;
  AlgorithmSettings changed = before;
  changed.index = index;
  const bool two_walls = !context.window.more || context.window.presents;
  if (const auto problem = ask_for_algorithm(context, changed)) {
    tell(context.toasts, *problem);
  } else if (two_walls) {
    keep_walls_apart(context, before, index);
  }
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
    const bool chosen = list_choice(label, i == in_force, tooltip);
    point_at_algorithm(context, i);
    if (chosen) choose_algorithm(context, i);
  }
  if (current >= list.size()) return;
  muted_text(context, list[current].idea);
  if (!context.window.more) return;
  for (const ParameterDescription& parameter : list[current].parameters)
    draw_parameter(context, parameter);
  if (context.compare.persisted.open || has_follower(context.session.scene().algorithm))
    draw_follower(context, list[current]);
}

}  // namespace hapticwall::ui
