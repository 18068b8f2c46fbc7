#include "app/draw/figure/map_legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "app/draw/axis/legend_keys.h"
#include "app/draw/axis/symbol_text.h"
#include "app/draw/axis/ticks.h"
#include "app/draw/figure/verdict_colours.h"
#include "core/run/metrics.h"
#include "core/units.h"

namespace hapticwall::draw {
namespace {

constexpr float kKeyGapEms = 1.4F;
constexpr float kBarEms = 16.0F;  // width of the colour bar, where there is room
constexpr float kBarHeightEms = 0.7F;

// A box of a colour, or a line of a weight, and its meaning; the next item stands beside it.
void draw_key(const Theme& theme, ImU32 colour, const char* text, float line_weight = 0.0F) {
  const float side = ImGui::GetFontSize();
  begin_key(1.4F * side + symbol_text_size(text).x);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (line_weight > 0.0F) {
    list.AddLine(ImVec2(at.x, at.y + 0.6F * side), ImVec2(at.x + side, at.y + 0.6F * side), colour,
                 line_weight);
  } else {
    list.AddRectFilled(ImVec2(at.x, at.y + 0.1F * side), ImVec2(at.x + 0.9F * side, at.y + side),
                       colour);
  }
  ImGui::Dummy(ImVec2(side, side));
  ImGui::SameLine(0.0F, 0.4F * side);
  draw_key_text(theme.packed(Tone::kText), text, kKeyGapEms * side);
}

bool has(std::span<const MapMetrics> figures, Verdict verdict) {
  return std::ranges::any_of(figures,
                             [&](const MapMetrics& each) { return each.verdict == verdict; });
}

void draw_verdict_keys(const Theme& theme, std::span<const MapMetrics> figures) {
  if (has(figures, Verdict::kSettled) || has(figures, Verdict::kMoving))
    draw_key(theme, verdict_area(Verdict::kSettled), "settled or moving");
  if (has(figures, Verdict::kNoContact))
    draw_key(theme, verdict_area(Verdict::kNoContact), "no contact");
  if (has(figures, Verdict::kActive)) {
    const std::string text =
        fmt::format("active: gives more than {:g} mW", kMaxGivenW * kMilliwattsPerWatt);
    draw_key(theme, verdict_area(Verdict::kActive), text.c_str());
  }
  if (has(figures, Verdict::kBuzzing)) {
    const std::string text = fmt::format("buzzing: still, chatter above {:g} N", kMaxChatterN);
    draw_key(theme, verdict_area(Verdict::kBuzzing), text.c_str());
  }
  if (has(figures, Verdict::kDiverged))
    draw_key(theme, verdict_area(Verdict::kDiverged), "diverged");
}

// The amplitudes of an oscillation in their colours, with a title at the left and numbers below.
void draw_colour_bar(const Theme& theme) {
  constexpr const char* kTitle = "oscillating, mm peak to peak";
  constexpr std::array kShownM{kSettledPeakToPeakM, 1e-3, 1e-2, kHottestM};
  constexpr int kSteps = 96;
  ImGui::NewLine();
  ImGui::TextUnformatted(kTitle);
  ImGui::SameLine(0.0F, ems(0.8F));
  if (ImGui::GetContentRegionAvail().x < ems(0.5F * kBarEms)) ImGui::NewLine();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float last = ImGui::CalcTextSize("100").x;  // half of it reaches beyond the bar
  const float width = std::min(ems(kBarEms), ImGui::GetContentRegionAvail().x - last);
  const float height = ems(kBarHeightEms);
  const float top = at.y + ems(0.2F);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (int i = 0; i < kSteps; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(kSteps);
    const double amplitude_m =
        kSettledPeakToPeakM * std::pow(kHottestM / kSettledPeakToPeakM, static_cast<double>(share));
    // Each step reaches under the following ones, so that no gap shows.
    list.AddRectFilled({at.x + share * width, top}, {at.x + width, top + height},
                       oscillating_colour(amplitude_m));
  }
  for (const double amplitude_m : kShownM) {
    const double share =
        std::log(amplitude_m / kSettledPeakToPeakM) / std::log(kHottestM / kSettledPeakToPeakM);
    const float x = at.x + static_cast<float>(share) * width;
    list.AddLine({x, top + height}, {x, top + height + ems(0.25F)}, theme.packed(Tone::kText),
                 ems(0.07F));
    const std::string text = fmt::format("{:g}", amplitude_m * kMillimetresPerMetre);
    const float left = share == 0.0 ? at.x : x - 0.5F * ImGui::CalcTextSize(text.c_str()).x;
    list.AddText({left, top + height + ems(0.25F)}, theme.packed(Tone::kText), text.c_str());
  }
  ImGui::Dummy({width + last, height + ems(1.6F)});
}

}  // namespace

void draw_map_legend(const Theme& theme, std::span<const MapMetrics> figures,
                     std::span<const BoundLines> bounds, float scale) {
  const FontScope font(nullptr, kSmallFontSize);
  draw_verdict_keys(theme, figures);
  if (has(figures, Verdict::kOscillating)) draw_colour_bar(theme);
  for (const BoundLines& bound : bounds) {
    const BoundStyle& style = bound_styles()[bound.bound];
    draw_key(theme, style.colour, style.name, style.weight * scale);
  }
  const bool theory = !bounds.empty() && bound_styles()[bounds.front().bound].bound != nullptr;
  const char* note = theory ? "bounds of the bare wall, without an algorithm"
                            : "this map has no theoretical bound";
  begin_key(ImGui::CalcTextSize(note).x);
  wrapped_symbol_text(theme.packed(Tone::kMuted), note);
}

}  // namespace hapticwall::draw
