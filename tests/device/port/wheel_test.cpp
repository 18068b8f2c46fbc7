// The whole device on a wheel of the test, with its threads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <thread>

#include "device/link/description.h"
#include "device/os_threads.h"
#include "device/port/wheel_port.h"
#include "tests/device/port/fake_wheel.h"

namespace hapticwall::device::evdev::test {
namespace {

using ::testing::HasSubstr;

class Table {
 public:
  Wheels wheels() {
    return {[this] {
              const std::scoped_lock lock(mutex_);
              return listed;
            },
            [this](const WheelListing&) -> Result<std::shared_ptr<WheelNode>> {
              const std::scoped_lock lock(mutex_);
              wheel = std::make_shared<FakeWheel>(monotonic_ns);
              wheel->value = value.load();
              wheel->tells = tells.load();
              return std::shared_ptr<WheelNode>(wheel);
            }};
  }
  void list(std::vector<WheelListing> wheels) {
    const std::scoped_lock lock(mutex_);
    listed = std::move(wheels);
  }
  std::shared_ptr<FakeWheel> now() {
    const std::scoped_lock lock(mutex_);
    return wheel;
  }

  std::atomic<std::int32_t> value{0};  // initial value of a wheel that is opened
  std::atomic<bool> tells{true};
  std::vector<WheelListing> listed{fake_listing()};
  std::shared_ptr<FakeWheel> wheel;

