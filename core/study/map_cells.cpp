// Computes the cells of a stability map. A file of its own: readers of maps need no simulator.
#include "core/batch/batch_simulator.h"
#include "core/study/stability_map.h"

namespace hapticwall {

std::vector<MapMetrics> run_cells(const StabilityMap& map, std::size_t begin, std::size_t end,
                                  const std::function<bool()>& should_stop) {
  std::vector<Scene> scenes;
  scenes.reserve(end - begin);
  for (std::size_t cell = begin; cell < end; ++cell) scenes.push_back(map.scene_at(cell));
  // Not simulate_all(): with short runs the second list of summaries costs time.
  const BatchResult result = simulate_batch(scenes, {.should_stop = should_stop, .progress = {}});
  std::vector<MapMetrics> metrics;
  if (result.stopped_early) return metrics;
  metrics.reserve(scenes.size());
  for (const std::optional<Summary>& summary : result.summaries) {
    metrics.push_back(map_metrics(*summary));
  }
  return metrics;
}

}  // namespace hapticwall
