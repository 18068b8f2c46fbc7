// A stability map that is computed beside the window: coarse first, then finer.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/draw/figure/map_field.h"
#include "app/ui/state/background.h"
#include "core/study/stability_map.h"

namespace hapticwall::ui {

// Side of a block of cells that shows the result of its middle, stage by stage.
inline constexpr std::array<std::size_t, 3> kMapStages{9, 3, 1};

// Of the block that holds `index`, on an axis of `count` values.
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
  // Of all cells: their own, or those of the middle of their block.
  [[nodiscard]] std::span<const MapMetrics> figures() const { return figures_; }
  // The cell whose figures stand at this cell.
  [[nodiscard]] std::size_t source(std::size_t cell) const { return sources_[cell]; }

  std::vector<draw::BoundLines> bounds;

 private:
  StabilityMap map_;
  std::vector<MapMetrics> figures_;
  std::vector<std::size_t> sources_;
};

// All members are called from the owner's thread. None waits, except the destructor, which waits
// for the threads: at most a thousand ticks of a scene on each.
class LiveMap {
 public:
  // Computes this map, unless it is the newest one. The picture of the one before stays until the
  // first stage is done.
  void ask_for(const StabilityMap& map);
  // Gives the computation up; the picture stays. ask_for() begins again if it was not complete.
  void stop();
  // Takes the results that have come since the last call.
  void take();

  [[nodiscard]] bool running() const { return task_.running(); }
  [[nodiscard]] double fraction() const { return complete_ ? 1.0 : task_.fraction(); }
  [[nodiscard]] bool complete() const { return complete_; }
  // nullptr: none yet.
  [[nodiscard]] const MapPicture* picture() const { return picture_ ? &*picture_ : nullptr; }
  // Whether the picture is of the map that was asked for.
  [[nodiscard]] bool up_to_date() const { return up_to_date_; }
  // Why there is no map; "" if there is one.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  struct Results {
    std::size_t stage = 0;
    std::vector<std::size_t> middles;
    std::vector<MapMetrics> metrics;
    std::vector<draw::BoundLines> bounds;  // of the first stage
  };
  // Between the thread of a computation and the owner.
  struct Outbox {
    std::mutex mutex;
    std::vector<Results> results;
  };
  using Task = Background<bool>;

  static bool compute(const StabilityMap& map, Outbox& outbox, const Task::Progress& progress);
  void show(Results results);

  Task task_;
  std::shared_ptr<Outbox> outbox_;
  std::optional<StabilityMap> asked_;
  std::optional<MapPicture> picture_;
  bool up_to_date_ = false;
  bool complete_ = false;
  std::string problem_;
};

}  // namespace hapticwall::ui
