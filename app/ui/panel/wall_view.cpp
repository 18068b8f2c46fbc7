#include "app/ui/panel/wall_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/ui/panel/energy_lamp_view.h"
#include "app/ui/panel/hand_drag.h"
#include "app/ui/wall/wall_labels.h"
#include "app/ui/widget/shown_axis.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr double kTurnPerPixel = glm::radians(0.3);
constexpr double kZoomPerNotch = 1.15;

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
  return context.state.tails.at(axis).summary.displayed_stiffness_n_per_m;
}

void draw_readout(const PanelContext& context, ImVec2 corner) {
  const Sample& sample = shown_sample(context);
  const bool contact = (sample.flags & kFlagInContact) != 0U;
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
  ImGui::PushFont(context.theme.fonts.digits, draw::kSmallFontSize);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                      ImVec2(style.ItemSpacing.x, 0.25F * style.ItemSpacing.y));
  const ImVec2 from(corner.x + style.WindowPadding.x, corner.y + style.WindowPadding.y);
  const float width = ImGui::CalcTextSize("penetration    0.000 kN/m").x;
  const float height = 4.0F * ImGui::GetTextLineHeightWithSpacing();
  ImGui::GetWindowDrawList()->AddRectFilled(
      ImVec2(from.x - style.ItemSpacing.x, from.y - 0.5F * style.ItemSpacing.y),
      ImVec2(from.x + width + style.ItemSpacing.x, from.y + height + 0.5F * style.ItemSpacing.y),
      context.theme.packed(draw::Tone::kPanel, kBehindText), style.FrameRounding);
  ImGui::SetCursorScreenPos(from);
  ImGui::BeginGroup();
  row("position", sample.position_m * kMillimetresPerMetre, 3, "mm", true);
  row("penetration", sample.penetration_m * kMillimetresPerMetre, 3, "mm", contact);
  row("force", sample.force_n, 3, "N", true);
  const std::optional<double> stiffness = shown_stiffness(context, shown_index(context));
  row("stiffness", stiffness.value_or(0.0) / 1e3, 2, "kN/m", stiffness.has_value());
  ImGui::EndGroup();
  ImGui::PopStyleVar();
  ImGui::PopFont();
}

// Only drawn where it has an effect.
void draw_reset_button(const PanelContext& context, const ViewArea& area) {
  WallOrbit& orbit = context.state.wall.persisted.orbit;
  if (orbit == WallOrbit{}) return;
  const ImGuiStyle& style = ImGui::GetStyle();
  constexpr const char* kLabel = "Reset view###reset view";
  const float right = area.corner.x + area.size.x - style.WindowPadding.x;
  ImGui::SetCursorScreenPos(
      ImVec2(right - button_width(kLabel), area.corner.y + style.WindowPadding.y));
  if (button(kLabel, "Restores the initial view; so does a double click with the right button."))
    orbit = {};
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
  renderer.set_draft_share(context.state.wall.transient.resolution.share());
  const GLuint texture = renderer.draw(picture, camera, context.theme,
                                       std::max(1, static_cast<int>(area.size.x * pixels.x)),
                                       std::max(1, static_cast<int>(area.size.y * pixels.y)));
  context.state.wall.transient.view_refined = renderer.refined();
  ImGui::GetWindowDrawList()->AddImage(
      ImTextureRef(static_cast<ImTextureID>(texture)), area.corner,
      ImVec2(area.corner.x + area.size.x, area.corner.y + area.size.y), ImVec2(0.0F, 1.0F),
      ImVec2(1.0F, 0.0F));
}

void take_pointer(const PanelContext& context, const WallCamera& camera, const ViewArea& area) {
  WallState& state = context.state.wall;
  ImGui::SetNextItemAllowOverlap();
  ImGui::InvisibleButton("##wall view", area.size,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
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

}  // namespace

WallCamera wall_view_camera(const Scene& scene, ImVec2 size) {
  return {wall_space(scene), WallOrbit{}, size.x, size.y};
}

WallPicture shown_picture(const PanelContext& context) {
  WallPicture picture = wall_picture(context.session.scene(), context.snapshot.newest);
  WallState::Transient& transient = context.state.wall.transient;
  if (context.shows.hides_force) {
    // Both walls look the same: the handle is where a rigid wall would hold the hand.
    picture.handle_m = held_by_walls(picture, picture.hand_m.value_or(glm::dvec2(0.0)));
    picture.force_n = {};
    picture.saturated = false;
    picture.shown = {};
    transient.shown = {};  // also right after the test
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
  if (const auto& lamp = context.state.compare.transient.lamp)
    picture.energy = lamp_words(lamp->story()).tone;
  return picture;
}

void draw_wall_view(const PanelContext& context, WallRenderer& renderer) {
  const ImVec2 available = ImGui::GetContentRegionAvail();
  const ViewArea area{ImGui::GetCursorScreenPos(),
                      ImVec2(std::max(available.x, 1.0F), std::max(available.y, 1.0F))};
  const WallCamera camera(wall_space(context.session.scene()), context.state.wall.persisted.orbit,
                          area.size.x, area.size.y);
  const WallPicture picture = shown_picture(context);
  draw_picture(context, renderer, picture, camera, area);
  take_pointer(context, camera, area);
  ImGui::PushFont(nullptr, draw::kSmallFontSize);
  draw_wall_labels(context.theme, picture, camera, area,
                   context.shows.hides_force
                       ? std::string()
                       : rhythm_text(context.state.tails.at(shown_index(context))));
  ImGui::PopFont();
  if (!context.shows.hides_force) draw_readout(context, area.corner);
  draw_reset_button(context, area);
}

}  // namespace hapticwall::ui
