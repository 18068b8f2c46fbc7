// Colours by their meaning. This file includes no Dear ImGui, so that results can name a colour.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/file/text/verdict.h"

namespace hapticwall::draw {

// Colours by meaning, equal in all plots and pages.
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

// The grades are told apart by lightness, too.
[[nodiscard]] constexpr Tone verdict_tone(Verdict verdict) {
  constexpr std::array kTones{Tone::kGood, Tone::kText, Tone::kWarning, Tone::kBad};
  return kTones.at(static_cast<std::size_t>(file::grade_of(verdict)));
}

}  // namespace hapticwall::draw
