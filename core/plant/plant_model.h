// The simulated device with the hand that holds it: the plant that a scene's tables ask for and no
// more.
#pragma once

#include <variant>

#include "core/encoder.h"
#include "core/plant/exact_plant.h"
#include "core/plant/one_body.h"
#include "core/plant/stepped_plant.h"
#include "core/plant/two_bodies.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall {

// Every plant: integrator, with or without a hand that grips, with or without friction.
using PlantVariant = std::variant<
    ExactPlant<OneBody, false>, ExactPlant<OneBody, true>, ExactPlant<TwoBodies, false>,
    ExactPlant<TwoBodies, true>, SteppedPlant<SemiImplicitEuler, false, false>,
    SteppedPlant<SemiImplicitEuler, false, true>, SteppedPlant<SemiImplicitEuler, true, false>,
    SteppedPlant<SemiImplicitEuler, true, true>, SteppedPlant<RungeKutta4, false, false>,
    SteppedPlant<RungeKutta4, false, true>, SteppedPlant<RungeKutta4, true, false>,
    SteppedPlant<RungeKutta4, true, true>>;

// The plant of a validated scene. Realtime-safe: no (set-up mathematics).
[[nodiscard]] PlantVariant make_plant(const Scene& scene);

// The same behind one interface, for the live loop. Realtime-safe: yes, after construction.
class PlantModel {
 public:
  explicit PlantModel(const Scene& scene)
      : plant_(make_plant(scene)), encoder_m_(scene.device.encoder_m.value_or(0.0)) {
    refresh();
  }

  // As the encoder tells it.
  [[nodiscard]] double measured_position_m() const {
    return encoder_m_ > 0.0 ? quantise(truth_.position_m, encoder_m_) : truth_.position_m;
  }
  // The state at the present tick.
  [[nodiscard]] const PlantTruth& truth() const { return truth_; }

  // To the next tick under a held force (newtons, finite).
  void advance(double force_n) {
    std::visit([&](auto& plant) { plant.advance(force_n); }, plant_);
    refresh();
  }
  void reset() {
    std::visit([](auto& plant) { plant.reset(); }, plant_);
    refresh();
  }
  void lead_hand_to(double position_m) {
    std::visit([&](auto& plant) { plant.path().lead_to(position_m); }, plant_);
    refresh();
  }
  void release_hand() {
    std::visit([](auto& plant) { plant.path().release(); }, plant_);
    refresh();
  }

 private:
  void refresh() {
    std::visit([&](auto& plant) { plant.write_truth(plant.motion(), truth_); }, plant_);
  }

  PlantVariant plant_;
  double encoder_m_;
  PlantTruth truth_;
};

}  // namespace hapticwall
