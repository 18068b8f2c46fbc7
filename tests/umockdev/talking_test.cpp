// Reports both ways between the program's port and the emulated firmware, through the real
// libhidapi.
#include <array>
#include <future>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/device/emulator/emulator_support.h"
#include "tests/umockdev/hidraw_test.h"

namespace hapticwall::device::hid::testing {
namespace {

// Timeout for reports that come: far longer than they take. Nothing waits for it to pass.
constexpr int kLongMs = 20'000;
constexpr std::uint64_t kForeverUs = 1'000'000'000;

class HidrawTalk : public HidrawTest {
 protected:
  // A device in which `faults` happen, open.
  void start(FaultScript faults = {}, const EmulatorSettings& settings = one_axis()) {
    device_ = &bus_.plug({}, FirmwareEmulator(settings, std::move(faults)));
    EXPECT_EQ(listing_of(device_->path()).usage_page, kUsagePage);
    handle_ = opened(*device_);
    ASSERT_NE(handle_, nullptr);
  }
  void ticks(std::uint64_t count) { device_->node().step(count * kTickUs); }

  ReadOutcome read(int wait_ms = 0) { return handle_->read(room_, wait_ms); }
  [[nodiscard]] std::span<const std::uint8_t> bytes(const ReadOutcome& outcome) const {
    return std::span(room_).first(outcome.size);
  }
  // The next report, which must be a STATE.
  StateReport next_state() {
    const ReadOutcome outcome = read(kLongMs);
    EXPECT_EQ(outcome.kind, ReadKind::kReport);
    const auto decoded = decode_state(bytes(outcome));
    EXPECT_NE(decoded.report(), nullptr);
    return decoded.report() == nullptr ? StateReport{} : *decoded.report();
  }
  [[nodiscard]] double amplifier_force_n() {
    return device_->node().with_emulator(
        [](const FirmwareEmulator& emulator) { return emulator.amplifier_force_n()[0]; });
  }

  static ForceReport command(std::uint16_t sequence, const StateReport& state, double force_n) {
    ForceReport force;
    force.enable = true;
    force.sequence = sequence;
    force.echoed_state_sequence = state.sequence;
    force.force_n = {force_n, 0.0};
    return force;
  }

