// The owner's side of plants that change while a session runs.
//
// A plant is built here, on the owner's thread, and its address travels with the parameters. The
// loop lets it take over from the one before and uses it from then on; it never frees one. The
// loop's echo of the parameters says that it has let go of everything older, and the owner frees
// that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>

#include "core/plant/plant_model.h"
#include "core/scene.h"

namespace hapticwall::runtime {

// Used by one thread. Realtime-safe: no.
class PlantKeeper {
 public:
  // `first`: the scene of generation 1, whose plant the device has brought itself.
  explicit PlantKeeper(const Scene& first);

  // The plant for parameters that are about to be published under this generation (which increases
  // from call to call): the one that the loop will then be running with where the scene has the
  // same, else a new one. nullptr: the device's own. `unread`: the loop has not seen and will not
  // see the parameters of the call before. Precondition: the scene is valid.
  [[nodiscard]] PlantModel* plant_for(const Scene& scene, std::uint32_t generation, bool unread);

  // The loop runs with these parameters: what was replaced by then is freed.
  void came_into_force(std::uint32_t generation);

  // Plants that are kept at this moment, without the device's own.
  [[nodiscard]] std::size_t count() const;

 private:
  struct Kept {
    Scene scene;                   // less what no plant depends on
    std::uint32_t generation = 1;  // the first that uses it
    std::unique_ptr<PlantModel> plant;
  };

  [[nodiscard]] static Kept kept(const Scene& scene, std::uint32_t generation,
                                 std::unique_ptr<PlantModel> plant);

  std::deque<Kept> kept_;  // oldest first; never empty
  std::uint32_t newest_generation_ = 1;
};

}  // namespace hapticwall::runtime
