/* The energy bounding algorithm as a plug-in in C: the law of docs/algorithms/energy-bounding.md.
 */
#include <float.h>
#include <hapticwall/plugin.h>
#include <math.h>

static const hw_parameter parameters[] = {
    {"damping_n_s_per_m", "N·s/m", 0.0, 1e6, NAN, "b as the algorithm believes it"},
    {"rest_force_step_n", "N", 0.0, 1e6, NAN, "the largest step of force without motion"}};

static const hw_signal signals[] = {{"step_bound_n", "the largest change of force in this tick"}};

typedef struct {
  double damping_n_s_per_m;
  double rest_force_step_n;
} State;

static void configure(void *state, const hw_context *context) {
  State *const s = state;
  const double hidden_m_per_s = 0.0075; /* slower motion than this hides in a count */
  s->damping_n_s_per_m = context->parameters[0];
  s->rest_force_step_n = context->parameters[1];
  if (isnan(s->damping_n_s_per_m)) s->damping_n_s_per_m = context->device_damping_n_s_per_m;
  if (isnan(s->rest_force_step_n))
    s->rest_force_step_n =
        context->encoder_m > 0.0 ? s->damping_n_s_per_m * hidden_m_per_s : DBL_MAX;
}

/* The previous force is in the input: the law keeps nothing between ticks. */
static void reset(void *state) { (void)state; }

static double step(void *state, const hw_input *in, double *shown) {
  const State *const s = state;
  const double speed = fabs(in->velocity_m_per_s);
  const double bound_n = speed != 0.0 ? s->damping_n_s_per_m * speed : s->rest_force_step_n;
  if (bound_n < DBL_MAX) shown[0] = bound_n;
  const double wanted_n = in->wall_force_n - in->previous_force_n;
  if (fabs(wanted_n) <= bound_n) return in->wall_force_n;
  return in->previous_force_n + copysign(bound_n, wanted_n);
}

const hw_plugin hapticwall_plugin = {
    HAPTICWALL_PLUGIN_ABI,
    sizeof(hw_plugin),
    sizeof(State),
    2,
    1,
    parameters,
    signals,
    "bounding-c",
    "Energy bounding in C",
    "limits the change of force in a tick to what the device's damping can dissipate",
    "F_d(k) = F_d(k-1) + (F_e - F_d(k-1)) within ±b|v|, within ±α_max where v = 0",
    configure,
    reset,
    step,
};
