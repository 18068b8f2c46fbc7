// The virtual coupling of Colgate, Stanley and Brown.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/algorithm/algorithm.h"
#include "core/environment/active_environment.h"
#include "core/scene_keys.h"

namespace hapticwall {

// A spring K_c and damper B_c join the handle to a massless proxy that the wall's spring K and
// damper B carry: the displayed wall is never stiffer than the coupling. Without dampers
//
//   F_d = p K K_c/(K + K_c),
//
// with them the proxy's penetration q follows (B + B_c) q' = K_c (p - q) + B_c v - K q, integrated
// by the implicit Euler rule (unconditionally stable, passive). Each contact on the axis has its
// own proxy and 1/n of the coupling, n the number of contacts at this tick.
//
// K_c defaults to 2 (b - B_c)/T, the largest that b ≥ K_c T/2 + B_c allows [paper, Eq. 18].
// Source: Colgate et al. 1995, formula reconstructed; paper, sections 1 and 3.2.
struct VirtualCoupling {
  static constexpr std::array<ParameterDescription, 3> kParameters{
      kBelievedDampingParameter,
      number_parameter("coupling_stiffness_n_per_m", "N/m", 0.0, 1e9, "2 (b - coupling damping)/T",
                       "K_c: stiffness of the coupling between handle and proxy"),
      number_parameter("coupling_damping_n_s_per_m", "N·s/m", 0.0, 1e6, "0",
                       "B_c: damping of the coupling between handle and proxy")};

  static double coupling_damping(const AlgorithmContext& context) {
    return context.value_or("coupling_damping_n_s_per_m", 0.0);
  }
  static double coupling_stiffness(const AlgorithmContext& context) {
    const double spare = believed_damping(context) - coupling_damping(context);
    return context.value_or("coupling_stiffness_n_per_m",
                            std::max(0.0, 2.0 * spare / context.period_s));
  }
  static std::optional<SceneProblem> problem(const AlgorithmContext& context) {
    const double damping = coupling_damping(context);
    const double max_damping = believed_damping(context);
    if (damping <= max_damping || context.value("coupling_stiffness_n_per_m")) return std::nullopt;
    return SceneProblem{
        "algorithm.coupling_damping_n_s_per_m",
        number_text(damping) + " leaves no coupling stiffness: it takes at most b = " +
            number_text(max_damping) + " N·s/m unless coupling_stiffness_n_per_m is given"};
  }

  static constexpr std::array<SignalDescription, 1> kSignals{
      {{"proxy_penetration_m", "q: the penetration of the first wall's proxy"}}};
  static constexpr AlgorithmDescription kDescription{
      "virtual-coupling",
      "Virtual coupling",
      "a spring between handle and wall, as soft as the device's damping requires",
      kParameters,
      "F_d = p K K_c/(K + K_c);  K_c = 2(b - B_c)/T, shared by the contacts",
      kSignals,
      problem,
      "",
      "",
      nullptr,
      true};

  void configure(const AlgorithmContext& context) {
    spring_n_per_m_ = coupling_stiffness(context);
    damper_n_s_per_m_ = coupling_damping(context);
    period_s_ = context.period_s;
    walls_ = context.walls;
  }
  void reset() { proxies_m_ = {}; }

  double step(const AlgorithmInput& in, std::span<double> signals) {
    if (in.environment != nullptr) return force_of_environment(*in.environment, in, signals);
    // Each contact's part of the coupling. In front of all walls it is not used.
    const double share = walls_.count() > 1 ? 1.0 / walls_.contacts(in.position_m) : 1.0;
    double force_n = 0.0;
    for (std::size_t i = 0; i < walls_.count(); ++i)
      force_n += force_of_wall(share, walls_[i], proxies_m_[i], in);
    signals[0] = proxies_m_[0];
    return force_n;
  }

 private:
  // The environment counts as a spring of its stiffness hint K without a damper, whose depth p is
  // F_e/K. Coupling and spring share that depth, and the force keeps the sign of F_e.
  [[nodiscard]] double force_of_environment(const ActiveEnvironment& environment,
                                            const AlgorithmInput& in, std::span<double> signals) {
    const double stiffness_n_per_m = environment.stiffness_hint();
    const double before_m = std::exchange(proxies_m_[0], 0.0);
    // NaN if it is unknown.
    if (!in.in_contact || !(stiffness_n_per_m > 0.0)) return 0.0 * stiffness_n_per_m;
    const double sign = std::copysign(1.0, in.wall_force_n);
    const double depth_m = std::abs(in.wall_force_n) / stiffness_n_per_m;
    const double rate = damper_n_s_per_m_ / period_s_;
    const double pushed_n = spring_n_per_m_ * depth_m +
                            sign * (damper_n_s_per_m_ * in.velocity_m_per_s + rate * before_m);
    const double proxy_m = std::max(0.0, pushed_n / (stiffness_n_per_m + spring_n_per_m_ + rate));
    proxies_m_[0] = signals[0] = sign * proxy_m;
    return sign * stiffness_n_per_m * proxy_m;
  }

  // Force of one wall; also moves the wall's proxy. Both are 0 out of contact.
  [[nodiscard]] double force_of_wall(double share, const WallSettings& wall, double& proxy_m,
                                     const AlgorithmInput& in) const {
    const double penetration_m = in.position_m - wall.position_m;
    const double before_m = std::exchange(proxy_m, 0.0);
    if (!(penetration_m > 0.0)) return 0.0;
    const double spring = share * spring_n_per_m_;
    const double damper = share * damper_n_s_per_m_;
    const double rate = (wall.damping_n_s_per_m + damper) / period_s_;  // of the implicit step
    // Without any stiffness and damping 0/0 counts as 0.
    proxy_m =
        std::max(0.0, (spring * penetration_m + damper * in.velocity_m_per_s + rate * before_m) /
                          (wall.stiffness_n_per_m + spring + rate));
    const double proxy_velocity_m_per_s = (proxy_m - before_m) / period_s_;
    // The wall's side of the proxy equals the coupling's side while the proxy is on the wall. It
    // avoids the cancellation in p - q when the coupling is much stiffer than the wall.
    return std::max(
        0.0, wall.stiffness_n_per_m * proxy_m + wall.damping_n_s_per_m * proxy_velocity_m_per_s);
  }

  double spring_n_per_m_ = 0.0;    // K_c
  double damper_n_s_per_m_ = 0.0;  // B_c
  double period_s_ = 0.0;
  WallSet walls_;
  std::array<double, kMaxWalls> proxies_m_{};  // penetration of each wall's proxy
};

}  // namespace hapticwall
