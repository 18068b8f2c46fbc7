#include "app/ui/state/live_map.h"

#include <algorithm>

#include "app/runtime/loop/realtime_setup.h"
#include "app/ui/state/map_choice.h"

namespace hapticwall::ui {
namespace {

constexpr std::size_t kCellsAtATime = 64;  // for each thread, between two deliveries

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

bool LiveMap::compute(const StabilityMap& map, Outbox& outbox, const Task::Progress& progress) {
  runtime::set_up_background_thread();
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
      Results results{stage, {some.begin(), some.end()}, std::move(metrics), {}};
      if (first) results.bounds = draw::map_bounds(map);
      const std::scoped_lock lock(outbox.mutex);
      outbox.results.push_back(std::move(results));
      from += some.size();
      done += some.size();
    }
  }
  return true;
}

void LiveMap::ask_for(const StabilityMap& map) {
  const bool same = asked_ && same_cells(*asked_, map);
  if (same && (complete_ || running() || !problem_.empty())) return;
  stop();
  asked_ = map;
  up_to_date_ = false;
  complete_ = false;
  problem_.clear();
  if (const auto invalid = validate(map)) {
    problem_ = invalid->key + ": " + invalid->message;
    return;
  }
  outbox_ = std::make_shared<Outbox>();
  task_.start([map, outbox = outbox_](const Task::Progress& progress) -> Result<bool> {
    return compute(map, *outbox, progress);
  });
}

void LiveMap::stop() {
  task_.give_up();
  outbox_.reset();
}

void LiveMap::take() {
  const auto ended = task_.take();  // before the results, which are then all there
  if (outbox_) {
    std::vector<Results> results;
    {
      const std::scoped_lock lock(outbox_->mutex);
      results.swap(outbox_->results);
    }
    for (Results& some : results) show(std::move(some));
  }
  if (!ended) return;
  complete_ = ended->ok() && **ended;
  if (!ended->ok()) problem_ = ended->error().message;
}

void LiveMap::show(Results results) {
  if (!up_to_date_) {
    picture_.emplace(*asked_);
    picture_->bounds = std::move(results.bounds);
    up_to_date_ = true;
  }
  for (std::size_t i = 0; i < results.middles.size(); ++i) {
    picture_->add(results.middles[i], results.stage, results.metrics[i]);
  }
}

}  // namespace hapticwall::ui
