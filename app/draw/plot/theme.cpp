#include "app/draw/plot/theme.h"

#include <implot.h>

#include <algorithm>
#include <string_view>

#include "embedded_fonts.h"

namespace hapticwall::draw {
namespace {

constexpr ImVec4 rgb(unsigned hex) {
  return {static_cast<float>((hex >> 16U) & 0xFFU) / 255.0F,
          static_cast<float>((hex >> 8U) & 0xFFU) / 255.0F,
          static_cast<float>(hex & 0xFFU) / 255.0F, 1.0F};
}

// Some of `b` in `a`.
constexpr ImVec4 blended(const ImVec4& a, const ImVec4& b, float share) {
  const auto mix = [share](float x, float y) { return x + share * (y - x); };
  return {mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z), a.w};
}

constexpr ImVec4 faded(ImVec4 colour, float alpha) {
  colour.w = alpha;
  return colour;
}

// In the order of Tone.
constexpr std::array<ImVec4, kToneCount> kScreenColours{
    rgb(0xDCE3EA), rgb(0x8E9AA8), rgb(0x2C343F), rgb(0x12161B), rgb(0x191E25),
    rgb(0x4FB6C9), rgb(0x6CC08B), rgb(0xE9B45A), rgb(0xF0716B), rgb(0x6FB1FF),
    rgb(0xB7A3E8), rgb(0x5FBFA8), rgb(0xF2B25C), rgb(0x5C6B7E), rgb(0x8FD17F),
    rgb(0x6FB1FF), rgb(0xC792EA), rgb(0xF0716B), rgb(0xD9C56B)};
// For light rooms: the same hues, dark enough to be read on white.
constexpr std::array<ImVec4, kToneCount> kLightColours{
    rgb(0x1B222A), rgb(0x56616D), rgb(0xDDE2E8), rgb(0xF2F4F7), rgb(0xFFFFFF),
    rgb(0x0B6E86), rgb(0x1E7A45), rgb(0x8F5A00), rgb(0xB3261E), rgb(0x1F69B8),
    rgb(0x7455BE), rgb(0x007A68), rgb(0xB05400), rgb(0x6B7A8C), rgb(0x3B7D2B),
    rgb(0x1F69B8), rgb(0x8A3FB0), rgb(0xB3261E), rgb(0x857000)};
// Distinct in grey, too, and for the colour-blind.
constexpr std::array<ImVec4, kToneCount> kPrintColours{
    rgb(0x1A1D21), rgb(0x4A525C), rgb(0xC9CFD6), rgb(0xFFFFFF), rgb(0xFFFFFF),
    rgb(0x0072B2), rgb(0x2E7D4F), rgb(0xB36B00), rgb(0xC0392B), rgb(0x0060A8),
    rgb(0x8A6FC2), rgb(0x00835F), rgb(0xC65A00), rgb(0xA3AFBD), rgb(0x2E7D4F),
    rgb(0x0060A8), rgb(0x9340B5), rgb(0xC0392B), rgb(0xA88400)};

ImFont* load_font(std::string_view name) {
  for (const EmbeddedFile& file : embedded_fonts()) {
    if (file.name != name) continue;
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    // ImGui takes a pointer to non-const but does not write through it.
    void* bytes = const_cast<char*>(file.bytes.data());
    return ImGui::GetIO().Fonts->AddFontFromMemoryTTF(bytes, static_cast<int>(file.bytes.size()),
                                                      kFontSize, &config);
  }
  return ImGui::GetIO().Fonts->AddFontDefault();
}

void set_colours(const Theme& theme, Look look) {
  if (look == Look::kScreen) {
    ImGui::StyleColorsDark();
  } else {
    ImGui::StyleColorsLight();
  }
  const ImVec4 text = theme.colour(Tone::kText);
  const ImVec4 accent = theme.colour(Tone::kAccent);
  const ImVec4 frame = theme.colour(Tone::kFaint);
  auto& colours = ImGui::GetStyle().Colors;
  colours[ImGuiCol_Text] = text;
  colours[ImGuiCol_TextDisabled] = theme.colour(Tone::kMuted);
  colours[ImGuiCol_WindowBg] = theme.colour(Tone::kBackground);
  colours[ImGuiCol_ChildBg] = theme.colour(Tone::kPanel);
  colours[ImGuiCol_PopupBg] = raised(theme);
  colours[ImGuiCol_Border] = faded(text, 0.14F);
  colours[ImGuiCol_ModalWindowDimBg] = faded(theme.colour(Tone::kBackground), 0.6F);
  colours[ImGuiCol_FrameBg] = frame;
  colours[ImGuiCol_FrameBgHovered] = faded(accent, 0.30F);
  colours[ImGuiCol_FrameBgActive] = faded(accent, 0.40F);
  colours[ImGuiCol_ScrollbarBg] = faded(text, 0.0F);
  colours[ImGuiCol_ScrollbarGrab] = faded(text, 0.18F);
  colours[ImGuiCol_CheckMark] = accent;
  colours[ImGuiCol_CheckboxSelectedBg] = faded(accent, 0.22F);
  colours[ImGuiCol_SliderGrab] = faded(accent, 0.80F);
  colours[ImGuiCol_SliderGrabActive] = accent;
  colours[ImGuiCol_Button] = frame;
  colours[ImGuiCol_ButtonHovered] = faded(accent, 0.35F);
  colours[ImGuiCol_ButtonActive] = faded(accent, 0.55F);
  colours[ImGuiCol_Header] = faded(accent, 0.22F);
  colours[ImGuiCol_HeaderHovered] = faded(accent, 0.32F);
  colours[ImGuiCol_HeaderActive] = faded(accent, 0.42F);
  colours[ImGuiCol_Separator] = faded(text, 0.10F);
  colours[ImGuiCol_SeparatorHovered] = faded(accent, 0.60F);
  colours[ImGuiCol_SeparatorActive] = accent;
  colours[ImGuiCol_ResizeGrip] = faded(text, 0.0F);
  colours[ImGuiCol_NavCursor] = accent;
  colours[ImGuiCol_TextSelectedBg] = faded(accent, 0.35F);
}

void set_spacing(float scale) {
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowPadding = {14.0F, 12.0F};
  style.FramePadding = {8.0F, 4.0F};
  style.ItemSpacing = {8.0F, 6.0F};
  style.ItemInnerSpacing = {6.0F, 4.0F};
  style.WindowRounding = 0.0F;
  style.ChildRounding = 6.0F;
  style.FrameRounding = 4.0F;
  style.GrabRounding = 4.0F;
  style.PopupRounding = 6.0F;
  style.ScrollbarRounding = 6.0F;
  style.ScrollbarSize = 10.0F;
  style.GrabMinSize = 10.0F;
  style.WindowBorderSize = 0.0F;
  style.ChildBorderSize = 1.0F;
  style.DisabledAlpha = 0.45F;
  style.ScaleAllSizes(scale);
  // Without a border a part of the window has no padding either.
  style.ChildBorderSize = std::max(style.ChildBorderSize, 1.0F);
  style.PopupBorderSize = std::max(style.PopupBorderSize, 1.0F);
  style.FontSizeBase = kFontSize;
  style.FontScaleMain = scale;
}

void set_plot_style(const Theme& theme, float scale) {
  ImPlotStyle& style = ImPlot::GetStyle();
  style.Colors[ImPlotCol_FrameBg] = ImVec4(0.0F, 0.0F, 0.0F, 0.0F);
  style.Colors[ImPlotCol_PlotBg] = theme.colour(Tone::kBackground);
  style.Colors[ImPlotCol_PlotBorder] = theme.colour(Tone::kFaint);
  style.Colors[ImPlotCol_AxisText] = theme.colour(Tone::kMuted);
  style.Colors[ImPlotCol_AxisGrid] = faded(theme.colour(Tone::kMuted), 0.22F);
  style.Colors[ImPlotCol_InlayText] = theme.colour(Tone::kText);
  style.PlotMinSize = {60.0F * scale, 40.0F * scale};
  style.PlotPadding = {2.0F * scale, 4.0F * scale};
  style.LabelPadding = {6.0F * scale, 4.0F * scale};
  style.MajorTickLen = {4.0F * scale, 4.0F * scale};
  style.MinorTickLen = {0.0F, 0.0F};
  style.MinorAlpha = 0.55F;
}

}  // namespace

