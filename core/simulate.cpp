#include "core/simulate.h"

#include <algorithm>
#include <vector>

#include "core/simulation_loop.h"

namespace hapticwall {
namespace {

static_assert(kChunkTicks == kAxesApartTicks);

// One axis of two: the samples that the other one has not reached yet wait.
class WaitingAxis {
 public:
  WaitingAxis(const Scene& scene, std::vector<ScheduledChange> changes, bool wants_samples)
      : changes_(std::move(changes)), simulation_(scene, options(wants_samples), make_plant) {}
  WaitingAxis(const WaitingAxis&) = delete;
  WaitingAxis& operator=(const WaitingAxis&) = delete;

  Simulation<PlantVariant>& simulation() { return simulation_; }
  std::vector<Sample>& waiting() { return waiting_; }

 private:
  const SimulationOptions& options(bool wants_samples) {
    options_.changes = changes_;
    if (wants_samples) {
      waiting_.reserve(kChunkTicks);
      options_.on_sample = [this](const Sample& sample) { waiting_.push_back(sample); };
    }
    return options_;
  }

  std::vector<Sample> waiting_;
  std::vector<ScheduledChange> changes_;
  SimulationOptions options_;
  Simulation<PlantVariant> simulation_;
};

std::vector<ScheduledChange> on_second_axis(std::span<const ScheduledChange> changes) {
  std::vector<ScheduledChange> of_axis;
  of_axis.reserve(changes.size());
  for (const ScheduledChange& change : changes)
    of_axis.push_back({change.tick, second_axis(change.scene)});
  return of_axis;
}

void hand_out(WaitingAxis& x, WaitingAxis& y, const AxesOptions& options) {
  const std::size_t count = std::min(x.waiting().size(), y.waiting().size());
  for (std::size_t i = 0; i < count; ++i) options.on_samples(x.waiting()[i], y.waiting()[i]);
  x.waiting().clear();
  y.waiting().clear();
}

}  // namespace

SimulationResult simulate(const Scene& scene, const SimulationOptions& options) {
  refuse_pointer(scene);
  return Simulation<PlantVariant>(scene, options, make_plant).run();
}

AxesResult simulate_axes(const Scene& scene, const AxesOptions& options) {
  const Scene y_scene = second_axis(scene);
  refuse_pointer(scene);
  refuse_pointer(y_scene);
  const bool wants_samples = static_cast<bool>(options.on_samples);
  WaitingAxis x(scene, {options.changes.begin(), options.changes.end()}, wants_samples);
  WaitingAxis y(y_scene, on_second_axis(options.changes), wants_samples);
  bool stopped_early = false;
  // Both have the same changes and so the same chunks.
  while (!x.simulation().over() && !y.simulation().over() && !stopped_early) {
    if (options.should_stop && options.should_stop()) {
      stopped_early = true;
      break;
    }
    x.simulation().advance();
    y.simulation().advance();
    if (wants_samples) hand_out(x, y, options);
  }
  AxesResult result{x.simulation().finish(), y.simulation().finish()};
  result.x.stopped_early = stopped_early;
  result.y.stopped_early = stopped_early;
  return result;
}

}  // namespace hapticwall
