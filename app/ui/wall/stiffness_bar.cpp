#include "app/ui/wall/stiffness_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace hapticwall::ui {

StiffnessBar::StiffnessBar(const LabelPen& pen, const WallPicture& picture)
    : pen_(pen),
      picture_(picture),
      scale_(stiffness_scale(picture)),
      line_(ImGui::GetFontSize()),
      length_(std::min(0.45F * pen.area().size.y, 7.0F * line_)),
      left_(pen.area().corner.x + pen.area().size.x - 1.4F * line_),
      right_(left_ + 0.6F * line_),
      bottom_(pen.area().corner.y + pen.area().size.y - 1.2F * line_) {}

draw::PixelBox StiffnessBar::area() const {
  return {ImVec2(left_ - 5.6F * line_, bottom_ - length_ - 2.2F * line_),
          ImVec2(right_ + 0.4F * line_, bottom_ + 0.8F * line_)};
}

void StiffnessBar::draw() {
  draw_colours();
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const ShownStiffness& shown = picture_.shown.at(axis);
    if (shown.strength <= 0.0) continue;
    const char* name = axis == 0 ? "x " : "y ";
    mark(shown.n_per_m);
    write(shown.n_per_m, draw::Tone::kText,
          (picture_.two_axes ? name : "") + stiffness_text(shown.n_per_m));
  }
  for (const double end : {scale_.softest_n_per_m(), scale_.stiffest_n_per_m})
    write(end, draw::Tone::kMuted, stiffness_text(end));
}

void StiffnessBar::draw_colours() const {
  constexpr int kSteps = 16;
  const float part = length_ / kSteps;
  pen_.list()->AddRectFilled(area().from, area().to, pen_.theme().packed(draw::Tone::kPanel, 0.85F),
                             4.0F);
  const char* title = "stiffness";
  pen_.list()->AddText(
      ImVec2(right_ - ImGui::CalcTextSize(title).x, bottom_ - length_ - 1.9F * line_),
      pen_.theme().packed(draw::Tone::kMuted), title);
  const auto shade = [&](int step) {
    const float share = static_cast<float>(step) / kSteps;
    return ImGui::ColorConvertFloat4ToU32(stiffness_colour(pen_.theme(), share));
  };
  for (int step = 0; step < kSteps; ++step) {
    const float lower = bottom_ - part * static_cast<float>(step);
    pen_.list()->AddRectFilledMultiColor(ImVec2(left_, lower - part), ImVec2(right_, lower),
                                         shade(step + 1), shade(step + 1), shade(step),
                                         shade(step));
  }
}

void StiffnessBar::mark(double n_per_m) const {
  const float y = level(n_per_m);
  pen_.list()->AddTriangleFilled(
      ImVec2(left_ - 0.1F * line_, y), ImVec2(left_ - 0.55F * line_, y - 0.3F * line_),
      ImVec2(left_ - 0.55F * line_, y + 0.3F * line_), pen_.theme().packed(draw::Tone::kText));
}

// Writes left of the bar, unless another text is there.
void StiffnessBar::write(double n_per_m, draw::Tone tone, const std::string& text) {
  const float y = level(n_per_m);
  const auto is_near = [&](float other) { return std::abs(other - y) < 1.1F * line_; };
  if (std::ranges::any_of(taken_, is_near)) return;
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
  pen_.list()->AddText(ImVec2(left_ - 0.8F * line_ - extent.x, y - 0.5F * extent.y),
                       pen_.theme().packed(tone), text.c_str());
  taken_.push_back(y);
}

float StiffnessBar::level(double n_per_m) const {
  return bottom_ - length_ * scale_.share(n_per_m);
}

std::string stiffness_text(double n_per_m) {
  if (n_per_m >= kNewtonsPerKilonewton)
    return fmt::format("{:.3g} kN/m", n_per_m / kNewtonsPerKilonewton);
  return fmt::format("{:.3g} N/m", n_per_m);
}

}  // namespace hapticwall::ui
