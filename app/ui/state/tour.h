// The tour of five lessons and its end. A lesson is seen when its keys were pressed in order and
// the verdict said what its text says.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "app/draw/verdict/tail.h"
#include "core/scene.h"
#include "core/study/energy_story.h"

namespace hapticwall::ui {

// Facts by which a step is judged.
struct Sight {
  const Scene& scene;
  const draw::Tail& tail;
  const EnergyStory& story;
};

// A key of a step, and what is to be seen before the next one.
struct TourMove {
  std::string_view algorithm;  // the one whose key is pressed; empty: R
  bool (*seen)(const Sight& sight);
};

// Places of the window that a step points at, besides the key of its present move.
enum class TourPlace : std::uint8_t { kVerdict, kLamp, kWall, kMore };

struct TourStep {
  std::string_view lesson;                // title of the lesson
  std::string_view text;                  // keys, and the expected verdict; also in README.md
  std::span<const TourMove> moves;        // in order; none: the end of the tour
  std::span<const TourPlace> looks;       // the places that the text speaks of
  std::string_view text_without_files{};  // in the place of `text` in a browser; empty: the same
};
// The lessons, and the end.
[[nodiscard]] std::span<const TourStep> tour_steps();

inline constexpr std::string_view kTourScene = "press";
inline constexpr std::string_view kTourAlgorithm = "none";  // algorithm at the start
inline constexpr std::size_t kMaxTourSteps = 8;

struct TourState {
  bool offered = true;              // stored in the settings file
  std::size_t step = 0;             // from 1; 0: no tour
  std::bitset<kMaxTourSteps> seen;  // lessons, from 0, since the tour began

  // Of the present step.
  std::size_t move = 0;         // index of the present one
  bool pressed = false;         // its key was pressed
  bool restarted = false;       // the session has begun anew since R was pressed
  std::uint64_t tail_tick = 0;  // newest tick of the tail that was looked at
};

// The present step, or null.
[[nodiscard]] const TourStep* present_step(const TourState& tour);
[[nodiscard]] bool step_seen(const TourState& tour);
// 0 leaves the tour.
void go_to_step(TourState& tour, std::size_t step);
void begin_steps(TourState& tour);

// The user has chosen an algorithm, or begun from rest.
void note_choice(TourState& tour, std::size_t algorithm);
void note_reset(TourState& tour);
// Judges the present move. Call it in every frame.
void look(TourState& tour, const Sight& sight);

// True if the present step points there. It points at a key until that is pressed.
[[nodiscard]] bool points_at(const TourState& tour, TourPlace place);
[[nodiscard]] bool points_at_algorithm(const TourState& tour, std::size_t algorithm);
[[nodiscard]] bool points_at_reset(const TourState& tour);

}  // namespace hapticwall::ui
