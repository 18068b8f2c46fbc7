// The simulated device and the hand that holds it: the smallest plant with all parts of the scene.
#pragma once

#include <variant>

#include "core/encoder.h"
#include "core/plant/exact_plant.h"
#include "core/plant/linear_body.h"
#include "core/plant/output_stage.h"
#include "core/plant/plant_variation.h"
#include "core/plant/stepped_plant.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall {

// The exact plants: with or without a lag of the amplifier, a hand that grips, friction.
template <typename Real>
using ExactPlantVariant = std::variant<ExactPlant<LinearBody<Real, false, false>, false>,
                                       ExactPlant<LinearBody<Real, false, false>, true>,
                                       ExactPlant<LinearBody<Real, false, true>, false>,
                                       ExactPlant<LinearBody<Real, false, true>, true>,
                                       ExactPlant<LinearBody<Real, true, false>, false>,
                                       ExactPlant<LinearBody<Real, true, false>, true>,
                                       ExactPlant<LinearBody<Real, true, true>, false>,
                                       ExactPlant<LinearBody<Real, true, true>, true>>;

using ReferencePlantVariant = ExactPlantVariant<long double>;

// `Variant` with more plants.
template <typename Variant, typename... Plants>
struct WithPlants;
template <typename... Exact, typename... Plants>
struct WithPlants<std::variant<Exact...>, Plants...> {
  using Type = std::variant<Exact..., Plants...>;
};
using PlantVariant = WithPlants<ExactPlantVariant<double>, SteppedPlant<SemiImplicitEuler>,
                                SteppedPlant<RungeKutta4>>::Type;

// Axis x of a scene. A hand's mass without a grip is added to the handle's. Realtime-safe: yes.
[[nodiscard]] PlantParameters plant_parameters(const Scene& scene);

// The path of a scene's hand; without a hand a path that stays at the start. Realtime-safe: no.
[[nodiscard]] HandPath hand_path(const Scene& scene);

// The plant of a validated scene. Realtime-safe: no (set-up mathematics).
[[nodiscard]] PlantVariant make_plant(const Scene& scene);
// The scene's plant with the exact integrator in long double, whatever the scene's integrator: the
// reference for measuring the others.
[[nodiscard]] ReferencePlantVariant make_reference_plant(const Scene& scene);

// Any plant behind one interface, for the live loop. Realtime-safe: yes, after construction.
class PlantModel {
 public:
  // Axis x of a validated scene. Realtime-safe: no (a matrix exponential).
  explicit PlantModel(const Scene& scene);

  // Position as the sensor measures it, with its noise.
  [[nodiscard]] double measured_position_m() const {
    const double position_m = variation_.measured_m(truth_.position_m, tick_);
    return encoder_m_ > 0.0 ? quantise(position_m, encoder_m_) : position_m;
  }
  // The state at the present tick.
  [[nodiscard]] const PlantTruth& truth() const { return truth_; }

  // True if a run ends as diverged.
  [[nodiscard]] bool has_diverged() const;
  // True if a tick was too much work for the exact integrator: the motion stands still since.
  [[nodiscard]] bool gave_up() const;

  // Advances to the next tick under a held command (newtons, finite).
  void advance(double force_n);
  // A force of the hand on the handle beside that of its spring, newtons, finite; held from the
  // present tick on. The motion stays exact.
  void push_hand(double force_n);
  // Back to the start of the scene, at rest.
  void reset();
  // See HandPath::lead_to() and release(): they act from the present tick on.
  void lead_hand_to(double position_m);
  void release_hand();

  // Continues from the state of `other`, with its hand's path and the commands on their way to the
  // amplifier. `other` may only be destroyed afterwards. Both scenes have the same rate and path.
  void take_over(PlantModel& other);

 private:
  void refresh();

  PlantVariant plant_;
  OutputStage output_;
  double encoder_m_;
  PlantVariation variation_;
  std::uint64_t tick_ = 0;
  double pushed_n_ = 0.0;
  PlantTruth truth_;
};

}  // namespace hapticwall
