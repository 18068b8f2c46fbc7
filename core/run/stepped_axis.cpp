#include "core/run/stepped_axis.h"

#include <utility>

namespace hapticwall {

void SteppedAxis::change(Scene changed) {
  changed.sampling = changed.sampling.with_clock_of(scene_.sampling);
  servo_.apply(servo_settings(changed));
  if (!same_plant(changed, scene_)) {
    auto plant = std::make_unique<PlantModel>(changed);
    plant->take_over(*plant_);
    plant_ = std::move(plant);
  }
  scene_ = std::move(changed);
}

}  // namespace hapticwall
