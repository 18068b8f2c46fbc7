// The energy bounding algorithm as a plug-in in C++: the law of docs/algorithms/energy-bounding.md.
#include <hapticwall/plugin.h>

#include <array>
#include <cmath>
#include <limits>
#include <new>

namespace {

constexpr double kUnset = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<hw_parameter, 2> kParameters{
    {{"damping_n_s_per_m", "N·s/m", 0.0, 1e6, kUnset, "b as the algorithm believes it"},
     {"rest_force_step_n", "N", 0.0, 1e6, kUnset, "the largest step of force without motion"}}};

constexpr std::array<hw_signal, 1> kSignals{
    {{"step_bound_n", "the largest change of force in this tick"}}};

// Lives in the host's block: no destructor runs.
struct Law {
  double damping_n_s_per_m;
  double rest_force_step_n;

  explicit Law(const hw_context& context)
      : damping_n_s_per_m(context.parameters[0]), rest_force_step_n(context.parameters[1]) {
    constexpr double kHiddenMPerS = 0.0075;  // slower motion than this hides in a count
    if (std::isnan(damping_n_s_per_m)) damping_n_s_per_m = context.device_damping_n_s_per_m;
    if (!std::isnan(rest_force_step_n)) return;
    rest_force_step_n = context.encoder_m > 0.0 ? damping_n_s_per_m * kHiddenMPerS
                                                : std::numeric_limits<double>::max();
  }

  [[nodiscard]] double step(const hw_input& in, double* signals) const {
    const double speed = std::abs(in.velocity_m_per_s);
    const double bound_n = speed != 0.0 ? damping_n_s_per_m * speed : rest_force_step_n;
    if (bound_n < std::numeric_limits<double>::max()) signals[0] = bound_n;
    const double wanted_n = in.wall_force_n - in.previous_force_n;
    if (std::abs(wanted_n) <= bound_n) return in.wall_force_n;
    return in.previous_force_n + std::copysign(bound_n, wanted_n);
  }
};

}  // namespace

const hw_plugin hapticwall_plugin = {
    HAPTICWALL_PLUGIN_ABI,
    sizeof(hw_plugin),
    sizeof(Law),
    kParameters.size(),
    kSignals.size(),
    kParameters.data(),
    kSignals.data(),
    "bounding-cpp",
    "Energy bounding in C++",
    "limits the change of force in a tick to what the device's damping can dissipate",
    "F_d(k) = F_d(k-1) + (F_e - F_d(k-1)) within ±b|v|, within ±α_max where v = 0",
    [](void* state, const hw_context* context) { new (state) Law(*context); },
    [](void* /*state*/) {},
    [](void* state, const hw_input* input, double* signals) {
      return static_cast<Law*>(state)->step(*input, signals);
    },
};
