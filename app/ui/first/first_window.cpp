#include "app/ui/first/first_window.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/draw/plot/runs_plot.h"
#include "app/file/text/text.h"
#include "app/ui/first/first_controls.h"
#include "app/ui/first/presentation.h"
#include "app/ui/first/wall_card.h"
#include "app/ui/page/magnifier.h"
#include "app/ui/panel/replay_bar.h"
#include "app/ui/panel/sections.h"
#include "app/ui/panel/toolbar.h"
#include "app/ui/panel/tour_strip.h"
#include "app/ui/panel/verdict_view.h"
#include "app/ui/panel/wall_view.h"
#include "app/ui/state/comparing.h"
#include "app/ui/state/time_view.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/widgets.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::ui {
namespace {

using compare::Slot;
using draw::PixelBox;

constexpr float kGapEms = 0.8F;
constexpr float kCardShare = 0.60F;  // of the height of cards and plots
constexpr float kPlotPaddingEms = 0.8F;
constexpr float kLeastEms = 10.0F;  // height of cards and plots in a window without room
constexpr float kKeySize = 24.0F;   // text of a presentation's keys, pixels at scale 1

CardWall session_card(const FirstParts& parts, Slot slot) {
  const PanelContext& context = parts.page.context;
  const auto& lamp = context.compare.transient.lamp;
  return {.slot = slot,
          .leads = true,
          .algorithm = context.session.scene().algorithm,
          .scene = context.session.scene(),
          .tail = context.tails.front(),
          .story = lamp ? &lamp->story() : nullptr,
          .history = parts.page.history,
          .picture = shown_picture(context),
          .newest = context.snapshot.newest.x()};
}

CardWall other_card(const FirstParts& parts, Slot slot) {
  FirstState& first = parts.first;
  const OtherWall& other = first.other;
  CardWall wall{.slot = slot,
                .leads = false,
                .algorithm = other.scene().algorithm,
                .scene = other.scene(),
                .tail = other.tail(),
                .story = &other.story(),
                .history = other.history(),
                .picture = draw::wall_picture(other.scene(), other.newest()),
                .newest = other.newest()};
  note_swept(first.other_swept, other.history());
  sweep(wall.picture, Axis::kX, first.other_swept);
  const auto stiffness = wall.tail.summary.displayed_stiffness_n_per_m;
  const bool contact = (wall.newest.flags & kFlagInContact) != 0U && stiffness;
  const draw::ShownStiffness now =
      contact ? draw::ShownStiffness{std::max(*stiffness, 0.0), 1.0} : draw::ShownStiffness{};
  first.other_shown = faded(first.other_shown, now, static_cast<double>(ImGui::GetIO().DeltaTime));
  wall.picture.shown.front() = first.other_shown;
  wall.picture.verdict = draw::edge_tone(wall.tail);
  return wall;
}

// Cards from left to right: slots A and B; one card before the first tick.
std::vector<CardWall> cards_of(const FirstParts& parts) {
  const Slot active = slots_of(parts.page.context.compare).active;
  std::vector<CardWall> cards;
  for (const Slot slot : {Slot::kA, Slot::kB}) {
    if (slot == active) cards.push_back(session_card(parts, slot));
    if (slot != active && parts.first.other.seen()) cards.push_back(other_card(parts, slot));
  }
  return cards;
}

// One magnification for both: the contact that reaches deeper decides.
double span_of(const FirstParts& parts, const std::vector<CardWall>& cards, float card_width) {
  const PanelContext& context = parts.page.context;
  const float strip = strip_width(card_width);
  double deepest_m = 0.0;
  for (const CardWall& card : cards) {
    const ContactView view{card.picture, card.history, card.newest, std::nullopt, false};
    deepest_m = std::max(
        deepest_m,
        recent_depth_m(view, parts.first.magnified.at(static_cast<std::size_t>(card.slot))));
  }
  const WallCamera camera =
      wall_view_camera(context.session.scene(), ImVec2(card_width - strip, strip));
  const double pixels_per_m = camera.pixels_per_unit() * camera.units_per_m();
  return contact_span_m(context.wall, deepest_m, static_cast<double>(strip) / pixels_per_m);
}

void draw_cards(const FirstParts& parts, const std::vector<CardWall>& cards, ImVec2 size) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float gap = ems(kGapEms);
  const auto count = static_cast<float>(cards.size());
  const float width = (size.x - (count - 1.0F) * gap) / count;
  const double span_m = span_of(parts, cards, width);
  for (std::size_t i = 0; i < cards.size(); ++i) {
    const float left = corner.x + static_cast<float>(i) * (width + gap);
    WallRenderer& renderer = cards[i].leads ? parts.page.renderer : parts.other_renderer;
    draw_wall_card(parts, renderer, cards[i],
                   {ImVec2(left, corner.y), ImVec2(left + width, corner.y + size.y)}, span_m);
  }
  ImGui::SetCursorScreenPos(ImVec2(corner.x, corner.y + size.y + gap));
}

