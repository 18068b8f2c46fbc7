// The contact of Hunt and Crossley with the exponent 1.5, as an environment in C++
// (docs/environments.md).
//
//   c++ -shared -fPIC -O2 -ffp-contract=off -std=c++20 tissue.cpp -o tissue.so
#include <hapticwall/environment.h>

#include <algorithm>
#include <cmath>

namespace {

constexpr double kSurfaceM = 0.05;

double depth_m(const void* /*state*/, const hw_motion* motion) {
  return motion->position_m - kSurfaceM;
}

double force_n(const void* state, const hw_motion* motion) {
  const double depth = depth_m(state, motion);
  if (!(depth > 0.0)) return 0.0;
  const double ratio = depth / 0.01;
  const double spring_n = 5.0 * (ratio * std::sqrt(ratio));
  return std::max(0.0, spring_n * (1.0 + 0.5 * motion->velocity_m_per_s));
}

}  // namespace

extern "C" {
const hw_environment hapticwall_environment{
    .abi = HAPTICWALL_ENVIRONMENT_ABI,
    .size = sizeof(hw_environment),
    .state_bytes = 0,
    .parameter_count = 0,
    .parameters = nullptr,
    .name = "tissue-cpp",
    .title = "Tissue in C++",
    .idea = "soft at the surface, stiffer with the depth",
    .equation = "F_e = F_0 (p/p_0)^1.5 (1 + D v)",
    .configure = nullptr,
    .reset = nullptr,
    .force = force_n,
    .advance = nullptr,
    .depth = depth_m,
    .stiffness_hint = nullptr,
};
}
