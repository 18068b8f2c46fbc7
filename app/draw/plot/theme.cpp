#include "app/draw/plot/theme.h"

#include <implot.h>

#include <algorithm>
#include <string_view>

#include "embedded_fonts.h"

namespace hapticwall::draw {
namespace {

using Colours = std::array<ImVec4, kToneCount>;

constexpr Colours colours_of(const std::array<unsigned, kToneCount>& rgb) {
  const auto part = [](unsigned value) { return static_cast<float>(value & 0xFFU) / 255.0F; };
  Colours colours{};
  for (std::size_t i = 0; i < colours.size(); ++i)
    colours[i] = {part(rgb[i] >> 16U), part(rgb[i] >> 8U), part(rgb[i]), 1.0F};
  return colours;
}

// Colours in the order of Tone. Signals have the hues of Okabe and Ito, Color Universal Design
// (2008), which the colour-blind tell apart; lighter or darker where the background asks for it.
// Text, good, warning and bad also differ in lightness
// (tests/app/draw/plot/verdict_colours_test.cpp).
constexpr Colours kScreenColours =
    colours_of({0xDCE3EA, 0x8E9AA8, 0x2C343F, 0x12161B, 0x191E25, 0x4FB6C9, 0x6CC08B, 0xF1C064,
                0xF0716B, 0x56B4E9, 0xD98CB8, 0x5FBFA8, 0xE69F00, 0x5C6B7E, 0x22B88A, 0x56B4E9,
                0xE8702A, 0x22B88A, 0xDCE3EA});
// Colours for light rooms: the same hues, dark enough to be read on white.
constexpr Colours kLightColours =
    colours_of({0x1B222A, 0x56616D, 0xDDE2E8, 0xF2F4F7, 0xFFFFFF, 0x0B6E86, 0x0C4B2A, 0x9A6000,
                0xAA1A12, 0x0072B2, 0x9E4A78, 0x007A68, 0x8F5C00, 0x7E8B9A, 0x007A5A, 0x0072B2,
                0xC65200, 0x007A5A, 0x1B222A});
constexpr Colours kPrintColours =
    colours_of({0x1A1D21, 0x4A525C, 0xC9CFD6, 0xFFFFFF, 0xFFFFFF, 0x0072B2, 0x0C4B2A, 0xA06600,
                0xAA1A12, 0x0072B2, 0xA85584, 0x00835F, 0xA86B00, 0x8F9BA9, 0x007F5F, 0x0072B2,
                0xD55E00, 0x007F5F, 0x1A1D21});

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
  colours[ImGuiCol_WindowBg] = theme.colour(Tone::kPanel);
  colours[ImGuiCol_ChildBg] = with_alpha(theme.colour(Tone::kPanel), 0.0F);
  colours[ImGuiCol_PopupBg] = raised(theme);
  colours[ImGuiCol_Border] = with_alpha(text, 0.14F);
  colours[ImGuiCol_ModalWindowDimBg] = with_alpha(theme.colour(Tone::kBackground), 0.6F);
  colours[ImGuiCol_FrameBg] = frame;
  colours[ImGuiCol_FrameBgHovered] = with_alpha(accent, 0.30F);
  colours[ImGuiCol_FrameBgActive] = with_alpha(accent, 0.40F);
  colours[ImGuiCol_ScrollbarBg] = with_alpha(text, 0.0F);
  colours[ImGuiCol_ScrollbarGrab] = with_alpha(text, 0.18F);
  colours[ImGuiCol_CheckMark] = accent;
  colours[ImGuiCol_CheckboxSelectedBg] = with_alpha(accent, 0.22F);
  colours[ImGuiCol_SliderGrab] = with_alpha(accent, 0.80F);
  colours[ImGuiCol_SliderGrabActive] = accent;
  colours[ImGuiCol_Button] = frame;
  colours[ImGuiCol_ButtonHovered] = with_alpha(accent, 0.35F);
  colours[ImGuiCol_ButtonActive] = with_alpha(accent, 0.55F);
  colours[ImGuiCol_Header] = with_alpha(accent, 0.22F);
  colours[ImGuiCol_HeaderHovered] = with_alpha(accent, 0.32F);
  colours[ImGuiCol_HeaderActive] = with_alpha(accent, 0.42F);
  colours[ImGuiCol_Separator] = with_alpha(text, 0.10F);
  colours[ImGuiCol_SeparatorHovered] = with_alpha(accent, 0.60F);
  colours[ImGuiCol_SeparatorActive] = accent;
  colours[ImGuiCol_ResizeGrip] = with_alpha(text, 0.0F);
  colours[ImGuiCol_ResizeGripHovered] = with_alpha(accent, 0.60F);
  colours[ImGuiCol_ResizeGripActive] = accent;
  for (const ImGuiCol title : {ImGuiCol_TitleBg, ImGuiCol_TitleBgActive, ImGuiCol_TitleBgCollapsed,
                               ImGuiCol_Tab, ImGuiCol_TabDimmed, ImGuiCol_DockingEmptyBg})
    colours[title] = theme.colour(Tone::kBackground);
  for (const ImGuiCol tab : {ImGuiCol_TabSelected, ImGuiCol_TabDimmedSelected})
    colours[tab] = mixed(theme.colour(Tone::kPanel), accent, 0.22F);
  colours[ImGuiCol_TabHovered] = mixed(theme.colour(Tone::kPanel), accent, 0.32F);
  colours[ImGuiCol_TabSelectedOverline] = colours[ImGuiCol_TabDimmedSelectedOverline] = accent;
  colours[ImGuiCol_DockingPreview] = with_alpha(accent, 0.40F);
  colours[ImGuiCol_NavCursor] = accent;
  colours[ImGuiCol_TextSelectedBg] = with_alpha(accent, 0.35F);
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
  style.WindowMenuButtonPosition = ImGuiDir_None;
  style.TabMinWidthShrink = 38.0F;
  style.DockingNodeHasCloseButton = false;  // every tab has one
  style.DockingSeparatorSize = 6.0F;
  style.ScaleAllSizes(scale);
  // A part of the window without a border has no padding either.
  style.ChildBorderSize = std::max(style.ChildBorderSize, 1.0F);
  style.PopupBorderSize = std::max(style.PopupBorderSize, 1.0F);
  style.FontSizeBase = kFontSize;
  style.FontScaleMain = scale;
}

void set_plot_style(const Theme& theme, float scale) {
  ImPlotStyle& style = ImPlot::GetStyle();
  style.Colors[ImPlotCol_FrameBg] = ImVec4(0.0F, 0.0F, 0.0F, 0.0F);
  style.Colors[ImPlotCol_PlotBg] = ImVec4(0.0F, 0.0F, 0.0F, 0.0F);
  style.Colors[ImPlotCol_PlotBorder] = theme.colour(Tone::kFaint);
  style.Colors[ImPlotCol_AxisText] = theme.colour(Tone::kMuted);
  style.Colors[ImPlotCol_AxisGrid] = with_alpha(theme.colour(Tone::kMuted), 0.22F);
  style.Colors[ImPlotCol_InlayText] = theme.colour(Tone::kText);
  style.PlotMinSize = {60.0F * scale, 40.0F * scale};
  style.PlotPadding = {2.0F * scale, 4.0F * scale};
  style.LabelPadding = {6.0F * scale, 4.0F * scale};
  style.MajorTickLen = {4.0F * scale, 4.0F * scale};
  style.MinorTickLen = {0.0F, 0.0F};
  style.MinorAlpha = 0.55F;
  // 0.3 pt on paper; a line of one dot would vanish in a print.
  if (!theme.prints()) return;
  style.PlotBorderSize = 0.5F * scale;
  style.MajorGridSize = {0.5F * scale, 0.5F * scale};
}

}  // namespace

