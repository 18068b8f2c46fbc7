// The summary of recorded or live samples of a scene with one axis or two.
#pragma once

#include <cstdint>
#include <optional>

#include "core/metrics.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::command {

class AxesMetrics {
 public:
  // As Metrics.
  AxesMetrics(const Scene& scene, std::uint64_t planned_ticks, bool has_truth)
      : x_(scene, planned_ticks, has_truth) {
    if (scene.y) y_.emplace(second_axis(scene), planned_ticks, has_truth);
  }

  // `y` is not looked at where the scene has one axis.
  void add(const Sample& x, const Sample& y) {
    x_.add(x);
    if (y_) y_->add(y);
  }
  [[nodiscard]] Summary finish() const {
    Summary summary = x_.finish();
    if (y_) summary.y.push_back(y_->finish());
    return summary;
  }

 private:
  Metrics x_;
  std::optional<Metrics> y_;
};

}  // namespace hapticwall::command
