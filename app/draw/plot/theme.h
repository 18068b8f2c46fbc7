// Colours, fonts and spacing of the window, and of the printed figure.
#pragma once

#include <imgui.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace hapticwall::draw {

// Colours by meaning, the same everywhere.
enum class Tone : std::uint8_t {
  kText,
  kMuted,  // secondary text, axes
  kFaint,  // frames, grid
  kBackground,
  kPanel,
  kAccent,  // chosen or running
  kGood,
  kWarning,
  kBad,
  kPosition,  // measured position
  kHand,      // the hand's intended position
  kWall,
  kForce,      // F_d
  kWallForce,  // F_e
  kStiffness,
  kObserver,  // Eq. 6
  kHold,      // Eq. 9
  kScv,       // Eq. 10
  kBudget,    // -T Σ b v²
};
inline constexpr std::size_t kToneCount = 19;

// The dark one of the screen, the one of printed figures, and the light one of the screen.
enum class Look : std::uint8_t { kScreen, kPrint, kLight };

struct Fonts {
  ImFont* text = nullptr;
  ImFont* strong = nullptr;
  ImFont* digits = nullptr;  // of constant width
};

struct Theme {
  std::array<ImVec4, kToneCount> colours{};
  Fonts fonts;

  [[nodiscard]] const ImVec4& colour(Tone tone) const {
    return colours[static_cast<std::size_t>(tone)];
  }
  [[nodiscard]] ImU32 packed(Tone tone, float alpha = 1.0F) const {
    ImVec4 value = colour(tone);
    value.w *= alpha;
    return ImGui::ColorConvertFloat4ToU32(value);
  }
};

[[nodiscard]] const std::array<ImVec4, kToneCount>& theme_colours(Look look);

inline constexpr float kFontSize = 15.0F;  // pixels at scale 1
inline constexpr float kSmallFontSize = 13.0F;
inline constexpr float kTitleFontSize = 17.0F;

// Loads the embedded fonts into the current ImGui context and sets the styles of ImGui and ImPlot.
// `scale` enlarges everything (screens with many pixels per inch).
[[nodiscard]] Theme apply_theme(Look look, float scale);

// The same for a theme that has its fonts, between two frames.
void restyle(Theme& theme, Look look, float scale);

// The background of popups over the window.
[[nodiscard]] ImVec4 raised(const Theme& theme);
// Around the ImGui window of a popup.
void begin_raised(const Theme& theme);
void end_raised();

}  // namespace hapticwall::draw
