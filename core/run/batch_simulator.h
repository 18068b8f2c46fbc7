// Many scenes at once, for stability maps and parameter studies: simulate() on all cores.
//
// Every metric has the bits of simulate() on the same scene, for any number of threads and order of
// scenes.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/run/simulate.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall {

struct BatchOptions {
  int threads = 0;  // max; 0: as many as the processor runs at a time
  // Any thread calls the two functions, but no two calls overlap. True ends the batch early.
  std::function<bool()> should_stop;
  // `done` of `total` scenes have ended; rises up to `total` unless stopped.
  std::function<void(std::size_t done, std::size_t total)> progress;
  // Called with the samples of each scene in order. Calls for different scenes overlap. Empty:
  // samples are not assembled.
  std::function<void(std::size_t scene, const Sample& sample)> on_sample = {};
};

struct BatchResult {
  // summaries[i] is of scenes[i]; nothing if the batch was stopped before its end.
  std::vector<std::optional<Summary>> summaries;
  bool stopped_early = false;
};

// Thrown by a batch for one of the scenes that simulate() refuses.
struct SceneRefused : SimulationRefused {
  SceneRefused(const SimulationRefused& refused, std::size_t index)
      : SimulationRefused(refused), scene(index) {}
  std::size_t scene;  // its index
};

// Scenes are validated ones, as for simulate(); a hand that follows the mouse throws
// std::invalid_argument. Realtime-safe: no.
[[nodiscard]] BatchResult simulate_batch(std::span<const Scene> scenes,
                                         const BatchOptions& options = {});

// simulate_batch() with the summaries alone; empty if the batch was stopped.
[[nodiscard]] std::vector<Summary> simulate_all(std::span<const Scene> scenes,
                                                const BatchOptions& options = {});

}  // namespace hapticwall
