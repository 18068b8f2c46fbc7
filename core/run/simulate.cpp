#include "core/run/simulate.h"

#include <algorithm>
#include <array>
#include <deque>
#include <stdexcept>

#include "core/run/measured_axes.h"
#include "core/run/simulation.h"

namespace hapticwall {
namespace {

static_assert(kChunkTicks == kAxesApartTicks);

void run_chunk(HeadlessRun& run, PlantVariant& variant, std::uint64_t end) {
  std::visit([&](auto& plant) { run_loop(run, plant, end); }, variant);
}

// One of several axes. Its samples wait until the others reach the same tick.
class WaitingAxis {
 public:
  WaitingAxis(const Scene& scene, std::vector<ScheduledChange> changes, const AxesOptions& all)
      : changes_(std::move(changes)), simulation_(scene, options(all), make_plant, run_chunk) {}
  WaitingAxis(const WaitingAxis&) = delete;
  WaitingAxis& operator=(const WaitingAxis&) = delete;

  Simulation<PlantVariant>& simulation() { return simulation_; }
  std::vector<Sample>& waiting() { return waiting_; }

 private:
  const SimulationOptions& options(const AxesOptions& all) {
    options_.changes = changes_;
    options_.signals = all.signals;
    if (all.on_tick) {
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

std::vector<ScheduledChange> changes_of(std::span<const ScheduledChange> changes,
                                        std::size_t axis) {
  std::vector<ScheduledChange> of_axis;
  of_axis.reserve(changes.size());
  for (const ScheduledChange& change : changes)
    of_axis.push_back({change.tick, axis_scene(change.scene, axis)});
  return of_axis;
}

// Passes on the ticks that all axes have reached.
void hand_out(std::deque<WaitingAxis>& axes, const AxesOptions& options) {
  std::size_t count = kChunkTicks;
  for (WaitingAxis& axis : axes) count = std::min(count, axis.waiting().size());
  Tick tick;
  tick.count = static_cast<std::uint8_t>(axes.size());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      tick.axes.at(axis) = axes[axis].waiting()[i];
    }
    options.on_tick(tick);
  }
  for (WaitingAxis& axis : axes) {
    axis.waiting().erase(axis.waiting().begin(),
                         axis.waiting().begin() + static_cast<std::ptrdiff_t>(count));
  }
}

// simulate_axes() for axes that need each other at every tick.
AxesResult simulate_together(const Scene& scene, const AxesOptions& options) {
  MeasuredAxes axes(scene);
  AxesResult result;
  std::size_t next_change = 0;
  Tick tick;
  tick.count = static_cast<std::uint8_t>(axes.count());
  for (std::uint64_t at = 0; at < scene.tick_count(); ++at) {
    if (at % kChunkTicks == 0 && options.should_stop && options.should_stop()) {
      result.stopped_early = true;
      break;
    }
    for (; next_change < options.changes.size() && options.changes[next_change].tick <= at;
         ++next_change) {
      axes.change(options.changes[next_change].scene);
    }
    if (!axes.pass_tick()) break;
    axes.check_work();
    for (std::size_t i = 0; i < axes.count(); ++i) tick.axes.at(i) = axes.sample(i);
    if (options.on_tick) options.on_tick(tick);
  }
  for (std::size_t i = 0; i < axes.count(); ++i) {
    SimulationResult& one = result.axes.emplace_back();
    one.summary = axes.summary(i);
    one.stopped_early = result.stopped_early;
    one.final_state.tick = axes.tick();
    one.final_state.time_s = static_cast<double>(axes.tick()) / scene.sampling.rate_hz;
    one.final_state.truth = axes.plant(i).truth();
  }
  return result;
}

}  // namespace

void refuse_pointer(const Scene& scene) {
  if (scene.x().hand && scene.x().hand->follows_mouse) {
    throw std::invalid_argument("a hand that follows the mouse needs the window");
  }
}

SimulationResult simulate(const Scene& scene, const SimulationOptions& options) {
  refuse_pointer(scene);
  return Simulation<PlantVariant>(scene, options, make_plant, run_chunk).run();
}

AxesResult simulate_axes(const Scene& scene, const AxesOptions& options) {
  const auto couples = [](const ScheduledChange& change) { return couples_axes(change.scene); };
  if (couples_axes(scene) || std::ranges::any_of(options.changes, couples)) {
    for (std::size_t i = 0; i < scene.axes.size(); ++i) refuse_pointer(axis_scene(scene, i));
    return simulate_together(scene, options);
  }
  const bool wants_samples = static_cast<bool>(options.on_tick);
  std::deque<WaitingAxis> axes;
  for (std::size_t i = 0; i < scene.axes.size(); ++i) {
    const Scene axis = axis_scene(scene, i);
    refuse_pointer(axis);
    axes.emplace_back(axis, changes_of(options.changes, i), options);
  }
  AxesResult result;
  const auto is_over = [](WaitingAxis& axis) { return axis.simulation().over(); };
  const auto diverged = [](WaitingAxis& axis) { return axis.simulation().diverged(); };
  while (std::ranges::none_of(axes, diverged) && !std::ranges::all_of(axes, is_over)) {
    result.stopped_early = options.should_stop && options.should_stop();
    if (result.stopped_early) break;
    // A chunk may end early: those behind catch up first.
    std::uint64_t behind = scene.tick_count();
    for (WaitingAxis& axis : axes) behind = std::min(behind, axis.simulation().tick());
    for (WaitingAxis& axis : axes) {
      if (axis.simulation().tick() == behind) axis.simulation().advance();
    }
    if (wants_samples) hand_out(axes, options);
  }
  for (WaitingAxis& axis : axes) result.axes.push_back(axis.simulation().finish());
  return result;
}

}  // namespace hapticwall
