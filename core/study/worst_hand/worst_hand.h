// A search for a hand that takes energy out of a scene's wall.
//
// Such a hand proves that the interface is not passive. A search that finds none proves nothing.
// docs/worst-hand.md has the method and its limits.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/scene.h"
#include "core/study/worst_hand/hand_space.h"
#include "core/summary.h"

namespace hapticwall::worst_hand {

// Less energy than this counts as rounding.
inline constexpr double kFoundJ = 1e-9;
inline constexpr std::size_t kNeighbours = 32;  // within ±1 % of a hand
inline constexpr std::size_t kMaxRanked = 128;  // hands whose neighbours run
inline constexpr std::uint64_t kMaxHands = 10'000'000;

struct Plan {
  Scene scene;  // its hand is replaced
  std::uint64_t hands = 10'000;
  std::uint64_t seed = 1;
  Bounds bounds = Bounds::kWide;
  Motion motion = Motion::kLetGo;
};

// A hand that took energy. N(t) is its net work on the handle from the start on, and t_r the time
// of its path's last point. The search maximises
//   taken_at_rest_j = max(0, min(N(t_r), 0) - min N over t >= t_r),
// which no muscle has paid for. It is -min N for a hand that is let go, whose t_r is 0.
struct FoundHand {
  HandValues values{};
  Scene scene;           // axis x with this hand
  double taken_j = 0.0;  // -min N; the run of `scene` has it as -passivity_margin_j
  double taken_at_rest_j = 0.0;
  double typical_j = 0.0;  // median of taken_at_rest_j over the neighbours
  double least_j = 0.0;    // minimum over the neighbours
  // Mean power to the hand in the last second; nullopt for a shorter run.
  std::optional<double> last_second_w;
};

// A hand that took more than all before it.
struct Gain {
  std::uint64_t hand = 0;  // its number, from 1 on
  double taken_at_rest_j = 0.0;
};

struct Found {
  std::uint64_t hands = 0;    // tried; fewer than planned if the time was up
  std::uint64_t refused = 0;  // of these, too much work for the integrator
  // From the first hand on that took more than kFoundJ; empty if none did.
  std::vector<Gain> gains;
  // Of the kMaxRanked distinct hands that took most, the one with the highest typical energy. The
  // largest energy alone may be the luck of one chaotic run.
  std::optional<FoundHand> hand;

  // Fills the numbers of a search in the summary of axis x.
  void put(Summary& summary) const {
    summary.searched_hands = hands;
    if (!hand) return;
    summary.most_taken_j = most_j();
    summary.typical_taken_j = hand->typical_j;
  }
  // The largest energy of all hands.
  [[nodiscard]] double most_j() const { return gains.empty() ? 0.0 : gains.back().taken_at_rest_j; }
  // Number of the first hand that took energy; nullopt if none did.
  [[nodiscard]] std::optional<std::uint64_t> first() const {
    return gains.empty() ? std::nullopt : std::optional(gains.front().hand);
  }
};

// One hand's run, as the search ranks it.
struct HandResult {
  // Energy taken at rest; without any, below 0: how much of the device's damping the actuator gave.
  double score = 0.0;
  double taken_j = 0.0;
  double taken_at_rest_j = 0.0;
};
// In the order of the hands; nullopt for a hand that the integrator refuses.
using HandResults = std::vector<std::optional<HandResult>>;

struct SearchOptions {
  int threads = 0;  // max; 0: as many as the processor runs at a time
  // Any thread calls the functions, never two at once. True ends the search without a result.
  std::function<bool()> should_stop;
  // True ends the search with the hands so far. Asked between populations.
  std::function<bool()> time_is_up;
  std::function<void(double fraction)> progress;
  // Runs hands elsewhere, with the results of run_hands(). nullopt ends the search without a
  // result.
  std::function<std::optional<HandResults>(std::span<const HandValues>)> run_hands = {};
};

// Runs hands in the plan's scene. nullopt if `should_stop` returned true. The same bits for any
// number of threads and for any division of the hands. Realtime-safe: no.
[[nodiscard]] std::optional<HandResults> run_hands(const Plan& plan,
                                                   std::span<const HandValues> hands,
                                                   const SearchOptions& options);

// Tries 1024 hands of a Sobol sequence, then populations of CMA-ES; then ranks. nullopt if
// `should_stop` returned true. Ramps take longer, because every sample is looked at. The same bits
// for any number of threads, unless the time was up.
// Precondition: problem_of() of the scene is nullopt. Realtime-safe: no.
[[nodiscard]] std::optional<Found> search(const Plan& plan, const SearchOptions& options = {});

}  // namespace hapticwall::worst_hand
