// The simulated device with the hand that holds it: the plant that a scene's tables ask for and no
// more.
#pragma once

#include <variant>

#include "core/encoder.h"
#include "core/plant/exact_plant.h"
#include "core/plant/one_body.h"
#include "core/plant/output_stage.h"
#include "core/plant/stepped_plant.h"
#include "core/plant/two_bodies.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall {

// The exact plants: with or without a hand that grips, friction, an amplifier's lag.
template <typename Real>
using ExactPlantVariant = std::variant<
    ExactPlant<BasicOneBody<Real, false>, false>, ExactPlant<BasicOneBody<Real, false>, true>,
    ExactPlant<BasicOneBody<Real, true>, false>, ExactPlant<BasicOneBody<Real, true>, true>,
    ExactPlant<BasicTwoBodies<Real, false>, false>, ExactPlant<BasicTwoBodies<Real, false>, true>,
    ExactPlant<BasicTwoBodies<Real, true>, false>, ExactPlant<BasicTwoBodies<Real, true>, true>>;

// The same with an integrator that steps: grip, friction, lag.
template <template <PlantParts> class Scheme>
using SteppedPlantVariant = std::variant<SteppedPlant<Scheme<PlantParts{false, false, false}>>,
                                         SteppedPlant<Scheme<PlantParts{false, false, true}>>,
                                         SteppedPlant<Scheme<PlantParts{false, true, false}>>,
                                         SteppedPlant<Scheme<PlantParts{false, true, true}>>,
                                         SteppedPlant<Scheme<PlantParts{true, false, false}>>,
                                         SteppedPlant<Scheme<PlantParts{true, false, true}>>,
                                         SteppedPlant<Scheme<PlantParts{true, true, false}>>,
                                         SteppedPlant<Scheme<PlantParts{true, true, true}>>>;

// By integrator, in the order of Integrator.
using PlantVariant = std::variant<ExactPlantVariant<double>, SteppedPlantVariant<SemiImplicitEuler>,
                                  SteppedPlantVariant<RungeKutta4>>;

using ReferencePlantVariant = std::variant<ExactPlantVariant<long double>>;

// Calls `visitor` with the plant itself.
template <typename Visitor, typename Variant>
decltype(auto) visit_plant(Visitor&& visitor, Variant& variant) {
  return std::visit([&](auto& group) -> decltype(auto) { return std::visit(visitor, group); },
                    variant);
}

// Of a scene whose hand does not grip. Realtime-safe: yes.
[[nodiscard]] OneBodyParameters one_body_parameters(const Scene& scene);

// The path of a scene's hand; one that stays at the start where a scene has none. Realtime-safe:
// no.
[[nodiscard]] HandPath hand_path(const Scene& scene);

// The plant of a validated scene. Realtime-safe: no (set-up mathematics).
[[nodiscard]] PlantVariant make_plant(const Scene& scene);
// The scene's plant with the exact integrator, whatever the scene says, in long double: the
// reference against which all others are measured.
[[nodiscard]] ReferencePlantVariant make_reference_plant(const Scene& scene);

// The same behind one interface, for the live loop. Realtime-safe: yes, after construction.
class PlantModel {
 public:
  explicit PlantModel(const Scene& scene);

  // As the encoder tells it.
  [[nodiscard]] double measured_position_m() const {
    return encoder_m_ > 0.0 ? quantise(truth_.position_m, encoder_m_) : truth_.position_m;
  }
  // The state at the present tick.
  [[nodiscard]] const PlantTruth& truth() const { return truth_; }

  // True where a run ends as diverged.
  [[nodiscard]] bool has_diverged() const;

  // To the next tick under a held command (newtons, finite).
  void advance(double force_n);
  void reset();
  void lead_hand_to(double position_m);
  void release_hand();

  // Goes on from where `other` is, with its hand's path and what is on its way to the amplifier;
  // `other` is good for nothing but its destruction after that. Both scenes have the same rate and
  // path.
  void take_over(PlantModel& other);

 private:
  void refresh();

  PlantVariant plant_;
  OutputStage output_;
  double encoder_m_;
  PlantTruth truth_;
};

}  // namespace hapticwall
