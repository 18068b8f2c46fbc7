// What differs from tick to tick at random in a simulated plant: the length of the tick, and the
// noise of the position.
#pragma once

#include <cstdint>

#include "core/chance.h"
#include "core/scene.h"

namespace hapticwall {

// Realtime-safe: yes.
class PlantVariation {
 public:
  // Of axis x. All axes have the same periods.
  explicit PlantVariation(const Scene& scene)
      : jitter_(scene.sampling.jitter.value_or(0.0)),
        noise_m_(scene.x().device.position_noise_m.value_or(0.0)),
        period_(scene.sampling.seed.value_or(1), 0, Purpose::kPeriod),
        noise_(scene.sampling.seed.value_or(1), scene.first_axis, Purpose::kPositionNoise) {}

  [[nodiscard]] bool any_period() const { return jitter_ > 0.0; }
  // False: measured_m() returns its argument.
  [[nodiscard]] bool has_noise() const { return noise_m_ > 0.0; }
  // Length of the tick, nominal periods.
  [[nodiscard]] double periods(std::uint64_t tick) const {
    return 1.0 + jitter_ * (2.0 * period_.uniform(tick) - 1.0);
  }
  // The position at the begin of a tick with the noise of the sensor.
  [[nodiscard]] double measured_m(double position_m, std::uint64_t tick) const {
    return noise_m_ > 0.0 ? position_m + noise_m_ * noise_.normal(tick) : position_m;
  }

 private:
  double jitter_;
  double noise_m_;
  Chance period_;
  Chance noise_;
};

// Advances a plant to the end of this tick under the held force.
template <typename Plant>
void advance_plant(Plant& plant, const PlantVariation& variation, std::uint64_t tick,
                   double force_n) {
  if (variation.any_period()) {
    plant.advance_for(force_n, variation.periods(tick));
  } else {
    plant.advance(force_n);
  }
}

}  // namespace hapticwall
