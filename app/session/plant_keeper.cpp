#include "app/session/plant_keeper.h"

#include <algorithm>
#include <utility>

namespace hapticwall::session {

PlantKeeper::PlantKeeper(const Scene& first) { kept_.push_back(kept(first, 1, nullptr)); }

PlantKeeper::Kept PlantKeeper::kept(const Scene& scene, std::uint32_t generation,
                                    std::unique_ptr<PlantModel> plant) {
  Kept entry;
  entry.scene.x().device = scene.x().device;
  entry.scene.x().hand = scene.x().hand;
  entry.scene.simulator = scene.simulator;
  entry.generation = generation;
  entry.plant = std::move(plant);
  return entry;
}

PlantModel* PlantKeeper::plant_for(const Scene& scene, std::uint32_t generation, bool unread) {
  // The loop has never used a plant that was first offered with unread parameters.
  const bool untouched =
      unread && kept_.size() > 1 && kept_.back().generation == newest_generation_;
  newest_generation_ = generation;
  if (untouched && same_plant(kept_.back().scene, scene)) {
    kept_.back().generation = generation;
    return kept_.back().plant.get();
  }
  // Compares with the plant that the loop uses, as a headless run does: an unseen change and its
  // reversal are no change.
  if (untouched) kept_.pop_back();
  if (!same_plant(kept_.back().scene, scene)) {
    kept_.push_back(kept(scene, generation, std::make_unique<PlantModel>(scene)));
  }
  return kept_.back().plant.get();
}

void PlantKeeper::came_into_force(std::uint32_t generation) {
  while (kept_.size() > 1 && kept_[1].generation <= generation) kept_.pop_front();
}

std::size_t PlantKeeper::count() const {
  return static_cast<std::size_t>(std::count_if(
      kept_.begin(), kept_.end(), [](const Kept& entry) { return entry.plant != nullptr; }));
}

}  // namespace hapticwall::session
