/* The contact of Hunt and Crossley with the exponent 1.5, as an environment in C
 * (docs/environments.md).
 *
 *   cc -shared -fPIC -O2 -ffp-contract=off tissue.c -lm -o tissue.so
 */
#include <hapticwall/environment.h>
#include <math.h>
#include <stddef.h>

static const hw_parameter parameters[] = {
    {"position_m", "m", -1.0, 1.0, 0.05, "the surface of the tissue"},
    {"reference_force_n", "N", 0.0, 1e6, 5.0, "F_0: the force at 10 mm, at rest"}};

typedef struct {
  double surface_m;
  double force_n;
} State;

static void configure(void *state, const hw_environment_context *context) {
  State *const s = state;
  s->surface_m = context->parameters[0];
  s->force_n = context->parameters[1];
}

static double depth(const void *state, const hw_motion *motion) {
  const State *const s = state;
  return motion->position_m - s->surface_m;
}

static double force(const void *state, const hw_motion *motion) {
  const State *const s = state;
  const double depth_m = depth(state, motion);
  if (!(depth_m > 0.0)) return 0.0;
  const double ratio = depth_m / 0.01;
  const double spring_n = s->force_n * (ratio * sqrt(ratio));
  const double force_n = spring_n * (1.0 + 0.5 * motion->velocity_m_per_s);
  return force_n > 0.0 ? force_n : 0.0;
}

const hw_environment hapticwall_environment = {
    HAPTICWALL_ENVIRONMENT_ABI,
    sizeof(hw_environment),
    sizeof(State),
    2,
    parameters,
    "tissue-c",
    "Tissue in C",
    "soft at the surface, stiffer with the depth",
    "F_e = F_0 (p/p_0)^1.5 (1 + D v)",
    configure,
    NULL, /* reset: no past */
    force,
    NULL, /* advance: no motion of its own */
    depth,
    NULL, /* stiffness_hint */
};
