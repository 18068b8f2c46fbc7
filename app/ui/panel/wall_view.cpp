#include "app/ui/panel/wall_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/ui/panel/hand_drag.h"
#include "app/ui/panel/identify_state.h"
#include "app/ui/panel/tour_strip.h"
#include "app/ui/panel/verdict_view.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/wall/wall_labels.h"
#include "app/ui/wall/wall_state.h"
#include "app/ui/widget/shown_axis.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr double kTurnPerPixel = glm::radians(0.3);
constexpr double kZoomPerNotch = 1.15;
constexpr float kReadoutGap = 0.25F;      // gap between the rows, as a share of the usual gap
constexpr float kMinReadoutShare = 0.6F;  // smallest text, as a share of the usual size

ViewDrag drag_of_button() {
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) return ViewDrag::kTurn;
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) return ViewDrag::kShift;
  return ViewDrag::kLeadHand;
}

// Turns, moves and zooms the camera by pointer actions on the last item.
void move_camera(WallState& state, const ViewArea& area, bool two_axes) {
  WallOrbit& orbit = state.persisted.orbit;
  const ImGuiIO& io = ImGui::GetIO();
  if (state.transient.drag == ViewDrag::kTurn) {
    orbit.yaw_rad -= kTurnPerPixel * static_cast<double>(io.MouseDelta.x);
    orbit.pitch_rad += kTurnPerPixel * static_cast<double>(io.MouseDelta.y);
  } else if (state.transient.drag == ViewDrag::kShift) {
    orbit.shift.x += 2.0 * static_cast<double>(io.MouseDelta.x / area.size.x);
    orbit.shift.y -= 2.0 * static_cast<double>(io.MouseDelta.y / area.size.y);
  }
  if (ImGui::IsItemHovered()) {
    ImGui::SetItemKeyOwner(ImGuiKey_MouseWheelY);
    if (io.MouseWheel != 0.0F) {
      const glm::dvec2 pointer(2.0F * (io.MousePos.x - area.corner.x) / area.size.x - 1.0F,
                               1.0F - 2.0F * (io.MousePos.y - area.corner.y) / area.size.y);
      orbit = zoomed(orbit, std::pow(kZoomPerNotch, static_cast<double>(io.MouseWheel)), pointer);
    }
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Right) ||
        ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Middle))
      orbit = {};
  }
  orbit = limited(orbit, two_axes);
}

// The mean force over the mean penetration of the last second, as the verdict tells it: a single
// quotient flickers by several times. Nullopt out of contact.
std::optional<double> shown_stiffness(const PanelContext& context, std::size_t axis) {
  const Sample& sample = context.snapshot.newest.axes.at(axis);
  if ((sample.flags & kFlagInContact) == 0U) return std::nullopt;
  return context.tails.at(axis).summary.displayed_stiffness_n_per_m;
}

constexpr const char* kWidestReadout = "penetration    0.000 kN/m";

// Size of the readout's text, so that it fits into a narrow picture.
float readout_size(const PanelContext& context, const ViewArea& area) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const draw::FontScope font(context.theme.fonts.digits, draw::kSmallFontSize);
  const float free = area.size.x - 2.0F * (style.WindowPadding.x + style.ItemSpacing.x);
  const float share = free / ImGui::CalcTextSize(kWidestReadout).x;
  return draw::kSmallFontSize * std::clamp(share, kMinReadoutShare, 1.0F);
}

// Area of the readout, with its background.
draw::PixelBox readout_area(const PanelContext& context, const ViewArea& area) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const draw::FontScope font(context.theme.fonts.digits, readout_size(context, area));
  const ImVec2 around(style.ItemSpacing.x, 0.5F * style.ItemSpacing.y);
  const float row = ImGui::GetTextLineHeight() + kReadoutGap * style.ItemSpacing.y;
  const ImVec2 text(area.corner.x + style.WindowPadding.x, area.corner.y + style.WindowPadding.y);
  return {ImVec2(text.x - around.x, text.y - around.y),
          ImVec2(text.x + ImGui::CalcTextSize(kWidestReadout).x + around.x,
                 text.y + 4.0F * row + around.y)};
}

