// A loop on a simulator, beside which the same run goes headless.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "app/session/plant_keeper.h"
#include "core/run/simulate.h"
#include "device/simulated_device.h"
#include "tests/app/session/loop/loop_bench.h"
#include "tests/samples.h"

namespace hapticwall::session::test {

struct Harness : LoopBench<device::SimulatedDevice> {
  explicit Harness(const Scene& first, bool start_paused = false,
                   const QueueCapacities& capacities = kBenchQueues)
      : LoopBench(first, start_paused, capacities, first), plants(first) {}

  void publish(const Scene& changed) {
    const bool unread = exchange.parameters.withdraw();
    ++generation;
    PlantModel* plant = plants.plant_for(changed, generation, unread);
    exchange.parameters.publish(parameters_of(changed, generation, plant));
  }
  static std::vector<Sample> taken(SpscQueue<Tick>& queue) {
    std::vector<Sample> samples;
    for (Tick tick; queue.try_pop(tick);) samples.push_back(tick.x());
    return samples;
  }
  std::vector<Sample> samples() { return taken(exchange.plot); }
  std::vector<ParameterEcho> echoes() {
    std::vector<ParameterEcho> all;
    for (ParameterEcho echo; exchange.echoes.try_pop(echo);) {
      all.push_back(echo);
      plants.came_into_force(echo.generation);
    }
    return all;
  }

  PlantKeeper plants;
  std::uint32_t generation = 1;
};

inline std::vector<Sample> headless(Scene scene, std::size_t ticks,
                                    const std::vector<ScheduledChange>& changes = {}) {
  scene.duration_s = static_cast<double>(ticks) / scene.sampling.rate_hz;
  return hapticwall::testing::samples_of(scene, changes);
}

// Every field, bit for bit, except the generation, which only a live session has.
inline void expect_same(const std::vector<Sample>& live, const std::vector<Sample>& reference) {
  static_assert(sizeof(Sample) == (24 + kMaxSignals) * sizeof(double),
                "no padding: bytes can be compared");
  ASSERT_EQ(live.size(), reference.size());
  for (std::size_t i = 0; i < live.size(); ++i) {
    Sample sample = live[i];
    sample.generation = 0;
    // Compares bits, because zero has a sign.
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
    ASSERT_EQ(std::memcmp(&sample, &reference[i], sizeof sample), 0)
        << "tick " << i << ": position " << sample.position_m << " / " << reference[i].position_m
        << ", force " << sample.force_n << " / " << reference[i].force_n << ", flags "
        << sample.flags << " / " << reference[i].flags;
  }
}

}  // namespace hapticwall::session::test
