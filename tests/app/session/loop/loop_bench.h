// A loop on a device of the test, one cycle at a time, without a thread, on the test's clock.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "app/session/loop/loop_driver.h"
#include "tests/app/session/support.h"

namespace hapticwall::session::test {

// Ten seconds. The queues of a session take 127 MB, and touching them takes longer than most tests.
inline constexpr QueueCapacities kBenchQueues{.plot = 10'000, .recorder = 10'000};

template <typename TestDevice>
struct LoopBench {
  // `for_device` are the arguments of the device's constructor.
  template <typename... ForDevice>
  explicit LoopBench(const Scene& first, bool start_paused = false,
                     const QueueCapacities& capacities = kBenchQueues, ForDevice&&... for_device)
      : scene(first),
        device(std::forward<ForDevice>(for_device)...),
        exchange(capacities, parameters_of(first)),
        loop({&device}, exchange, parameters_of(first), start_paused) {}

  void cycles(int count) {
    for (int i = 0; i < count; ++i) loop.cycle({clock.now_ns(), 0, 0}, clock);
  }
  void command(CommandKind kind, std::uint32_t ticks = 0) {
    ASSERT_TRUE(exchange.commands.try_push({kind, ticks}));
  }
  Snapshot snapshot() {
    exchange.snapshots.update();
    return exchange.snapshots.current();
  }

  Scene scene;
  TestDevice device;
  Exchange exchange;
  ServoLoop loop;
  FakeClock clock;
};

}  // namespace hapticwall::session::test
