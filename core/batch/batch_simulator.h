// Many scenes at once, for stability maps and parameter studies: on all cores, and on each several
// scenes side by side in the lanes of its vector registers.
//
// Every figure is that of simulate() on the same scene, to the last bit, whatever the processor,
// the number of threads, and the order and company of the scenes. What has no lanes yet (friction,
// a hand that grips, delay and lag, an algorithm with a follower, other integrators than the exact
// one, several walls) runs one by one through simulate() itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall {

// What a stability map needs of a run: how it ends and where the handle was. Asking for no more
// than this leaves the energies and forces out of the loop.
struct BatchVerdict {
  Verdict verdict = Verdict::kSettled;
  std::uint64_t ticks = 0;
  std::optional<std::uint64_t> diverged_at_tick;
  std::optional<double> tail_peak_to_peak_m;
  std::optional<double> max_penetration_m;

  friend bool operator==(const BatchVerdict&, const BatchVerdict&) = default;
};

struct BatchOptions {
  int threads = 0;  // at most so many; 0: as many as the processor runs at a time
  // Both are called by any thread, but never by two at a time. True ends the batch early, in good
  // order.
  std::function<bool()> should_stop;
  // Of `total` scenes `done` have ended; never falls, and comes to `total` unless stopped.
  std::function<void(std::size_t done, std::size_t total)> progress;
};

template <typename Figures>
struct BatchResult {
  // figures[i] is of scenes[i]; nothing where the batch was stopped before its end.
  std::vector<std::optional<Figures>> figures;
  bool stopped_early = false;
};

// Figures: Summary or BatchVerdict. Scenes are validated ones, as for simulate(); a hand that
// follows the mouse throws std::invalid_argument. Realtime-safe: no.
template <typename Figures>
[[nodiscard]] BatchResult<Figures> simulate_batch(std::span<const Scene> scenes,
                                                  const BatchOptions& options = {});

extern template BatchResult<Summary> simulate_batch(std::span<const Scene>, const BatchOptions&);
extern template BatchResult<BatchVerdict> simulate_batch(std::span<const Scene>,
                                                         const BatchOptions&);

}  // namespace hapticwall
