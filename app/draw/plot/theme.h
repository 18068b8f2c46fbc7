// Colours, fonts and spacing of the window, and of the printed figure.
#pragma once

#include <imgui.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "app/draw/plot/tone.h"

namespace hapticwall::draw {

// Dark screen, printed figure, light screen.
enum class Look : std::uint8_t { kScreen, kPrint, kLight };

struct Fonts {
  ImFont* text = nullptr;
  ImFont* strong = nullptr;
  ImFont* digits = nullptr;  // font of digits with constant width; in print that of the text
};

struct Theme {
  std::array<ImVec4, kToneCount> colours{};
  Fonts fonts;
  Look look = Look::kScreen;

  [[nodiscard]] bool prints() const { return look == Look::kPrint; }
  [[nodiscard]] const ImVec4& colour(Tone tone) const {
    return colours[static_cast<std::size_t>(tone)];
  }
  [[nodiscard]] ImU32 packed(Tone tone, float alpha = 1.0F) const {
    const ImVec4& value = colour(tone);
    return ImGui::ColorConvertFloat4ToU32({value.x, value.y, value.z, alpha * value.w});
  }
};

[[nodiscard]] const std::array<ImVec4, kToneCount>& theme_colours(Look look);

[[nodiscard]] constexpr ImVec4 with_alpha(const ImVec4& colour, float alpha) {
  return {colour.x, colour.y, colour.z, alpha};
}
// Interpolates between two colours; share 0 is the first.
[[nodiscard]] ImVec4 mixed(const ImVec4& first, const ImVec4& second, float share);

inline constexpr float kFontSize = 15.0F;  // pixels at scale 1
inline constexpr float kSmallFontSize = 13.0F;
inline constexpr float kTitleFontSize = 17.0F;

// Loads the embedded fonts into the current ImGui context and sets the styles of ImGui and ImPlot.
// `scale` enlarges everything (screens with many pixels per inch).
[[nodiscard]] Theme apply_theme(Look look, float scale);

// apply_theme() for a theme that has its fonts, between two frames.
void restyle(Theme& theme, Look look, float scale);

// The background of popups over the window.
[[nodiscard]] ImVec4 raised(const Theme& theme);
// Around the ImGui window of a popup.
void begin_raised(const Theme& theme);
void end_raised();

// Around a button that is a toggle: an outline, and filled while it is `chosen`.
void begin_choice(const Theme& theme, bool chosen);
void end_choice();

// `count` times the size of the text, in pixels.
[[nodiscard]] inline float ems(float count) { return count * ImGui::GetFontSize(); }
[[nodiscard]] float button_width(const char* label);  // ignores the part from "##" on
// Moves the cursor to the right, so that an item of this width ends at the edge of its region.
void align_right(float width);

// A font until the end of the block; `size` 0 keeps the size.
class FontScope {
 public:
  FontScope(ImFont* font, float size) { ImGui::PushFont(font, size); }
  FontScope(const FontScope&) = delete;
  FontScope& operator=(const FontScope&) = delete;
  ~FontScope() { ImGui::PopFont(); }
};

void strong_text(const Theme& theme, std::string_view text, float size = 0.0F);
void right_aligned_text(std::string_view text);
void wrapped_text(const ImVec4& colour, std::string_view text);

}  // namespace hapticwall::draw
