// Levels through a kernel and hid-pidff, each with the time of its command: tests/wheel_guest runs
// it in a guest and finds each level in the log of the wheel.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "device/os_threads.h"
#include "device/port/wheel_port.h"

namespace hapticwall::device::evdev::test {
namespace {

TEST(KernelWheel, LevelsReachItOneByOne) {
  const char* log = std::getenv("HAPTICWALL_WHEEL_SENT");  // NOLINT(concurrency-mt-unsafe)
  if (log == nullptr) GTEST_SKIP() << "only in the guest of tests/wheel_guest";
  WheelOptions options;
  // A level is a little less than a millinewton, the step of a command.
  options.wheel.torque_nm = 0.13 * 32.7667;
  options.wheel.force_limit_n = 32.0;
  const char* rate_hz = std::getenv("HAPTICWALL_WHEEL_RATE_HZ");  // NOLINT(concurrency-mt-unsafe)
  if (rate_hz != nullptr) options.wheel.rate_hz = std::strtod(rate_hz, nullptr);
  const auto wheel = make_wheel(options);
  const Failure failed = wheel->open();
  ASSERT_FALSE(failed) << failed->message;
  static_cast<void>(wheel->read());
  wheel->enable(true);
  std::ofstream sent(log);
  sent << "time_us,level\n";
  const WheelScale scale(options.wheel, {-kFullLevel, kFullLevel});
  std::int64_t next_ns = monotonic_ns();
  for (int tick = 0; tick < 3000; ++tick) {
    next_ns += 1'000'000;
    std::this_thread::sleep_for(std::chrono::nanoseconds(next_ns - monotonic_ns()));
    static_cast<void>(wheel->read());
    const double force_n = (2 * tick + 2) / 1000.0;  // even levels: the writer adds odd ones
    sent << monotonic_ns() / 1000 << ',' << scale.level(force_n) << '\n';
    wheel->write(force_n);
  }
  EXPECT_EQ(wheel->link().trouble, Trouble::kNone);
}

}  // namespace
}  // namespace hapticwall::device::evdev::test
