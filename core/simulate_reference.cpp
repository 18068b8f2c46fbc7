#include "core/simulate.h"
#include "core/simulation_loop.h"

namespace hapticwall {

SimulationResult simulate_reference(const Scene& scene, const SimulationOptions& options) {
  refuse_pointer(scene);
  return Simulation<ReferencePlantVariant>(scene, options, make_reference_plant).run();
}

}  // namespace hapticwall
