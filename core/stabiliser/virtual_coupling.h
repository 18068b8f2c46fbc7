// The virtual coupling of Colgate, Stanley and Brown.
#include <algorithm>

#include "core/scene_keys.h"
#include "core/stabiliser/law.h"

HAPTICWALL_LAW_BEGIN

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

  static double coupling_damping(const StabiliserContext& context) {
    return context.value_or("coupling_damping_n_s_per_m", 0.0);
  }
  static double coupling_stiffness(const StabiliserContext& context) {
    const double spare = believed_damping(context) - coupling_damping(context);
    return context.value_or("coupling_stiffness_n_per_m",
                            std::max(0.0, 2.0 * spare / context.period_s));
  }
  static std::optional<SceneProblem> problem(const StabiliserContext& context) {
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
      problem};
  static constexpr bool kOnlyPushes = true;

  template <class N>
  struct Parameters {
    N spring_n_per_m;    // K_c
    N damper_n_s_per_m;  // B_c
    N rate_n_per_m;      // (B + B_c)/T of the only wall: the dampers' weight in the implicit step
    N total_n_per_m;     // K + K_c + (B + B_c)/T
    N period_s;
  };
  template <class N>
  struct State {
    std::array<N, kLawWalls> proxies_m;  // penetration of each wall's proxy
  };

  static Parameters<double> parameters(const StabiliserContext& context) {
    const double spring = coupling_stiffness(context);
    const double damper = coupling_damping(context);
    const auto walls = context.walls.walls();
    const WallSettings wall = walls.empty() ? WallSettings{} : walls.front();
    const double rate = (wall.damping_n_s_per_m + damper) / context.period_s;
    return {spring, damper, rate, wall.stiffness_n_per_m + spring + rate, context.period_s};
  }

  static Number step(const Parameters<Number>& p, State<Number>& s, const Walls& walls,
                     const LawInput& in) {
    Number force_n = number(0.0);
    for (std::size_t i = 0; i < walls.count(); ++i) {
      const Number of_wall_n =
          force_of_wall(walls.count() == 1 ? p : part(p, walls[i], walls.contacts(in.position_m)),
                        walls[i], s.proxies_m[i], in);
      force_n = i == 0 ? of_wall_n : force_n + of_wall_n;
    }
    return force_n;
  }

  static std::array<Number, 1> signals(const Parameters<Number>& /*p*/, const State<Number>& s,
                                       const Walls& /*walls*/, const LawInput& /*in*/,
                                       Number /*force_n*/) {
    return {s.proxies_m[0]};
  }

 private:
  // One contact's part of the coupling.
  static Parameters<Number> part(const Parameters<Number>& p, const Wall& wall, Number contacts) {
    const Number share = number(1.0) / contacts;
    const Number spring = share * p.spring_n_per_m;
    const Number damper = share * p.damper_n_s_per_m;
    const Number rate = (wall.damping_n_s_per_m + damper) / p.period_s;
    return {spring, damper, rate, wall.stiffness_n_per_m + spring + rate, p.period_s};
  }

  // Also moves the wall's proxy. Both are 0 out of contact.
  static Number force_of_wall(const Parameters<Number>& p, const Wall& wall, Number& proxy_m,
                              const LawInput& in) {
    const Number zero = number(0.0);
    const Number penetration_m = in.position_m - wall.position_m;
    const Flags inside = greater(penetration_m, zero);
    const Number before_m = proxy_m;
    proxy_m = zero;
    if (none(inside)) return zero;
    // Without any stiffness and damping 0/0 counts as 0.
    const Number moved_m =
        positive_part((p.spring_n_per_m * penetration_m + p.damper_n_s_per_m * in.velocity_m_per_s +
                       p.rate_n_per_m * before_m) /
                      p.total_n_per_m);
    proxy_m = or_zero(inside, moved_m);
    const Number proxy_velocity_m_per_s = (moved_m - before_m) / p.period_s;
    // The wall's side of the proxy equals the coupling's side while the proxy is on the wall. It
    // avoids the cancellation in p - q when the coupling is much stiffer than the wall.
    return or_zero(inside, positive_part(wall.stiffness_n_per_m * moved_m +
                                         wall.damping_n_s_per_m * proxy_velocity_m_per_s));
  }
};

HAPTICWALL_LAW_END
