#include "app/ui/first/wall_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/draw/wall/wall_trail.h"
#include "app/ui/page/magnifier.h"
#include "app/ui/panel/energy_lamp_view.h"
#include "app/ui/panel/tour_strip.h"
#include "app/ui/panel/verdict_view.h"
#include "app/ui/panel/wall_view.h"
#include "app/ui/state/comparing.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/widgets.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::ui {
namespace {

constexpr float kPaddingEms = 1.0F;
constexpr float kTrailNameEms = 6.0F;  // height of a trail that has room for its name
constexpr float kLowCardEms = 9.0F;    // height of the rows below the verdict
constexpr float kStripShare = 0.42F;   // of the width inside the padding
constexpr float kStripGapEms = 0.8F;   // between the picture and the contact
constexpr float kVerdictSize = 38.0F;  // pixels at scale 1
constexpr float kPresentedVerdictSize = 40.0F;
constexpr float kPresentedNameSize = 20.0F;
constexpr float kNameGapShare = 0.2F;  // below the name, of its line
constexpr float kCornerRadius = 8.0F;
constexpr float kLeadingEdge = 2.0F;  // width of the frame of the session's card

// Sentence about the energy where something is wrong, and the algorithm's idea elsewhere.
std::string sentence_of(const CardWall& wall) {
  if (wall.story != nullptr && lamp_tone(*wall.story, wall.tail) != draw::Tone::kMuted)
    return plain_sentence(*wall.story);
  std::string idea(algorithms()[wall.algorithm.index].idea);
  if (!idea.empty()) idea.front() = static_cast<char>(std::toupper(idea.front()));
  return idea + ".";
}

// The whole card takes the click that makes its wall the session.
void take_click(const FirstParts& parts, const CardWall& wall, const draw::PixelBox& box) {
  if (wall.leads) return;
  ImGui::SetCursorScreenPos(box.from);
  ImGui::SetNextItemAllowOverlap();
  const std::string name = fmt::format("##lead {}", compare::slot_name(wall.slot));
  const ImVec2 size(box.to.x - box.from.x, box.to.y - box.from.y);
  if (ImGui::InvisibleButton(name.c_str(), size, ImGuiButtonFlags_EnableNav))
    choose_slot(parts.page.context, wall.slot);
  if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
}

void draw_frame(const PanelContext& context, const CardWall& wall, const draw::PixelBox& box) {
  const float scale = ImGui::GetStyle().FontScaleMain;
  const draw::Tone edge = wall.leads ? draw::tail_tone(wall.tail) : draw::Tone::kFaint;
  ImGui::GetWindowDrawList()->AddRect(box.from, box.to, context.theme.packed(edge),
                                      kCornerRadius * scale, 0,
                                      (wall.leads ? kLeadingEdge : 1.0F) * scale);
}

// Number and name at the left, the role at the right. Returns the lower edge.
float draw_name(const PanelContext& context, const CardWall& wall, const draw::PixelBox& inside) {
  const bool presents = context.window.presents;
  const draw::FontScope name_font(nullptr, presents ? kPresentedNameSize : 0.0F);
  const float below = inside.from.y + (1.0F + kNameGapShare) * ImGui::GetTextLineHeight();
  ImGui::SetCursorScreenPos(inside.from);
  ImGui::TextColored(context.theme.colour(draw::Tone::kMuted), "%zu", wall.algorithm.index + 1);
  ImGui::SameLine();
  draw::strong_text(context.theme, spoken_name(wall.algorithm));
  if (presents) return below;
  const char* role = wall.leads ? "keys act here" : "click to choose";
  const draw::FontScope font(nullptr, draw::kSmallFontSize);
  ImGui::SetCursorScreenPos(
      ImVec2(inside.to.x - ImGui::CalcTextSize(role).x, inside.from.y + 1.0F));
  ImGui::TextColored(context.theme.colour(draw::Tone::kMuted), "%s", role);
  return below;
}

void draw_sentence(const PanelContext& context, const CardWall& wall,
                   const draw::PixelBox& inside) {
  const draw::FontScope font(nullptr, draw::kSmallFontSize);
  const std::string sentence = sentence_of(wall);
  ImGui::SetCursorScreenPos(ImVec2(inside.from.x, inside.to.y - ImGui::GetTextLineHeight()));
  ImGui::PushClipRect(inside.from, inside.to, true);
  ImGui::TextColored(context.theme.colour(draw::Tone::kMuted), "%s", sentence.c_str());
  ImGui::PopClipRect();
  if (wall.leads) point_at(context, TourPlace::kLamp);
  const AlgorithmDescription& algorithm = algorithms()[wall.algorithm.index];
  explain(fmt::format("{}\n\n{}", sentence, algorithm.equation));
}

// The wall as the eye sees it, and beside it the contact, magnified.
void draw_pictures(const FirstParts& parts, WallRenderer& renderer, const CardWall& wall,
                   const draw::PixelBox& box, double span_m) {
  const PanelContext& context = parts.page.context;
  const float strip = kStripShare * (box.to.x - box.from.x);
  const ViewArea view{
      box.from, ImVec2(box.to.x - box.from.x - strip - ems(kStripGapEms), box.to.y - box.from.y)};
  const WallCamera camera = draw_wall_pane(context, renderer, wall.scene, wall.picture, view);
  if (wall.leads) {
    ImGui::SetCursorScreenPos(view.corner);
    take_wall_pointer(context, camera, view);
  }
  const ImVec2 contact(box.to.x - strip, box.from.y);
  draw_contact(context.theme, {contact, box.to}, span_m,
               {wall.picture, wall.history, wall.newest, wall.scene.x().device.encoder_m, false},
               parts.first.magnified.at(static_cast<std::size_t>(wall.slot)), parts.first.trail);
  const draw::FontScope font(nullptr, draw::kSmallFontSize);
  const ImVec2 inset(0.5F * ems(kPaddingEms), 0.3F * ems(kPaddingEms));
  ImGui::SetCursorScreenPos(ImVec2(contact.x + inset.x, contact.y + inset.y));
  ImGui::TextColored(context.theme.colour(draw::Tone::kMuted), "contact ×%d",
                     context.wall.transient.magnification);
  const float trail = contact.y + draw::Strip::kTrailShare * (box.to.y - box.from.y);
  if (box.to.y - trail < kTrailNameEms * ImGui::GetFontSize()) return;
  ImGui::SetCursorScreenPos(ImVec2(contact.x + inset.x, trail + inset.y));
  ImGui::TextColored(context.theme.colour(draw::Tone::kMuted), "last\n%g s ↓", draw::kTrailS);
}

}  // namespace