ImVec4 mixed(const ImVec4& first, const ImVec4& second, float share) {
  const auto between = [share](float a, float b) { return a + share * (b - a); };
  return {between(first.x, second.x), between(first.y, second.y), between(first.z, second.z),
          between(first.w, second.w)};
}

// A little lighter than a dark panel; in the light look the border separates it.
ImVec4 raised(const Theme& theme) {
  constexpr float kLift = 0.05F;
  const ImVec4 panel = theme.colour(Tone::kPanel);
  return panel.x < 0.5F ? mixed(panel, theme.colour(Tone::kText), kLift) : panel;
}

void begin_raised(const Theme& theme) {
  constexpr float kBorderAlpha = 0.28F;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ImGui::GetStyle().ChildRounding);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, raised(theme));
  ImGui::PushStyleColor(ImGuiCol_Border, with_alpha(theme.colour(Tone::kText), kBorderAlpha));
}

void end_raised() {
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar(2);
}

void begin_choice(const Theme& theme, bool chosen) {
  constexpr float kChosenAlpha = 0.30F;
  constexpr float kEdgeAlpha = 0.45F;
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 1.0F);
  ImGui::PushStyleColor(ImGuiCol_Border, chosen ? theme.packed(Tone::kAccent)
                                                : theme.packed(Tone::kMuted, kEdgeAlpha));
  ImGui::PushStyleColor(ImGuiCol_Button,
                        chosen ? theme.packed(Tone::kAccent, kChosenAlpha) : IM_COL32_BLACK_TRANS);
}

void end_choice() {
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar();
}

float button_width(const char* label) {
  return ImGui::CalcTextSize(label, nullptr, true).x + 2.0F * ImGui::GetStyle().FramePadding.x;
}

void align_right(float width) {
  const float free = ImGui::GetContentRegionAvail().x - width;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(free, 0.0F));
}

void strong_text(const Theme& theme, std::string_view text, float size) {
  const FontScope font(theme.fonts.strong, size);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
}

void right_aligned_text(std::string_view text) {
  const char* end = text.data() + text.size();
  align_right(ImGui::CalcTextSize(text.data(), end).x);
  ImGui::TextUnformatted(text.data(), end);
}

void wrapped_text(const ImVec4& colour, std::string_view text) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

const std::array<ImVec4, kToneCount>& theme_colours(Look look) {
  if (look == Look::kPrint) return kPrintColours;
  return look == Look::kLight ? kLightColours : kScreenColours;
}

Theme apply_theme(Look look, float scale) {
  Theme theme;
  theme.fonts.text = load_font("Inter-Regular.otf");
  theme.fonts.strong = load_font("Inter-SemiBold.otf");
  theme.fonts.digits =
      look == Look::kPrint ? theme.fonts.text : load_font("JetBrainsMono-Regular.ttf");
  restyle(theme, look, scale);
  return theme;
}

void restyle(Theme& theme, Look look, float scale) {
  theme.look = look;
  theme.colours = theme_colours(look);
  ImGui::GetStyle() = ImGuiStyle();
  set_colours(theme, look);
  set_spacing(scale);
  set_plot_style(theme, scale);
}

}  // namespace hapticwall::draw
