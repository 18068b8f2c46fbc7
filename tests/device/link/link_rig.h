// One emulated device and a host in virtual time that pushes against it.
#pragma once

#include <cstdint>
#include <utility>

#include "tests/device/emulator/emulator_support.h"
#include "tests/device/link/link_virtual_host.h"

namespace hapticwall::device::testing {

inline constexpr std::uint64_t kMillisecondUs = 1000;
inline constexpr double kPushN = 2.0;

class Rig {
 public:
  explicit Rig(hid::FaultScript script = {}, const ImpulseEngineOptions& options = {},
               const hid::EmulatorSettings& settings = hid::testing::one_axis())
      : plug(bus.add(hid::testing::usual_listing(), settings, std::move(script))),
        host(bus, options) {
    prepare();
  }
  // A device that speaks a dialect.
  Rig(const ImpulseEngineOptions& options, std::unique_ptr<hid::testing::ForeignBoard> board)
      : plug(bus.add(hid::testing::foreign_listing(options), hid::testing::one_axis())),
        host(bus, options) {
    plug.foreign = std::move(board);
    prepare();
  }
  void prepare() {
    host.behaviour.force_n = {kPushN, 0.0};
    host.after_tick = [this] {
      if (force_n() != 0.0) last_force_us = host.now_us();
    };
  }

  // Force at the amplifiers: pushing out of the wall is towards smaller counts.
  [[nodiscard]] double force_n() const {
    return plug.foreign ? plug.foreign->force_n() : plug.device.amplifier_force_n()[0];
  }
  [[nodiscard]] bool pushes() const { return force_n() == -kPushN; }
  void tick_until_ms(std::uint64_t time_ms) {
    while (host.now_us() < time_ms * kMillisecondUs) host.tick();
  }
  // Up, armed, pushing, and nothing seen yet.
  void drive_until_ms(std::uint64_t time_ms) {
    EXPECT_TRUE(host.come_up());
    host.arm();
    tick_until_ms(time_ms);
    EXPECT_TRUE(pushes());
    host.troubles.clear();
  }
  // Off the bus for a while.
  void replug() {
    plug.hidden = true;
    host.ticks(100);
    plug.hidden = false;
  }
  [[nodiscard]] bool saw(Trouble trouble) const { return host.troubles.contains(trouble); }

  hid::testing::FakeBus bus;
  hid::testing::Plug& plug;
  VirtualHost host;
  std::uint64_t last_force_us = 0;
};

}  // namespace hapticwall::device::testing