std::string spoken_name(const AlgorithmSettings& algorithm) {
  std::string name = algorithm_name(algorithm);
  if (name == "none") return "no algorithm";
  std::ranges::replace(name, '-', ' ');
  return name;
}

float strip_width(float card_width) {
  return kStripShare * std::max(card_width - 2.0F * ems(kPaddingEms), 1.0F);
}

void draw_wall_card(const FirstParts& parts, WallRenderer& renderer, const CardWall& wall,
                    const draw::PixelBox& box, double span_m) {
  const PanelContext& context = parts.page.context;
  ImGui::PushID(static_cast<int>(static_cast<std::size_t>(wall.slot)));
  draw_frame(context, wall, box);
  take_click(parts, wall, box);
  const ImVec2 padding(ems(kPaddingEms), 0.8F * ems(kPaddingEms));
  const draw::PixelBox inside{ImVec2(box.from.x + padding.x, box.from.y + padding.y),
                              ImVec2(box.to.x - padding.x, box.to.y - padding.y)};
  const bool presents = context.window.presents;
  const float below_name = draw_name(context, wall, inside);
  ImGui::SetCursorScreenPos(ImVec2(inside.from.x, below_name));
  const float size = presents ? kPresentedVerdictSize : kVerdictSize;
  ImGui::BeginGroup();
  draw_verdict_words(context.theme, draw::verdict_words(wall.tail), size,
                     inside.to.x - inside.from.x);
  ImGui::EndGroup();
  if (wall.leads) point_at(context, TourPlace::kVerdict);
  const float top = below_name + 1.3F * size * ImGui::GetStyle().FontScaleMain;
  // A low card has its picture in the place of the sentence.
  const bool tells = !presents && inside.to.y - top > kLowCardEms * ImGui::GetFontSize();
  const float bottom = inside.to.y - (tells ? 1.7F * ImGui::GetTextLineHeight() : 0.0F);
  if (bottom > top) {
    draw_pictures(parts, renderer, wall, {ImVec2(inside.from.x, top), ImVec2(inside.to.x, bottom)},
                  span_m);
  }
  if (tells) draw_sentence(context, wall, inside);
  ImGui::PopID();
}

}  // namespace hapticwall::ui
