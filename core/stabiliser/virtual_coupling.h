// The virtual coupling of Colgate, Stanley and Brown.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/stabiliser/stabiliser.h"

namespace hapticwall {

// A spring K_c and damper B_c between the handle and a massless proxy that the wall's spring K and
// damper B carry: what is displayed is never stiffer than the coupling. Without dampers
//
//   F_d = p K K_c/(K + K_c),
//
// with them the proxy's penetration q follows (B + B_c) q' = K_c (p - q) + B_c v - K q, integrated
// by the implicit Euler rule (unconditionally stable, passive). Each contact on the axis has its
// own proxy and 1/n of the coupling, n the number of contacts at this tick.
//
// K_c defaults to 2 (b - B_c)/T, the largest that b ≥ K_c T/2 + B_c allows [paper, Eq. 18].
// Source: Colgate et al. 1995, formula reconstructed; paper, sections 1 and 3.2.
// Realtime-safe: yes.
class VirtualCoupling {
 public:
  static constexpr std::array<ParameterDescription, 3> kParameters{
      kBelievedDampingParameter,
      ParameterDescription{"coupling_stiffness_n_per_m",
                           ParameterKind::kNumber,
                           "N/m",
                           0.0,
                           1e9,
                           {},
                           "2 (b - coupling damping)/T",
                           "K_c: stiffness of the coupling between handle and proxy"},
      ParameterDescription{"coupling_damping_n_s_per_m",
                           ParameterKind::kNumber,
                           "N·s/m",
                           0.0,
                           1e6,
                           {},
                           "0",
                           "B_c: damping of the coupling between handle and proxy"}};
  static constexpr AlgorithmDescription kDescription{
      "virtual-coupling", "Virtual coupling",
      "a spring between handle and wall, as soft as the device's damping requires", kParameters,
      "F_d = p K K_c/(K + K_c);  K_c = 2(b - B_c)/T, shared by the contacts"};

  // K_c and B_c as a scene has them, named or by default.
  [[nodiscard]] static double coupling_stiffness(const StabiliserContext& context);
  [[nodiscard]] static double coupling_damping(const StabiliserContext& context);

  void configure(const StabiliserContext& context);
  void reset() { proxies_.fill(Proxy{}); }
  [[nodiscard]] double step(const StabiliserInput& input);

 private:
  struct Proxy {
    double penetration_m = 0.0;
  };

  [[nodiscard]] double contact_force(const WallSettings& wall, Proxy& proxy, double penetration_m,
                                     double velocity_m_per_s, double share) const;

  WallSet walls_;
  double period_s_ = 1e-3;
  double stiffness_n_per_m_ = 0.0;
  double damping_n_s_per_m_ = 0.0;
  std::array<Proxy, kMaximumWalls> proxies_{};
};

}  // namespace hapticwall
