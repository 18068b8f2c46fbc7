// The tour of five lessons. A step is done when the verdict strip says so.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "app/draw/plot/tail.h"
#include "core/scene.h"
#include "core/study/energy_story.h"

namespace hapticwall::ui {

// Facts by which a step is judged.
struct Sight {
  const Scene& scene;
  const draw::Tail& tail;
  const EnergyStory& story;
};

struct TourStep {
  std::string_view lesson;  // title of the lesson
  std::string_view text;    // instruction, and the expected text of the strip; also in README.md
  bool (*done)(const Sight& sight);
};
[[nodiscard]] std::span<const TourStep> tour_steps();

inline constexpr std::string_view kTourScene = "press";
inline constexpr std::string_view kTourAlgorithm = "none";  // algorithm at the start

}  // namespace hapticwall::ui
