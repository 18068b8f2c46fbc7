#include "core/batch/batch_simulator.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include "core/batch/lane_figures.h"
#include "core/batch/lane_group.h"
#include "core/batch/workers.h"
#include "core/simulate.h"

namespace hapticwall {
namespace {

using batch::LaneKind;

// What one thread does at a time: scenes that go side by side, or one scene without lanes.
struct Work {
  std::vector<std::size_t> scenes;
  std::optional<LaneKind> kind;
};

// Like scenes go together: of one kind, and of about the same length, so that no lane idles long.
// Neighbours stay neighbours: in a map they diverge together and share their plant.
std::vector<Work> divide(std::span<const Scene> scenes, std::size_t lanes) {
  struct Place {
    LaneKind kind;
    std::uint64_t ticks;
    std::size_t scene;
  };
  std::vector<Place> places;
  std::vector<Work> all;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (const auto kind = batch::lane_kind(scenes[i])) {
      places.push_back({*kind, scenes[i].tick_count(), i});
    } else {
      all.push_back({{i}, std::nullopt});
    }
  }
  const auto order = [](const Place& place) {
    return std::tuple(place.kind.law, place.kind.encoder, place.kind.damped, place.ticks,
                      place.scene);
  };
  std::sort(places.begin(), places.end(),
            [&](const Place& a, const Place& b) { return order(a) < order(b); });
  for (const Place& place : places) {
    const bool full =
        all.empty() || all.back().kind != place.kind || all.back().scenes.size() == lanes;
    if (full) all.push_back({{}, place.kind});
    all.back().scenes.push_back(place.scene);
  }
  return all;
}

// The caller's two functions, of which no two calls overlap; a thread that finds another one at
// them goes on with its work.
class Reporter {
 public:
  Reporter(const BatchOptions& options, std::size_t total) : options_(options), total_(total) {}

  [[nodiscard]] bool should_stop() {
    if (!options_.should_stop || stopped_ || asking_.test_and_set()) return stopped_;
    if (options_.should_stop()) stopped_ = true;
    asking_.clear();
    return stopped_;
  }
  void add_done(std::size_t scenes) {
    done_ += scenes;
    if (!options_.progress || asking_.test_and_set()) return;
    tell();
    asking_.clear();
  }
  // After the last thread has ended.
  void finish() {
    if (options_.progress) tell();
  }
  [[nodiscard]] bool stopped() const { return stopped_; }

 private:
  void tell() {
    const std::size_t done = done_;
    if (done == told_) return;
    told_ = done;
    options_.progress(done, total_);
  }

  const BatchOptions& options_;
  std::size_t total_;
  std::atomic<bool> stopped_ = false;
  std::atomic<std::size_t> done_ = 0;
  std::atomic_flag asking_ = ATOMIC_FLAG_INIT;  // guards told_ and the functions
  std::size_t told_ = 0;
};

BatchVerdict verdict_of(const Summary& summary) {
  return {summary.verdict, summary.ticks, summary.diverged_at_tick, summary.tail_peak_to_peak_m,
          summary.max_penetration_m};
}

template <typename Figures>
class Batch {
 public:
  Batch(std::span<const Scene> scenes, const BatchOptions& options)
      : scenes_(scenes), reporter_(options, scenes.size()) {
    result_.figures.resize(scenes.size());
  }

  BatchResult<Figures> run(int threads) {
    const std::vector<Work> all = divide(scenes_, batch::lane_count());
    const std::size_t workers =
        std::clamp<std::size_t>(all.size(), 1, batch::worker_count(threads));
    std::vector<batch::LaneGroup> groups(workers);
    batch::share_out(all.size(), workers,
                     [&](std::size_t item, std::size_t worker) { run(all[item], groups[worker]); });
    reporter_.finish();
    result_.stopped_early = reporter_.stopped();
    return std::move(result_);
  }

 private:
  static constexpr bool kAccount = std::is_same_v<Figures, Summary>;

  void run(const Work& work, batch::LaneGroup& group) {
    if (reporter_.should_stop()) return;
    if (!work.kind) {
      run_one(work.scenes.front());
      return;
    }
    std::vector<const Scene*> scenes;
    for (const std::size_t i : work.scenes) scenes.push_back(&scenes_[i]);
    group.run(
        scenes, *work.kind, kAccount,
        [&](const batch::LaneEnd& end, const batch::LaneBlock& block) {
          const std::size_t scene = work.scenes[end.lane];
          result_.figures[scene] = batch::lane_figures<Figures>(scenes_[scene], end, block);
          reporter_.add_done(1);
        },
        [&] { return reporter_.should_stop(); });
  }

  void run_one(std::size_t scene) {
    SimulationOptions options;
    options.should_stop = [this] { return reporter_.should_stop(); };
    SimulationResult result = simulate(scenes_[scene], options);
    if (result.stopped_early) return;
    if constexpr (kAccount) {
      result_.figures[scene] = std::move(result.summary);
    } else {
      result_.figures[scene] = verdict_of(result.summary);
    }
    reporter_.add_done(1);
  }

  std::span<const Scene> scenes_;
  Reporter reporter_;
  BatchResult<Figures> result_;
};

}  // namespace

template <typename Figures>
BatchResult<Figures> simulate_batch(std::span<const Scene> scenes, const BatchOptions& options) {
  for (const Scene& scene : scenes) {
    if (scene.hand && scene.hand->follows_mouse) {
      throw std::invalid_argument("a hand that follows the mouse needs the window");
    }
  }
  return Batch<Figures>(scenes, options).run(options.threads);
}

template BatchResult<Summary> simulate_batch(std::span<const Scene>, const BatchOptions&);
template BatchResult<BatchVerdict> simulate_batch(std::span<const Scene>, const BatchOptions&);

}  // namespace hapticwall
