#include "app/ui/computed/live_map.h"

#include <algorithm>

#include "app/ui/computed/map_choice.h"

namespace hapticwall::ui {
namespace {

constexpr std::size_t kCellsAtATime = 64;  // cells a thread computes between two deliveries

std::size_t block_begin(std::size_t index, std::size_t stage) { return index / stage * stage; }

std::size_t work_of(const StabilityMap& map) {
  std::size_t cells = 0;
  for (const std::size_t stage : kMapStages) cells += middles(map, stage).size();
  return cells;
}

}  // namespace

std::size_t block_middle(std::size_t index, std::size_t stage, std::size_t count) {
  return std::min(block_begin(index, stage) + stage / 2, count - 1);
}

std::vector<std::size_t> middles(const StabilityMap& map, std::size_t stage) {
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < map.cell_count(); ++cell) {
    const MapPlace at = map.place(cell);
    if (at.x == block_middle(at.x, stage, map.x.count) &&
        at.y == block_middle(at.y, stage, map.y.count)) {
      cells.push_back(cell);
    }
  }
  return cells;
}

MapPicture::MapPicture(StabilityMap map)
    : map_(std::move(map)), figures_(map_.cell_count()), sources_(map_.cell_count()) {}

void MapPicture::add(std::size_t middle, std::size_t stage, const MapMetrics& metrics) {
  const MapPlace at = map_.place(middle);
  const std::size_t x = block_begin(at.x, stage);
  const std::size_t y = block_begin(at.y, stage);
  const std::size_t first_row = (middle / map_.x.count) - at.y;
  for (std::size_t row = y; row < std::min(y + stage, map_.y.count); ++row) {
    const std::size_t begin = (first_row + row) * map_.x.count;
    for (std::size_t cell = begin + x; cell < begin + std::min(x + stage, map_.x.count); ++cell) {
      figures_[cell] = metrics;
      sources_[cell] = middle;
    }
  }
}

// All stages, one after the other.
static Result<bool> compute(const StabilityMap& map, const LiveMap::Progress& progress,
                            const LiveMap::Deliver& deliver) {
  const int threads = background_thread_count();
  const auto work = static_cast<double>(work_of(map));
  std::size_t done = 0;
  const auto stops = [&] { return !progress(static_cast<double>(done) / work); };
  for (const std::size_t stage : kMapStages) {
    const std::vector<std::size_t> all = middles(map, stage);
    const bool first = stage == kMapStages.front();
    for (std::size_t from = 0; from < all.size();) {
      const std::size_t left = all.size() - from;
      // The first picture is whole.
      const auto some = std::span(all).subspan(
          from, first ? left : std::min(left, static_cast<std::size_t>(threads) * kCellsAtATime));
      std::vector<MapMetrics> metrics = run_cells(map, some, threads, stops);
      if (metrics.empty()) return false;
      deliver({stage,
               {some.begin(), some.end()},
               std::move(metrics),
               first ? draw::map_bounds(map) : std::vector<draw::BoundLines>()});
      from += some.size();
      done += some.size();
    }
  }
  return true;
}

LiveMap::LiveMap()
    : Computed(compute, same_cells, [](const StabilityMap& map) {
        const auto invalid = validate(map);
        return invalid ? invalid->key + ": " + invalid->message : "";
      }) {}

void LiveMap::take() {
  for (MapPart& part : Computed::take()) {
    if (!up_to_date()) {
      picture_.emplace(*asked());
      picture_->bounds = std::move(part.bounds);
      shows_ = count();
    }
    for (std::size_t i = 0; i < part.middles.size(); ++i) {
      picture_->add(part.middles[i], part.stage, part.metrics[i]);
    }
  }
}

}  // namespace hapticwall::ui
