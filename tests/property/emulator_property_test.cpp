// Whatever goes wrong and whatever the host sends: the force of the emulated device keeps to its
// limits and to the time promised, and nothing in it depends on anything but the calls.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/device/emulator/emulator_support.h"

namespace hapticwall::device::hid {
namespace {

using testing::kLimitN;
using testing::kMillisecondUs;

// A firmware that hangs holds its force until the watchdog in hardware strikes; the command before
// may have been as old as it may live.
constexpr std::uint64_t kMaxForceUs = (kMaxTimeToLiveMs + 50 + 1) * kMillisecondUs;

EmulatorSettings settings() {
  EmulatorSettings settings = testing::one_axis();
  settings.axes[0].x().hand->path = {{0.0, 0.03}, {0.1, 0.05}};
  return settings;
}

FaultScript random_script() {
  std::vector<Fault> faults(*rc::gen::inRange<std::size_t>(0, 6));
  for (Fault& fault : faults) {
    fault.kind = static_cast<FaultKind>(*rc::gen::inRange(0, static_cast<int>(kFaultKinds)));
    fault.begin_us = *rc::gen::inRange<std::uint64_t>(0, 400 * kMillisecondUs);
    fault.duration_us = *rc::gen::inRange<std::uint64_t>(0, 200 * kMillisecondUs);
    fault.every = *rc::gen::inRange<std::uint32_t>(1, 5);
  }
  return FaultScript(faults);
}

ForceReport random_command(std::uint16_t& sequence, const StateReport& state) {
  ForceReport command;
  command.enable = *rc::gen::inRange(0, 10) != 0;
  command.clear_faults = *rc::gen::inRange(0, 10) == 0;
  command.sequence = ++sequence;
  command.echoed_state_sequence = state.sequence;
  command.time_to_live_ms = *rc::gen::inRange<std::uint16_t>(0, 120);
  const auto bits = *rc::gen::arbitrary<std::uint64_t>();
  command.force_n = {*rc::gen::inRange(0, 3) == 0 ? std::bit_cast<double>(bits)
                                                  : *rc::gen::inRange(-20000, 20000) / 1e3,
                     1.0};
  return command;
}

RC_GTEST_PROP(EmulatorProperty, TheForceKeepsItsLimitsWhateverHappens, ()) {
  const FaultScript script = random_script();
  FirmwareEmulator device(settings(), script);
  StateReport state;
  std::uint16_t sequence = *rc::gen::arbitrary<std::uint16_t>();
  std::optional<std::uint64_t> last_enabled_us;
  bool force_seen = false;
  while (device.now_us() < 600 * kMillisecondUs) {
    device.step(*rc::gen::inRange<std::uint64_t>(100, 4000));
    while (const auto report = device.take_input()) {
      const auto decoded = decode_state(report->view());
      if (decoded.report() != nullptr) state = *decoded.report();
    }
    const auto [force_n, second_n] = device.amplifier_force_n();
    RC_ASSERT(std::abs(force_n) <= kLimitN);  // false for NaN
    RC_ASSERT(second_n == 0.0);
    if (force_n != 0.0) {
      force_seen = true;
      RC_ASSERT(last_enabled_us.has_value());
      RC_ASSERT(device.now_us() - *last_enabled_us <= kMaxForceUs);
    }
    if (*rc::gen::inRange(0, 20) == 0) sequence = *rc::gen::arbitrary<std::uint16_t>();
    const ForceReport command = random_command(sequence, state);
    ReportBytes bytes = encode_force(command);
    const bool spoilt = *rc::gen::inRange(0, 10) == 0;
    if (spoilt) bytes.at(*rc::gen::inRange<std::size_t>(0, kReportBytes)) ^= 0x10U;
    if (device.write_output(bytes) && command.enable && !spoilt) last_enabled_us = device.now_us();
  }
  RC_CLASSIFY(force_seen, "with force");
}

}  // namespace
}  // namespace hapticwall::device::hid