std::vector<draw::ShownRun> runs_of(const std::vector<CardWall>& cards) {
  std::vector<draw::ShownRun> runs;
  bool same_tone = true;
  for (const CardWall& card : cards)
    same_tone = same_tone && draw::tail_tone(card.tail) == draw::tail_tone(cards.front().tail);
  for (const CardWall& card : cards) {
    runs.push_back({card.history, spoken_name(card.algorithm), draw::tail_tone(card.tail),
                    same_tone && !card.leads});
  }
  return runs;
}

struct PlotChoice {
  draw::PlotId plot;
  draw::Quantity quantity;
};
constexpr std::array kShownPlots{
    PlotChoice{draw::PlotId::kPosition, draw::Quantity(&PlantTruth::position_m)},
    PlotChoice{draw::PlotId::kForce, draw::Quantity(&Sample::force_n)}};

void draw_plots(const FirstParts& parts, const std::vector<CardWall>& cards, ImVec2 size) {
  const PanelContext& context = parts.page.context;
  const std::vector<draw::ShownRun> runs = runs_of(cards);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float gap = ems(kGapEms);
  const float width = 0.5F * (size.x - gap);
  const ImVec2 padding(ems(kPlotPaddingEms), 0.7F * ems(kPlotPaddingEms));
  for (std::size_t i = 0; i < kShownPlots.size(); ++i) {
    const PlotChoice& choice = kShownPlots.at(i);
    const ImVec2 from(corner.x + static_cast<float>(i) * (width + gap), corner.y);
    ImGui::SetCursorScreenPos(ImVec2(from.x + padding.x, from.y + padding.y));
    const bool positions = choice.plot == draw::PlotId::kPosition;
    const std::span<const WallSettings> walls =
        positions ? std::span<const WallSettings>(context.session.scene().x().walls)
                  : std::span<const WallSettings>();
    draw_runs_plot({context.theme, draw::plot_description(choice.plot), choice.quantity, runs,
                    walls, time_window(context.time)},
                   parts.first.scratch,
                   ImVec2(width - 2.0F * padding.x, size.y - 2.0F * padding.y));
  }
  ImGui::SetCursorScreenPos(ImVec2(corner.x, corner.y + size.y + gap));
}

// Rows that are seen only when they are of use: an open recording, and one that is opened.
void draw_rows_of_use(const PanelContext& context) {
  const session::RecordingStatus status = context.shows.live->recording_status();
  if (status.state != session::RecordingState::kIdle) {
    draw_toolbar(context);
  } else {
    draw_opening(context);
  }
  if (context.tour.step > 0) draw_tour_strip(context);
}

// Fills the window around two panels that stand side by side, from `top` down to their lower edge.
// The panels themselves have the colour to which the window is cleared: every pixel is painted
// once, which a software renderer needs.
class Surroundings {
 public:
  explicit Surroundings(const draw::Theme& theme)
      : list_(ImGui::GetWindowDrawList()), colour_(theme.packed(draw::Tone::kBackground)) {
    list_->ChannelsSplit(2);
    list_->ChannelsSetCurrent(1);
  }
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;
  // Fills the rest.
  ~Surroundings() {
    fill({ImVec2(left(), top_), ImVec2(right(), bottom())});
    list_->ChannelsMerge();
  }

