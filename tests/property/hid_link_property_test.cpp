// Whatever goes wrong and whatever the loop asks for: every report that leaves the host is one of
// the protocol, within the limit, and without force and enable while nobody asked for it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/device/link/link_rig.h"

namespace hapticwall::device {
namespace {

using hid::Fault;
using hid::FaultKind;
using hid::FaultScript;
using testing::kMillisecondUs;
using testing::Rig;

constexpr std::uint64_t kRunMs = 1500;

FaultScript random_script() {
  std::vector<Fault> faults(*rc::gen::inRange<std::size_t>(0, 6));
  for (Fault& fault : faults) {
    fault.kind = static_cast<FaultKind>(*rc::gen::inRange(0, static_cast<int>(hid::kFaultKinds)));
    fault.begin_us = *rc::gen::inRange<std::uint64_t>(0, 1000 * kMillisecondUs);
    fault.duration_us = *rc::gen::inRange<std::uint64_t>(0, 400 * kMillisecondUs);
    fault.every = *rc::gen::inRange<std::uint32_t>(1, 5);
  }
  return FaultScript(faults);
}

double random_force() {
  if (*rc::gen::inRange(0, 4) != 0) return *rc::gen::inRange(-20000, 20000) / 1e3;
  return std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
}

// The device's, where it has told it, and the file's.
double limit_of(const Rig& rig, const ImpulseEngineOptions& options) {
  const auto described = rig.host.owner.description();
  if (!described) return 0.0;
  double limit_n = hid::kMaxForceN;
  if (described->describes_itself) limit_n = std::min(limit_n, hid::testing::kLimitN);
  if (options.axes[0]) limit_n = std::min(limit_n, options.axes[0]->force_limit_n);
  return limit_n;
}

// The host's own troubles: stalls, and a bus that loses its power or its patience.
void disturb(Rig& rig) {
  const auto now_and_then = [](int one_in) { return *rc::gen::inRange(0, one_in) == 0; };
  rig.host.armed = !now_and_then(4);
  rig.host.behaviour.force_n = {random_force(), random_force()};
  rig.host.behaviour.disarms = !now_and_then(3);
  rig.host.stalled = now_and_then(12);
  rig.host.loop_stalled = now_and_then(12);
  rig.host.reader_stalled = now_and_then(12);
  rig.plug.hidden = now_and_then(10);
  rig.plug.writes_hang = now_and_then(10);
}

RC_GTEST_PROP(HidLinkProperty, WhatLeavesTheHostIsAlwaysAllowedTo, ()) {
  ImpulseEngineOptions options;
  if (*rc::gen::arbitrary<bool>()) {
    options.axes[0] = AxisDescription{1e-4, *rc::gen::inRange(1, 20'000'000) / 1e6};
  }
  Rig rig(random_script(), options);
  rig.plug.bridged = *rc::gen::arbitrary<bool>();
  rig.plug.tells_empty = *rc::gen::arbitrary<bool>();
  int reports = 0;
  int enabled = 0;
  std::uint16_t previous = 0;
  rig.host.on_report = [&](const hid::ReportBytes& bytes) {
    const auto decoded = hid::decode_force(bytes);
    RC_ASSERT(decoded.report() != nullptr);
    const hid::ForceReport& report = *decoded.report();
    ++reports;
    RC_ASSERT(report.sequence == 1 || report.sequence == previous + 1);
    if (report.sequence == 1) RC_ASSERT(!report.enable);
    previous = report.sequence;
    RC_ASSERT(std::abs(report.force_n[0]) <= limit_of(rig, options));  // false for NaN
    RC_ASSERT(report.force_n[1] == 0.0);                               // there is no second axis
    if (!report.enable) RC_ASSERT(report.force_n[0] == 0.0);
    if (!report.enable) return;
    ++enabled;
    RC_ASSERT(rig.host.asked);
    RC_ASSERT(rig.host.last.state == DeviceState::kOk);
    RC_ASSERT(!report.clear_faults);
    for (const double force_n : rig.host.commanded_n) RC_ASSERT(std::isfinite(force_n));
  };
  while (rig.host.now_us() < kRunMs * kMillisecondUs) {
    disturb(rig);
    const int ticks = *rc::gen::inRange(1, 60);
    for (int i = 0; i < ticks; ++i) {
      rig.host.tick();
      RC_ASSERT(std::abs(rig.force_n()) <= hid::testing::kLimitN);
    }
  }
  RC_ASSERT(rig.host.port->never_listed == 0);
  RC_ASSERT(rig.bus.open_handles() <= 6U);
  RC_CLASSIFY(reports > 500, "many reports");
  RC_CLASSIFY(enabled > 100, "with force");
}

}  // namespace
}  // namespace hapticwall::device
