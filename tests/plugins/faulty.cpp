// One plug-in for each fault, and `sound` and `memory` without any; FAULT names it. `full`, `half`,
// `keys`, `shown` and `large` are builds of one plug-in.
#include <limits>
#include <stdexcept>

#include "core/algorithm/plugin/include/hapticwall/plugin.h"

#define HAPTICWALL_TEXT(text) #text
#define HAPTICWALL_NAME(fault) "test-" HAPTICWALL_TEXT(fault)

namespace {

// NOLINTBEGIN(readability-identifier-naming): FAULT names them.
enum class Fault {
  sound,
  memory,
  nan,
  throws,
  abi,
  size,
  range,
  shared,
  full,
  half,
  keys,
  shown,
  large
};
// NOLINTEND(readability-identifier-naming)
constexpr Fault kFault = Fault::FAULT;
constexpr const char* kName = kFault >= Fault::full ? "test-rebuilt" : HAPTICWALL_NAME(FAULT);

struct State {
  double force_n;
};

// A first-order filter: its force depends on all forces before.
double filtered(State& state, const hw_input& in) {
  state.force_n += 0.5 * (in.wall_force_n - state.force_n);
  return state.force_n;
}

double step(void* state, const hw_input* in, double* signals) {
  const bool late = in->tick >= 500;
  signals[0] = static_cast<double>(in->tick);
  if (kFault == Fault::nan && late) return std::numeric_limits<double>::quiet_NaN();
  if (kFault == Fault::throws && late) throw std::runtime_error("a fault");
  if (kFault == Fault::half) return 0.5 * in->wall_force_n;
  return kFault == Fault::memory ? filtered(*static_cast<State*>(state), *in) : in->wall_force_n;
}

constexpr double kMaximum = kFault == Fault::range ? -1.0 : kFault == Fault::keys ? 2.0 : 1.0;
constexpr hw_parameter kParameters[] = {{kFault == Fault::shared ? "damping_n_s_per_m" : "unused",
                                         "", 0.0, kMaximum, 0.0, "no effect"}};

constexpr hw_signal kSignals[] = {
    {kFault == Fault::shown ? "counted" : "ticks", "since the start"}};

}  // namespace

const hw_plugin hapticwall_plugin = {
    kFault == Fault::abi ? 7U : HAPTICWALL_PLUGIN_ABI,
    kFault == Fault::size ? 8U : sizeof(hw_plugin),
    kFault == Fault::large ? 6001U : sizeof(State),
    1,
    1,
    kParameters,
    kSignals,
    kName,
    "Test",
    "for tests",
    "",
    [](void* /*state*/, const hw_context* /*context*/) {},
    [](void* state) { static_cast<State*>(state)->force_n = 0.0; },
    step,
};