void draw_readout(const PanelContext& context, const ViewArea& area) {
  const Sample& sample = shown_sample(context);
  // Without a simulator the truth is where the encoder measures the handle.
  const double position_m = sample.truth.position_m;
  const double depth_m = std::max(0.0, sample.penetration_m + position_m - sample.position_m);
  const auto row = [&](const char* name, double value, int digits, const char* unit, bool known) {
    ImGui::TextDisabled("%-11s", name);
    ImGui::SameLine(0.0F, 0.0F);
    if (known) {
      ImGui::Text("%8.*f %s", digits, value, unit);
    } else {
      ImGui::TextDisabled("%8s", "–");
    }
  };
  const ImGuiStyle& style = ImGui::GetStyle();
  const draw::PixelBox box = readout_area(context, area);
  ImGui::GetWindowDrawList()->AddRectFilled(
      box.from, box.to, context.theme.packed(draw::Tone::kPanel, draw::kBehindText),
      style.FrameRounding);
  ImGui::SetCursorScreenPos(
      ImVec2(area.corner.x + style.WindowPadding.x, area.corner.y + style.WindowPadding.y));
  ImGui::PushFont(context.theme.fonts.digits, readout_size(context, area));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                      ImVec2(style.ItemSpacing.x, kReadoutGap * style.ItemSpacing.y));
  ImGui::BeginGroup();
  row("position", position_m * kMillimetresPerMetre, 3, "mm", true);
  row("penetration", depth_m * kMillimetresPerMetre, 3, "mm", true);
  row("force", sample.force_n, 3, "N", true);
  const std::optional<double> stiffness = shown_stiffness(context, shown_index(context));
  row("stiffness", stiffness.value_or(0.0) / 1e3, 2, "kN/m", stiffness.has_value());
  ImGui::EndGroup();
  ImGui::PopStyleVar();
  ImGui::PopFont();
}

constexpr const char* kResetView = "Reset view###reset view";

// Area of the button at the upper right; empty while the button would have no effect.
draw::PixelBox reset_area(const PanelContext& context, const ViewArea& area) {
  if (context.wall.persisted.orbit == WallOrbit{}) return {area.corner, area.corner};
  const ImGuiStyle& style = ImGui::GetStyle();
  const float right = area.corner.x + area.size.x - style.WindowPadding.x;
  const float top = area.corner.y + style.WindowPadding.y;
  return {ImVec2(right - button_width(kResetView), top),
          ImVec2(right, top + ImGui::GetFrameHeight())};
}

void draw_reset_button(const PanelContext& context, const ViewArea& area) {
  if (context.wall.persisted.orbit == WallOrbit{}) return;
  ImGui::SetCursorScreenPos(reset_area(context, area).from);
  if (button(kResetView,
             "Restores the initial view; so does a double click with the right button."))
    context.wall.persisted.orbit = {};
}

// Infinite without one, and for an axis that the scene does not have.
double force_limit_n(const PanelContext& context, std::size_t axis) {
  const std::vector<AxisSettings>& axes = context.session.scene().axes;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  return axis < axes.size() ? axes[axis].device.force_limit_n.value_or(kNone) : kNone;
}

// The picture and the invisible item over it, which takes the pointer.
void draw_picture(const PanelContext& context, WallRenderer& renderer, const WallPicture& picture,
                  const WallCamera& camera, const ViewArea& area) {
  const ImVec2 pixels = ImGui::GetIO().DisplayFramebufferScale;
  renderer.set_draft_share(context.wall.transient.resolution.share());
  const GLuint texture = renderer.draw(picture, camera, context.theme,
                                       std::max(1, static_cast<int>(area.size.x * pixels.x)),
                                       std::max(1, static_cast<int>(area.size.y * pixels.y)));
  context.wall.transient.view_refined = renderer.refined();
  ImGui::GetWindowDrawList()->AddImage(
      ImTextureRef(static_cast<ImTextureID>(texture)), area.corner,
      ImVec2(area.corner.x + area.size.x, area.corner.y + area.size.y), ImVec2(0.0F, 1.0F),
      ImVec2(1.0F, 0.0F));
}

