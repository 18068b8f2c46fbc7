#include "core/run/batch_simulator.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "core/run/workers.h"

namespace hapticwall {
namespace {

// Keeps calls of the caller's two functions from overlapping: a thread that finds another one in a
// call skips its own.
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
  // Reports the end of the batch. Call it after the last thread has ended.
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
      : scenes_(scenes), on_sample_(options.on_sample), reporter_(options, scenes.size()) {
    result_.summaries.resize(scenes.size());
  }

  BatchResult run(int threads) {
    const std::size_t workers = std::clamp<std::size_t>(scenes_.size(), 1, worker_count(threads));
    share_out(scenes_.size(), workers,
              [this](std::size_t scene, std::size_t /*worker*/) { run_one(scene); });
    reporter_.finish();
    result_.stopped_early = reporter_.stopped();
    return std::move(result_);
  }

 private:
  void run_one(std::size_t scene) try {
    if (reporter_.should_stop()) return;
    SimulationOptions options;
    options.should_stop = [this] { return reporter_.should_stop(); };
    if (on_sample_) options.on_sample = [&](const Sample& sample) { on_sample_(scene, sample); };
    SimulationResult result = simulate(scenes_[scene], options);
    if (result.stopped_early) return;
    result_.summaries[scene] = std::move(result.summary);
    reporter_.add_done(1);
  } catch (const SimulationRefused& refused) {
    throw SceneRefused(refused, scene);
  }

  std::span<const Scene> scenes_;
  const std::function<void(std::size_t, const Sample&)>& on_sample_;
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
