#include "core/run/simulate.h"
#include "core/run/simulation.h"

namespace hapticwall {
namespace {

void run_reference_chunk(HeadlessRun& run, ReferencePlantVariant& variant, std::uint64_t end) {
  std::visit([&](auto& plant) { run_loop(run, plant, end); }, variant);
}

}  // namespace

SimulationResult simulate_reference(const Scene& scene, const SimulationOptions& options) {
  refuse_pointer(scene);
  return Simulation<ReferencePlantVariant>(scene, options, make_reference_plant,
                                           run_reference_chunk)
      .run();
}

}  // namespace hapticwall
