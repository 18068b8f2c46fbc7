// All axes of a scene on the simulator, a tick at a time, with the metrics of a run.
#pragma once

#include <cstdint>
#include <vector>

#include "core/run/metrics.h"
#include "core/run/stepped_axis.h"
#include "core/summary.h"

namespace hapticwall {

// Ticks, metrics and summaries are those of simulate_axes(). Axes that need each other tick
// together. Realtime-safe: pass_tick() and push_hand().
class MeasuredAxes {
 public:
  // A validated scene.
  explicit MeasuredAxes(const Scene& scene);

  [[nodiscard]] std::size_t count() const { return axes_.size(); }
  // A force of the hand on the handle beside that of its spring, newtons; held from the next tick
  // on until another one.
  void push_hand(std::size_t axis, double force_n);
  // Computes the next tick and passes its time. False: the run has diverged at tick() of an axis,
  // and there is no further tick.
  [[nodiscard]] bool pass_tick();
  // Throws SimulationRefused if a tick was too much work for the exact integrator.
  void check_work() const;
  // Takes a scene that a session may change to, from the next tick on.
  void change(const Scene& scene);

  // The next tick, or the tick at which an axis diverged.
  [[nodiscard]] std::uint64_t tick() const;
  [[nodiscard]] bool diverged() const;
  // Of the last tick. Precondition: axis < count(), as for all from here.
  [[nodiscard]] const Sample& sample(std::size_t axis) const { return axes_[axis].sample; }
  [[nodiscard]] const PlantModel& plant(std::size_t axis) const {
    return axes_[axis].stepped.plant();
  }
  // Of the ticks so far, as a run that ends here.
  [[nodiscard]] Summary summary(std::size_t axis) const;

 private:
  struct Axis {
    explicit Axis(const Scene& scene) : stepped(scene), metrics(tick_metrics(scene)) {}

    SteppedAxis stepped;
    TickMetrics metrics;
    Sample sample;
    bool pushed = false;  // ever
  };

  [[nodiscard]] bool compute();

  std::vector<Axis> axes_;
};

}  // namespace hapticwall
