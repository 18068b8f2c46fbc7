#include "app/ui/panel/tour_strip.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>

#include "app/ui/panel/sections.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/state/tour.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr float kTourButtonEms = 4.5F;
constexpr int kTourButtons = 3;

// True if the step is done. Also notes it: the sight may be over before the text is read.
bool is_done(const PanelContext& context, const TourStep& step) {
  const auto& lamp = context.compare.transient.lamp;
  bool& done = context.tour.step_done;
  const Sight sight{context.session.scene(), context.tails.front(),
                    lamp ? lamp->story() : EnergyStory{}};
  done = done || step.done(sight);
  return done;
}

void go_to_step(TourState& tour, std::size_t step) {
  tour.step = step;
  tour.step_done = false;
}

void draw_offer(const PanelContext& context) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("New here? Five lessons, a minute each.");
  ImGui::SameLine();
  if (button("Begin the tour###begin tour", "Starts in the scene 'press', without an algorithm"))
    begin_tour(context);
  ImGui::SameLine();
  if (button("No###close tour", "The tour begins from F1 as well")) context.tour.offered = false;
}

void draw_step_buttons(const PanelContext& context, std::size_t step, std::size_t count) {
  TourState& tour = context.tour;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  ImGui::SameLine();
  draw::align_right(kTourButtons * (ems(kTourButtonEms) + gap) - gap);
  if (button("Back###tour back", "", {.width = ems(kTourButtonEms), .enabled = step > 1}))
    go_to_step(tour, step - 1);
  ImGui::SameLine();
  if (button("Next###tour next", "", {.width = ems(kTourButtonEms), .enabled = step < count}))
    go_to_step(tour, step + 1);
  ImGui::SameLine();
  if (button("Close###close tour", "The tour begins again from F1", {.width = ems(kTourButtonEms)}))
    go_to_step(tour, 0);
}

void draw_step(const PanelContext& context, std::size_t step) {
  const auto steps = tour_steps();
  const TourStep& now = steps[step - 1];
  const bool done = is_done(context, now);
  ImGui::AlignTextToFramePadding();
  draw::strong_text(context.theme,
                    fmt::format("step {} of {} · {}", step, steps.size(), now.lesson));
  ImGui::SameLine();
  ImGui::TextColored(context.theme.colour(done ? draw::Tone::kGood : draw::Tone::kMuted), "%s",
                     done ? "· seen" : "· not seen yet");
  draw_step_buttons(context, step, steps.size());
  draw::wrapped_text(context.theme.colour(draw::Tone::kText), now.text);
}

}  // namespace

void draw_tour_strip(const PanelContext& context) {
  if (context.shows.live == nullptr || context.shows.hides_algorithm) return;
  TourState& tour = context.tour;
  // A user who chooses another scene has left the tour.
  if (context.session.scene().name != kTourScene) go_to_step(tour, 0);
  if (tour.step > 0) {
    draw_step(context, tour.step);
  } else if (tour.offered) {
    draw_offer(context);
  }
}

void begin_tour(const PanelContext& context) {
  want_builtin(context, kTourScene, kTourAlgorithm);
  context.tour.offered = false;
  go_to_step(context.tour, 1);
}

}  // namespace hapticwall::ui
