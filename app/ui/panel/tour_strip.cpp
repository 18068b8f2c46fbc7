#include "app/ui/panel/tour_strip.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>

#include "app/ui/panel/sections.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/state/scene_state.h"
#include "app/ui/state/tour.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr float kTourButtonEms = 4.5F;
constexpr int kTourButtons = 3;
// Pixels at scale 1, between an item and its frame. A verdict has little room above.
constexpr ImVec2 kFrameGap(3.0F, 3.0F);
constexpr ImVec2 kVerdictGap(5.0F, 0.0F);
constexpr float kFrameWidth = 1.5F;
constexpr float kFrameRadius = 5.0F;

void judge(const PanelContext& context) {
  const auto& lamp = context.compare.transient.lamp;
  look(context.tour,
       {context.session.scene(), context.tails.front(), lamp ? lamp->story() : EnergyStory{}});
}

// Parts of the window do not cut it off.
void frame_last_item(const PanelContext& context, ImVec2 gap = kFrameGap) {
  if (context.window.presents) return;
  const float scale = ImGui::GetStyle().FontScaleMain;
  const ImVec2 from = ImGui::GetItemRectMin();
  const ImVec2 to = ImGui::GetItemRectMax();
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->PushClipRectFullScreen();
  list->AddRect(ImVec2(from.x - gap.x * scale, from.y - gap.y * scale),
                ImVec2(to.x + gap.x * scale, to.y + gap.y * scale),
                context.theme.packed(draw::Tone::kAccent), kFrameRadius * scale, 0,
                kFrameWidth * scale);
  list->PopClipRect();
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

// The end comes after the last lesson was seen.
bool has_next(const TourState& tour) {
  const std::size_t lessons = tour_steps().size() - 1;
  return tour.step < lessons || (tour.step == lessons && step_seen(tour));
}

void draw_step_buttons(const PanelContext& context) {
  TourState& tour = context.tour;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const ButtonLook look{.width = ems(kTourButtonEms)};
  const float width = kTourButtons * (look.width + gap) - gap;
  beside(width);
  draw::align_right(width);
  if (button("Back###tour back", "", {.width = look.width, .enabled = tour.step > 1}))
    go_to_step(tour, tour.step - 1);
  ImGui::SameLine();
  const std::string next = "Next###tour next";
  const ButtonLook next_look{.width = look.width, .enabled = has_next(tour)};
  const bool goes_on = step_seen(tour) ? choice_button(context, next, true, "", next_look)
                                       : button(next, "", next_look);
  if (goes_on) go_to_step(tour, tour.step + 1);
  ImGui::SameLine();
  if (button("Close###close tour", "The tour begins again from F1", look)) go_to_step(tour, 0);
}

void draw_step(const PanelContext& context) {
  judge(context);
  const TourState& tour = context.tour;
  const TourStep& now = *present_step(tour);
  const bool lesson = !now.moves.empty();
  ImGui::AlignTextToFramePadding();
  draw::strong_text(context.theme, lesson ? fmt::format("step {} of {} · {}", tour.step,
                                                        tour_steps().size() - 1, now.lesson)
                                          : std::string(now.lesson));
  if (lesson) {
    const bool seen = step_seen(tour);
    ImGui::SameLine();
    ImGui::TextColored(context.theme.colour(seen ? draw::Tone::kGood : draw::Tone::kMuted), "%s",
                       seen ? "· seen" : "· not seen yet");
  }
  draw_step_buttons(context);
  const bool elsewhere = !context.can.files && !now.text_without_files.empty();
  draw::wrapped_text(context.theme.colour(draw::Tone::kText),
                     elsewhere ? now.text_without_files : now.text);
}

}  // namespace

void draw_tour_strip(const PanelContext& context) {
  if (context.shows.live == nullptr || context.shows.hides_algorithm) return;
  TourState& tour = context.tour;
  // A user who chooses another scene has left the tour. Its own begins after this frame.
  if (context.session.scene().name != kTourScene && !context.scene.wanted) go_to_step(tour, 0);
  if (tour.step > 0) {
    draw_step(context);
  } else if (tour.offered) {
    draw_offer(context);
  }
}

void begin_tour(const PanelContext& context) {
  want_builtin(context, kTourScene, kTourAlgorithm);
  context.window.presents = false;
  begin_steps(context.tour);
}

void point_at(const PanelContext& context, TourPlace place) {
  if (!points_at(context.tour, place)) return;
  frame_last_item(context, place == TourPlace::kVerdict ? kVerdictGap : kFrameGap);
}

void point_at_algorithm(const PanelContext& context, std::size_t algorithm) {
  if (points_at_algorithm(context.tour, algorithm)) frame_last_item(context);
}

void point_at_reset(const PanelContext& context) {
  if (points_at_reset(context.tour)) frame_last_item(context);
}

}  // namespace hapticwall::ui
