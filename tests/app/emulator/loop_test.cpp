// The emulated device on a bus, in the test's time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "tests/device/emulator/emulator_support.h"
#include "tests/emulator/program/device_loop.h"
#include "tests/emulator/program/tick_log.h"

namespace hapticwall::emulator {
namespace {

using device::hid::BusRequest;
using device::hid::EmulatorSettings;
using device::hid::FaultKind;
using device::hid::FaultScript;
using device::hid::FirmwareEmulator;
using device::hid::ForceReport;
using device::hid::RequestKind;
using device::hid::StateReport;
using device::hid::VirtualBus;

constexpr std::int64_t kTickNs = 1'000'000;
constexpr std::uint64_t kTickUs = 1000;
constexpr double kPushN = 2.0;

// Requests come at their time; `wake_late_ns` is how late the machine wakes us.
class FakeBus : public VirtualBus {
 public:
  Failure plug() override {
    if (refuses) return Error{ErrorKind::kDevice, "no"};
    plugs.push_back(now_ns_);
    return {};
  }
  void unplug() override { unplugs.push_back(now_ns_); }
  void send(std::span<const std::uint8_t> bytes) override {
    const auto decoded = device::hid::decode_state(bytes);
    if (decoded.report() != nullptr) states.emplace_back(now_ns_, *decoded.report());
  }
  std::optional<BusRequest> next_request() override {
    if (requests.empty() || requests.front().first > now_ns_) return {};
    BusRequest request = requests.front().second;
    requests.pop_front();
    return request;
  }
  void answer_get(std::uint32_t ticket, std::span<const std::uint8_t> bytes) override {
    got.emplace_back(ticket, bytes.size());
  }
  void answer_set(std::uint32_t ticket, bool taken) override { set.emplace_back(ticket, taken); }
  std::int64_t now_ns() override { return now_ns_; }
  void wait_until_ns(std::int64_t deadline_ns) override {
    std::int64_t until_ns = deadline_ns + std::exchange(wake_late_ns, 0);
    if (!requests.empty()) until_ns = std::min(until_ns, requests.front().first);
    now_ns_ = std::max(now_ns_, until_ns);
  }

  void push_at(std::int64_t time_ns, std::uint16_t sequence, bool enable = true) {
    ForceReport command;
    command.enable = enable;
    command.sequence = sequence;
    command.echoed_state_sequence = static_cast<std::uint16_t>((time_ns - kStartNs) / kTickNs);
    command.force_n = {kPushN, 0.0};
    const auto bytes = device::hid::encode_force(command);
    requests.emplace_back(
        time_ns, BusRequest{RequestKind::kOutput, 0, bytes[0], {bytes.begin(), bytes.end()}});
  }

  static constexpr std::int64_t kStartNs = 7'000'123;
  bool refuses = false;
  std::int64_t wake_late_ns = 0;  // of the next wait
  std::deque<std::pair<std::int64_t, BusRequest>> requests;
  std::vector<std::pair<std::int64_t, StateReport>> states;
  std::vector<std::int64_t> plugs;
  std::vector<std::int64_t> unplugs;
  std::vector<std::pair<std::uint32_t, std::size_t>> got;
  std::vector<std::pair<std::uint32_t, bool>> set;

 private:
  std::int64_t now_ns_ = kStartNs;
};

// A device that runs for so many ticks.
struct Table {
  explicit Table(std::uint64_t ticks, FaultScript faults = {}, bool in_step = false)
      : device(settings(), std::move(faults)),
        loop(device, bus, {.duration_us = ticks * kTickUs, .in_step = in_step}) {
    loop.on_tick = [this] { rows.push_back(row_of(device)); };
  }
  static EmulatorSettings settings() {
    EmulatorSettings settings = device::hid::testing::one_axis();
    settings.hand_waits = true;
    return settings;
  }

