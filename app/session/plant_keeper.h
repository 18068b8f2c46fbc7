// Ownership of plants that change during a session.
//
// The owner's thread builds a plant and passes its address with the parameters. The loop takes over
// the state and uses the new plant; it never frees one. The loop's echo shows that all older plants
// are unused, and the owner frees them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>

#include "core/plant/plant_model.h"
#include "core/scene.h"

namespace hapticwall::session {

// Used by one thread. Realtime-safe: no.
class PlantKeeper {
 public:
  // `first`: the scene of generation 1, with the plant of the device.
  explicit PlantKeeper(const Scene& first);

  // The plant for the parameters of this generation (increasing from call to call): the one that
  // the loop will be using if the scene has the same plant, else a new one. nullptr: that of the
  // device. `unread`: the loop never sees the parameters of the previous call. Precondition: the
  // scene is valid.
  [[nodiscard]] PlantModel* plant_for(const Scene& scene, std::uint32_t generation, bool unread);

  // The loop uses these parameters: frees all older plants.
  void came_into_force(std::uint32_t generation);

  // Number of plants kept, without that of the device.
  [[nodiscard]] std::size_t count() const;

 private:
  struct Kept {
    Scene scene;                   // without values that no plant depends on
    std::uint32_t generation = 1;  // the first one that uses it
    std::unique_ptr<PlantModel> plant;
  };

  [[nodiscard]] static Kept kept(const Scene& scene, std::uint32_t generation,
                                 std::unique_ptr<PlantModel> plant);

  std::deque<Kept> kept_;  // oldest first; never empty
  std::uint32_t newest_generation_ = 1;
};

}  // namespace hapticwall::session
