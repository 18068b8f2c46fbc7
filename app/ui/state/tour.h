// The tour of five lessons. A step is done when the verdict strip says so.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "app/ui/computed/tail.h"
#include "core/scene.h"
#include "core/study/energy_story.h"

namespace hapticwall::ui {

// Facts by which a step is judged.
struct Sight {
  const Scene& scene;
  const Tail& tail;
  const EnergyStory& story;
};

struct TourStep {
  std::string_view lesson;  // its title
  std::string_view text;    // what to do, and what the strip then says; also in README.md
  bool (*done)(const Sight& sight);
};
[[nodiscard]] std::span<const TourStep> tour_steps();

inline constexpr std::string_view kTourScene = "press";
inline constexpr std::string_view kTourAlgorithm = "none";  // that it begins with

}  // namespace hapticwall::ui