void draw_labels(const PanelContext& context, const WallPicture& picture, const WallCamera& camera,
                 const ViewArea& area) {
  const bool hidden = context.shows.hides_force;
  const std::array taken{reset_area(context, area), hidden
                                                        ? draw::PixelBox{area.corner, area.corner}
                                                        : readout_area(context, area)};
  const draw::FontScope font(nullptr, draw::kSmallFontSize);
  draw_wall_labels(context.theme, picture, camera, area, taken,
                   hidden ? std::string() : rhythm_text(context.tails.at(shown_index(context))));
}

}  // namespace

WallCamera wall_view_camera(const Scene& scene, ImVec2 size) {
  return {wall_space(scene), WallOrbit{}, size.x, size.y};
}

WallPicture shown_picture(const PanelContext& context) {
  WallPicture picture = wall_picture(scene_to_show(context), context.snapshot.newest);
  WallState::Transient& transient = context.wall.transient;
  if (context.shows.hides_force) {
    // Both walls must look the same: draws the handle where a rigid wall would hold the hand.
    picture.hides_stiffness = true;
    picture.handle_m = held_by_walls(picture, picture.hand_m.value_or(glm::dvec2(0.0)));
    picture.force_n = {};
    picture.saturated = false;
    picture.shown = {};
    transient.shown = {};  // also cleared right after the test
    return picture;
  }
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    ShownStiffness& shown = transient.shown.at(axis);
    const std::optional<double> mean = shown_stiffness(context, axis);
    const ShownStiffness now = mean ? ShownStiffness{std::max(*mean, 0.0), 1.0} : ShownStiffness{};
    shown = faded(shown, now, static_cast<double>(ImGui::GetIO().DeltaTime));
    picture.shown.at(axis) = shown;
    const Swept& swept = transient.swept.at(axis);
    sweep(picture, static_cast<Axis>(axis), swept);
    const double most_n = std::max(swept.force_n.maximum, -swept.force_n.minimum);
    picture.saturated = picture.saturated || most_n >= force_limit_n(context, axis);
  }
  if (!context.identify.experiment) picture.verdict = draw::edge_tone(context.tails.front());
  return picture;
}

void take_wall_pointer(const PanelContext& context, const WallCamera& camera,
                       const ViewArea& area) {
  WallState& state = context.wall;
  ImGui::SetNextItemAllowOverlap();
  ImGui::InvisibleButton("##wall view", area.size,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  point_at(context, TourPlace::kWall);
  if (ImGui::IsItemActivated()) state.transient.drag = drag_of_button();
  if (!ImGui::IsItemActive()) state.transient.drag = ViewDrag::kNone;
  lead_hand(context, camera, state.transient.drag == ViewDrag::kLeadHand);
  move_camera(state, area, camera.space().y.has_value());
  const bool turning = ImGui::IsItemActive() && state.transient.drag != ViewDrag::kLeadHand;
  if (turning) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
  } else if (ImGui::IsItemHovered() && context.session.scene().x().hand &&
             context.shows.live != nullptr) {
    ImGui::SetMouseCursor(camera.space().y ? ImGuiMouseCursor_ResizeAll
                                           : ImGuiMouseCursor_ResizeEW);
  }
}

WallCamera draw_wall_pane(const PanelContext& context, WallRenderer& renderer, const Scene& scene,
                          const WallPicture& picture, const ViewArea& area) {
  WallCamera camera(wall_space(scene), context.wall.persisted.orbit, area.size.x, area.size.y);
  ImGui::SetCursorScreenPos(area.corner);
  draw_picture(context, renderer, picture, camera, area);
  const draw::FontScope font(nullptr, draw::kSmallFontSize);
  draw_few_wall_labels(context.theme, picture, camera, area);
  return camera;
}

void draw_wall_view(const PanelContext& context, WallRenderer& renderer) {
  const ImVec2 available = ImGui::GetContentRegionAvail();
  const ViewArea area{ImGui::GetCursorScreenPos(),
                      ImVec2(std::max(available.x, 1.0F), std::max(available.y, 1.0F))};
  const WallCamera camera(wall_space(scene_to_show(context)), context.wall.persisted.orbit,
                          area.size.x, area.size.y);
  const WallPicture picture = shown_picture(context);
  draw_picture(context, renderer, picture, camera, area);
  take_wall_pointer(context, camera, area);
  draw_labels(context, picture, camera, area);
  if (!context.shows.hides_force) draw_readout(context, area);
  draw_reset_button(context, area);
}

}  // namespace hapticwall::ui
