// A stability map that is computed beside the window: coarse first, then finer.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/draw/figure/map_field.h"
#include "app/ui/computed/computed.h"
#include "core/study/stability_map.h"

namespace hapticwall::ui {

// Side of a block of cells that shows the result of its middle, stage by stage.
inline constexpr std::array<std::size_t, 3> kMapStages{9, 3, 1};

// Middle of the block that holds `index`, on an axis of `count` values.
[[nodiscard]] std::size_t block_middle(std::size_t index, std::size_t stage, std::size_t count);
// The middles of all blocks, in the order of cells.
[[nodiscard]] std::vector<std::size_t> middles(const StabilityMap& map, std::size_t stage);

// A map as far as it is known.
class MapPicture {
 public:
  explicit MapPicture(StabilityMap map);

  // The result of the middle of a block.
  void add(std::size_t middle, std::size_t stage, const MapMetrics& metrics);

  [[nodiscard]] const StabilityMap& map() const { return map_; }
  // Metrics of all cells; a cell not yet computed has those of the middle of its block.
  [[nodiscard]] std::span<const MapMetrics> figures() const { return figures_; }
  // Index of the cell whose metrics stand at this cell.
  [[nodiscard]] std::size_t source(std::size_t cell) const { return sources_[cell]; }

  std::vector<draw::BoundLines> bounds;

 private:
  StabilityMap map_;
  std::vector<MapMetrics> figures_;
  std::vector<std::size_t> sources_;
};

// The results of some cells: the middles of blocks of one stage.
struct MapPart {
  std::size_t stage = 0;
  std::vector<std::size_t> middles;
  std::vector<MapMetrics> metrics;
  std::vector<draw::BoundLines> bounds;  // bounds of the first stage
};

// The previous picture stays until the first stage of the next map is done. stop() keeps it, too.
class LiveMap : public Computed<StabilityMap, MapPart> {
 public:
  LiveMap();
  void take();

  [[nodiscard]] double fraction() const { return complete() ? 1.0 : Computed::fraction(); }
  [[nodiscard]] bool complete() const { return answered(); }
  // nullptr: none yet.
  [[nodiscard]] const MapPicture* picture() const { return picture_ ? &*picture_ : nullptr; }
  // True if the picture is of the map that was asked for.
  [[nodiscard]] bool up_to_date() const { return picture_ && shows_ == count(); }

 private:
  std::optional<MapPicture> picture_;
  std::size_t shows_ = 0;  // number of the start that the picture is of
};

}  // namespace hapticwall::ui