 private:
  std::mutex mutex_;
};

// Ticks until it holds, for far longer than it takes.
template <typename Condition>
bool ticks_until(Device& wheel, double force_n, Condition holds) {
  for (int i = 0; i < 5000; ++i) {
    const DeviceReading reading = wheel.read();
    wheel.write(force_n);
    if (holds(reading)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

TEST(Wheel, TellsItsPositionAndItsLimits) {
  Table table;
  table.value = 3277;
  const auto device = make_wheel({}, table.wheels());
  Device& wheel = *device;
  ASSERT_FALSE(wheel.open());
  EXPECT_TRUE(ticks_until(wheel, 0.0, [](const DeviceReading& reading) {
    return reading.state == DeviceState::kOk && std::abs(reading.position_m - 0.1021) < 1e-4;
  }));
  const DeviceInfo info = wheel.info();
  EXPECT_EQ(info.name, "Fake wheel");
  EXPECT_EQ(info.force_limit_n, 5.0);
  EXPECT_EQ(info.max_force_rate_n_per_s, 2500.0) << "the limit within 2 ms";
  EXPECT_NEAR(info.motion.max_m, 1.021, 1e-3);
  EXPECT_FALSE(wheel.link().acknowledges);
  EXPECT_EQ(wheel.link().delay_s, 0.0) << "unknown";
}

TEST(Wheel, PushesOnlyWhenEnabledAndStopsWhenItIsClosed) {
  Table table;
  WheelOptions options;
  options.wheel.torque_nm = 5.0;
  const auto device = make_wheel(options, table.wheels());
  Device& wheel = *device;
  ASSERT_FALSE(wheel.open());
  const auto node = table.now();
  EXPECT_TRUE(ticks_until(
      wheel, 2.0, [](const DeviceReading& reading) { return reading.state == DeviceState::kOk; }));
  EXPECT_EQ(node->motor(), 0);
  wheel.enable(true);
  EXPECT_TRUE(ticks_until(wheel, 2.0, [&](const DeviceReading& reading) {
    return node->motor() == 1703 && std::abs(reading.applied_force_n - 2.0) < 2e-3;
  }));
  wheel.close();
  EXPECT_EQ(node->motor(), 0);
}

// A lower bound of time: a busy machine only makes it longer.
TEST(Wheel, ItsFileCannotAskForMoreThanItTakes) {
  Table table;
  table.listed[0].max_rate_hz = 100.0;
  WheelOptions options;
  options.wheel.rate_hz = 1000.0;
  const auto device = make_wheel(options, table.wheels());
  Device& wheel = *device;
  ASSERT_FALSE(wheel.open());
  const auto node = table.now();
  static_cast<void>(wheel.read());
  wheel.enable(true);
  const std::int64_t began_ns = monotonic_ns();
  EXPECT_TRUE(ticks_until(wheel, 2.0, [&](const DeviceReading&) { return node->reports >= 6; }));
  EXPECT_GE(monotonic_ns() - began_ns, 50'000'000) << "five intervals";
}

TEST(Wheel, SilenceIsRest) {
  Table table;
  const auto device = make_wheel({}, table.wheels());
  Device& wheel = *device;
  ASSERT_FALSE(wheel.open());
  int faults = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
  EXPECT_TRUE(ticks_until(wheel, 0.0, [&](const DeviceReading& reading) {
    faults += reading.state == DeviceState::kOk ? 0 : 1;
    return std::chrono::steady_clock::now() > end;
  }));
  EXPECT_LT(faults, 100) << "some, on a busy machine";
  EXPECT_EQ(wheel.link().states, 0U);
}

// One at rest has told nothing since it was opened: what the kernel has is old, or 0.
TEST(Wheel, APositionThatWasNotToldIsNone) {
  Table table;
  table.tells = false;
  const auto device = make_wheel({}, table.wheels());
  Device& wheel = *device;
  const Failure failed = wheel.open();
  ASSERT_TRUE(failed);
  EXPECT_THAT(failed->message, HasSubstr("turn the wheel a little"));
}

TEST(Wheel, AnUnpluggedOneThatComesBackSaysThatItMustBeTurned) {
  Table table;
  const auto device = make_wheel({}, table.wheels());
  Device& wheel = *device;
  ASSERT_FALSE(wheel.open());
  const auto first = table.now();
  table.tells = false;
  first->gone = true;
  EXPECT_TRUE(ticks_until(wheel, 2.0, [&](const DeviceReading& reading) {
    return reading.state != DeviceState::kOk &&
           wheel.trouble_details().find("turn the wheel a little") != std::string::npos;
  }));
  table.now()->tells = true;
  EXPECT_TRUE(ticks_until(wheel, 2.0, [&](const DeviceReading& reading) {
    return reading.state == DeviceState::kOk && wheel.trouble_details().empty();
  }));
}

TEST(Wheel, AnUnpluggedOneIsAFaultAndComesBackWithoutForce) {
  Table table;
  WheelOptions options;
  options.wheel.torque_nm = 5.0;
  const auto device = make_wheel(options, table.wheels());
  Device& wheel = *device;
  ASSERT_FALSE(wheel.open());
  wheel.enable(true);
  const auto first = table.now();
  table.list({});
  first->gone = true;
  EXPECT_TRUE(ticks_until(wheel, 2.0, [&](const DeviceReading&) {
    return wheel.link().trouble == Trouble::kUnplugged &&
           wheel.trouble_details().find("no longer connected") != std::string::npos;
  }));
  table.list({fake_listing()});
  EXPECT_TRUE(ticks_until(wheel, 2.0, [&](const DeviceReading& reading) {
    return table.now() != first && reading.state == DeviceState::kOk;
  }));
  EXPECT_EQ(table.now()->reports, 0U) << "it is armed anew, or not at all";
  EXPECT_EQ(wheel.link().losses, 1U);
}

TEST(Wheel, NoneAndAQueueingOneAreRefusedWithAReason) {
  Table table;
  table.listed.clear();
  const Failure none = make_wheel({}, table.wheels())->open();
  ASSERT_TRUE(none);
  EXPECT_THAT(none->message, HasSubstr("no wheel or stick with a constant force is connected"));
  WheelListing queues = fake_listing();
  queues.refusal = "it queues";
  table.listed = {queues};
  const Failure refused = make_wheel({}, table.wheels())->open();
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->message, "Fake wheel: it queues");
}

TEST(Wheel, TheOptionsChooseByPathOrNumbers) {
  Table table;
  table.listed.push_back(fake_listing());
  table.listed[1].node = NodeListing("event8");
  table.listed[1].product_id = 1;
  WheelPort port({}, table.wheels(), monotonic_ns);
  const auto chosen = [&](const WheelOptions& options) {
    return hid::choose(*port.list(), options_of(options), std::nullopt);
  };
  EXPECT_EQ(chosen({})->path, "/dev/input/event7") << "the first one";
  WheelOptions options;
  options.vendor_id = 0x1209;
  options.product_id = 1;
  EXPECT_EQ(chosen(options)->path, "/dev/input/event8");
  WheelOptions path;
  path.path = "/dev/input/event9";
  EXPECT_FALSE(chosen(path));
  EXPECT_THAT(make_wheel(path, table.wheels())->open()->message, HasSubstr("at /dev/input/event9"));
}

TEST(KernelAdvice, OldKernelsAreToldApart) {
  for (const char* old : {"6.1.0-56-amd64", "6.12.23", "6.13.11", "6.14.2", "5.10.0", "6.11.9"})
    EXPECT_THAT(kernel_advice(old), HasSubstr(old)) << old;
  for (const char* repaired : {"6.12.24", "6.12.107+deb12", "6.13.12", "6.14.3", "6.15.0", "7.0.1"})
    EXPECT_EQ(kernel_advice(repaired), "") << repaired;
}

}  // namespace
}  // namespace hapticwall::device::evdev::test
