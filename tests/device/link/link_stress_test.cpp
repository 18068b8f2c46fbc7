// The real threads of a link, started, stopped, unplugged and blocked at any moment; clean under
// ThreadSanitizer. Tests wait for conditions, never for times.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <memory>
#include <thread>

#include "device/port/impulse_engine.h"
#include "tests/device/link/link_real_bus.h"

namespace hapticwall::device {
namespace {

using hid::testing::RealBus;
using hid::testing::RealPort;
using hid::testing::slow_ns;

constexpr std::chrono::seconds kPatience{60};
constexpr std::chrono::milliseconds kPace{1};

bool wait_for(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(kPace);
  }
  return true;
}

std::unique_ptr<ImpulseEngine> engine_on(const std::shared_ptr<RealBus>& bus) {
  return make_impulse_engine({}, std::make_unique<RealPort>(bus), slow_ns);
}

// A loop that reads and writes until a condition holds.
bool loop_until(ImpulseEngine& engine, const std::function<bool(const AxesReading&)>& condition) {
  return wait_for([&] {
    const AxesReading reading = engine.read_axes();
    engine.write_axes({1.0, 0.5});
    return condition(reading);
  });
}
bool is_ok(const AxesReading& reading) { return reading.state == DeviceState::kOk; }
bool is_faulty(const AxesReading& reading) { return !is_ok(reading); }

TEST(LinkStress, StartsAndStopsManyTimesAndLeavesNothingOpen) {
  const auto bus = std::make_shared<RealBus>();
  for (int round = 0; round < 20; ++round) {
    const auto engine = engine_on(bus);
    const Failure failure = engine->open();
    ASSERT_FALSE(failure) << failure->message;
    EXPECT_EQ(bus->open_handles(), 2);
    EXPECT_EQ(engine->info().name, "Emulated device");
    EXPECT_EQ(engine->info().encoder_m, 1.0 / 3937.0);
    EXPECT_EQ(engine->info().force_limit_n, 8.9);
    EXPECT_FALSE(engine->info().is_simulated);
    if (round % 2 == 0) {
      ASSERT_TRUE(loop_until(*engine, is_ok));
    }
    if (round % 3 == 0) engine->close();
    if (round % 6 == 0) {
      ASSERT_FALSE(engine->open());
    }
    engine->close();
    ASSERT_EQ(bus->open_handles(), 0);
    // One thread an open(): the owner's.
    ASSERT_LE(bus->take_owners(), round % 6 == 0 ? 2U : 1U);
  }
}

TEST(LinkStress, TheForceComesAndGoesWithTheDevice) {
  const auto bus = std::make_shared<RealBus>();
  const auto engine = engine_on(bus);
  ASSERT_FALSE(engine->open());
  // The calls of a window.
  std::jthread asker([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      static_cast<void>(engine->trouble_details());
      static_cast<void>(engine->info());
      std::this_thread::sleep_for(kPace);
    }
  });
  for (int round = 0; round < 3; ++round) {
    ASSERT_TRUE(loop_until(*engine, [&](const AxesReading& reading) {
      // Enables the device again, as a person does after every loss.
      engine->enable(false);
      engine->enable(is_ok(reading));
      return is_ok(reading) && bus->force_n() == -1.0;
    }));
    bus->plug(false);
    ASSERT_TRUE(loop_until(*engine, is_faulty));
    ASSERT_TRUE(loop_until(*engine, [&](const AxesReading&) { return bus->open_handles() == 0; }));
    ASSERT_TRUE(loop_until(*engine, [&](const AxesReading&) {
      return engine->link().trouble == Trouble::kUnplugged;
    }));
    bus->plug(true);
    const std::uint64_t before = engine->link().states;
    // A continued request is no new request.
    ASSERT_TRUE(loop_until(*engine, [&](const AxesReading&) {
      engine->enable(true);
      return engine->link().connected && engine->link().states > before + 10;
    }));
    EXPECT_EQ(bus->force_n(), 0.0);
  }
  EXPECT_GE(engine->link().losses, 3U);
  engine->close();
  EXPECT_EQ(bus->open_handles(), 0);
  EXPECT_EQ(bus->take_owners(), 1U);
}

TEST(LinkStress, ABlockedWriteDoesNotKeepTheProgramFromEnding) {
  const auto bus = std::make_shared<RealBus>();
  auto engine = engine_on(bus);
  ASSERT_FALSE(engine->open());
  bus->block(true);
  ASSERT_TRUE(loop_until(*engine, [&](const AxesReading&) { return bus->blocked_writes() == 1; }));
  engine->close();
  EXPECT_EQ(bus->blocked_writes(), 1);
  EXPECT_EQ(bus->open_handles(), 1);  // the one that is being written to, and no other
  engine.reset();
  bus->block(false);
  EXPECT_TRUE(wait_for([&] { return bus->open_handles() == 0; }));
  EXPECT_TRUE(wait_for([&] { return bus.use_count() == 1; }));  // all of the link is gone
  EXPECT_EQ(bus->take_owners(), 1U);
}

TEST(LinkStress, ABlockedWriteDoesNotKeepTheLinkFromComingBack) {
  const auto bus = std::make_shared<RealBus>();
  const auto engine = engine_on(bus);
  ASSERT_FALSE(engine->open());
  for (int round = 0; round < 2; ++round) {
    bus->block(true);
    ASSERT_TRUE(loop_until(*engine,
                           [&](const AxesReading&) { return bus->blocked_writes() == round + 1; }));
    bus->plug(false);
    ASSERT_TRUE(loop_until(*engine, is_faulty));
    bus->plug(true);
    // The new writer's first command blocks, too, and positions still arrive.
    ASSERT_TRUE(loop_until(*engine, is_ok));
  }
  bus->block(false);
  ASSERT_TRUE(loop_until(*engine, [&](const AxesReading& reading) {
    engine->enable(false);
    engine->enable(is_ok(reading));
    return bus->blocked_writes() == 0 && bus->open_handles() == 2 && bus->force_n() == -1.0;
  }));
  engine->close();
  EXPECT_EQ(bus->open_handles(), 0);
  EXPECT_EQ(bus->take_owners(), 1U);
}

TEST(LinkStress, TheThreadsThatReadAndWriteCanBePrepared) {
  const auto bus = std::make_shared<RealBus>();
  std::atomic<int> prepared{0};
  ImpulseEngineOptions options;
  options.prepare_thread = [&] { ++prepared; };
  const auto engine = make_impulse_engine(options, std::make_unique<RealPort>(bus), slow_ns);
  ASSERT_FALSE(engine->open());
  EXPECT_TRUE(wait_for([&] { return prepared == 2; }));
  engine->close();
  EXPECT_EQ(prepared, 2);
}

TEST(LinkStress, NothingConnectedIsOneClearSentence) {
  const auto bus = std::make_shared<RealBus>();
  bus->plug(false);
  const auto engine = engine_on(bus);
  const Failure failure = engine->open();
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, ErrorKind::kDevice);
  EXPECT_EQ(failure->message,
            "no haptic device is connected; 'hapticwall devices' lists the connected devices");
  // A closed device accepts all calls.
  EXPECT_EQ(engine->read().state, DeviceState::kFault);
  engine->write(1.0);
  engine->enable(true);
  engine->close();
  EXPECT_EQ(engine->trouble_details(), "");
  EXPECT_EQ(engine->link().states, 0U);
}

}  // namespace
}  // namespace hapticwall::device
