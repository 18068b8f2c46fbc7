#include "core/simulate.h"

#include "core/simulation_loop.h"

namespace hapticwall {

SimulationResult simulate(const Scene& scene, const SimulationOptions& options) {
  refuse_pointer(scene);
  return Simulation<PlantVariant>(scene, options, make_plant).run();
}

}  // namespace hapticwall
