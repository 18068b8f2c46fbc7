#include "app/ui/wall_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/ui/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr double kMillimetresPerMetre = 1e3;
constexpr double kRulerStepM = 0.01;
constexpr float kRulerFront = WallMeasures::kWallHalfDepth + 0.2F;  // z of the ruler on the floor

// Writes beside the picture: places in the picture's units become pixels of the window.
class Labels {
 public:
  Labels(const WallCamera& camera, ImVec2 corner, ImVec2 size)
      : camera_(camera), corner_(corner), size_(size), list_(ImGui::GetWindowDrawList()) {}

  [[nodiscard]] ImVec2 screen(glm::vec3 point) const {
    const glm::vec2 pixel = camera_.pixel_of(point);
    return {corner_.x + pixel.x, corner_.y + pixel.y};
  }
  // Centred at `place`, kept inside the picture.
  void write(ImVec2 place, ImU32 colour, const std::string& text) const {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    const float right = corner_.x + size_.x - extent.x - kEdge;
    const float x = std::clamp(place.x - 0.5F * extent.x, corner_.x + kEdge,
                               std::max(corner_.x + kEdge, right));
    list_->AddText(ImVec2(x, place.y - 0.5F * extent.y), colour, text.c_str());
  }
  // For a line of text under this place.
  [[nodiscard]] bool has_room_below(ImVec2 place) const {
    const bool within = place.x >= corner_.x && place.x <= corner_.x + size_.x;
    return within && place.y + 1.5F * ImGui::GetFontSize() < corner_.y + size_.y;
  }
  void line(ImVec2 from, ImVec2 to, ImU32 colour) const { list_->AddLine(from, to, colour, 1.0F); }

 private:
  static constexpr float kEdge = 4.0F;
  const WallCamera& camera_;
  ImVec2 corner_;
  ImVec2 size_;
  ImDrawList* list_;
};

// Every centimetre along the axis, on the floor in front.
void draw_ruler(const PanelContext& context, const WallCamera& camera, const Labels& labels,
                AxisExtent extent) {
  const ImU32 colour = context.theme.packed(Tone::kMuted);
  const auto first = static_cast<int>(std::ceil(extent.from_m / kRulerStepM));
  const auto last = static_cast<int>(std::floor(extent.to_m / kRulerStepM));
  // At most a dozen labels, however long the axis is.
  const int step = std::max(1, (last - first) / 12 + 1);
  for (int i = first; i <= last; i += step) {
    const double position_m = i * kRulerStepM;
    const ImVec2 place =
        labels.screen({camera.x_of(position_m), WallMeasures::kFloor, kRulerFront});
    if (!labels.has_room_below(place)) continue;
    labels.line(ImVec2(place.x, place.y - 3.0F), ImVec2(place.x, place.y + 3.0F), colour);
    labels.write(ImVec2(place.x, place.y + 0.9F * ImGui::GetFontSize()), colour,
                 fmt::format("{:g} mm", position_m * kMillimetresPerMetre));
  }
}

void draw_labels(const PanelContext& context, const WallPicture& picture, const WallCamera& camera,
                 const Labels& labels) {
  const Theme& theme = context.theme;
  const float line = ImGui::GetFontSize();
  for (const double face_m : picture.wall_faces_m) {
    const ImVec2 top =
        labels.screen({camera.x_of(face_m), WallMeasures::kWallTop, -WallMeasures::kWallHalfDepth});
    labels.write(ImVec2(top.x, top.y - 0.7F * line), theme.packed(Tone::kWall),
                 fmt::format("wall {:.4g} mm", face_m * kMillimetresPerMetre));
  }
  const float tip = camera.x_of(picture.handle_m);
  const float length = arrow_length(picture);
  if (length != 0.0F) {
    const ImVec2 arrow =
        labels.screen({tip + 0.5F * length, WallMeasures::kArrowHeight + 0.3F, 0.0F});
    labels.write(ImVec2(arrow.x, arrow.y - 0.4F * line),
                 theme.packed(picture.saturated ? Tone::kBad : Tone::kForce),
                 fmt::format("{:.2f} N{}", picture.force_n, picture.saturated ? "  limit" : ""));
  }
  if (picture.hand_m) {
    const float hand = camera.x_of(*picture.hand_m) - WallMeasures::kHandleRadius;
    const ImVec2 below = labels.screen({hand, -WallMeasures::kHandleRadius - 0.1F, 0.0F});
    labels.write(ImVec2(below.x, below.y + 0.5F * line), theme.packed(Tone::kHand), "hand");
  }
}

