// Time-domain passivity control of Hannaford and Ryu: an observer and the damper that it drives.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/algorithm/algorithm.h"

namespace hapticwall {

// The observer sums the energy that went into the virtual wall. When it would fall below what is
// tolerated, a damper takes back the missing part:
//
//   W = E(k-1) + F_e(k) Δx_k      (observer "same-sample": Hannaford & Ryu 2002; paper, Eq. 6)
//   W = E(k-1) + F_d(k-1) Δx_k    (observer "held-force":  Ryu et al. 2004; paper, Eq. 10)
//   W = E(k-1) + F_d(k-1) Δx_k + F_e(k) Δx_k   (observer "one-step")
//   W < -credit, |v_k| > floor:   α = min((-credit - W)/(T v_k²), α_max),  F_d = F_e + α v_k
//   else                          F_d = F_e;      E follows the force really applied.
//
// The observer "same-sample" is blind to the hold: on a spring wall W is never negative
// [paper, Eq. 12] and the controller never acts (the paper's Figure 4 (c)). The observer "one-step"
// predicts Δx_{k+1} = Δx_k and takes what the hold will then have given out.
// Source: Hannaford & Ryu 2002 and Ryu et al. 2004, formulas reconstructed; for the prediction we
// read no original. The quotient is used only where it is at most α_max|v|, so it cannot overflow.
struct PassivityControl {
  static constexpr std::array<std::string_view, 3> kObservers{"same-sample", "held-force",
                                                              "one-step"};
  static constexpr std::array<ParameterDescription, 6> kParameters{
      kBelievedDampingParameter,
      choice_parameter("observer", kObservers,
                       "which force the observer pairs with the motion of a tick"),
      switch_parameter("damping_credit",
                       "tolerate what the device's damping eats: act below -b T Σ v² only"),
      switch_parameter("reset_in_free_motion",
                       "forget the observed energy while the handle is out of the wall"),
      number_parameter("max_damping_n_s_per_m", "N·s/m", 0.0, 1e6,
                       "b, the largest damper that the hold renders passively",
                       "α_max: the largest damper that the controller may inject"),
      number_parameter("velocity_floor_m_per_s", "m/s", 0.0, 1e3, "0",
                       "no action at or below this measured speed")};
  static constexpr std::array<SignalDescription, 3> kSignals{
      {{"observed_energy_j", "W: the energy that went into the wall, by the observer"},
       {"credit_j", "b T Σ v²: how far W may be below zero"},
       {"injected_damping_n_s_per_m", "α: the damper of this tick"}}};
  static constexpr AlgorithmDescription kDescription{
      "passivity-control",
      "Passivity control",
      "watches the energy that the wall returns and damps the handle when it is too much",
      kParameters,
      "W = E(k-1) + F_e Δx;  F_d = F_e + α v where W < 0,  α = min(-W/(T v²), α_max)",
      kSignals,
      nullptr,
      "",
      "observer"};

  // α_max defaults to b, because b ≥ K T/2 + B with K = 0 [paper, Eq. 18].
  void configure(const AlgorithmContext& context) {
    damping_n_s_per_m_ = believed_damping(context);
    max_damping_n_s_per_m_ = context.value_or("max_damping_n_s_per_m", damping_n_s_per_m_);
    velocity_floor_m_per_s_ = context.value_or("velocity_floor_m_per_s", 0.0);
    observer_ = static_cast<Observer>(context.value_or("observer", 0.0));
    damping_credit_ = context.value_or("damping_credit", 0.0) != 0.0;
    reset_in_free_motion_ = context.value_or("reset_in_free_motion", 0.0) != 0.0;
  }
  void reset() { observed_j_ = credit_j_ = pending_displacement_m_ = 0.0; }

  double step(const AlgorithmInput& in, std::span<double> signals) {
    observe(in);
    const double energy_j = observer_ == Observer::kHeldForce
                                ? observed_j_
                                : observed_j_ + in.wall_force_n * in.displacement_m;  // W
    const double deficit_j = -credit_j_ - energy_j;
    double force_n = in.wall_force_n;
    if (deficit_j > 0.0 && std::abs(in.velocity_m_per_s) > velocity_floor_m_per_s_) {
      // A damper α takes α T v² in a tick; T v = Δx.
      const double most_j = max_damping_n_s_per_m_ * energy_per_damping(in);
      force_n += most_j <= deficit_j ? max_damping_n_s_per_m_ * in.velocity_m_per_s
                                     : deficit_j / in.displacement_m;
    }
    signals[0] = energy_j;
    signals[1] = credit_j_;
    signals[2] =
        in.velocity_m_per_s != 0.0 ? (force_n - in.wall_force_n) / in.velocity_m_per_s : 0.0;
    return force_n;
  }

 private:
  enum class Observer : std::uint8_t { kSameSample, kHeldForce, kOneStep };  // order of kObservers

  [[nodiscard]] static double energy_per_damping(const AlgorithmInput& in) {
    return std::abs(in.velocity_m_per_s * in.displacement_m);
  }

  void observe(const AlgorithmInput& in) {
    if (!in.in_contact && reset_in_free_motion_) return reset();
    // The force really applied is known one tick later: both pairings take it from there.
    observed_j_ +=
        in.previous_force_n *
        (observer_ == Observer::kSameSample ? pending_displacement_m_ : in.displacement_m);
    pending_displacement_m_ = in.displacement_m;
    if (damping_credit_) credit_j_ += damping_n_s_per_m_ * energy_per_damping(in);
  }

  double damping_n_s_per_m_ = 0.0;       // b
  double max_damping_n_s_per_m_ = 0.0;   // α_max
  double velocity_floor_m_per_s_ = 0.0;  // floor
  Observer observer_ = Observer::kSameSample;
  bool damping_credit_ = false;
  bool reset_in_free_motion_ = false;
  double observed_j_ = 0.0;              // E
  double credit_j_ = 0.0;                // b T Σ v²
  double pending_displacement_m_ = 0.0;  // Δx of the last tick, whose force is known only now
};

}  // namespace hapticwall
