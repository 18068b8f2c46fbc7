#include "app/ui/state/tour.h"

#include <algorithm>
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

bool chatters(const Sight& sight) { return under(sight, "none") && swings(sight, kChatterM); }

bool hold_to_blame(const Sight& sight) {
  return under(sight, "passivity-control") && swings(sight, kChatterM) &&
         sight.story.blame == EnergyBlame::kHold && sight.story.control_law_j <= 0.0;
}

bool coupled(const Sight& sight) { return under(sight, "virtual-coupling"); }

bool quiet_and_soft(const Sight& sight) {
  return coupled(sight) && settles(sight, 0.0, kSoftNPerM);
}

bool bounded(const Sight& sight) { return under(sight, "energy-bounding"); }

bool cycles(const Sight& sight) { return bounded(sight) && swings(sight, kCycleM); }

bool quiet_and_stiff(const Sight& sight) {
  if (sight.scene.x().walls.empty()) return false;
  const double wall_n_per_m = sight.scene.x().walls.front().stiffness_n_per_m;
  return bounded(sight) && settles(sight, kStiffNPerM, wall_n_per_m);
}

constexpr std::array kBreaks{TourMove{"none", chatters}};
constexpr std::array kBlind{TourMove{"passivity-control", hold_to_blame}};
constexpr std::array kSoft{TourMove{"virtual-coupling", coupled}, TourMove{"", quiet_and_soft}};
constexpr std::array kStiff{TourMove{"energy-bounding", bounded}, TourMove{"", quiet_and_stiff}};
constexpr std::array kAttractors{TourMove{"none", chatters}, TourMove{"energy-bounding", cycles},
                                 TourMove{"", quiet_and_stiff}};

constexpr std::array kVerdictAlone{TourPlace::kVerdict};
constexpr std::array kVerdictAndLamp{TourPlace::kVerdict, TourPlace::kLamp};
constexpr std::array kWallAndMore{TourPlace::kWall, TourPlace::kMore};

// The words after the last colon of a paragraph that begins with "Press" are those of the verdict.
constexpr std::array kTourSteps{
    TourStep{"It breaks",
             "Press 1: no algorithm. A firm hand presses into a wall of 35 kN/m, and the wall "
             "chatters: oscillating, 2.8 mm, 50 Hz.",
             kBreaks, kVerdictAlone},
    TourStep{"The observer is blind",
             "Press 3: passivity control with the observer of 2002. The hold has fed the hand "
             "energy that the observer (Eq. 6) does not see, and the wall chatters as before: "
             "oscillating, 2.8 mm.",
             kBlind, kVerdictAndLamp},
    TourStep{"Quiet, but soft",
             "Press 2, then R: virtual coupling from rest. The wall is quiet, but soft: settled, "
             "1.9 kN/m.",
             kSoft, kVerdictAlone},
    TourStep{
        "Quiet and stiff",
        "Press 4, then R: energy bounding from rest. For this hand, on a handle with 0.14 N of "
        "friction, the wall is quiet and stiff: settled, 30 kN/m.",
        kStiff, kVerdictAlone},
    TourStep{"Two attractors",
             "Press 1 until the wall chatters, then 4. The force does not jump, but the contact "
             "falls into a cycle: oscillating, 15 mm. Press R: from rest, the same algorithm is "
             "quiet again: settled, 30 kN/m.",
             kAttractors, kVerdictAlone},
    TourStep{"What next",
             "Drag in the picture of the wall to lead the hand yourself, record with Ctrl+R, or "
             "open the stability map: More, page Map. docs/adding-an-algorithm.md adds a control "
             "law of your own.",
             {},
             kWallAndMore,
             "Drag in the picture of the wall to lead the hand yourself, or open More: every "
             "parameter, and all algorithms at once. The program for the desktop records, draws "
             "stability maps and drives devices."}};
static_assert(kTourSteps.size() <= kMaxTourSteps);

// The key of the present move, while it has to be pressed.
const TourMove* wanted_move(const TourState& tour) {
  const TourStep* step = present_step(tour);
  if (step == nullptr || step->moves.empty() || tour.pressed || step_seen(tour)) return nullptr;
  return &step->moves[tour.move];
}

void go_to_move(TourState& tour, std::size_t move, bool pressed) {
  tour.move = move;
  tour.pressed = pressed;
  tour.restarted = false;
}

}  // namespace

std::span<const TourStep> tour_steps() { return kTourSteps; }

const TourStep* present_step(const TourState& tour) {
  return tour.step == 0 ? nullptr : &kTourSteps.at(tour.step - 1);
}

bool step_seen(const TourState& tour) { return tour.step > 0 && tour.seen.test(tour.step - 1); }

void go_to_step(TourState& tour, std::size_t step) {
  tour.step = step;
  go_to_move(tour, 0, false);
}

void begin_steps(TourState& tour) {
  tour.offered = false;
  tour.seen.reset();
  go_to_step(tour, 1);
}

// An earlier key of the step goes back to it, and any other algorithm to the first one.
void note_choice(TourState& tour, std::size_t algorithm) {
  const TourStep* step = present_step(tour);
  if (step == nullptr || step_seen(tour)) return;
  const auto so_far = step->moves.first(std::min(tour.move + 1, step->moves.size()));
  const auto found = std::ranges::find_if(so_far, [&](const TourMove& move) {
    return !move.algorithm.empty() && find_algorithm(move.algorithm) == algorithm;
  });
  const bool known = found != so_far.end();
  go_to_move(tour, known ? static_cast<std::size_t>(found - so_far.begin()) : 0, known);
}

// From rest the first move is seen as well; a later one may need what came before.
void note_reset(TourState& tour) {
  const TourStep* step = present_step(tour);
  if (step == nullptr || step->moves.empty() || step_seen(tour)) return;
  const bool wanted = step->moves[tour.move].algorithm.empty();
  if (wanted && !tour.pressed) go_to_move(tour, tour.move, true);
  if (!wanted && tour.move > 0) go_to_move(tour, 0, false);
}

void look(TourState& tour, const Sight& sight) {
  tour.restarted = tour.restarted || sight.tail.end_tick < tour.tail_tick;
  tour.tail_tick = sight.tail.end_tick;
  const TourStep* step = present_step(tour);
  if (step == nullptr || !tour.pressed || step_seen(tour)) return;
  const TourMove& move = step->moves[tour.move];
  // The verdict of the session before R tells nothing.
  if (move.algorithm.empty() && !tour.restarted) return;
  if (!move.seen(sight)) return;
  if (tour.move + 1 < step->moves.size()) return go_to_move(tour, tour.move + 1, false);
  tour.seen.set(tour.step - 1);
}

bool points_at(const TourState& tour, TourPlace place) {
  const TourStep* step = present_step(tour);
  return step != nullptr && std::ranges::find(step->looks, place) != step->looks.end();
}

bool points_at_algorithm(const TourState& tour, std::size_t algorithm) {
  const TourMove* move = wanted_move(tour);
  return move != nullptr && !move->algorithm.empty() &&
         find_algorithm(move->algorithm) == algorithm;
}

bool points_at_reset(const TourState& tour) {
  const TourMove* move = wanted_move(tour);
  return move != nullptr && move->algorithm.empty();
}

}  // namespace hapticwall::ui