void draw_readout(const PanelContext& context, ImVec2 corner) {
  const Sample& sample = context.snapshot.sample;
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
  ImGui::PushFont(context.theme.fonts.digits, kSmallFontSize);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                      ImVec2(style.ItemSpacing.x, 0.25F * style.ItemSpacing.y));
  ImGui::SetCursorScreenPos(
      ImVec2(corner.x + style.WindowPadding.x, corner.y + style.WindowPadding.y));
  ImGui::BeginGroup();
  row("position", sample.position_m * kMillimetresPerMetre, 3, "mm", true);
  row("penetration", sample.penetration_m * kMillimetresPerMetre, 3, "mm", contact);
  row("force", sample.force_n, 3, "N", true);
  row("stiffness", sample.stiffness_n_per_m / 1e3, 2, "kN/m", contact);
  ImGui::EndGroup();
  ImGui::PopStyleVar();
  ImGui::PopFont();
}

// While the button is down the pointer leads; then the script again, or the hand stays.
void lead_hand(const PanelContext& context, const WallCamera& camera, ImVec2 corner, bool held) {
  UiState& state = context.state;
  TransientState& transient = state.transient;
  const auto& hand = context.session.scene().hand;
  if (held && !hand) {
    tell(state, MessageKind::kNote, "this scene has no hand that the pointer could lead");
    return;
  }
  if (held) {
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    const double position_m = camera.position_at({pointer.x - corner.x, pointer.y - corner.y});
    if (!transient.dragging_hand || transient.hand_m != position_m)
      context.session.lead_hand(position_m);
    transient.hand_m = position_m;
    transient.dragging_hand = true;
  } else if (transient.dragging_hand) {
    transient.dragging_hand = false;
    if (state.persisted.hand_stays_where_released || (hand && hand->follows_mouse)) return;
    transient.hand_m.reset();
    context.session.lead_hand(std::nullopt);
  }
}

}  // namespace

WallCamera wall_view_camera(const Scene& scene, ImVec2 size) {
  return {axis_extent(scene), size.x, size.y};
}

void draw_wall_view(const PanelContext& context, WallRenderer& renderer) {
  const Scene& scene = context.session.scene();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 available = ImGui::GetContentRegionAvail();
  const ImVec2 size(std::max(available.x, 1.0F), std::max(available.y, 1.0F));
  const WallCamera camera = wall_view_camera(scene, size);
  const WallPicture picture = wall_picture(scene, context.snapshot.sample);
  const ImVec2 pixels = ImGui::GetIO().DisplayFramebufferScale;
  const GLuint texture = renderer.draw(picture, camera, context.theme,
                                       std::max(1, static_cast<int>(size.x * pixels.x)),
                                       std::max(1, static_cast<int>(size.y * pixels.y)));
  ImGui::GetWindowDrawList()->AddImage(ImTextureRef(static_cast<ImTextureID>(texture)), corner,
                                       ImVec2(corner.x + size.x, corner.y + size.y),
                                       ImVec2(0.0F, 1.0F), ImVec2(1.0F, 0.0F));
  ImGui::InvisibleButton("##wall-view", size);
  remember_item(context.state, "wall view");
  lead_hand(context, camera, corner, ImGui::IsItemActive());
  if (ImGui::IsItemHovered() && scene.hand) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);

  const Labels labels(camera, corner, size);
  ImGui::PushFont(nullptr, kSmallFontSize);
  draw_ruler(context, camera, labels, axis_extent(scene));
  draw_labels(context, picture, camera, labels);
  ImGui::PopFont();
  draw_readout(context, corner);
}

}  // namespace hapticwall::ui
