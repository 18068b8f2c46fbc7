// The summary of recorded or live samples of a scene with one axis or two.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/run/metrics.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::command {

class AxesMetrics {
 public:
  // Parameters as in Metrics.
  AxesMetrics(const Scene& scene, std::uint64_t planned_ticks, SampleOrigin origin) {
    for (std::size_t axis = 0; axis < scene.axes.size(); ++axis) {
      axes_.emplace_back(axis_scene(scene, axis), planned_ticks, origin);
    }
  }

  // Precondition: the tick has the axes of the scene.
  void add(const Tick& tick) {
    for (std::size_t axis = 0; axis < axes_.size(); ++axis) axes_[axis].add(tick.axes[axis]);
  }
  // The axes that diverged, at these ticks: their samples may not show it.
  void diverge(const std::array<std::optional<std::uint64_t>, kMaxAxes>& ticks) {
    for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
      if (ticks.at(axis)) axes_[axis].diverge(*ticks.at(axis));
    }
  }
  [[nodiscard]] RunSummary finish() const {
    RunSummary run;
    for (const Metrics& axis : axes_) run.push_back(axis.finish());
    return run;
  }

 private:
  std::vector<Metrics> axes_;
};

}  // namespace hapticwall::command
