#include "core/batch/batch_simulator.h"

#include <algorithm>
#include <atomic>
#include <tuple>
#include <utility>

#include "core/batch/lane_group.h"
#include "core/batch/workers.h"

namespace hapticwall {
namespace {

using batch::LaneKind;

// One piece of work of a thread: scenes side by side, or one scene without lanes.
struct Work {
  std::vector<std::size_t> scenes;
  std::optional<LaneKind> kind;
};

// Groups scenes of one kind and about the same length, so that no lane idles long. Neighbours stay
// together: in a map they diverge together and share their plant.
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
    return std::tuple(place.kind.algorithm, place.kind.encoder, place.kind.damped, place.ticks,
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

// The caller's two functions without overlapping calls: a thread that finds another one in a call
// skips its own.
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

class Batch {
 public:
  Batch(std::span<const Scene> scenes, const BatchOptions& options)
      : scenes_(scenes), reporter_(options, scenes.size()) {
    result_.summaries.resize(scenes.size());
  }

  BatchResult run(int threads) {
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
  void run(const Work& work, batch::LaneGroup& group) {
    if (reporter_.should_stop()) return;
    if (!work.kind) {
      run_one(work.scenes.front());
      return;
    }
    std::vector<const Scene*> scenes;
    for (const std::size_t i : work.scenes) scenes.push_back(&scenes_[i]);
    group.run(
        scenes, *work.kind,
        [&](const batch::LaneEnd& end, const batch::LaneBlock& block) {
          const std::size_t scene = work.scenes[end.lane];
          result_.summaries[scene] = batch::lane_summary(scenes_[scene], end, block);
          reporter_.add_done(1);
        },
        [&] { return reporter_.should_stop(); });
  }

  void run_one(std::size_t scene) try {
    SimulationOptions options;
    options.should_stop = [this] { return reporter_.should_stop(); };
    SimulationResult result = simulate(scenes_[scene], options);
    if (result.stopped_early) return;
    result_.summaries[scene] = std::move(result.summary);
    reporter_.add_done(1);
  } catch (const SimulationRefused& refused) {
    throw SceneRefused(refused, scene);
  }

  std::span<const Scene> scenes_;
  Reporter reporter_;
  BatchResult result_;
};

}  // namespace

BatchResult simulate_batch(std::span<const Scene> scenes, const BatchOptions& options) {
  for (const Scene& scene : scenes) refuse_pointer(scene);
  return Batch(scenes, options).run(options.threads);
}

std::vector<Summary> simulate_all(std::span<const Scene> scenes, const BatchOptions& options) {
  BatchResult result = simulate_batch(scenes, options);
  std::vector<Summary> summaries;
  if (result.stopped_early) return summaries;
  summaries.reserve(scenes.size());
  for (std::optional<Summary>& summary : result.summaries) summaries.push_back(std::move(*summary));
  return summaries;
}

}  // namespace hapticwall
