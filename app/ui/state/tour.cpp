#include "app/ui/state/tour.h"

#include <array>

#include "core/algorithm/algorithm.h"

namespace hapticwall::ui {
namespace {

constexpr double kChatterM = 1e-3;
constexpr double kCycleM = 10e-3;
constexpr double kSoftNPerM = 2500.0;
constexpr double kStiffNPerM = 25e3;

bool under(const Sight& sight, std::string_view algorithm) {
  return sight.scene.name == kTourScene && sight.scene.algorithm.index == find_algorithm(algorithm);
}

bool swings(const Sight& sight, double least_m) {
  return sight.tail.summary.verdict == Verdict::kOscillating && sight.tail.frequency_hz &&
         sight.tail.summary.tail_peak_to_peak_m.value_or(0.0) > least_m;
}

bool settles(const Sight& sight, double least_n_per_m, double most_n_per_m) {
  const double stiffness = sight.tail.summary.displayed_stiffness_n_per_m.value_or(0.0);
  return sight.tail.summary.verdict == Verdict::kSettled && stiffness > least_n_per_m &&
         stiffness < most_n_per_m;
}

bool quiet_and_stiff(const Sight& sight) {
  if (sight.scene.x().walls.empty()) return false;
  const double wall_n_per_m = sight.scene.x().walls.front().stiffness_n_per_m;
  return under(sight, "energy-bounding") && settles(sight, kStiffNPerM, wall_n_per_m);
}

// Steps whose text ends, after the last colon, with the words that the strip must show.
constexpr std::array kTourSteps{
    TourStep{"It breaks",
             "Press 1: no algorithm. A firm hand presses into a wall of 35 kN/m, and the wall "
             "chatters: oscillating, 2.8 mm, 50 Hz.",
             [](const Sight& s) { return under(s, "none") && swings(s, kChatterM); }},
    TourStep{"The observer is blind",
             "Press 3: passivity control with the observer of 2002. The lamp blames the hold, the "
             "observer (Eq. 6) sees nothing, and the wall chatters as before: oscillating, 2.8 mm.",
             [](const Sight& s) {
               return under(s, "passivity-control") && swings(s, kChatterM) &&
                      s.story.blame == EnergyBlame::kHold && s.story.control_law_j <= 0.0;
             }},
    TourStep{
        "Quiet, but soft",
        "Press 2, then R: virtual coupling from rest. The wall is quiet, but soft: settled, "
        "1.9 kN/m.",
        [](const Sight& s) { return under(s, "virtual-coupling") && settles(s, 0.0, kSoftNPerM); }},
    TourStep{
        "Quiet and stiff",
        "Press 4, then R: energy bounding from rest. For this hand, on a handle with 0.14 N of "
        "friction, the wall is quiet and stiff: settled, 30 kN/m.",
        quiet_and_stiff},
    TourStep{"Two attractors",
             "Press 1 until the wall chatters, then 4. The force does not jump, but the contact "
             "falls into a cycle: oscillating, 15 mm.",
             [](const Sight& s) { return under(s, "energy-bounding") && swings(s, kCycleM); }},
    TourStep{"Two attractors",
             "Press R: from rest, the same algorithm is quiet again: settled, 30 kN/m.",
             quiet_and_stiff}};

}  // namespace

std::span<const TourStep> tour_steps() { return kTourSteps; }

}  // namespace hapticwall::ui