  MockDevice* device_ = nullptr;
  std::unique_ptr<Handle> handle_;
  std::array<std::uint8_t, kReportBytes + 32> room_{};
};

TEST_F(HidrawTalk, InfoIsWhatTheFirmwareSays) {
  start();
  const std::size_t size = handle_->get_feature(kInfoId, room_);
  const auto expected = device_->node().with_emulator(
      [](const FirmwareEmulator& emulator) { return emulator.get_feature(kInfoId); });
  ASSERT_TRUE(expected);
  ASSERT_EQ(size, kReportBytes);
  EXPECT_TRUE(std::equal(expected->begin(), expected->end(), room_.begin()));
}

TEST_F(HidrawTalk, WithoutInfoTheFeatureFailsAndStatesCome) {
  EmulatorSettings settings = one_axis();
  settings.has_info = false;
  start({}, settings);
  EXPECT_EQ(handle_->get_feature(kInfoId, room_), 0U);
  ticks(1);
  EXPECT_EQ(next_state().sequence, 1);
}

TEST_F(HidrawTalk, AnotherFeatureIsNotThere) {
  start();
  EXPECT_EQ(handle_->get_feature(kStateId, room_), 0U);
}

TEST_F(HidrawTalk, StatesComeOneByOneInTheirOrder) {
  start();
  EXPECT_EQ(read().kind, ReadKind::kNothing);
  ticks(5);
  for (std::uint16_t sequence = 1; sequence <= 5; ++sequence) {
    EXPECT_EQ(next_state().sequence, sequence);
  }
  EXPECT_EQ(read().kind, ReadKind::kNothing);
  EXPECT_EQ(read(1).kind, ReadKind::kNothing);
}

TEST_F(HidrawTalk, AForceReachesTheAmplifiersAndIsAcknowledged) {
  start();
  ticks(1);
  EXPECT_TRUE(handle_->write(encode_force(command(1, next_state(), -1.5))));
  ticks(1);
  EXPECT_EQ(amplifier_force_n(), -1.5);
  const StateReport state = next_state();
  EXPECT_EQ(state.acknowledged_sequence, 1);
  EXPECT_EQ(state.applied_force_n[0], -1.5);
  EXPECT_EQ(state.status & kStatusEnabled, kStatusEnabled);
}

TEST_F(HidrawTalk, TheWatchdogOfADeviceThatHearsNothingTakesTheForce) {
  start();
  ticks(1);
  EXPECT_TRUE(handle_->write(encode_force(command(1, next_state(), 2.0))));
  ticks(1);
  EXPECT_EQ(amplifier_force_n(), 2.0);
  ticks(60);
  EXPECT_EQ(amplifier_force_n(), 0.0);
  StateReport state;
  for (ReadOutcome next = read(); next.kind == ReadKind::kReport; next = read()) {
    state = *decode_state(bytes(next)).report();
  }
  EXPECT_EQ(state.fault, kFaultWatchdog);
}

TEST_F(HidrawTalk, WhoeverWaitsIsWokenByAReport) {
  start();
  auto waiting = std::async(std::launch::async, [&] { return next_state().sequence; });
  ticks(1);
  EXPECT_EQ(waiting.get(), 1);
}

TEST_F(HidrawTalk, WhatArrivesSpoiltArrivesAsItIs) {
  struct Spoilt {
    FaultKind kind;
    Refusal refusal;
  };
  std::uint64_t begin_us = kTickUs;
  std::vector<Fault> faults;
  const std::vector<Spoilt> all{
      {FaultKind::kShort, Refusal::kLength}, {FaultKind::kOverLong, Refusal::kLength},
      {FaultKind::kWrongId, Refusal::kId},   {FaultKind::kWrongMajor, Refusal::kProtocol},
      {FaultKind::kBadCrc, Refusal::kCrc},   {FaultKind::kAllZero, Refusal::kId}};
  for (const Spoilt& spoilt : all) {
    faults.push_back({spoilt.kind, begin_us, kTickUs});
    begin_us += kTickUs;
  }
  start(FaultScript(faults));
  ticks(all.size());
  for (const Spoilt& spoilt : all) {
    const ReadOutcome outcome = read(kLongMs);
    EXPECT_EQ(outcome.kind, ReadKind::kReport);
    const auto decoded = decode_state(bytes(outcome));
    ASSERT_NE(decoded.refusal(), nullptr);
    EXPECT_EQ(*decoded.refusal(), spoilt.refusal);
  }
  ticks(1);
  EXPECT_EQ(next_state().sequence, all.size() + 1);
}

TEST_F(HidrawTalk, AnEmptyPacketIsNoFailure) {
  start({{FaultKind::kEmpty, kTickUs, kTickUs}});
  ticks(2);
  const ReadOutcome outcome = read(kLongMs);
  EXPECT_NE(outcome.kind, ReadKind::kFailed);
  EXPECT_EQ(outcome.size, 0U);
  EXPECT_EQ(next_state().sequence, 2);
}

// The kernel does the same: a reader of one report a turn reads the past.
TEST_F(HidrawTalk, WhatNobodyReadsIsKeptFromTheOldestOn) {
  start();
  ticks(200);
  std::uint16_t sequence = 0;
  for (std::size_t i = 0; i < HidrawNode::kKernelQueue; ++i) sequence = next_state().sequence;
  EXPECT_EQ(sequence, HidrawNode::kKernelQueue);
  EXPECT_EQ(read().kind, ReadKind::kNothing);
  ticks(1);
  EXPECT_EQ(next_state().sequence, 201);
}

TEST_F(HidrawTalk, AWriteThatIsNotTakenFailsAndTheNextOneIsAsGoodAsEver) {
  start({{FaultKind::kNoOutput, 0, 2 * kTickUs}});
  ticks(1);
  const StateReport state = next_state();
  EXPECT_FALSE(handle_->write(encode_force(command(1, state, 1.0))));
  ticks(2);
  EXPECT_EQ(amplifier_force_n(), 0.0);
  EXPECT_TRUE(handle_->write(encode_force(command(2, state, 1.0))));
  ticks(1);
  EXPECT_EQ(amplifier_force_n(), 1.0);
}

TEST_F(HidrawTalk, OffTheBusEverythingFails) {
  start({{FaultKind::kUnplugged, 2 * kTickUs, kForeverUs}});
  ticks(3);
  EXPECT_EQ(read(kLongMs).kind, ReadKind::kFailed);
  EXPECT_EQ(read().kind, ReadKind::kFailed);
  EXPECT_FALSE(handle_->write(encode_force({})));
  EXPECT_EQ(handle_->get_feature(kInfoId, room_), 0U);
}

TEST_F(HidrawTalk, UnpluggedWhileSomebodyWaitsAndPluggedInAgain) {
  start();
  auto waiting = std::async(std::launch::async, [&] { return read(kLongMs).kind; });
  bus_.unplug(*device_);
  EXPECT_EQ(waiting.get(), ReadKind::kFailed);
  EXPECT_THAT(listed(), ::testing::IsEmpty());
  handle_.reset();
  start();
  ticks(1);
  EXPECT_EQ(next_state().sequence, 1);
}

// One handle reads, the other writes, and the bus goes on: three threads, as in the program.
TEST_F(HidrawTalk, TwoHandlesOfADeviceServeTwoThreads) {
  constexpr std::uint16_t kCommands = 200;
  start();
  const auto writing = opened(*device_);
  ASSERT_NE(writing, nullptr);
  auto writer = std::async(std::launch::async, [&] {
    int failed = 0;
    for (std::uint16_t i = 1; i <= kCommands; ++i) {
      ForceReport force;
      force.sequence = i;  // without enable it is taken with any echo
      if (!writing->write(encode_force(force))) ++failed;
    }
    return failed;
  });
  auto reader = std::async(std::launch::async, [&] {
    int states = 0;
    while (next_state().acknowledged_sequence != kCommands) ++states;
    return states;
  });
  while (reader.wait_for(std::chrono::seconds(0)) != std::future_status::ready) ticks(1);
  EXPECT_EQ(writer.get(), 0);
  EXPECT_GT(reader.get(), 0);
}

}  // namespace
}  // namespace hapticwall::device::hid::testing