  FirmwareEmulator device;
  FakeBus bus;
  DeviceLoop loop;
  std::vector<TickRow> rows;
};

constexpr std::int64_t at(double ticks) {
  return FakeBus::kStartNs + static_cast<std::int64_t>(ticks * kTickNs);
}

TEST(EmulatorLoop, ATickIsSentAtItsTimeAndTheEndUnplugs) {
  Table table(3);
  EXPECT_FALSE(table.loop.run());
  ASSERT_EQ(table.bus.states.size(), 3U);
  for (std::uint16_t i = 0; i < 3; ++i) {
    EXPECT_EQ(table.bus.states[i].first, at(i + 1));
    EXPECT_EQ(table.bus.states[i].second.sequence, i + 1);
    EXPECT_EQ(table.bus.states[i].second.time_us, (i + 1) * kTickUs);
  }
  EXPECT_EQ(table.bus.plugs, std::vector<std::int64_t>{at(0)});
  EXPECT_EQ(table.bus.unplugs, std::vector<std::int64_t>{at(3)});
}

TEST(EmulatorLoop, ACommandIsTakenAtItsTimeAndActsAtTheNextTick) {
  Table table(4);
  table.bus.push_at(at(1.4), 1);
  EXPECT_FALSE(table.loop.run());
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_EQ(table.rows[0].force_n[0], 0.0);
  EXPECT_FALSE(table.rows[0].enabled);
  EXPECT_EQ(table.rows[1].force_n[0], kPushN);
  EXPECT_TRUE(table.rows[1].enabled);
  EXPECT_EQ(table.bus.states[1].second.acknowledged_sequence, 1);
  EXPECT_EQ(table.bus.states[1].second.acknowledged_time_us, 1400U);
  EXPECT_EQ(table.loop.stats().commands, 1U);
}

TEST(EmulatorLoop, LateIsLateAndOldReportsAreNotSent) {
  Table table(6);
  table.bus.wake_late_ns = 3 * kTickNs + kTickNs / 2;
  EXPECT_FALSE(table.loop.run());
  ASSERT_EQ(table.bus.states.size(), 3U);
  EXPECT_EQ(table.bus.states[0].second.sequence, 4);
  EXPECT_NE(table.bus.states[0].second.status & device::hid::kStatusReportOverrun, 0);
  EXPECT_EQ(table.bus.states[1].first, at(5));  // no tick is put off
  EXPECT_EQ(table.bus.states[1].second.status & device::hid::kStatusReportOverrun, 0);
  EXPECT_EQ(table.rows.size(), 6U);  // every tick happened
  EXPECT_EQ(table.loop.stats().late_ticks, 3U);
  EXPECT_EQ(table.loop.stats().largest_latency_ns, 3 * kTickNs + kTickNs / 2);
}

TEST(EmulatorLoop, UnpluggedItLeavesTheBusAndComesBack) {
  Table table(20, {{FaultKind::kUnplugged, 5 * kTickUs, 10 * kTickUs}});
  for (std::uint16_t i = 1; i < 20; ++i) table.bus.push_at(at(i + 0.5), i);
  EXPECT_FALSE(table.loop.run());
  EXPECT_EQ(table.bus.plugs, (std::vector<std::int64_t>{at(0), at(15)}));
  EXPECT_EQ(table.bus.unplugs, (std::vector<std::int64_t>{at(5), at(20)}));
  EXPECT_EQ(table.rows[3].force_n[0], kPushN);
  EXPECT_FALSE(table.rows[4].plugged);
  EXPECT_EQ(table.rows[7].force_n[0], 0.0);  // 3 ms without a start of frame
  EXPECT_EQ(table.rows[12].force_n[0], 0.0);
  EXPECT_TRUE(table.rows[14].plugged);
}

TEST(EmulatorLoop, AnswersWhatTheHostAsks) {
  Table table(3);
  const auto info = device::hid::kInfoId;
  const auto force = device::hid::kForceId;
  const auto command = device::hid::encode_force({.enable = true, .sequence = 1});
  const std::vector<std::uint8_t> bytes(command.begin(), command.end());
  table.bus.requests = {{at(0.1), {RequestKind::kGetFeature, 11, info, {}}},
                        {at(0.2), {RequestKind::kGetFeature, 12, force, {}}},
                        {at(0.3), {RequestKind::kSet, 13, force, bytes}},
                        {at(0.4), {RequestKind::kSet, 14, info, bytes}}};
  EXPECT_FALSE(table.loop.run());
  EXPECT_EQ(table.bus.got, (std::vector<std::pair<std::uint32_t, std::size_t>>{
                               {11, device::hid::kReportBytes}, {12, 0}}));
  EXPECT_EQ(table.bus.set, (std::vector<std::pair<std::uint32_t, bool>>{{13, true}, {14, false}}));
  EXPECT_TRUE(table.rows[0].enabled);
}

// Whatever the phase of the host: its commands then come half-way between two ticks.
TEST(EmulatorLoop, InStepItMovesTheTickOnce) {
  for (const double phase : {0.02, 0.3, 0.5, 0.7, 0.98}) {
    Table table(12, {}, true);
    table.bus.push_at(at(3 + phase), 1, false);
    for (std::uint16_t i = 4; i < 10; ++i) table.bus.push_at(at(i + phase), i);
    EXPECT_FALSE(table.loop.run());
    ASSERT_EQ(table.bus.states.size(), 12U) << phase;
    EXPECT_EQ(table.bus.states[2].first, at(3)) << phase;  // not moved by a command without enable
    for (std::size_t i = 4; i < 12; ++i) {
      EXPECT_NEAR(static_cast<double>(table.bus.states[i].first - at(0)),
                  (static_cast<double>(i) + phase + 0.5) * kTickNs, 1.0)
          << phase;
    }
    // The tick after the first command is the first with force, as without the move.
    EXPECT_FALSE(table.rows[3].enabled) << phase;
    EXPECT_TRUE(table.rows[4].enabled) << phase;
    EXPECT_EQ(table.bus.states[6].second.acknowledged_sequence, 6) << phase;
  }
}

TEST(EmulatorLoop, EndsWhenAskedTo) {
  Table table(1000);
  table.loop.should_stop = [&] { return table.rows.size() >= 5; };
  EXPECT_FALSE(table.loop.run());
  EXPECT_EQ(table.rows.size(), 5U);
}

TEST(EmulatorLoop, ABusThatRefusesTheDeviceIsAFailure) {
  Table table(5);
  table.bus.refuses = true;
  const Failure failed = table.loop.run();
  ASSERT_TRUE(failed);
  EXPECT_EQ(failed->kind, ErrorKind::kDevice);
}

TEST(EmulatorLog, ARowATickWithNumbersThatReadBack) {
  TickLog log;
  log.take({.time_us = 1000,
            .sequence = 1,
            .plugged = true,
            .enabled = false,
            .true_position_m = {0.03, 0.0},
            .force_n = {0.0, 0.0}});
  log.take({.time_us = 2000,
            .sequence = 2,
            .plugged = true,
            .enabled = true,
            .acknowledged = 7,
            .true_position_m = {0.1 + 0.2, -1e-9},
            .force_n = {-8.9, 1.5}});
  EXPECT_EQ(log.text(),
            "time_us,sequence,plugged,enabled,acknowledged,true_position_m,force_n,"
            "y_true_position_m,y_force_n\n"
            "1000,1,1,0,0,0.03,0,0,0\n"
            "2000,2,1,1,7,0.30000000000000004,-8.9,-1e-09,1.5\n");
}

}  // namespace
}  // namespace hapticwall::emulator