// A little lighter than a dark panel; in the light look the border separates it.
ImVec4 raised(const Theme& theme) {
  constexpr float kLift = 0.05F;
  const ImVec4 panel = theme.colour(Tone::kPanel);
  return panel.x < 0.5F ? blended(panel, theme.colour(Tone::kText), kLift) : panel;
}

void begin_raised(const Theme& theme) {
  constexpr float kBorderAlpha = 0.28F;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ImGui::GetStyle().ChildRounding);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, raised(theme));
  ImGui::PushStyleColor(ImGuiCol_Border, faded(theme.colour(Tone::kText), kBorderAlpha));
}

void end_raised() {
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar(2);
}

const std::array<ImVec4, kToneCount>& theme_colours(Look look) {
  switch (look) {
    case Look::kPrint:
      return kPrintColours;
    case Look::kLight:
      return kLightColours;
    case Look::kScreen:
      break;
  }
  return kScreenColours;
}

Theme apply_theme(Look look, float scale) {
  Theme theme;
  theme.fonts.text = load_font("Inter-Regular.otf");
  theme.fonts.strong = load_font("Inter-SemiBold.otf");
  theme.fonts.digits = load_font("JetBrainsMono-Regular.ttf");
  restyle(theme, look, scale);
  return theme;
}

void restyle(Theme& theme, Look look, float scale) {
  theme.colours = theme_colours(look);
  ImGui::GetStyle() = ImGuiStyle();
  set_colours(theme, look);
  set_spacing(scale);
  set_plot_style(theme, scale);
}

}  // namespace hapticwall::draw
