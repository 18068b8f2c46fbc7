// Duty 7 of docs/hid-protocol.md: an invalid report changes nothing.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/device/emulator/emulator_support.h"

namespace hapticwall::device::hid {
namespace {

using testing::Bench;
using testing::kPushN;

struct BadCommand {
  std::string name;
  std::function<std::vector<std::uint8_t>(const ForceReport&)> bytes;
};

std::vector<std::uint8_t> sealed(const ForceReport& command,
                                 const std::function<void(ReportBytes&)>& change) {
  ReportBytes bytes = encode_force(command);
  change(bytes);
  seal(bytes);
  return {bytes.begin(), bytes.end()};
}
std::vector<std::uint8_t> changed(ForceReport command,
                                  const std::function<void(ForceReport&)>& change) {
  change(command);
  return sealed(command, [](ReportBytes&) {});
}
std::vector<std::uint8_t> resized(const ForceReport& command, std::size_t size) {
  std::vector<std::uint8_t> bytes = sealed(command, [](ReportBytes&) {});
  bytes.resize(size);
  return bytes;
}

std::vector<BadCommand> bad_commands() {
  using Bytes = ReportBytes;
  using Force = ForceReport;
  return {
      {"empty", [](const Force& c) { return resized(c, 0); }},
      {"short", [](const Force& c) { return resized(c, 63); }},
      {"long", [](const Force& c) { return resized(c, 65); }},
      {"all zero", [](const Force&) { return std::vector<std::uint8_t>(kReportBytes); }},
      {"id", [](const Force& c) { return sealed(c, [](Bytes& b) { b[0] = kStateId; }); }},
      {"crc",
       [](const Force& c) {
         auto bytes = resized(c, kReportBytes);
         bytes.back() ^= 1U;
         return bytes;
       }},
      {"reserved byte", [](const Force& c) { return sealed(c, [](Bytes& b) { b[40] = 1; }); }},
      {"reserved flag", [](const Force& c) { return sealed(c, [](Bytes& b) { b[1] |= 4U; }); }},
      {"no life", [](const Force& c) { return sealed(c, [](Bytes& b) { b[6] = 0; }); }},
      {"too long a life", [](const Force& c) { return sealed(c, [](Bytes& b) { b[6] = 101; }); }},
      {"enable and clear",
       [](const Force& c) { return changed(c, [](Force& f) { f.clear_faults = true; }); }},
      {"the sequence before",
       [](const Force& c) { return changed(c, [](Force& f) { --f.sequence; }); }},
      {"a sequence half a turn ahead",
       [](const Force& c) { return changed(c, [](Force& f) { f.sequence += 32768U - 1U; }); }},
      {"echo of the past",
       [](const Force& c) { return changed(c, [](Force& f) { f.echoed_state_sequence -= 21; }); }},
      {"echo of the future",
       [](const Force& c) { return changed(c, [](Force& f) { f.echoed_state_sequence += 1; }); }}};
}

TEST(EmulatorDuty, No7RejectedCommandsChangeNothing) {
  for (const BadCommand& bad : bad_commands()) {
    Bench bench;
    bench.ticks(300);
    bench.drive(kPushN, 5);
    const StateReport before = bench.state;
    ForceReport command = bench.next_command(-kPushN);
    ASSERT_TRUE(bench.device.write_output(bad.bytes(command)));
    bench.tick();
    EXPECT_EQ(bench.force_n(), kPushN) << bad.name;
    EXPECT_EQ(bench.state.rejected_commands, 1) << bad.name;
    EXPECT_TRUE(bench.has(kStatusCommandRejected)) << bad.name;
    EXPECT_EQ(bench.state.acknowledged_sequence, before.acknowledged_sequence) << bad.name;
    EXPECT_EQ(bench.state.acknowledged_time_us, before.acknowledged_time_us) << bad.name;
    // They renew neither the force nor the watchdog.
    for (int i = 0; i < 20; ++i) {
      command.echoed_state_sequence = bench.state.sequence;
      ASSERT_TRUE(bench.device.write_output(bad.bytes(command)));
      bench.tick();
    }
    EXPECT_EQ(bench.force_n(), 0.0) << bad.name;
    bench.ticks(30);
    EXPECT_TRUE(bench.has(kStatusWatchdog)) << bad.name;
    EXPECT_EQ(bench.state.rejected_commands, 21) << bad.name;
  }
}

TEST(EmulatorDuty, No7TheBitGoesWithTheNextCommandThatIsAccepted) {
  Bench bench;
  bench.tick();
  bench.device.write_output({});
  bench.tick();
  EXPECT_TRUE(bench.has(kStatusCommandRejected));
  bench.drive(kPushN);
  EXPECT_FALSE(bench.has(kStatusCommandRejected));
  EXPECT_EQ(bench.state.rejected_commands, 1);
}

TEST(EmulatorDuty, No7AnEchoAsOldAsTheTimeToLiveIsStillGood) {
  Bench bench;
  bench.ticks(300);
  ForceReport command = bench.next_command(kPushN);
  command.time_to_live_ms = 30;
  command.echoed_state_sequence = 270;
  bench.send(command);
  bench.tick();
  EXPECT_EQ(bench.force_n(), kPushN);
}

// A new session may start with any sequence once the previous one is over.
TEST(EmulatorDuty, No7ASessionMayBeginAnew) {
  Bench bench;
  bench.tick();
  bench.sequence = 5000;
  bench.drive(kPushN, 5);
  bench.sequence = 0;
  bench.drive(-kPushN);
  EXPECT_EQ(bench.force_n(), kPushN);  // the other one is still there
  bench.sequence = 0;
  bench.send_without_enable();
  bench.drive(-kPushN);
  EXPECT_EQ(bench.force_n(), -kPushN);
}

}  // namespace
}  // namespace hapticwall::device::hid
