#include "core/stabiliser/virtual_coupling.h"

namespace hapticwall {

double VirtualCoupling::coupling_damping(const StabiliserContext& context) {
  return context.value_or("coupling_damping_n_s_per_m", 0.0);
}

double VirtualCoupling::coupling_stiffness(const StabiliserContext& context) {
  const double spare = believed_damping(context) - coupling_damping(context);
  const double largest = std::max(0.0, 2.0 * spare / context.period_s);
  return context.value_or("coupling_stiffness_n_per_m", largest);
}

void VirtualCoupling::configure(const StabiliserContext& context) {
  walls_ = context.walls;
  period_s_ = context.period_s;
  damping_n_s_per_m_ = coupling_damping(context);
  stiffness_n_per_m_ = coupling_stiffness(context);
}

double VirtualCoupling::step(const StabiliserInput& input) {
  const auto walls = walls_.walls();
  std::size_t contacts = 0;
  while (contacts < walls.size() && input.position_m > walls[contacts].position_m) ++contacts;
  double force_n = 0.0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (i >= contacts) {
      proxies_[i] = Proxy{};
      continue;
    }
    force_n += contact_force(walls[i], proxies_[i], input.position_m - walls[i].position_m,
                             input.velocity_m_per_s, 1.0 / static_cast<double>(contacts));
  }
  return force_n;
}

double VirtualCoupling::contact_force(const WallSettings& wall, Proxy& proxy, double penetration_m,
                                      double velocity_m_per_s, double share) const {
  const double coupling_n_per_m = share * stiffness_n_per_m_;
  const double coupling_damping = share * damping_n_s_per_m_;
  // N·s/m over s: the dampers' weight in the implicit step.
  const double rate_n_per_m = (wall.damping_n_s_per_m + coupling_damping) / period_s_;
  const double total_n_per_m = wall.stiffness_n_per_m + coupling_n_per_m + rate_n_per_m;
  if (!(total_n_per_m > 0.0)) return 0.0;
  const double previous_m = proxy.penetration_m;
  proxy.penetration_m =
      std::max(0.0, (coupling_n_per_m * penetration_m + coupling_damping * velocity_m_per_s +
                     rate_n_per_m * previous_m) /
                        total_n_per_m);
  const double proxy_velocity_m_per_s = (proxy.penetration_m - previous_m) / period_s_;
  // The wall's side of the proxy: equal to the coupling's side wherever the proxy is on the wall,
  // and free of the cancellation p - q when the coupling is much stiffer than the wall.
  return std::max(0.0, wall.stiffness_n_per_m * proxy.penetration_m +
                           wall.damping_n_s_per_m * proxy_velocity_m_per_s);
}

}  // namespace hapticwall