  // `from`, `to`: of the row of panels.
  void leave_out(ImVec2 from, ImVec2 to, std::size_t panels, float gap) {
    fill({ImVec2(left(), top_), ImVec2(right(), from.y)});
    fill({ImVec2(left(), from.y), ImVec2(from.x, to.y)});
    fill({ImVec2(to.x, from.y), ImVec2(right(), to.y)});
    const auto count = static_cast<float>(panels);
    const float width = (to.x - from.x - (count - 1.0F) * gap) / count;
    for (std::size_t i = 1; i < panels; ++i) {
      const float x = from.x + static_cast<float>(i) * (width + gap);
      fill({ImVec2(x - gap, from.y), ImVec2(x, to.y)});
    }
    top_ = to.y;
  }

 private:
  [[nodiscard]] static float left() { return ImGui::GetMainViewport()->WorkPos.x; }
  [[nodiscard]] static float right() { return left() + ImGui::GetMainViewport()->WorkSize.x; }
  [[nodiscard]] static float bottom() {
    const ImGuiViewport* viewport = ImGui::GetMainViewport();
    return viewport->WorkPos.y + viewport->WorkSize.y;
  }
  void fill(const PixelBox& box) {
    list_->ChannelsSetCurrent(0);
    list_->AddRectFilled(box.from, box.to, colour_);
    list_->ChannelsSetCurrent(1);
  }

  ImDrawList* list_;
  ImU32 colour_;
  float top_ = ImGui::GetMainViewport()->WorkPos.y;  // what is above is filled
};

// Leaves `below` pixels free under the plots.
void draw_walls_and_plots(const FirstParts& parts, Surroundings& around, float below) {
  follow_newest(parts.page.context.time, parts.page.history.newest_time_s());
  const ImVec2 free = ImGui::GetContentRegionAvail();
  const float height = std::max(free.y - below - 2.0F * ems(kGapEms), ems(kLeastEms));
  const std::vector<CardWall> cards = cards_of(parts);
  const float gap = ems(kGapEms);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float plots = corner.y + kCardShare * height + gap;
  around.leave_out(corner, ImVec2(corner.x + free.x, plots - gap), cards.size(), gap);
  around.leave_out(ImVec2(corner.x, plots),
                   ImVec2(corner.x + free.x, plots + (1.0F - kCardShare) * height),
                   kShownPlots.size(), gap);
  draw_cards(parts, cards, ImVec2(free.x, kCardShare * height));
  draw_plots(parts, cards, ImVec2(free.x, (1.0F - kCardShare) * height));
}

// Walls, plots and large keys, and everything as large as the window has room for.
void draw_presentation(const FirstParts& parts, Surroundings& around) {
  const ScaleScope large(presented_scale());
  const float keys = kKeySize * ImGui::GetStyle().FontScaleMain;
  draw_walls_and_plots(parts, around, keys + 2.0F * ImGui::GetStyle().FramePadding.y);
  const draw::FontScope font(parts.page.context.theme.fonts.strong, kKeySize);
  draw_first_chips(parts.page.context);
}

}  // namespace

bool shows_first_window(const PanelContext& context) {
  return !why_no_two_walls(context) && (context.window.presents || !context.window.more);
}

void draw_first_window(const FirstParts& parts) {
  const PanelContext& context = parts.page.context;
  Surroundings around(context.theme);
  if (context.window.presents) return draw_presentation(parts, around);
  const ScaleScope fitting(fitting_scale());
  draw_first_head(context);
  draw_rows_of_use(context);
  const ImGuiStyle& style = ImGui::GetStyle();
  draw_walls_and_plots(
      parts, around,
      ImGui::GetFrameHeight() + style.ItemSpacing.y + draw::kSmallFontSize * style.FontScaleMain);
  draw_first_chips(context);
  const draw::FontScope font(nullptr, draw::kSmallFontSize);
  draw_foot(context);
}

}  // namespace hapticwall::ui
