// Cells of a stability map, computed; apart from the plan, which is text and numbers alone.
#include "core/study/stability_map.h"

namespace hapticwall {

std::vector<MapFigures> run_cells(const StabilityMap& map, std::size_t begin, std::size_t end,
                                  const std::function<bool()>& should_stop) {
  std::vector<Scene> scenes;
  scenes.reserve(end - begin);
  for (std::size_t cell = begin; cell < end; ++cell) scenes.push_back(map.scene_at(cell));
  BatchOptions options;
  options.should_stop = should_stop;
  const BatchResult<Summary> result = simulate_batch<Summary>(scenes, options);
  std::vector<MapFigures> figures;
  if (result.stopped_early) return figures;
  figures.reserve(scenes.size());
  for (const std::optional<Summary>& summary : result.figures) {
    figures.push_back(map_figures(*summary));
  }
  return figures;
}

}  // namespace hapticwall
