// Computes the cells of a stability map. It is a separate file, because readers of maps need no
// simulator.
#include <numeric>
#include <string>

#include "core/run/batch_simulator.h"
#include "core/study/stability_map.h"

namespace hapticwall {
namespace {

// Setting of an axis value, as --set takes it.
std::string setting(const MapAxis& axis, std::size_t index) {
  return axis.number.path + "=" + number_text(axis.value(index));
}

std::string cell_name(const StabilityMap& map, std::size_t cell) {
  const MapPlace at = map.place(cell);
  return "the cell " + setting(map.x, at.x) + ", " + setting(map.y, at.y);
}

}  // namespace

std::vector<MapMetrics> run_cells(const StabilityMap& map, std::size_t begin, std::size_t end,
                                  const std::function<bool()>& should_stop) {
  std::vector<std::size_t> cells(end - begin);
  std::iota(cells.begin(), cells.end(), begin);
  return run_cells(map, cells, 0, should_stop);
}

std::vector<MapMetrics> run_cells(const StabilityMap& map, std::span<const std::size_t> cells,
                                  int threads, const std::function<bool()>& should_stop) {
  std::vector<Scene> scenes;
  scenes.reserve(cells.size());
  for (const std::size_t cell : cells) scenes.push_back(map.scene_at(cell));
  // simulate_batch() in the place of simulate_all(): with short runs the second list of summaries
  // costs time.
  BatchResult result;
  try {
    result =
        simulate_batch(scenes, {.threads = threads, .should_stop = should_stop, .progress = {}});
  } catch (const SceneRefused& refused) {
    throw SimulationRefused(cell_name(map, cells[refused.scene]) + ": " + refused.what());
  }
  std::vector<MapMetrics> metrics;
  if (result.stopped_early) return metrics;
  metrics.reserve(scenes.size());
  for (const std::optional<Summary>& summary : result.summaries) {
    metrics.push_back(map_metrics(*summary));
  }
  return metrics;
}

}  // namespace hapticwall
